// SPDX-License-Identifier: GPL-3.0-or-later
// node outfits.mjs [--tops A,B] [--bottoms C,D] [--modes over,tucked] [--keep FOLDER] FOLDER...: lays every top over or
// under every bottom of finished catalogues (FOLDER/SKU/garment.glb, dressed.glb) and measures the files that come out,
// with three-mesh-bvh and nothing of what laid them together. Fails beyond the bars below.
import { mkdir, readFile, readdir, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import validator from 'gltf-validator';
import { BufferAttribute, BufferGeometry, DoubleSide, Ray, Vector3 } from 'three';
import { MeshBVH } from 'three-mesh-bvh';
import { composeOutfit } from '../../showroom/web/outfit.js';

// Edges that lay across a fold grow short where a tucked top is drawn in flat: shorter is no tear.
const BARS = { cloth_mm: 1, body_mm: 0.5, longer: 1.25, shorter: 0.2 };
const FINE = 0.004; // [m] between the points of a triangle that are looked at
const NEAR = 0.08; // [m] an outer cloth is looked for this far off

/** The meshes of a GLB: name -> {positions, triangles}. */
function meshesOf(glb) {
  const view = new DataView(glb.buffer, glb.byteOffset), size = view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(glb.subarray(20, 20 + size)));
  const numbers = (index, kind) => {
    const a = json.accessors[index], v = json.bufferViews[a.bufferView], n = a.count * (a.type === 'VEC3' ? 3 : 1);
    const start = 28 + size + (v.byteOffset ?? 0) + (a.byteOffset ?? 0);
    return new kind(glb.slice(start, start + n * kind.BYTES_PER_ELEMENT).buffer);
  };
  const found = new Map();
  for (const node of json.nodes) {
    const [p] = json.meshes[node.mesh].primitives;
    const kind = json.accessors[p.indices].componentType === 5123 ? Uint16Array : Uint32Array;
    found.set(node.name, { positions: numbers(p.attributes.POSITION, Float32Array), triangles: numbers(p.indices, kind) });
  }
  return { json, found };
}

/** A surface that can be asked for its nearest point and for what a ray meets. */
class Surface {
  constructor({ positions, triangles }) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    geometry.setIndex(new BufferAttribute(triangles.slice(), 1));
    this.bvh = new MeshBVH(geometry);
    this.hit = {};
  }
  nearest(p) {
    return this.bvh.closestPointToPoint(p, this.hit);
  }
  /** Whether a ray meets it within `far`. */
  met(from, direction, far) {
    return this.bvh.raycastFirst(new Ray(from, direction), DoubleSide, 1e-6, far) !== null;
  }
  /** Of a closed surface: odd crossings along two of three slanted rays. */
  contains(p) {
    const slants = [new Vector3(0.31, 0.92, 0.24), new Vector3(-0.83, 0.41, 0.37), new Vector3(0.12, -0.35, 0.93)];
    return slants.filter((d) => this.bvh.raycast(new Ray(p, d.normalize()), DoubleSide).length % 2).length >= 2;
  }
}

/** Calls `look` with points all over a mesh between two heights. */
function over({ positions: p, triangles }, low, high, look) {
  const corners = [new Vector3(), new Vector3(), new Vector3()], point = new Vector3();
  for (let t = 0; t < triangles.length; t += 3) {
    corners.forEach((c, i) => c.fromArray(p, 3 * triangles[t + i]));
    if (corners.every((c) => c.y < low) || corners.every((c) => c.y > high)) continue;
    const [a, b, c] = corners;
    const n = Math.ceil(Math.max(a.distanceTo(b), b.distanceTo(c), c.distanceTo(a)) / FINE) || 1;
    for (let i = 0; i <= n; ++i)
      for (let j = 0; i + j <= n; ++j)
        look(point.set(0, 0, 0).addScaledVector(a, i / n).addScaledVector(b, j / n).addScaledVector(c, 1 - (i + j) / n));
  }
}

/** How deep points of the outer cloth lie under the inner one, and of the inner one above the outer one [m]. */
function through(outer, inner, body, low, high) {
  const [o, i, solid] = [outer, inner, body].map((m) => new Surface(m)), away = new Vector3();
  const worst = { depth: 0, at: null, points: 0 };
  const note = (p, depth) => {
    if (depth > 1e-3) ++worst.points;
    if (depth > worst.depth) [worst.depth, worst.at] = [depth, p.toArray().map((x) => +x.toFixed(3))];
  };
  over(outer, low, high, (p) => {
    const near = solid.nearest(p);
    away.subVectors(p, near.point).normalize();
    const within = i.nearest(p);
    // Only what lies outwards from here and is no fold's other side: between it and this point there is no cloth.
    if (within.distance > 1e-5 && within.distance > worst.depth && i.met(p, away, NEAR)) note(p, i.nearest(p).distance);
  });
  over(inner, low, high, (p) => {
    const near = solid.nearest(p), far = near.distance;
    away.subVectors(near.point, p).normalize();
    if (far > 1e-5 && o.nearest(p).distance > worst.depth && o.met(p, away, far)) note(p, o.nearest(p).distance);
  });
  return worst;
}

/** How deep a cloth's points lie in the body [m]. */
function inBody(cloth, body, low, high) {
  const solid = new Surface(body);
  let worst = 0;
  over(cloth, low, high, (p) => {
    const { distance } = solid.nearest(p);
    if (distance > worst && distance < 0.03 && solid.contains(p)) worst = distance;
  });
  return worst;
}

/** The largest and the smallest ratio of an edge's length to what it was, of edges that are still there. */
function stretch(now, before) {
  let longer = 1, shorter = 1, lost = 0;
  const length = (p, a, b) => Math.hypot(p[3 * a] - p[3 * b], p[3 * a + 1] - p[3 * b + 1], p[3 * a + 2] - p[3 * b + 2]);
  for (let t = 0; t < now.triangles.length; t += 3)
    for (let i = 0; i < 3; ++i) {
      const a = now.triangles[t + i], b = now.triangles[t + ((i + 1) % 3)], was = length(before.positions, a, b);
      if (was < 1e-4) continue;
      const ratio = length(now.positions, a, b) / was;
      longer = Math.max(longer, ratio);
      shorter = Math.min(shorter, ratio);
    }
  // What was one point is one point: a seam that opened would be a tear.
  const together = new Map();
  for (let v = 0; v < before.positions.length / 3; ++v) {
    const key = before.positions.slice(3 * v, 3 * v + 3).join(), first = together.get(key);
    if (first === undefined) together.set(key, v);
    else if (now.positions.slice(3 * v, 3 * v + 3).join() !== now.positions.slice(3 * first, 3 * first + 3).join()) ++lost;
  }
  return { longer, shorter, lost };
}

const heights = ({ positions }) => {
  const y = positions.filter((_, i) => i % 3 === 1);
  return [y.reduce((a, b) => Math.min(a, b)), y.reduce((a, b) => Math.max(a, b))];
};

async function check(folder, top, bottom, mode, keep) {
  const read = async (sku, name) => new Uint8Array(await readFile(join(folder, sku, name)));
  const [dressed, garment] = [await read(bottom, 'dressed.glb'), await read(top, 'garment.glb')];
  const start = process.cpuUsage();
  const glb = await composeOutfit({ dressed, garment, mode });
  const spent = process.cpuUsage(start), cpu = (spent.user + spent.system) / 1000;
  if (keep) await writeFile(join(keep, `${top}_${bottom}_${mode}.glb`), glb);
  const { json, found } = meshesOf(glb), names = json.nodes.map((n) => n.name);
  const pick = (name, from) => [...from.entries()].find(([n]) => n === name)?.[1];
  const before = { top: pick(`garment_${top}`, meshesOf(garment).found), bottom: pick(`garment_${bottom}`, meshesOf(dressed).found) };
  const now = { top: pick(`garment_${top}`, found), bottom: pick(`garment_${bottom}`, found) }, body = found.get('mannequin');
  const faults = [];
  if (names.length !== 3 || !now.top || !now.bottom || !body) return [[`nodes ${names}`], 0, ''];
  const [outer, inner] = mode === 'over' ? [now.top, now.bottom] : [now.bottom, now.top];
  const band = heights(now.bottom)[1], hem = heights(before.top)[0];
  const worst = through(outer, inner, body, hem - 0.02, band + 0.005);
  const [bareOuter, bareInner] = mode === 'over' ? [before.top, before.bottom] : [before.bottom, before.top];
  const bare = through(bareOuter, bareInner, body, hem - 0.02, band + 0.005);
  const deep = Math.max(inBody(now.top, body, hem, band + 0.1), inBody(now.bottom, body, hem, band));
  const was = Math.max(inBody(before.top, body, hem, band + 0.1), inBody(before.bottom, body, hem, band));
  const edges = [stretch(now.top, before.top), stretch(now.bottom, before.bottom)];
  const longer = Math.max(...edges.map((e) => e.longer)), shorter = Math.min(...edges.map((e) => e.shorter));
  const { issues } = await validator.validateBytes(glb, { maxIssues: 20 });
  const expect = (good, what) => good || faults.push(what);
  expect(1e3 * worst.depth <= BARS.cloth_mm, `cloth through cloth by ${(1e3 * worst.depth).toFixed(2)} mm at ${worst.at}`);
  expect(1e3 * deep <= Math.max(BARS.body_mm, 1e3 * was), `${(1e3 * deep).toFixed(2)} mm in the body`);
  expect(longer <= BARS.longer, `an edge is ${longer.toFixed(2)} times as long`);
  expect(shorter >= BARS.shorter, `an edge is ${shorter.toFixed(2)} times as long`);
  expect(edges.every((e) => e.lost === 0), 'a seam has opened');
  expect(issues.numErrors + issues.numWarnings + issues.numInfos === 0, `glTF: ${issues.messages.map((m) => `${m.code} ${m.pointer}`).join(', ')}`);
  const figures = [1e3 * worst.depth, 1e3 * bare.depth, 1e3 * deep, 1e3 * was, json.asset.extras.outfit.moved_mm, longer, shorter, cpu];
  return [faults, bare.depth, figures.map((f, i) => f.toFixed(i === 7 ? 0 : 2).padStart(7)).join(' ')];
}

const args = process.argv.slice(2);
const option = (name) => {
  const at = args.indexOf(`--${name}`);
  return at < 0 ? null : args.splice(at, 2)[1];
};
const only = { top: option('tops')?.split(','), bottom: option('bottoms')?.split(',') };
const modes = (option('modes') ?? 'over,tucked').split(','), keep = option('keep');
if (args.length === 0) {
  console.error('usage: node outfits.mjs [--tops A,B] [--bottoms C,D] [--modes over,tucked] [--keep FOLDER] FOLDER...');
  process.exit(64);
}
if (keep) await mkdir(keep, { recursive: true });
let failed = 0, pairs = 0, clashes = 0;
console.log('cloth through cloth mm, (as draped), cloth in the body mm, (as draped), moved mm, longest, shortest edge / before, composing ms of processor');
for (const folder of args) {
  const skus = { top: [], bottom: [] };
  for (const sku of (await readdir(folder)).sort()) {
    const glb = await readFile(join(folder, sku, 'garment.glb')).catch(() => null);
    if (!glb) continue;
    const { garment } = meshesOf(new Uint8Array(glb)).json.asset.extras;
    const role = /^(skirt|trousers|shorts)$/.test(garment) ? 'bottom' : /^dress/.test(garment) ? null : 'top';
    if (role && (!only[role] || only[role].includes(sku))) skus[role].push(sku);
  }
  for (const top of skus.top)
    for (const bottom of skus.bottom)
      for (const mode of modes) {
        const [faults, bare, line] = await check(folder, top, bottom, mode, keep);
        ++pairs;
        clashes += 1e3 * bare > BARS.cloth_mm;
        failed += faults.length > 0;
        console.log(`${faults.length ? 'FAILED' : 'ok    '} ${line} ${folder} ${top} ${mode} ${bottom}`);
        for (const fault of faults) console.log(`         ${fault}`);
      }
}
console.log(`${pairs} outfits, ${clashes} of them would clash as they were draped, ${failed} failed`);
// Garments draped each for itself on one body do clash: where none is seen to, the measuring is blind.
process.exit(failed === 0 && clashes > 0 ? 0 : 1);

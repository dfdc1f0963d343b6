// SPDX-License-Identifier: GPL-3.0-or-later
// A top and a bottom worn together: two models that were draped on the same mannequin, each for itself, laid into one
// file with the cloth of the outer one moved off the inner one. Works in browsers and in node, without any library.
import { Envelope, polar } from './envelope.js';
import { OutfitError, append, meshOf, putMesh, readGlb, writeGlb } from './glb.js';
import { Cloth } from './layers.js';

export { OutfitError };

/** What the garment types that come with Vitrine are in an outfit. */
const ROLES = {
  vest: 'top', t_shirt: 'top', long_sleeve: 'top',
  skirt: 'bottom', trousers: 'bottom', shorts: 'bottom',
  dress: 'whole', dress_short_sleeve: 'whole', dress_long_sleeve: 'whole',
};

// All in metres.
const GAP_OVER = 0.0025; // between a top and the bottom that it hangs over
const GAP_BODY = 0.002; // between the body and a top that is tucked in
const GAP_BAND = 0.0015; // between that top and the band over it
const FADE = 0.12; // a top is moved up to this far above the band
const BULGE = 0.11; // above the band within which a tucked top comes in
const SLACK = 1.12; // times its length, an edge of a top that is drawn in gives way
const HIDDEN = 0.03; // below the band's edge nobody sees a tucked top
const HELD = 0.12; // a band is moved down to this far below its edge

function roleOf(glb, said, what) {
  const id = glb.json.asset?.extras?.garment, role = said ?? ROLES[id];
  if (role === 'top' || role === 'bottom') return role;
  if (role === 'whole') throw new OutfitError('NO_PAIR', `${what} (${id}) covers the body above and below: it is worn by itself.`);
  throw new OutfitError('UNKNOWN_GARMENT', `${what} (${id ?? 'no garment named'}) is not known as a top or a bottom: say which in \`roles\`.`);
}

/** Both files have to be of one body in one place: that is what the mannequin's hash says. */
function checkSameBody(a, b) {
  const [p, q] = [a, b].map((glb) => glb.json.asset?.extras ?? {});
  for (const [glb, extras] of [[a, p], [b, q]])
    if (!extras.mannequin_sha256)
      throw new OutfitError('NO_MANNEQUIN', `${glb.what} does not say which mannequin it was draped on: convert it again.`);
  if (p.mannequin_sha256 !== q.mannequin_sha256)
    throw new OutfitError('OTHER_MANNEQUIN',
      `${a.what} and ${b.what} were draped on different mannequins (${sizeOf(p)} and ${sizeOf(q)}): use two of the same size.`);
}

const sizeOf = ({ mannequin, mannequin_mm: mm }) => `${mannequin}, bust ${mm?.bust} mm, height ${mm?.height} mm`;

/** The upright axis through the bottom's band, which encloses it at every height. */
function axisOf(bottom) {
  const { high } = bottom.heights(), p = bottom.positions, low = [Infinity, Infinity], far = [-Infinity, -Infinity];
  for (let v = 0; v < p.length; v += 3) {
    if (p[v + 1] < high - 0.1) continue;
    [p[v], p[v + 2]].forEach((x, i) => {
      low[i] = Math.min(low[i], x);
      far[i] = Math.max(far[i], x);
    });
  }
  return { x: (low[0] + far[0]) / 2, z: (low[1] + far[1]) / 2 };
}

const all = (mark) => (a, b, c) => mark[a] && mark[b] && mark[c];
const byPoint = (cloth, mark) => all(Uint8Array.from(cloth.points.of, (g) => mark[g]));
const pick = (cloth, test) => Uint8Array.from({ length: cloth.points.count }, (_, v) => (test(v) ? 1 : 0));

/** The top hangs over the bottom's band: its cloth is moved out. */
function wearOver(top, bottom, axis) {
  const band = bottom.heights().high, low = top.heights().low;
  if (low >= band) return { most: 0, short: 0 };
  const trunk = top.roundTheAxis(axis, band + 0.03);
  const under = new Envelope(axis, low - 0.02, band).add(bottom.mesh.positions, bottom.mesh.triangles, () => true).close();
  const free = pick(top, (v) => trunk[v] || (top.positions[3 * v + 1] >= band + 0.03 && top.positions[3 * v + 1] < band + FADE));
  return top.pushOut(under, GAP_OVER, trunk, free);
}

/**
 * The top goes under the band: drawn in to the body, taken out where nobody sees it, and the band moved off it where the
 * body leaves too little room.
 */
function tuckIn(top, bottom, axis, body) {
  const band = bottom.heights().high, low = top.heights().low;
  if (low >= band) return { most: 0, short: 0 };
  const edge = new Envelope(axis, bottom.heights().low, band).add(bottom.mesh.positions, bottom.mesh.triangles, () => true).upperEdge();
  const trunk = top.roundTheAxis(axis, band + 0.03), near = top.roundTheAxis(axis, band + BULGE);
  const room = new Envelope(axis, low - 0.02, band + BULGE)
    .add(body.mesh.positions, body.mesh.triangles, byPoint(body, body.roundTheAxis(axis, band + BULGE + 0.03)))
    .close();
  const p = top.positions, hidden = new Uint8Array(top.points.count);
  const columnOf = (v) => polar(axis, p[3 * v], p[3 * v + 2]);
  const above = (v, column) => p[3 * v + 1] - edge[Math.floor(column) % edge.length];
  const edges = top.edges();
  // Cloth that goes in has a longer way to go: it comes from below the band, where it has been pulled in too. Drawing in
  // and giving way by turns ends with both.
  for (let round = 0; round < 6; ++round) {
    for (let v = 0; v < top.points.count; ++v) {
      const at = columnOf(v), reach = near[v] ? room.at(p[3 * v + 1], at.column) : 0;
      if (reach === 0 || at.r <= reach + GAP_BODY) continue;
      const t = Math.min(1, Math.max(0, (above(v, at.column) - 0.01) / (BULGE - 0.01)));
      // From the second round on only what is under the band is drawn in again.
      const share = round === 0 ? 1 - t * t * (3 - 2 * t) : t === 0 ? 1 : 0;
      top.moveOut(v, axis, -share * (at.r - reach - GAP_BODY));
    }
    top.slacken(edges, SLACK, near, 12);
  }
  for (let v = 0; v < top.points.count; ++v) hidden[v] = near[v] && above(v, columnOf(v).column) < -HIDDEN ? 1 : 0;
  top.leaveOut(hidden);
  top.pushOut(room, GAP_BODY / 2, trunk, near);
  const positions = top.write().positions;
  const inner = new Envelope(axis, low - 0.02, band).add(positions, top.mesh.triangles, byPoint(top, trunk)).close();
  const q = bottom.positions;
  const held = pick(bottom, (v) => q[3 * v + 1] > band - HIDDEN - 2 * HELD);
  return bottom.pushOut(inner, GAP_BAND, held, held);
}

/**
 * Lays a dressed model and another item's garment, draped on the same mannequin, into one model.
 * `dressed`, `garment`: two GLBs as ArrayBuffer or Uint8Array. `mode`: 'over', the top hangs over the bottom's waistband,
 * or 'tucked', it goes under. `roles` ({dressed, garment}: 'top' or 'bottom') says what garment types of others are;
 * `decoder`, meshoptimizer's MeshoptDecoder, lets compressed files in. Gives the GLB's bytes: mannequin and both
 * garments, pictures as they were.
 * Throws OutfitError with a `code`: NOT_A_GLB, COMPRESSED, NO_MANNEQUIN, OTHER_MANNEQUIN, NO_PAIR, UNKNOWN_GARMENT, BAD_MODE.
 */
export async function composeOutfit({ dressed, garment, mode = 'over', roles = {}, decoder }) {
  if (mode !== 'over' && mode !== 'tucked')
    throw new OutfitError('BAD_MODE', `"${mode}" is no way to wear a top: it is 'over' or 'tucked'.`);
  const first = await readGlb(dressed, 'The dressed model', decoder);
  const second = await readGlb(garment, 'The other garment', decoder);
  const role = { first: roleOf(first, roles.dressed, first.what), second: roleOf(second, roles.garment, second.what) };
  if (role.first === role.second)
    throw new OutfitError('NO_PAIR', `Both garments are a ${role.first}: an outfit is a top and a bottom.`);
  checkSameBody(first, second);
  const meshes = [meshOf(first, 'garment'), meshOf(second, 'garment'), meshOf(first, 'mannequin')];
  if (!meshes[0] || !meshes[1]) throw new OutfitError('NOT_A_GLB', 'One of the two models has no garment.');
  if (!meshes[2]) throw new OutfitError('NO_MANNEQUIN', 'The dressed model has no mannequin: give dressed.glb for it.');
  const [a, b, body] = meshes.map((mesh) => new Cloth(mesh));
  const [top, bottom] = role.first === 'top' ? [a, b] : [b, a];
  const axis = axisOf(bottom);
  const { most } = mode === 'over' ? wearOver(top, bottom, axis) : tuckIn(top, bottom, axis, body);
  putMesh(first, a.write());
  putMesh(second, b.write());

  const [p, q] = [first, second].map((glb) => glb.json.asset);
  const extras = { top: p.extras, bottom: q.extras };
  if (role.first === 'bottom') [extras.top, extras.bottom] = [q.extras, p.extras];
  const { mannequin, mannequin_mm, mannequin_sha256 } = p.extras;
  p.extras = { outfit: { mode, moved_mm: Math.round(1e4 * most) / 10, ...extras }, mannequin, mannequin_mm, mannequin_sha256 };
  const rights = [...new Set([p.copyright, q.copyright].filter(Boolean))];
  if (rights.length > 0) p.copyright = rights.join('; ');
  append(first, second);
  return writeGlb(first);
}

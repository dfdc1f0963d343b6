// SPDX-License-Identifier: GPL-3.0-or-later
// Binary glTF as Vitrine writes it: read, looked into, laid together, written. Pictures and indices pass through as
// the bytes that they are. Works in browsers and in node, without any library.

const MAGIC = 0x46546c67, JSON_CHUNK = 0x4e4f534a, BIN_CHUNK = 0x004e4942;
const FLOAT = 5126, INDEX_ARRAYS = { 5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array };
const MESHOPT = 'EXT_meshopt_compression';
const padded = (n) => (n + 3) & ~3;

/** What this module and its callers throw: `code` for programs, the message for people. */
export class OutfitError extends Error {
  constructor(code, message) {
    super(message);
    this.name = 'OutfitError';
    this.code = code;
  }
}

function fail(what, why) {
  throw new OutfitError('NOT_A_GLB', `${what} is no binary glTF that Vitrine wrote: ${why}.`);
}

/**
 * Reads a GLB. `what` names it in messages; `decoder` is meshoptimizer's MeshoptDecoder, asked only where views are
 * compressed. Returns {json, views}: the glTF without its buffers, and for each buffer view its bytes.
 * Throws OutfitError NOT_A_GLB, COMPRESSED.
 */
export async function readGlb(data, what, decoder) {
  // Node's Buffers are such arrays too, but copy in another way.
  const bytes = ArrayBuffer.isView(data) ? new Uint8Array(data.buffer, data.byteOffset, data.byteLength) : new Uint8Array(data);
  const words = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 28 || words.getUint32(0, true) !== MAGIC || words.getUint32(4, true) !== 2)
    fail(what, 'its header is not that of one');
  if (words.getUint32(8, true) !== bytes.length) fail(what, 'its length is not the one that it states');
  const jsonSize = words.getUint32(12, true);
  if (words.getUint32(16, true) !== JSON_CHUNK || jsonSize > bytes.length - 28) fail(what, 'it has no JSON chunk');
  const at = 20 + jsonSize, size = words.getUint32(at, true);
  if (words.getUint32(at + 4, true) !== BIN_CHUNK || size > bytes.length - at - 8) fail(what, 'it has no binary chunk');
  const binary = bytes.subarray(at + 8, at + 8 + size);
  let json;
  try {
    json = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(bytes.subarray(20, at)));
  } catch {
    fail(what, 'its JSON cannot be read');
  }
  for (const list of ['bufferViews', 'accessors', 'meshes', 'nodes', 'scenes'])
    if (!Array.isArray(json[list]) || json[list].length === 0) fail(what, `it has no ${list}`);
  const slice = (offset = 0, length = 0) => {
    if (!(offset >= 0 && length >= 0 && offset + length <= binary.length)) fail(what, 'a view lies outside its buffer');
    return binary.subarray(offset, offset + length);
  };
  const views = [];
  for (const view of json.bufferViews) {
    const packed = view.extensions?.[MESHOPT];
    if (!packed) {
      views.push(slice(view.byteOffset, view.byteLength));
      continue;
    }
    if (!decoder)
      throw new OutfitError('COMPRESSED', `${what} is compressed (${MESHOPT}): give its plain file, or pass a decoder.`);
    await decoder.ready;
    const target = new Uint8Array(packed.count * packed.byteStride);
    decoder.decodeGltfBuffer(target, packed.count, packed.byteStride, slice(packed.byteOffset, packed.byteLength),
      packed.mode, packed.filter);
    views.push(target);
    delete view.extensions;
  }
  for (const list of ['extensionsUsed', 'extensionsRequired']) {
    const others = (json[list] ?? []).filter((e) => e !== MESHOPT);
    if (list === 'extensionsRequired' && others.length > 0) fail(what, `it needs ${others.join(', ')}`);
    if (others.length > 0) json[list] = others;
    else delete json[list];
  }
  delete json.buffers;
  return { json, views, what };
}

/** An accessor's numbers as a typed array of its own; vectors one after the other. */
function numbersOf(glb, index, parts) {
  const { json, views, what } = glb, a = json.accessors[index];
  const type = parts === 1 ? 'SCALAR' : `VEC${parts}`, kind = parts === 1 ? INDEX_ARRAYS[a?.componentType] : Float32Array;
  if (!a || a.type !== type || !kind || (parts > 1 && a.componentType !== FLOAT))
    fail(what, `accessor ${index} is no ${type} of the kind that is written`);
  const view = views[a.bufferView], start = a.byteOffset ?? 0, size = a.count * parts * kind.BYTES_PER_ELEMENT;
  const stride = json.bufferViews[a.bufferView]?.byteStride ?? parts * kind.BYTES_PER_ELEMENT;
  if (!view || stride !== parts * kind.BYTES_PER_ELEMENT || start + size > view.length)
    fail(what, `accessor ${index} does not lie in its view`);
  return new kind(view.slice(start, start + size).buffer);
}

/**
 * The one mesh of the node whose name begins with `prefix`: {name, positions, normals (x y z each, metres),
 * triangles (three indices each), accessors}; null where there is none.
 */
export function meshOf(glb, prefix) {
  const { json, what } = glb;
  const node = json.nodes.find((n) => n.name === prefix || n.name?.startsWith(`${prefix}_`));
  if (!node) return null;
  if (node.children || node.matrix || node.translation || node.rotation || node.scale)
    fail(what, `node ${node.name} is not in the mannequin's frame`);
  const primitives = json.meshes[node.mesh]?.primitives;
  if (primitives?.length !== 1 || primitives[0].indices === undefined) fail(what, `node ${node.name} is not one mesh`);
  const [p] = primitives, { POSITION, NORMAL } = p.attributes;
  const positions = numbersOf(glb, POSITION, 3), normals = numbersOf(glb, NORMAL, 3);
  const triangles = numbersOf(glb, p.indices, 1), count = positions.length / 3;
  if (normals.length !== positions.length || triangles.length % 3 || triangles.some((v) => v >= count))
    fail(what, `node ${node.name} has triangles of points that do not exist`);
  return { name: node.name, positions, normals, triangles, accessors: { POSITION, NORMAL, indices: p.indices } };
}

/** Puts a mesh's positions, normals and triangles back, with the accessors' bounds. */
export function putMesh(glb, mesh) {
  const { json, views } = glb;
  const put = (index, numbers, parts) => {
    const a = json.accessors[index];
    const view = views.length;
    views.push(new Uint8Array(numbers.buffer, numbers.byteOffset, numbers.byteLength));
    json.bufferViews.push({ ...json.bufferViews[a.bufferView], byteLength: numbers.byteLength });
    a.bufferView = view;
    a.count = numbers.length / parts;
    delete a.byteOffset;
    return a;
  };
  const { POSITION, NORMAL, indices } = mesh.accessors;
  const a = put(POSITION, mesh.positions, 3);
  a.min = [Infinity, Infinity, Infinity];
  a.max = [-Infinity, -Infinity, -Infinity];
  mesh.positions.forEach((v, i) => {
    a.min[i % 3] = Math.min(a.min[i % 3], v);
    a.max[i % 3] = Math.max(a.max[i % 3], v);
  });
  put(NORMAL, mesh.normals, 3);
  put(indices, mesh.triangles, 1);
}

const shifted = (index, by) => (index === undefined ? undefined : index + by);

/** Adds all of `more` to `glb`: its views, meshes, materials and pictures, and its nodes to the scene. */
export function append(glb, more) {
  const { json } = glb, from = (list) => (json[list] ??= []).length;
  const base = Object.fromEntries(
    ['bufferViews', 'accessors', 'images', 'samplers', 'textures', 'materials', 'meshes', 'nodes'].map((l) => [l, from(l)]),
  );
  const add = (list, change) => {
    for (const item of more.json[list] ?? []) json[list].push(change(structuredClone(item)));
  };
  glb.views.push(...more.views);
  add('bufferViews', (v) => v);
  add('accessors', (a) => ({ ...a, bufferView: shifted(a.bufferView, base.bufferViews) }));
  add('images', (i) => ({ ...i, bufferView: shifted(i.bufferView, base.bufferViews) }));
  add('samplers', (s) => s);
  add('textures', (t) => ({ ...t, source: shifted(t.source, base.images), sampler: shifted(t.sampler, base.samplers) }));
  const textures = (node) => {
    for (const [key, value] of Object.entries(node ?? {}))
      if (key.endsWith('Texture')) value.index += base.textures;
      else if (value && typeof value === 'object' && key !== 'extras') textures(value);
    return node;
  };
  add('materials', textures);
  add('meshes', (m) => {
    for (const p of m.primitives) {
      for (const name of Object.keys(p.attributes)) p.attributes[name] += base.accessors;
      p.indices = shifted(p.indices, base.accessors);
      p.material = shifted(p.material, base.materials);
    }
    return m;
  });
  add('nodes', (n) => ({ ...n, mesh: shifted(n.mesh, base.meshes) }));
  const scene = json.scenes[json.scene ?? 0];
  for (const n of more.json.scenes[more.json.scene ?? 0].nodes) scene.nodes.push(n + base.nodes);
  for (const list of Object.keys(base)) if (json[list].length === 0) delete json[list];
}

/** The GLB's bytes. Views that no accessor and no picture uses any more are left out. */
export function writeGlb({ json, views }) {
  const used = new Map(), order = [];
  for (const user of [...json.accessors, ...(json.images ?? [])])
    if (user.bufferView !== undefined) {
      if (!used.has(user.bufferView)) used.set(user.bufferView, order.push(user.bufferView) - 1);
      user.bufferView = used.get(user.bufferView);
    }
  let size = 0;
  json.bufferViews = order.map((i) => {
    const view = { ...json.bufferViews[i], buffer: 0, byteOffset: size, byteLength: views[i].length };
    delete view.byteStride; // every element fills its stride
    size += padded(views[i].length);
    return view;
  });
  json.buffers = [{ byteLength: size }];
  const text = new TextEncoder().encode(JSON.stringify(json)), jsonSize = padded(text.length);
  const out = new Uint8Array(28 + jsonSize + size), words = new DataView(out.buffer);
  [MAGIC, 2, out.length, jsonSize, JSON_CHUNK].forEach((w, i) => words.setUint32(4 * i, w, true));
  out.fill(0x20, 20, 20 + jsonSize).set(text, 20);
  words.setUint32(20 + jsonSize, size, true);
  words.setUint32(24 + jsonSize, BIN_CHUNK, true);
  order.forEach((i, k) => out.set(views[i], 28 + jsonSize + json.bufferViews[k].byteOffset));
  return out;
}

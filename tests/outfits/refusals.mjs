// SPDX-License-Identifier: GPL-3.0-or-later
// node refusals.mjs FOLDER TOP BOTTOM DRESS: what composeOutfit refuses, and by which code; and that what was compressed
// comes out as what was not. FOLDER/TOP has garment-page.glb too.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { MeshoptDecoder } from 'meshoptimizer';
import { readGlb, meshOf, writeGlb } from '../../showroom/web/glb.js';
import { composeOutfit, OutfitError } from '../../showroom/web/outfit.js';

const [folder, top, bottom, dress] = process.argv.slice(2);
if (!dress) {
  console.error('usage: node refusals.mjs FOLDER TOP BOTTOM DRESS');
  process.exit(64);
}
const read = async (sku, name) => new Uint8Array(await readFile(join(folder, sku, name))).buffer;
const dressed = await read(bottom, 'dressed.glb'), garment = await read(top, 'garment.glb');
const changed = async (data, change) => {
  const glb = await readGlb(data, 'a file');
  change(glb.json.asset.extras, glb.json);
  return writeGlb(glb);
};
const refused = async (code, words, request) =>
  assert.rejects(composeOutfit(request), (e) => {
    assert.ok(e instanceof OutfitError, String(e));
    assert.equal(e.code, code, e.message);
    assert.match(e.message, words);
    return true;
  });

await refused('BAD_MODE', /"under"/, { dressed, garment, mode: 'under' });
await refused('NO_PAIR', /both|Both/, { dressed, garment: await read(bottom, 'garment.glb') });
await refused('NO_PAIR', /by itself/, { dressed, garment: await read(dress, 'garment.glb') });
await refused('OTHER_MANNEQUIN', /same size/, { dressed, garment: await changed(garment, (x) => (x.mannequin_sha256 = 'f'.repeat(64))) });
await refused('NO_MANNEQUIN', /convert it again/, { dressed, garment: await changed(garment, (x) => delete x.mannequin_sha256) });
await refused('NO_MANNEQUIN', /dressed\.glb/, { dressed: await read(bottom, 'garment.glb'), garment });
const poncho = await changed(garment, (x) => (x.garment = 'poncho'));
await refused('UNKNOWN_GARMENT', /roles/, { dressed, garment: poncho });
await refused('NOT_A_GLB', /frame/, { dressed, garment: await changed(garment, (_, json) => (json.nodes[0].translation = [0, 1, 0])) });
await refused('NOT_A_GLB', /length/, { dressed, garment: garment.slice(0, garment.byteLength - 4) });
await refused('NOT_A_GLB', /header/, { dressed: new ArrayBuffer(64), garment });
const page = await read(top, 'garment-page.glb');
await refused('COMPRESSED', /decoder/, { dressed, garment: page });

// Said by the caller, a stranger's garment is worn like any other.
const plain = await composeOutfit({ dressed, garment });
const said = await composeOutfit({ dressed, garment: poncho, roles: { garment: 'top' } });
const positions = async (glb) => meshOf(await readGlb(glb, 'an outfit'), `garment_${top}`).positions;
assert.deepEqual(await positions(said), await positions(plain));
// Same input, same bytes; and whichever of the two comes dressed, the cloth lies the same.
assert.deepEqual(await composeOutfit({ dressed, garment }), plain);
const turned = await composeOutfit({ dressed: await read(top, 'dressed.glb'), garment: await read(bottom, 'garment.glb') });
assert.deepEqual(await positions(turned), await positions(plain));
// A compressed file keeps coordinates to some 15 bits.
const unpacked = await positions(await composeOutfit({ dressed, garment: page, decoder: MeshoptDecoder }));
const flat = await positions(plain);
assert.equal(unpacked.length, flat.length);
assert.ok(unpacked.every((x, i) => Math.abs(x - flat[i]) < 1e-3), 'it lies elsewhere');
console.log('refusals: ok');

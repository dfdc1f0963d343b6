// SPDX-License-Identifier: GPL-3.0-or-later
// node view.mjs [--picture OUT.png] FILE.glb...: opens each file from disk in model-viewer, in a headless
// Chromium, and fails unless it loads, has the size that the file states, stands upright on its soles, shows the garment
// in colour, leaves no error in the console and asks nobody for anything. --picture keeps what the last file looks like.
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import puppeteer from 'puppeteer-core';

const args = process.argv.slice(2);
const at = args.indexOf('--picture');
const picture = at < 0 ? null : args.splice(at, 2)[1];
if (args.length === 0) {
  console.error('usage: node view.mjs [--picture OUT.png] FILE.glb...');
  process.exit(64);
}
const browserPath = process.env.CHROMIUM ?? '/usr/bin/chromium';
const viewer = createRequire(import.meta.url).resolve('@google/model-viewer/dist/model-viewer-umd.min.js');

/** The box over all positions as the accessors state it: {low, high} in metres. */
function statedBox(glb) {
  const json = JSON.parse(glb.subarray(20, 20 + glb.readUInt32LE(12)).toString('utf8'));
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const mesh of json.meshes)
    for (const primitive of mesh.primitives) {
      const { min, max } = json.accessors[primitive.attributes.POSITION];
      for (let i = 0; i < 3; ++i) {
        low[i] = Math.min(low[i], min[i]);
        high[i] = Math.max(high[i], max[i]);
      }
    }
  return { low, high };
}

async function check(browser, folder, file) {
  const glb = await readFile(file);
  const { low, high } = statedBox(glb);
  const page = await browser.newPage();
  const faults = [];
  const expect = (good, what) => good || faults.push(what);
  try {
    await page.setViewport({ width: 600, height: 750 });
    page.on('console', (m) => m.type() === 'error' && faults.push(`console: ${m.text()}`));
    page.on('pageerror', (e) => faults.push(`page: ${e.message}`));
    page.on('request', (r) => {
      if (!/^(file|data|blob):/.test(r.url())) faults.push(`asked for ${r.url()}`);
    });
    // A page on disk may not fetch its neighbour: the model travels inside it.
    const html = join(folder, 'page.html');
    await writeFile(
      html,
      `<!doctype html><html lang="en"><meta charset="utf-8"><title>viewer</title>
<style>body{margin:0;background:#fff}model-viewer{width:600px;height:750px;--progress-bar-height:0px}</style>
<script src="${pathToFileURL(viewer)}"></script>
<model-viewer id="v" alt="garment" camera-orbit="0deg 85deg 105%" interaction-prompt="none" shadow-intensity="0.6"
 exposure="1"></model-viewer>`,
    );
    await page.goto(pathToFileURL(html).href, { waitUntil: 'load' });
    const seen = await page.evaluate(async (source) => {
      const v = document.getElementById('v');
      await new Promise((resolve, reject) => {
        v.addEventListener('load', resolve, { once: true });
        v.addEventListener('error', (e) => reject(new Error(`model-viewer: ${e.detail?.type ?? 'error'}`)), { once: true });
        setTimeout(() => reject(new Error('model-viewer: not loaded within 90 s')), 90_000);
        v.src = source;
      });
      v.jumpCameraToGoal();
      await new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(r)));
      const xyz = (p) => [p.x, p.y, p.z];
      return { size: xyz(v.getDimensions()), centre: xyz(v.getBoundingBoxCenter()) };
    }, `data:model/gltf-binary;base64,${glb.toString('base64')}`);
    for (let i = 0; i < 3; ++i) {
      expect(Math.abs(seen.size[i] - (high[i] - low[i])) < 1e-3, `size ${seen.size} m, the file states ${high} - ${low}`);
      expect(Math.abs(seen.centre[i] - (high[i] + low[i]) / 2) < 1e-3, `centre ${seen.centre} m`);
    }
    expect(seen.size[1] > 0.05 && seen.size[1] < 3, `height ${seen.size[1]} m is no garment's`);
    expect(low[1] > -0.05, `reaches ${low[1]} m below the floor`);
    const shot = await page.screenshot({ type: 'png' });
    if (picture) await writeFile(picture, shot);
    // Where on the screen the subject is, read back from the picture itself.
    const rows = await page.evaluate(async (data) => {
      const image = new Image();
      image.src = data;
      await image.decode();
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [image.width, image.height];
      const context = canvas.getContext('2d');
      context.drawImage(image, 0, 0);
      const { data: pixels } = context.getImageData(0, 0, canvas.width, canvas.height);
      return Array.from({ length: canvas.height }, (_, y) => {
        let first = -1, last = -1;
        for (let x = 0; x < canvas.width; ++x) {
          const k = 4 * (y * canvas.width + x);
          if (Math.min(pixels[k], pixels[k + 1], pixels[k + 2]) > 232) continue;
          if (first < 0) first = x;
          last = x;
        }
        return first < 0 ? 0 : last - first + 1;
      });
    }, `data:image/png;base64,${Buffer.from(shot).toString('base64')}`);
    const shown = rows.map((w, y) => [w, y]).filter(([w]) => w > 0).map(([, y]) => y);
    expect(shown.length > 150, 'hardly anything is to be seen');
    // A dressed mannequin has its head at the top: no wider than a fifth of what its arms span.
    if (seen.size[1] > 1.4 && shown.length > 0) {
      const head = rows[shown[0] + Math.round(0.05 * shown.length)];
      expect(head < 0.3 * Math.max(...rows), `the top of the figure is ${head} px wide, its arms ${Math.max(...rows)}`);
    }
    console.log(
      `${faults.length === 0 ? 'ok' : 'FAILED'} ${file}: ${seen.size.map((s) => s.toFixed(3)).join(' x ')} m`,
    );
  } catch (error) {
    faults.push(error.message ?? String(error));
    console.log(`FAILED ${file}`);
  } finally {
    await page.close();
  }
  for (const fault of faults) console.log(`  ${fault}`);
  return faults.length === 0;
}

const folder = await mkdtemp(join(tmpdir(), 'vitrine-viewer-'));
const browser = await puppeteer.launch({
  executablePath: browserPath,
  headless: true,
  userDataDir: join(folder, 'profile'),
  args: [
    '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
  ],
});
let good = true;
try {
  for (const file of args) good = (await check(browser, folder, file)) && good;
} finally {
  await browser.close();
  await rm(folder, { recursive: true, force: true });
}
process.exit(good ? 0 : 1);

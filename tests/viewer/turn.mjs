// SPDX-License-Identifier: GPL-3.0-or-later
// node turn.mjs [--orbits "0deg 85deg 3.2m,180deg 85deg 3.2m"] OUT FILE.glb...: pictures OUT00.png, OUT01.png, ... of each
// file from each side, as model-viewer draws it in a headless Chromium; for documents and to be looked at.
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import puppeteer from 'puppeteer-core';

const args = process.argv.slice(2), at = args.indexOf('--orbits');
const orbits = (at < 0 ? '0deg 85deg 3.2m,60deg 85deg 3.2m,180deg 85deg 3.2m' : args.splice(at, 2)[1]).split(',');
const [out, ...files] = args;
if (files.length === 0) {
  console.error('usage: node turn.mjs [--orbits A,B,...] OUT FILE.glb...');
  process.exit(64);
}
const viewer = createRequire(import.meta.url).resolve('@google/model-viewer/dist/model-viewer-umd.min.js');
const folder = await mkdtemp(join(tmpdir(), 'vitrine-turn-'));
const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  headless: true,
  userDataDir: join(folder, 'profile'),
  args: ['--no-sandbox', '--disable-gpu', '--no-first-run', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
try {
  const page = await browser.newPage(), html = join(folder, 'page.html');
  await page.setViewport({ width: 420, height: 640 });
  await writeFile(
    html,
    `<!doctype html><html lang="en"><meta charset="utf-8"><title>turn</title>
<style>body{margin:0;background:#eee}model-viewer{width:420px;height:640px;--progress-bar-height:0px}</style>
<script src="${pathToFileURL(viewer)}"></script>
<model-viewer id="v" alt="outfit" camera-target="0m 0.95m 0m" field-of-view="22deg" interaction-prompt="none"
 shadow-intensity="0.6"></model-viewer>`,
  );
  await page.goto(pathToFileURL(html).href);
  let count = 0;
  for (const file of files) {
    const glb = await readFile(file);
    await page.evaluate(async (source) => {
      const v = document.getElementById('v');
      await new Promise((resolve, reject) => {
        v.addEventListener('load', resolve, { once: true });
        v.addEventListener('error', (e) => reject(new Error(`model-viewer: ${e.detail?.type ?? 'error'}`)), { once: true });
        v.src = source;
      });
    }, `data:model/gltf-binary;base64,${glb.toString('base64')}`);
    for (const orbit of orbits) {
      await page.evaluate(async (o) => {
        const v = document.getElementById('v');
        v.cameraOrbit = o;
        v.jumpCameraToGoal();
        await new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(r)));
      }, orbit);
      await writeFile(`${out}${String(count++).padStart(2, '0')}.png`, await page.screenshot({ type: 'png' }));
    }
  }
} finally {
  await browser.close();
  await rm(folder, { recursive: true, force: true });
}

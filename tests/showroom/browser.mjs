// SPDX-License-Identifier: GPL-3.0-or-later
// A Chromium, a server for a folder under a path of its own, and a page whose errors and requests are kept.
import { createReadStream } from 'node:fs';
import { mkdtemp, rm, stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';
import puppeteer from 'puppeteer-core';

const types = {
  '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.css': 'text/css', '.json': 'application/json',
  '.webp': 'image/webp', '.jpg': 'image/jpeg', '.glb': 'model/gltf-binary', '.svg': 'image/svg+xml',
};

/** The folder as http://127.0.0.1:port/shop/3d/, as a host would have it on a sub-path. */
export async function serve(folder) {
  const base = '/shop/3d/';
  const server = createServer(async (request, response) => {
    const path = decodeURIComponent(new URL(request.url, 'http://x').pathname);
    let file = path.startsWith(base) ? join(folder, normalize(`/${path.slice(base.length)}`)) : '';
    const known = file && (await stat(file).catch(() => null));
    if (known?.isDirectory()) file = join(file, 'index.html');
    if (!known || !(await stat(file).catch(() => null))) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, { 'Content-Type': types[extname(file)] ?? 'application/octet-stream' });
    createReadStream(file).pipe(response);
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  return { url: `http://127.0.0.1:${server.address().port}${base}`, close: () => server.close() };
}

export async function launch() {
  const folder = await mkdtemp(join(tmpdir(), 'vitrine-showroom-'));
  const browser = await puppeteer.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    headless: true,
    protocolTimeout: 240_000,
    userDataDir: join(folder, 'profile'),
    args: [
      '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--disable-component-update', '--disable-sync', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      '--js-flags=--expose-gc', '--enable-precise-memory-info',
    ],
  });
  return { browser, close: async () => { await browser.close(); await rm(folder, { recursive: true, force: true }); } };
}

/** A page; `faults` gathers console errors, exceptions, failed and outside requests; `seen` [{url, bytes}]. */
export async function open(browser, site, { width = 1280, height = 860, phone = false } = {}) {
  const page = await browser.newPage();
  await page.setViewport({ width, height, deviceScaleFactor: phone ? 2 : 1, isMobile: phone, hasTouch: phone });
  const faults = [], seen = [];
  page.on('console', (m) => m.type() === 'error' && faults.push(`console: ${m.text()} (${m.location().url ?? ''})`));
  page.on('pageerror', (e) => faults.push(`exception: ${e.message}`));
  page.on('request', (r) => {
    if (!r.url().startsWith(site.url) && !/^(blob|data):/.test(r.url())) faults.push(`asked for ${r.url()}`);
  });
  page.on('response', (r) => r.status() >= 400 && faults.push(`${r.status()} ${r.url()}`));
  const session = await page.createCDPSession();
  await session.send('Network.enable');
  const urls = new Map();
  session.on('Network.responseReceived', (e) => urls.set(e.requestId, e.response.url));
  session.on('Network.loadingFinished', (e) => seen.push({ url: urls.get(e.requestId) ?? '', bytes: e.encodedDataLength }));
  return { page, faults, seen, session };
}

export const shown = (page, timeout = 120_000) => page.waitForFunction(
  () => document.querySelector('.stage.live model-viewer')?.loaded && !document.querySelector('#stage[aria-busy]'), { timeout });

export const text = (page, selector) => page.$eval(selector, (e) => e.textContent);

/** What the stage shows, as a picture. */
export const stagePixels = async (page) => (await page.$('#stage')).screenshot({ encoding: 'base64' });

// SPDX-License-Identifier: GPL-3.0-or-later
// node many.mjs VITRINE CATALOGUE [N]: makes a catalogue of N items (1,000) by linking those of a finished one under new
// names, hostile titles among them, writes its show room, and measures: bytes of the first paint, models loaded while the
// whole grid is scrolled (none), memory while 50 items are opened in turn (where there are as many).
import { execFileSync } from 'node:child_process';
import { cpSync, linkSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { launch, open, serve, shown } from './browser.mjs';

const [vitrine, catalogue, wanted = '1000'] = process.argv.slice(2);
if (!catalogue) {
  console.error('usage: node many.mjs VITRINE CATALOGUE [N]');
  process.exit(64);
}
const opened = 50; // fewer say nothing of leaks, and software draws each for seconds
const n = Number(wanted), hostile = [
  '</title><script>document.title="hacked"</script>', '"><img src=x onerror=alert(1)>', 'x'.repeat(10_000),
  'חולצה עם "ציטוט" & <b>תגיות</b>', '../../../etc/passwd', '\u202Egpj.exe',
];
let failed = false;
const expect = (good, what) => {
  failed ||= !good;
  console.log(`${good ? 'ok    ' : 'FAILED'} ${what}`);
};
function linkTree(from, to) {
  mkdirSync(to, { recursive: true });
  for (const name of readdirSync(from)) {
    const [a, b] = [join(from, name), join(to, name)];
    if (statSync(a).isDirectory()) linkTree(a, b);
    else try { linkSync(a, b); } catch { cpSync(a, b); }
  }
}
const work = mkdtempSync(join(tmpdir(), 'vitrine-many-'));
const { browser, close } = await launch();
try {
  const lines = readFileSync(join(catalogue, 'report.jsonl'), 'utf8').trim().split('\n').map((l) => JSON.parse(l))
    .filter((l) => l.status === 'ok');
  const out = join(work, 'out'), report = [];
  for (let i = 0; i < n; ++i) {
    const line = { ...lines[i % lines.length] };
    const source = line.sku;
    line.sku = `${source}-${String(i).padStart(5, '0')}`;
    line.title = hostile[i] ?? `${line.title} ${i}`;
    delete line.outputs;
    linkTree(join(catalogue, source), join(out, line.sku));
    report.push(JSON.stringify(line));
  }
  writeFileSync(join(out, 'report.jsonl'), `${report.join('\n')}\n`);
  const folder = join(work, 'site');
  execFileSync(vitrine, ['-q', 'showroom', out, '--out', folder], { stdio: ['ignore', 'ignore', 'inherit'] });
  const site = await serve(folder);
  const { page, faults, seen, session } = await open(browser, site);
  await page.goto(site.url, { waitUntil: 'networkidle0' });
  const first = seen.reduce((sum, r) => sum + r.bytes, 0);
  expect(first <= 300 * 1024, `${n} items: the first page needs ${(first / 1024).toFixed(0)} KB until the network is quiet, at most 300`);
  expect((await page.title()) !== 'hacked' && !(await page.$('img[src="x"]')), 'hostile titles are text');

  let last = 0;
  for (let k = 0; k < 400; ++k) {
    const now = await page.evaluate(async () => {
      scrollTo(0, document.documentElement.scrollHeight);
      await new Promise((r) => setTimeout(r, 120));
      return document.querySelectorAll('.card').length;
    });
    if (now >= n) { last = now; break; }
    last = now;
  }
  expect(last === n, `the grid was scrolled to its end: ${last} cards`);
  const models = seen.filter((r) => /\.glb$/.test(r.url)).length;
  expect(models === 0, `${models} models were loaded by scrolling`);

  if (n >= opened + hostile.length) {
    // The same page changes places, as a shopper's does; what is left over after garbage collection is what leaks.
    await page.setViewport({ width: 360, height: 480 }); // pixels cost, and none of them is looked at
    const heap = [];
    for (let i = 0; i < opened; ++i) {
      const sku = JSON.parse(report[i + hostile.length]).sku;
      await page.goto(`${site.url}item/${sku}/index.html`, { waitUntil: 'load' });
      await shown(page);
      await session.send('HeapProfiler.collectGarbage');
      const m = await page.metrics();
      heap.push({ heap: m.JSHeapUsedSize / 1e6, nodes: m.Nodes, documents: m.Documents });
    }
    const mean = (list, key) => list.reduce((s, h) => s + h[key], 0) / list.length;
    const early = heap.slice(5, 15), late = heap.slice(-10);
    expect(mean(late, 'heap') < 1.15 * mean(early, 'heap') + 2,
      `memory after ${opened} items: ${mean(late, 'heap').toFixed(1)} MB of heap, ${mean(early, 'heap').toFixed(1)} MB after the first; ` +
      `${mean(late, 'documents').toFixed(0)} documents, ${mean(late, 'nodes').toFixed(0)} nodes`);
  }
  expect(faults.length === 0, `no errors, no requests outside ${faults.slice(0, 4).join(' | ')}`);
  site.close();
} catch (error) {
  expect(false, error.stack);
} finally {
  await close();
  rmSync(work, { recursive: true, force: true });
}
process.exit(failed ? 1 : 0);

// SPDX-License-Identifier: GPL-3.0-or-later
// node check.mjs SITE [--pictures FOLDER]: walks through a show room of the sample catalogue in Chromium as a shopper does,
// on a desktop and on a phone, from a server that has it under a path. Fails on anything in the console, any request
// outside of the site, any serious or critical finding of axe-core.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { launch, open, serve, shown, stagePixels, text } from './browser.mjs';

const [folder, ...rest] = process.argv.slice(2);
if (!folder) {
  console.error('usage: node check.mjs SITE [--pictures FOLDER]');
  process.exit(64);
}
const pictures = rest[0] === '--pictures' ? rest[1] : null;
const axe = await readFile(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const faults = [];
const expect = (good, what) => {
  if (!good) faults.push(what);
  console.log(`${good ? 'ok    ' : 'FAILED'} ${what}`);
};
const site = await serve(folder);
const { browser, close } = await launch();

async function accessible(page, session, name) {
  // The page's own policy lets no foreign script in; the tester's goes through the debugger.
  await session.send('Runtime.evaluate', { expression: axe });
  const found = await page.evaluate(async () => {
    const r = await axe.run();
    return r.violations.filter((v) => ['serious', 'critical'].includes(v.impact))
      .map((v) => `${v.id}: ${v.nodes.map((n) => n.target.join(' ')).slice(0, 3).join(', ')}`);
  });
  expect(found.length === 0, `${name}: no serious or critical finding of axe-core ${found.join(' | ')}`);
}
const settle = (page, ms = 500) => page.evaluate((t) => new Promise((r) => setTimeout(r, t)), ms);
const picture = async (page, name) => {
  if (!pictures) return;
  await settle(page, 2000); // the viewer's progress bar fades
  await page.screenshot({ path: join(pictures, name), type: 'jpeg', quality: 82 });
};

try {
  const { page, faults: noise, session } = await open(browser, site);
  const items = (await Promise.all([0].map((k) => readFile(join(folder, `data/items-${k}.json`), 'utf8')))).flatMap((t) => JSON.parse(t));
  await page.goto(site.url, { waitUntil: 'networkidle0' });
  expect((await page.$$('.card')).length === Math.min(24, items.length), `the grid shows ${items.length} items`);
  await picture(page, 'showroom-desktop.jpg');
  await accessible(page, session, 'grid');

  const type = items[0].g, ofType = items.filter((i) => i.g === type).length;
  await page.select('select[name="type"]', type);
  await page.waitForFunction((n) => document.querySelectorAll('.card').length === n, {}, ofType);
  expect((await text(page, '#count')) === `${ofType} of ${items.length} garments`, `filter: ${ofType} of type ${type}`);
  const colour = items.find((i) => i.g === type).c[0];
  await page.select('select[name="colour"]', colour);
  const both = items.filter((i) => i.g === type && i.c.includes(colour)).length;
  await page.waitForFunction((n) => document.querySelectorAll('.card').length === n, {}, both);
  await page.select('select[name="colour"]', '');
  await page.waitForFunction((n) => document.querySelectorAll('.card').length === n, {}, ofType);

  await page.locator('.card a').click(); // tries again where the grid is drawn anew just then
  await page.waitForSelector('#stage');
  await shown(page);
  expect(page.url().includes('/item/'), 'an item opens on its own page, in 3D');
  await settle(page);
  const before = await stagePixels(page);
  await picture(page, 'showroom-item.jpg');
  await accessible(page, session, 'item');
  await page.click('[data-turn="180"]');
  await page.waitForFunction(() => Math.abs(document.querySelector('model-viewer').getCameraOrbit().theta - Math.PI) < 0.02);
  const box = await (await page.$('#stage')).boundingBox();
  await settle(page);
  const turned = await stagePixels(page);
  expect(turned !== before, 'the button turns it');
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 120, box.y + box.height / 2, { steps: 6 });
  await page.mouse.up();
  await page.waitForFunction(() => Math.abs(document.querySelector('model-viewer').getCameraOrbit().theta - Math.PI) > 0.2);
  expect(true, 'the mouse turns it');
  const sizes = await page.$$('input[name="size"]');
  if (sizes.length > 1) {
    const src = await page.$eval('model-viewer', (v) => v.src);
    await sizes[sizes.length - 1].evaluate((input) => input.click());
    await page.waitForFunction((old) => document.querySelector('model-viewer').src !== old, {}, src);
    await shown(page);
    expect(true, 'a size button shows another size');
  }
  await page.click('#bare');
  await page.waitForFunction(() => document.querySelector('model-viewer').src.endsWith('garment.glb'));
  await shown(page);
  expect(true, 'the garment can be seen without the mannequin');
  const snippet = await page.$eval('#snippet', (t) => t.value);
  expect(snippet.includes(`src="${site.url}item/`) && snippet.includes('/embed.html"'), 'the snippet names the frame');
  await page.goBack();
  await page.waitForFunction((n) => document.querySelectorAll('.card').length === n, {}, ofType);
  expect((await page.$eval('select[name="type"]', (s) => s.value)) === type, 'back brings the filtered grid back');
  await page.click('button[type="reset"]');
  await page.type('input[name="q"]', items.at(-1).s);
  await page.waitForFunction(() => document.querySelectorAll('.card').length === 1);
  expect(true, 'search finds an article by its number');

  await page.goto(`${site.url}item/${items[0].s}/embed.html`, { waitUntil: 'load' });
  await page.click('#start');
  await shown(page);
  expect(true, 'the frame for other pages opens in 3D when asked');

  await page.goto(`${site.url}size.html`, { waitUntil: 'networkidle0' });
  const bodies = JSON.parse(await text(page, '#data'));
  const wanted = bodies.length - 1;
  const names = ['height', 'bust', 'under_bust', 'waist', 'hip', 'inside_leg', 'arm', 'neck_base'];
  for (const [i, name] of names.entries()) {
    const cm = bodies[wanted].cm[i] + (name === 'hip' ? 1.5 : 0);
    await page.type(`input[name="${name}"]`, cm.toFixed(1));
  }
  await page.click('button[type="submit"]');
  const said = await text(page, '#near');
  expect(/hip is 1\.5 cm more/.test(said), `measurements: ${said}`);
  await accessible(page, session, 'size');
  await page.reload({ waitUntil: 'networkidle0' });
  expect((await text(page, '#near')) === said, 'the choice is kept');
  await picture(page, 'showroom-size.jpg');

  const outfits = JSON.parse(await readFile(join(folder, 'data/outfits.json'), 'utf8'));
  if (outfits.tops.length && outfits.bottoms.length) {
    await page.goto(`${site.url}outfits.html`, { waitUntil: 'networkidle0' });
    await page.$eval('#tops input', (i) => i.click());
    await page.$eval('#bottoms input', (i) => i.click());
    await shown(page);
    const over = await page.$eval('model-viewer', (v) => v.src);
    await page.$eval('input[value="tucked"]', (i) => i.click());
    await page.waitForFunction((old) => document.querySelector('model-viewer').src !== old, { timeout: 60_000 }, over);
    await shown(page);
    expect((await text(page, '#note')).includes(' + '), `an outfit is composed: ${await text(page, '#note')}`);
    await settle(page);
    await accessible(page, session, 'outfits');
    await picture(page, 'showroom-outfit.jpg');
  }
  expect(noise.length === 0, `desktop: no errors, no requests outside ${noise.slice(0, 4).join(' | ')}`);
  await page.close();

  const phone = await open(browser, site, { width: 390, height: 844, phone: true });
  await phone.page.goto(site.url, { waitUntil: 'networkidle0' });
  await picture(phone.page, 'showroom-phone.jpg');
  const wide = await phone.page.evaluate(() => document.documentElement.scrollWidth > innerWidth + 1);
  expect(!wide, 'phone: nothing is wider than the screen');
  await phone.page.tap('.card a');
  await phone.page.waitForSelector('#stage');
  await shown(phone.page);
  await settle(phone.page);
  await picture(phone.page, 'showroom-phone-item.jpg');
  await accessible(phone.page, phone.session, 'item on a phone');
  expect(phone.faults.length === 0, `phone: no errors, no requests outside ${phone.faults.slice(0, 4).join(' | ')}`);
} catch (error) {
  expect(false, error.message);
} finally {
  await close();
  site.close();
}
process.exit(faults.length ? 1 : 0);

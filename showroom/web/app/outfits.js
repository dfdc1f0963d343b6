// SPDX-License-Identifier: GPL-3.0-or-later
import { nearest, remembered, sizeLabel } from './body.js';
import { Viewer } from './viewer.js';

const $ = (id) => document.getElementById(id);
const stage = $('stage'), note = $('note');
const data = await fetch('data/outfits.json').then((r) => r.json());
const chosen = { top: '', bottom: '', body: -1, mode: 'over' };
let viewer = null, made = '', turn = 0;

/** Mannequins that wear at least one top and one bottom. */
const worn = (list, body) => list.some((item) => item.l.some(([, b]) => b === body));
const bodies = data.bodies.map((b, i) => i).filter((i) => worn(data.tops, i) && worn(data.bottoms, i));

const lookOf = (list, sku) => {
  const item = list.find((i) => i.s === sku);
  const look = item?.l.find(([, body]) => body === chosen.body);
  return item && look ? { item, folder: `item/${item.s}/${look[0] ? `${look[0]}/` : ''}` } : null;
};
const bytes = async (url) => {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status}`);
  return answer.arrayBuffer();
};

async function compose() {
  const now = ++turn;
  history.replaceState(null, '', `#${new URLSearchParams(Object.entries(chosen).filter(([, v]) => v !== '' && v !== -1))}`);
  const top = lookOf(data.tops, chosen.top), bottom = lookOf(data.bottoms, chosen.bottom);
  if (!top || !bottom) {
    note.textContent = !top && !bottom ? 'Choose a top and a bottom.' : top ? 'Now choose a bottom.' : 'Now choose a top.';
    return;
  }
  note.textContent = 'One moment, both are being put on…';
  try {
    const [{ composeOutfit }, dressed, garment] = await Promise.all([
      import('./outfit.js'), bytes(`${bottom.folder}dressed.glb`), bytes(`${top.folder}garment.glb`)]);
    if (now !== turn) return;
    const glb = await composeOutfit({ dressed, garment, mode: chosen.mode, roles: { dressed: 'bottom', garment: 'top' } });
    if (now !== turn) return;
    const url = URL.createObjectURL(new Blob([glb], { type: 'model/gltf-binary' }));
    const alt = `${top.item.t} with ${bottom.item.t} on a mannequin`;
    viewer ??= new Viewer(stage, { alt });
    viewer.alt = alt;
    const old = made;
    made = url;
    await viewer.show(url);
    if (old) URL.revokeObjectURL(old);
    if (now === turn) note.textContent = `${top.item.t} + ${bottom.item.t}`;
  } catch (error) {
    if (now === turn) note.textContent = `These two cannot be put together: ${error.message}`;
  }
}

function radio(name, value, checked, inside) {
  const label = document.createElement('label');
  const input = Object.assign(document.createElement('input'), { type: 'radio', name, value, checked });
  label.append(input, inside);
  return label;
}

function choices(place, list, part) {
  const fitting = list.filter((item) => item.l.some(([, body]) => body === chosen.body));
  if (!fitting.some((item) => item.s === chosen[part])) chosen[part] = '';
  $(place).replaceChildren(...fitting.map((item) => {
    const box = document.createElement('span');
    const img = new Image(150, 200);
    img.loading = 'lazy';
    img.alt = '';
    img.src = `item/${item.s}/card.webp`;
    const name = Object.assign(document.createElement('span'), { className: 'name', dir: 'auto', textContent: item.t });
    box.append(img, name);
    return radio(part, item.s, item.s === chosen[part], box);
  }));
}

function list() {
  choices('tops', data.tops, 'top');
  choices('bottoms', data.bottoms, 'bottom');
  find('top');
  find('bottom');
}

function find(part) {
  const words = $(`find-${part}`).value.toLocaleLowerCase().split(/\s+/).filter(Boolean);
  for (const label of $(`${part}s`).children)
    label.hidden = !words.every((w) => label.textContent.toLocaleLowerCase().includes(w));
}

function open() {
  const want = new URLSearchParams(location.hash.slice(1));
  for (const key of ['top', 'bottom']) chosen[key] = want.get(key) ?? '';
  if (['over', 'tucked'].includes(want.get('mode'))) chosen.mode = want.get('mode');
  const mine = remembered();
  const near = mine ? nearest(mine, bodies.map((i) => data.bodies[i])) : null;
  const asked = Number(want.get('body') ?? NaN);
  chosen.body = bodies.includes(asked) ? asked : near ? bodies[near.index] : bodies[0];
  for (const input of document.querySelectorAll('input[name="mode"]')) input.checked = input.value === chosen.mode;
  $('sizes').hidden = bodies.length < 2;
  $('sizes').replaceChildren($('sizes').firstElementChild, ...bodies.map((i) => radio('body', i, i === chosen.body,
    Object.assign(document.createElement('span'), { textContent: sizeLabel(data.bodies[i].label) }))));
  list();
  compose();
}

document.querySelector('.about').addEventListener('change', (event) => {
  const { name, value } = event.target;
  if (!['top', 'bottom', 'mode', 'body'].includes(name)) return;
  chosen[name] = name === 'body' ? Number(value) : value;
  if (name === 'body') list();
  compose();
});
for (const part of ['top', 'bottom']) $(`find-${part}`).addEventListener('input', () => find(part));
addEventListener('hashchange', open);
addEventListener('pagehide', () => {
  viewer?.remove();
  viewer = null;
});
if (bodies.length) open();
else note.textContent = 'This catalogue has no top and bottom on the same mannequin.';

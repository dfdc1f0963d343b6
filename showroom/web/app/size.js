// SPDX-License-Identifier: GPL-3.0-or-later
import { howNear, measures, nearest, remember, remembered, spoken } from './body.js';

const bodies = JSON.parse(document.getElementById('data').textContent);
const form = document.getElementById('measures'), near = document.getElementById('near');
const compare = document.getElementById('compare'), sexes = document.getElementById('sexes');
sexes.hidden = new Set(bodies.map((b) => b.sex).filter(Boolean)).size < 2;

function show(mine) {
  compare.hidden = true;
  if (!bodies.some((b) => b.cm)) {
    near.textContent = 'This catalogue does not tell its mannequins\' measurements.';
    return;
  }
  const found = mine && nearest(mine, bodies);
  near.textContent = found ? howNear(found, bodies[found.index]) : '';
  if (!found) return;
  const rows = measures.map((m, i) => {
    const row = document.createElement('tr');
    const name = document.createElement('th');
    name.scope = 'row';
    name.textContent = spoken[m].charAt(0).toUpperCase() + spoken[m].slice(1);
    const theirs = bodies[found.index].cm[i];
    const known = Number.isFinite(mine[m]);
    const difference = mine[m] - theirs;
    const texts = [known ? mine[m].toFixed(1) : '–', theirs.toFixed(1),
      known ? `${difference > 0 ? '+' : difference < 0 ? '−' : ''}${Math.abs(difference).toFixed(1)}` : '–'];
    row.append(name, ...texts.map((t) => Object.assign(document.createElement('td'), { textContent: t })));
    return row;
  });
  compare.tBodies[0].replaceChildren(...rows);
  compare.hidden = false;
}

form.addEventListener('submit', (event) => {
  event.preventDefault();
  const mine = {};
  const wrong = [];
  for (const m of measures) {
    const field = form.elements[m];
    const text = field.value.trim().replace(',', '.');
    field.removeAttribute('aria-invalid');
    if (!text) continue;
    const cm = Number(text);
    if (cm >= 10 && cm <= 250) {
      mine[m] = cm;
    } else {
      wrong.push(field);
      field.setAttribute('aria-invalid', 'true');
    }
  }
  if (form.elements.sex.value) mine.sex = form.elements.sex.value;
  if (wrong.length || !measures.some((m) => m in mine)) {
    near.textContent = wrong.length ? 'Please give centimetres, between 10 and 250.' : 'Please give at least one measurement.';
    compare.hidden = true;
    (wrong[0] ?? form.elements.height).focus();
    return;
  }
  remember(mine);
  show(mine);
});
document.getElementById('forget').addEventListener('click', () => {
  remember(null);
  form.reset();
  compare.hidden = true;
  near.textContent = 'Forgotten.';
});

const mine = remembered();
if (mine) {
  for (const m of measures) if (Number.isFinite(mine[m])) form.elements[m].value = mine[m];
  form.elements.sex.value = mine.sex ?? '';
  show(mine);
}

// SPDX-License-Identifier: GPL-3.0-or-later
import { howNear, nearest, remembered, sizeLabel } from './body.js';
import { eager, onDisk, Viewer } from './viewer.js';

const $ = (id) => document.getElementById(id);
const item = JSON.parse($('data').textContent);
const stage = $('stage'), poster = $('poster'), start = $('start'), tools = $('tools'), bare = $('bare'), near = $('near');
const sizes = [...document.querySelectorAll('input[name="size"]')];
let look = item.looks[0];
let viewer = null;

async function open3D() {
  start.hidden = true;
  stage.setAttribute('aria-busy', 'true');
  viewer ??= new Viewer(stage, { alt: item.alt });
  const withBody = bare?.getAttribute('aria-pressed') !== 'true';
  try {
    await viewer.show(withBody ? look.model : look.garment);
    if (tools) tools.hidden = false;
  } catch (error) {
    viewer.remove();
    viewer = null;
    start.textContent = 'The 3D view failed. Try again';
    start.hidden = false;
    start.title = error.message;
  }
  stage.removeAttribute('aria-busy');
}

function wear(index) {
  look = item.looks[index];
  poster.src = look.poster;
  for (const cell of document.querySelectorAll('[data-flat]')) cell.textContent = look.flat[cell.dataset.flat] ?? '–';
  if (viewer) open3D();
}

const mine = remembered();
const found = mine && nearest(mine, item.looks.map((l) => l.body));
if (found) {
  near.textContent = howNear(found, item.looks[found.index].body);
  if (sizes.length) {
    sizes[found.index].checked = true;
    wear(found.index);
  }
}
sizes.forEach((radio, index) => radio.addEventListener('change', () => {
  wear(index);
  near.textContent = found && index !== found.index
    ? `Shown in ${sizeLabel(look.size)}. ${howNear(found, item.looks[found.index].body)}`
    : found ? howNear(found, item.looks[found.index].body) : '';
}));

tools?.addEventListener('click', (event) => {
  const turn = event.target.dataset?.turn;
  if (turn !== undefined) viewer?.turn(turn);
});
bare?.addEventListener('click', () => {
  bare.setAttribute('aria-pressed', bare.getAttribute('aria-pressed') === 'true' ? 'false' : 'true');
  open3D();
});

// Coming from the grid, "back" is the shopper's own way back, with the filters and the place on the page.
$('back')?.addEventListener('click', (event) => {
  if (event.button !== 0 || event.metaKey || event.ctrlKey || sessionStorage.getItem('vitrine-grid') === null) return;
  event.preventDefault();
  location.href = '../../index.html' + sessionStorage.getItem('vitrine-grid');
});

if ($('snippet')) {
  const quoted = item.alt.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
  $('snippet').value = `<iframe src="${new URL('embed.html', location.href).href}" title="${quoted}" loading="lazy"
 width="480" height="640" style="border:0" allow="fullscreen; xr-spatial-tracking"></iframe>`;
  $('copy').addEventListener('click', async () => {
    $('snippet').select();
    try {
      await navigator.clipboard.writeText($('snippet').value);
      $('copied').textContent = 'Copied.';
    } catch {
      $('copied').textContent = 'Press Ctrl+C to copy what is marked.';
    }
  });
}

start.addEventListener('click', open3D);
if (onDisk) {
  start.hidden = true;
} else if (eager && !document.body.classList.contains('embed')) {
  // The poster first; the viewer when the page is quiet.
  (window.requestIdleCallback ?? setTimeout)(() => open3D());
} else {
  start.hidden = false;
}
addEventListener('pagehide', () => {
  viewer?.remove();
  viewer = null;
});
addEventListener('pageshow', (event) => {
  if (event.persisted && !onDisk) start.hidden = false;
});

// SPDX-License-Identifier: GPL-3.0-or-later
// The page comes with its first cards; the rest of the list is fetched in parts, when it is scrolled to or searched.
const grid = document.getElementById('grid'), form = document.getElementById('filters'), more = document.getElementById('more');
const count = document.getElementById('count'), empty = document.getElementById('empty');
const chunks = Number(form.dataset.chunks), total = Number(form.dataset.count);
const step = 24;
const parts = [];
let items = [];  // of the parts that are here, in order
let shown = grid.children.length;
let fits = null;  // what the filters let through, or null: everything
let turn = 0;

const spoken = (id) => {
  let words = id === 't_shirt' ? 'T-shirt' : id.startsWith('neck_') ? `${id.slice(5)} neck` : id;
  words = words.replaceAll('_', ' ');
  return words.charAt(0).toUpperCase() + words.slice(1);
};

async function part(k) {
  parts[k] ??= fetch(`data/items-${k}.json`).then((r) => {
    if (!r.ok) throw new Error(`items-${k}.json: ${r.status}`);
    return r.json();
  });
  return parts[k];
}

/** Parts 0 to k in order; a list with a hole would show cards twice. */
async function upTo(k) {
  const lists = await Promise.all(Array.from({ length: k + 1 }, (_, i) => part(i)));
  items = lists.flat();
}

function card(item) {
  const li = document.createElement('li');
  li.className = 'card';
  const a = document.createElement('a');
  const place = `item/${item.s}/`;
  a.href = `${place}index.html`;
  const img = new Image(300, 400);
  img.loading = 'lazy';
  img.decoding = 'async';
  img.alt = `${item.t} (${spoken(item.g)}) on a mannequin`;
  img.src = `${place}card.webp`;
  const name = document.createElement('span');
  name.className = 'name';
  name.dir = 'auto';
  name.textContent = item.t;
  const kind = document.createElement('span');
  kind.className = 'kind';
  kind.textContent = spoken(item.g) + (item.n ? ` · ${spoken(item.n)}` : '');
  a.append(img, name, kind);
  li.append(a);
  return li;
}

const state = () => Object.fromEntries([...new FormData(form)].map(([k, v]) => [k, v.trim()]).filter(([, v]) => v));

async function showMore() {
  const now = turn;
  const end = shown + step;
  if (!fits && items.length < Math.min(end, total)) {
    await upTo(Math.min(chunks - 1, Math.floor((end - 1) / 200)));
    if (now !== turn) return;
  }
  const list = fits ?? items;
  if (shown >= list.length) return;
  grid.append(...list.slice(shown, end).map(card));
  shown = Math.min(end, list.length);
}

async function filter(least = step) {
  const now = ++turn;
  const want = state();
  const active = Object.keys(want).length > 0;
  const hash = active ? `#${new URLSearchParams(want)}` : '';
  history.replaceState(history.state, '', hash || location.pathname + location.search);
  sessionStorage.setItem('vitrine-grid', hash);
  if (active || least > step) {
    await upTo(chunks - 1);
  } else if (items.length < Math.min(step, total)) {
    await upTo(0);
  }
  if (now !== turn) return;
  const words = (want.q ?? '').toLocaleLowerCase().split(/\s+/).filter(Boolean);
  fits = !active ? null : items.filter((item) => {
    const text = `${item.t} ${item.s} ${spoken(item.g)} ${item.c.join(' ')}`.toLocaleLowerCase();
    return (!want.type || item.g === want.type) && (!want.neckline || item.n === want.neckline) &&
      (!want.colour || item.c.includes(want.colour)) && words.every((w) => text.includes(w));
  });
  const list = fits ?? items;
  grid.replaceChildren(...list.slice(0, least).map(card));
  shown = grid.children.length;
  const n = fits ? fits.length : total;
  count.textContent = fits ? `${n} of ${total} garments` : `${n} garments`;
  empty.hidden = n > 0;
  watch();
}

/** A new observation tells at once whether the end is in sight, which an old one does only when that changes. */
let watcher = null;
function watch() {
  watcher?.disconnect();
  watcher = new IntersectionObserver(async (seen) => {
    if (!seen.some((s) => s.isIntersecting)) return;
    const before = shown;
    await showMore().catch(() => { count.textContent = 'The list could not be loaded. Scroll to try again.'; parts.length = 0; });
    if (shown > before) watch();
  }, { rootMargin: '400px' });
  watcher.observe(more);
}

function restore() {
  const want = new URLSearchParams(location.hash.slice(1));
  let any = false;
  for (const field of form.elements)
    if (field.name) {
      field.value = want.get(field.name) ?? '';
      any ||= field.value !== '';
    }
  const kept = history.state?.shown ?? 0;
  if (any || kept > shown) filter(Math.max(step, kept)).then(() => history.state?.y && scrollTo(0, history.state.y));
  else watch();
  sessionStorage.setItem('vitrine-grid', any ? location.hash : '');
}

let wait = 0;
form.addEventListener('input', () => {
  clearTimeout(wait);
  wait = setTimeout(() => filter(), 120);
});
form.addEventListener('submit', (event) => event.preventDefault());
form.addEventListener('reset', () => setTimeout(() => filter()));
addEventListener('hashchange', () => restore());
// What the browser cannot bring back by itself after "back": how far the list went.
grid.addEventListener('click', () => history.replaceState({ shown, y: scrollY }, ''));
restore();

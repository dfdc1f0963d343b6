// SPDX-License-Identifier: GPL-3.0-or-later
// The shopper's own measurements: kept in this browser, compared with the mannequins', sent nowhere.
export const measures = ['height', 'bust', 'under_bust', 'waist', 'hip', 'inside_leg', 'arm', 'neck_base'];
export const spoken = {
  height: 'height', bust: 'bust', under_bust: 'under bust', waist: 'waist', hip: 'hip', inside_leg: 'inside leg',
  arm: 'arm', neck_base: 'neck',
};
const key = 'vitrine-measurements';

/** {sex, height, ...} [cm] as typed in, or null. */
export function remembered() {
  try {
    const kept = JSON.parse(localStorage.getItem(key));
    return kept && measures.some((m) => Number.isFinite(kept[m])) ? kept : null;
  } catch {
    return null;
  }
}

export function remember(mine) {
  try {
    if (mine) localStorage.setItem(key, JSON.stringify(mine));
    else localStorage.removeItem(key);
  } catch { /* a browser that keeps nothing still compares */ }
}

/** "M" for a shopper, of a folder such as woman-m. */
export const sizeLabel = (label) => {
  const m = /^(?:woman|man)-(\w+)$/.exec(label);
  return m ? m[1].toUpperCase() : label.replace(/^built-in /, 'standard ');
};

/**
 * The nearest of the bodies [{label, sex, cm: [8]}] by the sum of squared differences of what is known:
 * {index, worst: {measure, cm}} or null. The largest difference is what a shopper wants to hear.
 */
export function nearest(mine, bodies) {
  let best = null;
  bodies.forEach((body, index) => {
    if (!body?.cm || (mine.sex && body.sex && mine.sex !== body.sex)) return;
    let sum = 0;
    let worst = null;
    measures.forEach((measure, i) => {
      if (!Number.isFinite(mine[measure])) return;
      const cm = mine[measure] - body.cm[i];
      sum += cm * cm;
      if (!worst || Math.abs(cm) > Math.abs(worst.cm)) worst = { measure, cm };
    });
    if (worst && (!best || sum < best.sum)) best = { index, sum, worst };
  });
  return best;
}

export function howNear(found, body) {
  const { measure, cm } = found.worst;
  const far = Math.abs(cm) < 0.05 ? 'with your very measurements'
    : `the largest difference: your ${spoken[measure]} is ${Math.abs(cm).toFixed(1)} cm ${cm > 0 ? 'more' : 'less'}`;
  return `Nearest to you: ${sizeLabel(body.label)}, ${far}.`;
}

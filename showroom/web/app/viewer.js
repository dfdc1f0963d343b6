// SPDX-License-Identifier: GPL-3.0-or-later
// One <model-viewer> at a time: made when it is wanted, taken out with its memory when it is not.
const vendor = new URL('../vendor/', import.meta.url);
let loading = null;

function loadViewer() {
  // The decoder's place has to be known before the element is defined; the viewer's own would be another host.
  self.ModelViewerElement ??= { meshoptDecoderLocation: new URL('meshopt_decoder.js', vendor).href };
  loading ??= import(new URL('model-viewer.min.js', vendor).href);
  return loading;
}

export const still = matchMedia('(prefers-reduced-motion: reduce)');
/** A shopper who saves data, or a page from a disk, which may not read its neighbours, gets a button or pictures. */
export const eager = !navigator.connection?.saveData;
export const onDisk = location.protocol === 'file:';

export class Viewer {
  constructor(stage, { alt, poster }) {
    this.stage = stage;
    this.alt = alt;
    this.poster = poster;
    this.element = null;
  }

  /** Shows the model at this address; settles when it can be seen. */
  async show(src, { ar = true } = {}) {
    await loadViewer();
    if (this.gone) return;
    if (!this.element) {
      const v = document.createElement('model-viewer');
      v.setAttribute('alt', this.alt);
      v.setAttribute('camera-controls', '');
      v.setAttribute('touch-action', 'pan-y');
      v.setAttribute('interaction-prompt', 'none');
      v.setAttribute('camera-orbit', '0deg 85deg 100%');
      v.setAttribute('min-camera-orbit', 'auto 20deg auto');
      v.setAttribute('max-camera-orbit', 'auto 110deg auto');
      v.setAttribute('shadow-intensity', '0.6');
      v.setAttribute('shadow-softness', '0.8');
      v.setAttribute('exposure', '1.05');
      if (ar) {
        v.setAttribute('ar', '');
        v.setAttribute('ar-modes', 'webxr scene-viewer quick-look');
      }
      if (still.matches) v.setAttribute('interpolation-decay', '1');
      this.element = v;
      v.hidden = true;
      v.style.position = 'absolute';
      this.stage.append(v);
      v.hidden = false;
    }
    const v = this.element;
    v.setAttribute('alt', this.alt);
    const seen = new Promise((resolve, reject) => {
      v.addEventListener('load', resolve, { once: true });
      v.addEventListener('error', (e) => reject(new Error(e.detail?.sourceError?.message ?? 'the model cannot be shown')),
        { once: true });
    });
    v.src = src;
    await seen;
    this.stage.classList.add('live');
  }

  turn(degrees) {
    if (!this.element) return;
    this.element.cameraOrbit = `${degrees}deg 85deg 100%`;
    if (still.matches) this.element.jumpCameraToGoal();
  }

  /** Takes the element out; the viewer gives textures and geometry back when it is. */
  remove() {
    this.gone = true;
    this.stage.classList.remove('live');
    if (!this.element) return;
    this.element.removeAttribute('src');
    this.element.remove();
    this.element = null;
  }
}

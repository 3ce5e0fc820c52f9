// In a corner of the picture: which way the axes point, and a ruler where lengths are the same everywhere.

import {byId, el, short, svg} from '../panel/dom.js';

const LENGTH = 24, LONGEST = 96;  // pixels, of the axes and of the ruler

/** The greatest of 1, 2, 5, 10, 20 and so on that is not greater. */
function roundLength(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  return power * ([5, 2].find((times) => times * power <= most) ?? 1);
}

export class Gauges {
  constructor(view) {
    this.view = view;
    this.axes = ['X', 'Y', 'Z'].map((name) => svg('g', {class: name}, svg('line', {}), svg('text', {}, name)));
    this.picture = svg('svg', {viewBox: '-36 -36 72 72', width: 72, height: 72}, ...this.axes);
    this.ruler = el('div', {id: 'ruler', role: 'img'});
    this.box = el('div', {id: 'gauges'}, this.ruler, this.picture);
    this.picture.setAttribute('aria-hidden', 'true');
    byId('canvas').after(this.box);
    view.viewport.onDraw = () => this.show();
  }

  show() {
    const {viewport} = this.view, axes = viewport.axes();
    axes.forEach(([x, y, z], k) => {
      const [line, name] = this.axes[k].children;
      line.setAttribute('x2', LENGTH * x);
      line.setAttribute('y2', -LENGTH * y);
      name.setAttribute('x', (LENGTH + 7) * x);
      name.setAttribute('y', -(LENGTH + 7) * y);
      this.axes[k].setAttribute('opacity', z < -0.2 ? 0.55 : 1);  // those that point away
    });
    const order = [0, 1, 2].sort((a, b) => axes[a][2] - axes[b][2]).map((k) => this.axes[k]);
    if (order.some((axis, i) => axis !== this.picture.children[i])) this.picture.append(...order);
    this.showRuler(viewport.isOrthographic ? viewport.pixel * this.view.space.side : 0);
  }

  /** A pixel has this length. */
  showRuler(pixel) {
    this.ruler.hidden = pixel === 0;
    if (pixel === 0) return;
    const length = roundLength(LONGEST * pixel), {unit} = this.view.scene, text = `${short(length)}${unit ? ` ${unit}` : ''}`;
    this.ruler.style.width = `${length / pixel}px`;
    if (this.ruler.textContent === text) return;
    this.ruler.textContent = text;
    this.ruler.setAttribute('aria-label', `Ruler: ${text}`);
  }

  end() { this.box.remove(); }
}

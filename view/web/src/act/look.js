// How everything is shown: from where, how opaque, in which colours.

import {legendColors} from '../data/heat.js';
import {byId, el, grouped, save, short} from '../panel/dom.js';
import {explosion, showsParts} from '../picture/materials.js';

export class Look {
  constructor(view) { this.view = view; }

  /** The theme, and from where one looks. */
  direct() {
    const {viewport, space, state: {theme, look}} = this.view;
    this.setTheme(theme);
    if (look) viewport.look(look[0], look[1], look[2] * space.radius, look.slice(3).map((x) => x * space.radius));
  }

  open() {
    const {state, hasHeat, sides} = this.view;
    this.legend();
    this.setOrthographic(state.orthographic);
    this.setOpacity(state.opacity);
    this.setEdges(state.edges);
    this.setDefects(state.defects);
    this.setHeat(state.heat && hasHeat);
    this.setBeside(state.beside && sides.length > 1);
    this.setParts(state.parts);
    this.setExplosion(state.explosion);
  }

  show(i, is) {
    const {bodies, state, viewport} = this.view;
    bodies[i].body.visible = is;
    state.hidden = bodies.flatMap((entry, k) => entry.body.visible ? [] : [k]);
    viewport.changed();
  }

  setOpacity(opacity) {
    this.view.state.opacity = opacity;
    this.applyOpacity();
  }
  /** What others lie in is glass. */
  applyOpacity() {
    const {bodies, state, viewport} = this.view;
    for (const {body, isGlass} of bodies) body.setOpacity(isGlass && !state.beside && !state.heat ? state.opacity : 1);
    viewport.changed();
  }

  setEdges(is) {
    const {bodies, state, base, viewport} = this.view;
    state.edges = is;
    for (const {body, role} of bodies) body.showEdges(is && (role === 'hull' || state.beside));
    base?.showEdges(is);
    this.colorEdges();
    viewport.changed();
  }
  setDefects(is) {
    const {bodies, state, viewport, hasDefects} = this.view;
    if (!hasDefects) return;
    state.defects = is;
    for (const {body} of bodies) body.showDefects(is);
    viewport.changed();
  }
  colorEdges() {
    const color = this.isDark ? [0.02, 0.05, 0.1] : [0.05, 0.1, 0.18];
    for (const body of this.view.allBodies) body.setEdgeColor(color);
  }

  setHeat(is) {
    this.view.state.heat = is;
    for (const hull of this.view.hulls) hull.body.showHeat(is);
    byId('legend').hidden = !is;
    this.applyOpacity();
  }
  /** One for all hulls. */
  legend() {
    const {heatMax, scene: {unit}} = this.view;
    byId('legend-bar').style.background = `linear-gradient(to right, ${legendColors(24).join(', ')})`;
    byId('legend-title').textContent = `Distance from the original${unit ? `, in ${unit}` : ', in the unit of the mesh'}`;
    byId('legend-ticks').replaceChildren(...[0, 0.25, 0.5, 0.75, 1].map((t) => el('span', {}, short(t * heatMax, 3))));
  }

  setParts(is) {
    this.view.state.parts = showsParts.value = is;
    this.view.viewport.changed();
  }
  setExplosion(factor) {
    this.view.state.explosion = explosion.value = factor;
    this.view.picks.show();
    this.view.viewport.changed();
  }

  setBeside(is) {
    const {state, viewport, sides, base} = this.view;
    state.beside = is;
    viewport.panels = is ? sides : null;
    if (base) base.visible = is;
    byId('captions').replaceChildren(...(is ? sides.map(({name}) => el('span', {}, name)) : []));
    this.setEdges(state.edges);
    this.applyOpacity();
    this.caption();
  }
  caption() {
    const {state, sides} = this.view;
    if (!state.beside) return;
    sides.forEach(({hull, name}, i) => {
      if (hull?.levels) byId('captions').children[i].textContent = `${name}, ${grouped(hull.levels.shownFaces)} faces`;
    });
  }

  get isDark() {
    const {theme} = this.view.state;
    return (theme ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light')) === 'dark';
  }
  setTheme(theme) {
    this.view.state.theme = theme;
    document.documentElement.dataset.theme = this.isDark ? 'dark' : 'light';
    this.view.viewport.setBackground(this.isDark ? '#12161a' : '#f4f5f6');
    this.colorEdges();
  }
  toggleTheme() { this.setTheme(this.isDark ? 'light' : 'dark'); }

  setOrthographic(is) {
    this.view.state.orthographic = is;
    this.view.viewport.setOrthographic(is);
    byId('orthographic').setAttribute('aria-pressed', String(is));
  }
  toggleOrthographic() { this.setOrthographic(!this.view.state.orthographic); }

  async savePicture() {
    save(await this.view.viewport.picture(), 'prohull-view.png');
  }
}

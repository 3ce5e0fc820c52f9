// A plane that cuts everything.

import {byId} from '../panel/dom.js';

const AXES = {x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1]};

export class Section {
  constructor(view) { this.view = view; }

  /** "x", "y", "z", "v" for the direction that one looks in, or "" for no section. */
  setAxis(axis) {
    const {state, viewport} = this.view;
    state.cut = axis;
    const back = viewport.camera.position.clone().sub(viewport.controls.target).normalize().toArray();
    if (axis === 'v') state.cutFacing = back;
    // What is nearer to the viewer goes.
    state.cutSign = axis === 'v' || !axis || back['xyz'.indexOf(axis)] >= 0 ? 1 : -1;
    this.cut();
  }
  /** A second time, the key ends the section. */
  toggle(axis) { this.setAxis(this.view.state.cut === axis ? '' : axis); }

  setPlace(at) {
    this.view.state.cutAt = Math.max(-1, Math.min(1, at));
    this.cut();
  }
  move(by) { this.setPlace(this.view.state.cutAt + by); }
  flip() {
    this.view.state.cutSign = -this.view.state.cutSign;
    this.cut();
  }

  cut() {
    const {state: {cut, cutAt, cutSign, cutFacing}, space, viewport, allBodies} = this.view;
    byId('cut').value = cut;
    byId('cut-at').value = cutAt;
    for (const id of ['cut-at', 'flip']) byId(id).hidden = !cut;
    const axis = cut === 'v' ? cutFacing : AXES[cut];
    if (!axis) return viewport.setCut(null, 0, allBodies);
    const reach = axis.reduce((sum, x, k) => sum + Math.abs(x) * space.half[k], 0);
    viewport.setCut(axis.map((x) => x * cutSign), cutSign * cutAt * reach, allBodies);
  }
}

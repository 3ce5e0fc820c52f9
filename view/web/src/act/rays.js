// A ray meets the active progressive hull, which is split only where it does.

import {Refinement} from '../data/query.js';

const FOUND = '#00664a', MISSED = '#a33600', RAY = '#5b2a86';

export class RayControl {
  constructor(view) {
    this.view = view;
    this.query = null;
  }

  open() {
    const {ray} = this.view.state;
    if (ray) this.shoot({origin: ray.slice(0, 3), direction: ray.slice(3)});
  }

  /** A ray in the unit of the mesh. */
  shoot(ray) {
    const {view} = this, {levels, body} = view.active;
    if (!levels || !ray.direction.some((x) => x !== 0)) return;
    view.levels.stop();
    view.levels.arrive();
    this.end();
    this.refinement ??= new Refinement(levels);
    const origin = view.space.steps(ray.origin);
    const tip = view.space.steps(ray.origin.map((x, k) => x + ray.direction[k]));
    this.query = {ray, hull: view.active, ...this.refinement.shoot({origin, direction: tip.map((x, k) => x - origin[k])})};
    for (const hit of this.query.hits) hit.point = ray.origin.map((x, k) => x + hit.t * ray.direction[k]);
    body.replaceFaces(this.refinement.triangles());
    body.update(this.query.faces);
    view.state.ray = [...ray.origin, ...ray.direction];
    view.refresh();
  }
  shootAt(x, y) {
    const {active, state, viewport, space} = this.view;
    if (!active.levels || state.beside) return;
    const {origin, direction} = viewport.ray(x, y), from = space.point(origin.toArray());
    const to = space.point(origin.clone().add(direction).toArray());
    this.shoot({origin: from, direction: to.map((x, k) => x - from[k])});
  }
  shootThroughMiddle() { this.shootAt(...this.view.viewport.middle); }

  /** The level is shown again that was shown before. */
  end() {
    if (!this.query) return;
    const {hull} = this.query, {view} = this;
    this.refinement.rollBack();
    hull.body.replaceFaces(null);
    this.query = view.state.ray = null;
    view.levels.show(hull, view.levels.first(hull));
    view.refresh();
  }

  /** Another hull comes. */
  forget() { this.refinement = null; }

  mark() {
    if (!this.query) return;
    const {viewport, space} = this.view, {ray, hits} = this.query;
    const length = 2 * (viewport.homeDistance + viewport.radius) * space.side / Math.hypot(...ray.direction);
    viewport.line([ray.origin, ray.origin.map((x, k) => x + length * ray.direction[k])].map((p) => space.at(p)), RAY);
    hits.forEach((hit, i) => {
      viewport.mark(space.at(hit.point), String(i + 1), hit.found ? FOUND : MISSED).userData.point = hit.point;
    });
  }
}

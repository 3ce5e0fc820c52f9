// Places that are marked and flown to: the farthest point, and what lies outside.

const FAR = '#c2410c', OUTSIDE = '#a3195b';

export class Places {
  constructor(view) { this.view = view; }

  flyTo(point) { this.view.viewport.fly(this.view.space.at(point)); }

  /** Where a point of a body is. */
  flyToPointOf(body, point) { this.view.viewport.fly(point.clone().applyMatrix4(body.moved.matrix)); }

  get worst() { return this.view.active.verification?.worst ?? []; }

  mark() {
    const {viewport, space, rays, panel} = this.view;
    viewport.clearMarks();
    rays.mark();
    this.far = panel.farthest();
    const {far} = this;
    if (!rays.query && far?.lower > 0) viewport.mark(space.at(far.farthest), '★', FAR).userData.point = far.farthest;
    this.worst.forEach((o, i) => {
      viewport.mark(space.at(o.point), String(i + 1), OUTSIDE).userData.point = o.point;
    });
  }

  /** While the level changes. */
  follow() {
    if (this.view.panel.farthest() !== this.far) this.mark();
  }

  nextOutside() {
    if (this.worst.length === 0) return;
    this.seen = ((this.seen ?? -1) + 1) % this.worst.length;
    this.flyTo(this.worst[this.seen].point);
  }
}

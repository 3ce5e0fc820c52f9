// Where things are drawn: the longest side of the scene has length 1, and its middle is at 0.

const STEPS = 2 ** 30 - 1;

export class Space {
  /** `arrays` has points as steps of the grid, each with how far things reach around its points, or without. */
  constructor({origin, step}, arrays) {
    this.origin = origin;
    this.side = step * STEPS;  // in the unit of the meshes
    const most = [0, 0, 0], least = [STEPS, STEPS, STEPS];
    for (const [steps, around] of arrays)
      for (let i = 0; i < steps.length; ++i) {
        const reach = around ? around[Math.floor(i / 3)] : 0;
        most[i % 3] = Math.max(most[i % 3], steps[i] + reach);
        least[i % 3] = Math.min(least[i % 3], steps[i] - reach);
      }
    this.middle = most.map((m, k) => (m + least[k]) / 2 / STEPS);
    this.half = most.map((m, k) => (m - least[k]) / 2 / STEPS);
  }

  /** Where points are drawn that are given as steps of the grid, x, y, z in turn. */
  drawn(steps) {
    const points = new Float32Array(steps.length);
    for (let i = 0; i < steps.length; ++i) points[i] = steps[i] / STEPS - this.middle[i % 3];
    return points;
  }

  lengths(steps) { return Float32Array.from(steps, (x) => x / STEPS); }

  /** Where a point in the unit of the meshes is drawn. */
  at(point) {
    return point.map((x, k) => x / this.side - this.origin[k] / this.side - this.middle[k]);
  }

  /** A point in the unit of the meshes, as steps of the grid. */
  steps(point) { return point.map((x, k) => (x - this.origin[k]) / this.side * STEPS); }

  /** The point in the unit of the meshes that is drawn there. */
  point(drawn) {
    return drawn.map((x, k) => (x + this.middle[k]) * this.side + this.origin[k]);
  }

  get radius() { return Math.max(Math.hypot(...this.half), 1e-6); }
}

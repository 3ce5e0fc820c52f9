// Where things are drawn: the longest side of the scene has length 1, and its middle is at 0.

const STEPS = 2 ** 30 - 1;

export class Space {
  constructor({origin, step}, arrays) {
    this.origin = origin;
    this.side = step * STEPS;  // in the unit of the meshes
    const most = [0, 0, 0], least = [STEPS, STEPS, STEPS];
    for (const steps of arrays)
      for (let i = 0; i < steps.length; ++i) {
        most[i % 3] = Math.max(most[i % 3], steps[i]);
        least[i % 3] = Math.min(least[i % 3], steps[i]);
      }
    this.middle = most.map((m, k) => (m + least[k]) / 2 / STEPS);
    this.half = most.map((m, k) => (m - least[k]) / 2 / STEPS);
  }

  /** Of steps of the grid, x, y, z in turn. */
  drawn(steps) {
    const points = new Float32Array(steps.length);
    for (let i = 0; i < steps.length; ++i) points[i] = steps[i] / STEPS - this.middle[i % 3];
    return points;
  }

  /** Of a point in the unit of the meshes. */
  at(point) {
    return point.map((x, k) => x / this.side - this.origin[k] / this.side - this.middle[k]);
  }

  /** Of a point in the unit of the meshes, as steps of the grid. */
  steps(point) { return point.map((x, k) => (x - this.origin[k]) / this.side * STEPS); }

  /** In the unit of the meshes. */
  point(drawn) {
    return drawn.map((x, k) => (x + this.middle[k]) * this.side + this.origin[k]);
  }

  get radius() { return Math.max(Math.hypot(...this.half), 1e-6); }
}

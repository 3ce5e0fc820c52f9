// A ray meets a progressive hull, which is split only where it does: Platis and Theoharis (2003), 3.2.1. What is tested, and in
// which order, is what `prohull query --engine paper-refinement --mode all` tests (paper/refinement_engine.cpp), so that
// the counts are the same.

import {NONE} from './levels.js';

/** Where a ray crosses a face of which the corners stand at 3 times a, b and c in `points`: null, or t and whether it enters. */
function crossing({origin: p, direction: d}, points, a, b, c) {
  const at = (v, k) => points[3 * v + k] - p[k];
  const side = (v, w) =>
      d[0] * (at(v, 1) * at(w, 2) - at(v, 2) * at(w, 1)) + d[1] * (at(v, 2) * at(w, 0) - at(v, 0) * at(w, 2)) +
      d[2] * (at(v, 0) * at(w, 1) - at(v, 1) * at(w, 0));
  const ab = side(a, b), bc = side(b, c), ca = side(c, a);
  const leaves = ab >= 0 && bc >= 0 && ca >= 0, enters = ab <= 0 && bc <= 0 && ca <= 0;
  const sum = ab + bc + ca;
  if (!(leaves || enters) || sum === 0) return null;
  const depth = (v) => (at(v, 0) * d[0] + at(v, 1) * d[1] + at(v, 2) * d[2]) / (d[0] ** 2 + d[1] ** 2 + d[2] ** 2);
  const t = (bc * depth(a) + ca * depth(b) + ab * depth(c)) / sum;
  return t >= 0 ? {t, entering: enters} : null;
}

/** Whether a ray meets the box around some points. */
function meetsBox({origin, direction}, points, vertices) {
  let from = 0, to = Infinity;
  for (let k = 0; k < 3; ++k) {
    let least = Infinity, most = -Infinity;
    for (let v = 0; v < vertices; ++v) {
      least = Math.min(least, points[3 * v + k]);
      most = Math.max(most, points[3 * v + k]);
    }
    const ends = [(least - origin[k]) / direction[k], (most - origin[k]) / direction[k]].sort((x, y) => x - y);
    if (direction[k] === 0 && (origin[k] < least || origin[k] > most)) return false;
    if (direction[k] === 0) continue;
    from = Math.max(from, ends[0]);
    to = Math.min(to, ends[1]);
  }
  return from <= to;
}

export class Refinement {
  constructor(levels) {
    this.levels = levels;
    this.isSplit = new Uint8Array(levels.count);
    this.waiting = new Uint8Array(levels.finestFaces);
  }

  /** Splits the base mesh where the ray meets it. The ray is on the grid of the page. */
  shoot(ray) {
    const {levels} = this;
    const crossings = this.originalCrossings(ray);
    levels.goTo(0);
    Object.assign(this, {ray, tests: 0, found: [], splits: [], stars: [], queue: [], taken: 0, lastTaken: 0});
    this.pending = levels.firstSplits.slice();
    if (meetsBox(ray, levels.steps, levels.baseVertices)) this.refine();
    const found = new Set(this.found);
    return {
      tests: this.tests,
      splits: this.splits.length,
      faces: levels.baseFaces + 2 * this.splits.length,
      hits: crossings.map(({face, ...hit}) => ({...hit, found: found.has(face)})),
    };
  }

  /** All crossings with the original, in order. */
  originalCrossings(ray) {
    const {levels} = this, {corners, steps} = levels, found = [];
    levels.goTo(levels.count);
    for (let f = 0; f < levels.finestFaces; ++f) {
      const hit = crossing(ray, steps, corners[3 * f], corners[3 * f + 1], corners[3 * f + 2]);
      if (hit) found.push({face: f, ...hit});
    }
    return found.sort((x, y) => x.t - y.t);
  }

  refine() {
    const {corners, steps} = this.levels;
    for (let face = this.take(); face !== NONE; face = this.take()) {
      const vertices = corners.slice(3 * face, 3 * face + 3);
      if (!crossing(this.ray, steps, ...vertices)) continue;
      const wanted = [...vertices].map((v) => this.pending[v]).filter((split) => split !== NONE);
      if (wanted.length === 0) this.found.push(face);
      for (const split of wanted) this.split(split);
    }
  }

  /** The next candidate: first the faces of the base mesh, then those that splits changed. */
  take() {
    if (this.lastTaken < this.levels.baseFaces) {
      ++this.tests;
      return this.lastTaken++;
    }
    if (this.queue.length === this.taken) return NONE;
    ++this.tests;
    const face = this.queue[this.taken++];
    this.waiting[face] = 0;
    return face;
  }

  add(face) {
    const hadTurn = face >= this.levels.baseFaces || face < this.lastTaken;
    if (!hadTurn || this.waiting[face]) return;
    this.waiting[face] = 1;
    this.queue.push(face);
  }

  /** Makes a split, and before it those that it needs; then the faces that they changed are candidates. */
  split(wanted) {
    if (this.isSplit[wanted]) return;
    const first = this.splits.length, stack = [[wanted, this.levels.needs(wanted), 0]];
    while (stack.length > 0) {
      const top = stack[stack.length - 1], [k, needs] = top;
      while (top[2] < needs.length && this.isSplit[needs[top[2]]]) ++top[2];
      if (top[2] < needs.length) {
        const next = needs[top[2]];
        stack.push([next, this.levels.needs(next), 0]);
      } else {
        this.make(k);
        stack.pop();
      }
    }
    for (let i = first; i < this.splits.length; ++i) {
      for (const corner of this.stars[i]) this.add(Math.floor(corner / 3));
      const face = this.levels.baseFaces + 2 * this.splits[i];
      this.add(face);
      this.add(face + 1);
    }
  }

  make(k) {
    const {levels} = this;
    this.stars.push(levels.orderedStar(k));
    levels.apply(k, true);
    this.isSplit[k] = 1;
    this.splits.push(k);
    this.pending[levels.splitVertices[k]] = levels.nextOfO[k];
    this.pending[levels.baseVertices + k] = levels.nextOfD[k];
  }

  /** The faces that are there, as corners. */
  triangles() {
    const {corners, baseFaces} = this.levels;
    const found = new Uint32Array(3 * (baseFaces + 2 * this.splits.length));
    found.set(corners.subarray(0, 3 * baseFaces));
    this.splits.forEach((k, i) => {
      const at = 3 * (baseFaces + 2 * k);
      found.set(corners.subarray(at, at + 6), 3 * (baseFaces + 2 * i));
    });
    return found;
  }

  /** Back to the base mesh. */
  rollBack() {
    for (let i = this.splits.length; i-- > 0;) {
      this.levels.apply(this.splits[i], false);
      this.isSplit[this.splits[i]] = 0;
    }
    this.splits = [];
  }
}

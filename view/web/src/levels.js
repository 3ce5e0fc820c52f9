// A progressive hull: vertex splits replayed forth and back. view/levels.h describes the record.

import {numbers, reals} from './blocks.js';

const following = (corner) => corner % 3 === 2 ? corner - 2 : corner + 1;
const preceding = (corner) => corner % 3 === 0 ? corner + 2 : corner - 1;

/** The one number that is in `some` and not in `others`. */
const only = (some, others) => some.find((v) => !others.includes(v));

export class Levels {
  constructor(facts, bytes) {
    this.baseFaces = facts.base_faces;
    this.count = facts.splits;
    this.level = this.count;  // how many splits are made
    const base = numbers(bytes, facts.positions);
    this.baseVertices = base.length / 3;
    this.splitVertices = numbers(bytes, facts.split_vertices);
    this.readFaces(numbers(bytes, facts.triangles), numbers(bytes, facts.split_bits));
    this.readPositions(base, numbers(bytes, facts.split_moves));
    this.readHeat(numbers(bytes, facts.heat), numbers(bytes, facts.split_heat));
    this.voids = facts.void_ratios ? reals(bytes, facts.void_ratios) : null;
  }

  get finestFaces() { return this.baseFaces + 2 * this.count; }
  get faces() { return this.baseFaces + 2 * this.level; }
  get vertices() { return this.baseVertices + this.level; }

  /** The finest level of at most so many faces, or the base mesh: a number of splits. */
  levelOf(faces) {
    return Math.max(0, Math.min(this.count, Math.floor((faces - this.baseFaces) / 2)));
  }

  /** Makes all splits, to learn which corners each of them gives to d. */
  readFaces(base, bits) {
    const corners = new Uint32Array(base.length + 6 * this.count);
    corners.set(base);
    const cornersOf = Array.from({length: this.baseVertices}, () => []);
    base.forEach((v, corner) => cornersOf[v].push(corner));
    const moved = [], ends = new Uint32Array(this.count + 1);
    let bit = 0;
    const add = (at, face) => face.forEach((v, k) => {
      corners[at + k] = v;
      cornersOf[v].push(at + k);
    });
    for (let k = 0; k < this.count; ++k) {
      const o = this.splitVertices[k], d = this.baseVertices + k;
      const kept = [], given = [];
      for (const corner of cornersOf[o]) {
        (bits[bit >> 3] >> (bit & 7) & 1 ? given : kept).push(corner);
        ++bit;
      }
      // Counter-clockwise the faces of o go from l to r.
      const from = kept.map((c) => corners[following(c)]), to = kept.map((c) => corners[preceding(c)]);
      const l = only(from, to), r = only(to, from);
      for (const corner of given) {
        corners[corner] = d;
        moved.push(corner);
      }
      ends[k + 1] = moved.length;
      cornersOf[o] = kept;
      cornersOf.push(given);
      add(base.length + 6 * k, [o, d, l]);
      add(base.length + 6 * k + 3, [d, o, r]);
    }
    this.corners = corners;
    this.moved = Uint32Array.from(moved);
    this.movedEnds = ends;
  }

  /** The positions at the finest level, and those of s and o for every split. */
  readPositions(base, moves) {
    const steps = new Float64Array(3 * (this.baseVertices + this.count));
    steps.set(base);
    this.before = new Float64Array(3 * this.count);
    this.after = new Float64Array(3 * this.count);
    for (let k = 0; k < this.count; ++k) {
      const s = 3 * this.splitVertices[k], d = 3 * (this.baseVertices + k);
      for (let i = 0; i < 3; ++i) {
        const from = steps[s + i];
        this.before[3 * k + i] = from;
        this.after[3 * k + i] = steps[s + i] = from + moves[6 * k + i];
        steps[d + i] = from + moves[6 * k + 3 + i];
      }
    }
    this.steps = steps;
  }

  readHeat(base, splits) {
    this.heat = new Float32Array(this.baseVertices + this.count);
    this.heat.set(base);
    this.heatBefore = new Float32Array(this.count);
    this.heatAfter = new Float32Array(this.count);
    for (let k = 0; k < this.count; ++k) {
      this.heatBefore[k] = this.heat[this.splitVertices[k]];
      this.heatAfter[k] = this.heat[this.splitVertices[k]] = splits[2 * k];
      this.heat[this.baseVertices + k] = splits[2 * k + 1];
    }
    const scale = (array) => { for (let i = 0; i < array.length; ++i) array[i] /= 65535; };
    [this.heat, this.heatBefore, this.heatAfter].forEach(scale);
  }

  /** Positions become those that are drawn. */
  place(space) {
    this.positions = space.drawn(this.steps);
    this.before = space.drawn(this.before);
    this.after = space.drawn(this.after);
    this.steps = null;
  }

  /** Makes or undoes splits; returns whether there were any. */
  goTo(level) {
    const changes = level !== this.level;
    while (this.level < level) this.apply(this.level++, true);
    while (this.level > level) this.apply(--this.level, false);
    return changes;
  }

  apply(k, forth) {
    const s = this.splitVertices[k], v = forth ? this.baseVertices + k : s;
    const positions = forth ? this.after : this.before;
    for (let i = 0; i < 3; ++i) this.positions[3 * s + i] = positions[3 * k + i];
    this.heat[s] = (forth ? this.heatAfter : this.heatBefore)[k];
    for (let i = this.movedEnds[k]; i < this.movedEnds[k + 1]; ++i) this.corners[this.moved[i]] = v;
  }

  /** The mesh of a level, on its own. */
  copy(level) {
    const now = this.level;
    this.goTo(level);
    const mesh = {
      positions: this.positions.slice(0, 3 * (this.baseVertices + level)),
      triangles: this.corners.slice(0, 3 * this.faces),
    };
    this.goTo(now);
    return mesh;
  }
}

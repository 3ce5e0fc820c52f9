// A progressive hull: vertex splits replayed forth and back. view/levels.h describes the record.

import {numbers, reals} from './blocks.js';

const following = (corner) => corner % 3 === 2 ? corner - 2 : corner + 1;
const preceding = (corner) => corner % 3 === 0 ? corner + 2 : corner - 1;

const NONE = 0xffffffff;

/** The vertex of each corner, and for each vertex a chain of its corners, in the order in which they came. */
class Stars {
  constructor(corners, vertices) {
    this.corners = new Uint32Array(corners);
    this.next = new Uint32Array(corners);
    this.first = new Uint32Array(vertices).fill(NONE);
    this.last = new Uint32Array(vertices);
    this.seen = new Uint32Array(vertices);
    this.time = 0;
  }

  append(corner, v) {
    this.corners[corner] = v;
    this.next[corner] = NONE;
    if (this.first[v] === NONE) this.first[v] = corner;
    else this.next[this.last[v]] = corner;
    this.last[v] = corner;
  }

  addFace(at, a, b, c) {
    this.append(at, a);
    this.append(at + 1, b);
    this.append(at + 2, c);
  }

  /** Gives d the corners of o whose bits are set, and lists them in `moved`; returns the place of the next bit. */
  divide(o, d, bits, bit, moved) {
    let corner = this.first[o];
    this.first[o] = NONE;
    for (; corner !== NONE; ++bit) {
      const next = this.next[corner];
      if (bits[bit >> 3] >> (bit & 7) & 1) {
        this.append(corner, d);
        moved.push(corner);
      } else {
        this.append(corner, o);
      }
      corner = next;
    }
    return bit;
  }

  /** The ends l and r of the link of o, whose faces go counter-clockwise from l to r. */
  sides(o) { return [this.only(o, following, preceding), this.only(o, preceding, following)]; }

  /** The one vertex that `some` finds beside a corner of o, and `others` beside none. */
  only(o, some, others) {
    ++this.time;
    for (let c = this.first[o]; c !== NONE; c = this.next[c]) this.seen[this.corners[others(c)]] = this.time;
    for (let c = this.first[o]; c !== NONE; c = this.next[c])
      if (this.seen[this.corners[some(c)]] !== this.time) return this.corners[some(c)];
    throw new Error('the record of vertex splits is damaged');
  }
}

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
    const star = new Stars(base.length + 6 * this.count, this.baseVertices + this.count);
    for (let at = 0; at < base.length; at += 3) star.addFace(at, base[at], base[at + 1], base[at + 2]);
    const moved = [], ends = new Uint32Array(this.count + 1);
    let bit = 0;
    for (let k = 0, at = base.length; k < this.count; ++k, at += 6) {
      const o = this.splitVertices[k], d = this.baseVertices + k;
      bit = star.divide(o, d, bits, bit, moved);
      ends[k + 1] = moved.length;
      const [l, r] = star.sides(o);
      star.addFace(at, o, d, l);
      star.addFace(at + 3, d, o, r);
    }
    this.corners = star.corners;
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

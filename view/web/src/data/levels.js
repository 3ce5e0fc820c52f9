// A progressive hull: vertex splits replayed forth and back. view/levels.h describes the record.

import {numbers, reals} from './blocks.js';
import {breathe} from './breathe.js';

const following = (corner) => corner % 3 === 2 ? corner - 2 : corner + 1;
const preceding = (corner) => corner % 3 === 0 ? corner + 2 : corner - 1;

export const NONE = 0xffffffff;

/** Lists of numbers, one after the other. */
class Pool {
  constructor(lists) {
    this.ends = new Uint32Array(lists + 1);
    this.values = new Uint32Array(4 * lists);
    this.size = this.lists = 0;
  }
  push(value) {
    if (this.size === this.values.length) {
      const values = new Uint32Array(2 * this.size + 16);
      values.set(this.values);
      this.values = values;
    }
    this.values[this.size++] = value;
  }
  end() { this.ends[++this.lists] = this.size; }
  of(list) { return this.values.subarray(this.ends[list], this.ends[list + 1]); }
}

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

  /** The face (a, b, c), of which a stands at corner `turn`. */
  addFace(at, a, b, c, turn) {
    this.append(at + turn, a);
    this.append(at + (turn + 1) % 3, b);
    this.append(at + (turn + 2) % 3, c);
  }

  /** Gives d the corners of o whose bits are set: these are `moved`. Returns the place of the next bit. */
  divide(o, d, bits, bit, moved, kept) {
    let corner = this.first[o];
    this.first[o] = NONE;
    for (; corner !== NONE; ++bit) {
      const next = this.next[corner];
      if (bits[bit >> 3] >> (bit & 7) & 1) {
        this.append(corner, d);
        moved.push(corner);
      } else {
        this.append(corner, o);
        kept.push(corner);
      }
      corner = next;
    }
    return bit;
  }

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
  constructor(facts) {
    this.baseFaces = facts.base_faces;
    this.count = facts.splits;
    this.level = this.shown = this.count;  // how many splits are made, and how many of them wholly
    this.gliding = 0;                      // how many of the last ones have vertices on their way
  }

  static async read(facts, bytes) {
    const levels = new Levels(facts), base = numbers(bytes, facts.positions);
    levels.baseVertices = base.length / 3;
    levels.splitVertices = numbers(bytes, facts.split_vertices);
    await levels.readFaces(numbers(bytes, facts.triangles), numbers(bytes, facts.split_bits), numbers(bytes, facts.split_turns));
    levels.readPositions(base, numbers(bytes, facts.split_moves));
    await breathe();
    levels.readHeat(numbers(bytes, facts.heat), numbers(bytes, facts.split_heat));
    levels.voids = facts.void_ratios ? reals(bytes, facts.void_ratios) : null;
    return levels;
  }

  get finestFaces() { return this.baseFaces + 2 * this.count; }
  get faces() { return this.baseFaces + 2 * this.level; }
  /** The faces of the true level that is nearest to what is drawn. */
  get shownFaces() { return this.baseFaces + 2 * this.shown; }

  /** The finest level of at most so many faces, or the base mesh: a number of splits. */
  levelOf(faces) {
    return Math.max(0, Math.min(this.count, Math.floor((faces - this.baseFaces) / 2)));
  }

  /** Makes all splits, to learn which corners each of them gives to d, and which splits must come before it. */
  async readFaces(base, bits, turns) {
    const vertices = this.baseVertices + this.count;
    const stars = new Stars(base.length + 6 * this.count, vertices);
    for (let at = 0; at < base.length; at += 3) stars.addFace(at, base[at], base[at + 1], base[at + 2], 0);
    this.moved = new Pool(this.count);
    this.kept = new Pool(this.count);
    this.makers = new Pool(this.count);  // of each split those that made its vertex and its link
    this.firstSplits = new Uint32Array(vertices).fill(NONE);  // of each vertex, as it is when it comes
    this.nextOfO = new Uint32Array(this.count).fill(NONE);
    this.nextOfD = new Uint32Array(this.count).fill(NONE);
    const makers = new Uint32Array(vertices).fill(NONE);
    let bit = 0;
    const pools = [this.makers, this.moved, this.kept];
    for (let k = 0, at = base.length; k < this.count; ++k, at += 6) {
      if (k % 1024 === 0) await breathe();
      const o = this.splitVertices[k], d = this.baseVertices + k;
      this.follow(makers[o], o, k);
      for (let c = stars.first[o]; c !== NONE; c = stars.next[c]) {
        const maker = makers[stars.corners[following(c)]];
        if (maker !== NONE) this.makers.push(maker);
      }
      if (makers[o] !== NONE) this.makers.push(makers[o]);
      makers[o] = makers[d] = k;
      bit = stars.divide(o, d, bits, bit, this.moved, this.kept);
      pools.forEach((pool) => pool.end());
      // Counter-clockwise, the faces of o go from l to r.
      const l = stars.only(o, following, preceding), r = stars.only(o, preceding, following);
      stars.addFace(at, o, d, l, turns[k] % 3);
      stars.addFace(at + 3, d, o, r, Math.floor(turns[k] / 3));
    }
    this.corners = stars.corners;
  }

  /** Split k replaces the vertex v that split `before` made, or that the base mesh has. */
  follow(before, v, k) {
    if (before === NONE) this.firstSplits[v] = k;
    else if (this.splitVertices[before] === v) this.nextOfO[before] = k;
    else this.nextOfD[before] = k;
  }

  /** The splits that come before split k, the last one of the record first. */
  needs(k) {
    return [...new Set(this.makers.of(k))].sort((a, b) => b - a);
  }

  /** The corners of the vertex of split k, where it can be made but is not: counter-clockwise, those of o first. */
  orderedStar(k) {
    const beside = new Map(), ends = new Set(), star = [...this.kept.of(k), ...this.moved.of(k)];
    for (const corner of star) beside.set(this.corners[following(corner)], corner);
    for (const corner of this.kept.of(k)) ends.add(this.corners[preceding(corner)]);
    const first = [...this.kept.of(k)].find((corner) => !ends.has(this.corners[following(corner)]));
    const ordered = [first];
    while (ordered.length < star.length)
      ordered.push(beside.get(this.corners[preceding(ordered[ordered.length - 1])]));
    return ordered;
  }

  /** The positions at the finest level, and those of s and o for every split; all as steps of the grid. */
  readPositions(base, moves) {
    const steps = new Float64Array(3 * (this.baseVertices + this.count));
    steps.set(base);
    this.stepsBefore = new Float64Array(3 * this.count);
    this.stepsAfter = new Float64Array(3 * this.count);
    this.stepsPlaced = new Float64Array(3 * this.count);  // of d, as it comes
    for (let k = 0; k < this.count; ++k) {
      const s = 3 * this.splitVertices[k], d = 3 * (this.baseVertices + k);
      for (let i = 0; i < 3; ++i) {
        const from = steps[s + i];
        this.stepsBefore[3 * k + i] = from;
        this.stepsAfter[3 * k + i] = steps[s + i] = from + moves[6 * k + i];
        this.stepsPlaced[3 * k + i] = steps[d + i] = from + moves[6 * k + 3 + i];
      }
    }
    this.steps = steps;
  }

  readHeat(base, splits) {
    this.heat = new Float32Array(this.baseVertices + this.count);
    this.heat.set(base);
    this.heatBefore = new Float32Array(this.count);
    this.heatAfter = new Float32Array(this.count);
    this.heatPlaced = new Float32Array(this.count);
    for (let k = 0; k < this.count; ++k) {
      this.heatBefore[k] = this.heat[this.splitVertices[k]];
      this.heatAfter[k] = this.heat[this.splitVertices[k]] = splits[2 * k];
      this.heatPlaced[k] = this.heat[this.baseVertices + k] = splits[2 * k + 1];
    }
    const scale = (array) => { for (let i = 0; i < array.length; ++i) array[i] /= 65535; };
    [this.heat, this.heatBefore, this.heatAfter, this.heatPlaced].forEach(scale);
  }

  /** Finds out where everything is drawn. */
  place(space) {
    this.positions = space.drawn(this.steps);
    this.before = space.drawn(this.stepsBefore);
    this.after = space.drawn(this.stepsAfter);
    this.placed = space.drawn(this.stepsPlaced);
    this.stepsPlaced = null;
  }

  /** Makes or undoes splits; returns whether there were any. */
  goTo(level) {
    this.land();
    const changes = level !== this.level;
    while (this.level < level) this.apply(this.level++, true);
    while (this.level > level) this.apply(--this.level, false);
    this.shown = level;
    return changes;
  }

  apply(k, forth) {
    const s = this.splitVertices[k], v = forth ? this.baseVertices + k : s;
    const positions = forth ? this.after : this.before, steps = forth ? this.stepsAfter : this.stepsBefore;
    for (let i = 0; i < 3; ++i) {
      this.positions[3 * s + i] = positions[3 * k + i];
      this.steps[3 * s + i] = steps[3 * k + i];
    }
    this.heat[s] = (forth ? this.heatAfter : this.heatBefore)[k];
    const {ends, values} = this.moved;
    for (let i = ends[k]; i < ends[k + 1]; ++i) this.corners[values[i]] = v;
  }

  /**
   * Between levels: the `ahead` splits after `level` are made in part, the first of them nearly wholly, the last one hardly.
   * Their vertices are on the way from where they parted. Both numbers may have fractions, with which the mesh changes
   * continuously.
   */
  blend(level, ahead) {
    this.goTo(Math.min(this.count, Math.ceil(level + ahead)));
    this.shown = Math.min(this.level, Math.round(level));
    this.gliding = Math.max(0, this.level - Math.floor(level));
    for (let k = this.level; k-- > this.level - this.gliding;) this.setParent(k);
    for (let k = this.level - this.gliding; k < this.level; ++k) this.part(k, Math.min(1, (level + ahead - k) / (ahead + 1)));
  }

  /** All vertices arrive. */
  land() {
    for (let k = this.level - this.gliding; k < this.level; ++k) this.part(k, 1);
    this.gliding = 0;
  }

  /** Where the vertex of split k is before it. */
  setParent(k) {
    const s = this.splitVertices[k];
    for (let i = 0; i < 3; ++i) this.positions[3 * s + i] = this.before[3 * k + i];
    this.heat[s] = this.heatBefore[k];
  }

  /** Moves o and d, which are both where their parent is, by a part of their way. */
  part(k, part) {
    const s = this.splitVertices[k], d = this.baseVertices + k;
    const between = (from, to) => part === 1 ? to : from + part * (to - from);
    for (let i = 0; i < 3; ++i) {
      const from = this.positions[3 * s + i];
      this.positions[3 * s + i] = between(from, this.after[3 * k + i]);
      this.positions[3 * d + i] = between(from, this.placed[3 * k + i]);
    }
    const heat = this.heat[s];
    this.heat[s] = between(heat, this.heatAfter[k]);
    this.heat[d] = between(heat, this.heatPlaced[k]);
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

// The parts of a mesh, such as convex pieces: what shared vertices connect. As `prohull render --explode` draws them.

import {rgb} from '../picture/materials.js';

// The colours of Okabe and Ito (2008), without black; then lighter, then darker.
const COLORS = ['#56b4e9', '#e69f00', '#009e73', '#f0e442', '#0072b2', '#d55e00', '#cc79a7'].map(rgb);
const MOST = 1000;

export function partColor(i) {
  const color = COLORS[i % COLORS.length], round = Math.floor(i / COLORS.length) % 3;
  return round === 0 ? color : color.map((x) => (x + (round === 1 ? 1 : 0)) / 2);
}

/** The number of the part of each vertex, by what faces connect, or edges: these have two `corners`. */
export function numbersOfParts(triangles, vertices, corners = 3) {
  const parents = Uint32Array.from({length: vertices}, (_, v) => v);
  const root = (v) => {
    while (parents[v] !== v) v = parents[v] = parents[parents[v]];
    return v;
  };
  for (let c = 0; c < triangles.length; c += corners)
    for (let k = 1; k < corners; ++k) parents[root(triangles[c + k])] = root(triangles[c]);
  const numbers = new Map();
  for (const v of triangles) if (!numbers.has(root(v))) numbers.set(root(v), numbers.size);
  return {count: numbers.size, of: Uint32Array.from({length: vertices}, (_, v) => numbers.get(root(v)) ?? 0)};
}

/** For each vertex its part, its colour, and how it moves when the parts go apart; null if there is one part only, or too many. */
export function partsOf({positions, triangles}) {
  const vertices = positions.length / 3, parts = numbersOfParts(triangles, vertices);
  if (parts.count < 2 || parts.count > MOST) return null;
  const boxes = Array.from({length: parts.count}, () => ({least: [1, 1, 1], most: [-1, -1, -1]}));
  for (let i = 0; i < positions.length; ++i) {
    const {least, most} = boxes[parts.of[Math.floor(i / 3)]], k = i % 3;
    least[k] = Math.min(least[k], positions[i]);
    most[k] = Math.max(most[k], positions[i]);
  }
  const middle = [0, 1, 2].map((k) => (Math.min(...boxes.map((b) => b.least[k])) + Math.max(...boxes.map((b) => b.most[k]))) / 2);
  const shifts = new Float32Array(positions.length), tints = new Float32Array(positions.length);
  const colors = boxes.map((_, i) => partColor(i));
  for (let i = 0; i < positions.length; ++i) {
    const part = parts.of[Math.floor(i / 3)], k = i % 3;
    shifts[i] = (boxes[part].least[k] + boxes[part].most[k]) / 2 - middle[k];
    tints[i] = colors[part][k];
  }
  return {parts: parts.of, shifts, tints};
}

// Colours for distances, and meshes that have distances on a grid on each face: view/heat.h writes them.

import {numbers} from './blocks.js';

// viridis as a polynomial, the light end for no distance: people with any kind of colour vision can read it, and it stays in order in grey.
const VIRIDIS = [
  [0.2777273, 0.0054073, 0.3340998], [0.1050930, 1.4046135, 1.3845902], [-0.3308618, 0.2148476, 0.0950952],
  [-4.6342305, -5.7991010, -19.3324410], [6.2282699, 14.1799334, 56.6905526],
  [4.7763850, -13.7451454, -65.3530326], [-5.4354559, 4.6458526, 26.3124352]];

const vec3 = (c) => `vec3(${c.map((x) => x.toFixed(7)).join(', ')})`;
export const VIRIDIS_GLSL = `vec3 viridis(float t) { return ${
    VIRIDIS.map(vec3).reduceRight((sum, c) => `${c} + t * (${sum})`)}; }`;

/** Colours along a legend, as CSS has them. */
export function legendColors(count) {
  return Array.from({length: count}, (_, i) => {
    const t = 1 - i / (count - 1);
    const channel = (k) => VIRIDIS.reduceRight((sum, c) => sum * t + c[k], 0);
    return `rgb(${[0, 1, 2].map((k) => Math.round(255 * Math.min(1, Math.max(0, channel(k))))).join(' ')})`;
  });
}

/** The faces of a mesh, divided as its distances are. */
export function dividedMesh({positions, triangles, shifts, tints}, facts, bytes) {
  const parts = numbers(bytes, facts.parts), values = numbers(bytes, facts.values);
  const points = new Float32Array(3 * values.length), heat = new Float32Array(values.length);
  for (let i = 0; i < values.length; ++i) heat[i] = values[i] / 65535;
  const moved = shifts && {shifts: new Float32Array(points.length), tints: new Float32Array(points.length)};
  const corners = [];
  let at = 0;
  for (let f = 0; f < parts.length; ++f) {
    const n = parts[f];
    const [a, b, c] = [0, 1, 2].map((k) => 3 * triangles[3 * f + k]);
    for (let row = 0; row <= n; ++row)
      for (let i = 0; i + row <= n; ++i, ++at) {
        for (let k = 0; k < 3; ++k)
          points[3 * at + k] =
              (positions[a + k] * (n - row - i) + positions[b + k] * i + positions[c + k] * row) / n;
        if (moved) {
          moved.shifts.set(shifts.subarray(a, a + 3), 3 * at);
          moved.tints.set(tints.subarray(a, a + 3), 3 * at);
        }
        if (i + row === n) continue;
        const above = at + n - row + 1;
        corners.push(at, at + 1, above);
        if (i + row < n - 1) corners.push(at + 1, above + 1, above);
      }
  }
  return {positions: points, triangles: Uint32Array.from(corners), heat, ...moved};
}

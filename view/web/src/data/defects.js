// What is wrong with a mesh, to show it.

import * as THREE from 'three';
import {numbersOfParts} from './parts.js';

/** The ends of all edges along which faces do not run as often one way as the other: a watertight mesh has none. */
export function openEdges(triangles, vertices) {
  const keys = new Float64Array(triangles.length);
  for (let c = 0; c < triangles.length; ++c) {
    const a = triangles[c], b = triangles[c % 3 === 2 ? c - 2 : c + 1];
    keys[c] = 2 * (Math.min(a, b) * vertices + Math.max(a, b)) + (a < b ? 1 : 0);
  }
  keys.sort();
  const ends = [];
  for (let i = 0, next; i < keys.length; i = next) {
    const edge = Math.floor(keys[i] / 2);
    let sum = 0;
    for (next = i; next < keys.length && Math.floor(keys[next] / 2) === edge; ++next) sum += keys[next] % 2 ? 1 : -1;
    if (sum !== 0) ends.push(Math.floor(edge / vertices), edge % vertices);
  }
  return Uint32Array.from(ends);
}

/** Which of these edges hang together: how many, how long they are together, and the middle of their box. The longest come first. */
export function openings(ends, positions) {
  const parts = numbersOfParts(ends, positions.length / 3, 2), point = (v) => new THREE.Vector3().fromArray(positions, 3 * v);
  const found = Array.from({length: parts.count}, () => ({edges: 0, length: 0, box: new THREE.Box3()}));
  for (let e = 0; e < ends.length; e += 2) {
    const opening = found[parts.of[ends[e]]], [from, to] = [point(ends[e]), point(ends[e + 1])];
    ++opening.edges;
    opening.length += from.distanceTo(to);
    opening.box.expandByPoint(from).expandByPoint(to);
  }
  return found.map(({box, ...facts}) => ({...facts, middle: box.getCenter(new THREE.Vector3())})).sort((a, b) => b.length - a.length);
}

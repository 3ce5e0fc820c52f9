// The picture of a figure: what the library's answers are drawn with.

import * as THREE from 'three';
import {LineMaterial} from 'three/addons/lines/LineMaterial.js';
import {LineSegments2} from 'three/addons/lines/LineSegments2.js';
import {LineSegmentsGeometry} from 'three/addons/lines/LineSegmentsGeometry.js';
import {Body} from '../src/picture/body.js';
import {Viewport} from '../src/picture/viewport.js';

// Of Okabe and Ito: told apart by people with any kind of colour vision.
export const CLAY = '#e0b48c', BLUE = '#6aa9e6', GREEN = '#009e73', RED = '#d55e00', ORANGE = '#e69f00', PURPLE = '#cc79a7';

export const minus = (a, b) => a.map((x, k) => x - b[k]);
export const plus = (a, b, factor = 1) => a.map((x, k) => x + factor * b[k]);
export const vertexOf = (numbers, v) => [...numbers.slice(3 * v, 3 * v + 3)];

/** The middle of the box around points, and how far they are from it at most. */
export function frameOf(numbers) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  numbers.forEach((x, i) => {
    low[i % 3] = Math.min(low[i % 3], x);
    high[i % 3] = Math.max(high[i % 3], x);
  });
  const center = plus(low, high).map((x) => x / 2);
  let radius = 0;
  for (let v = 0; v < numbers.length / 3; ++v) radius = Math.max(radius, Math.hypot(...minus(vertexOf(numbers, v), center)));
  return {center, radius};
}

export class Picture {
  constructor(section) {
    const canvas = section.querySelector('canvas');
    this.viewport = new Viewport(canvas, 1);
    this.viewport.markSize = 0.06;
    this.viewport.controls.enableZoom = false;  // the wheel and fingers scroll the page
    canvas.style.touchAction = 'pan-y';
    canvas.addEventListener('keydown', (event) => this.press(event));
    this.own = [];
    this.frame = {center: [0, 0, 0], radius: 1};
    this.setTheme();
  }

  setTheme() { this.viewport.setBackground(getComputedStyle(document.documentElement).getPropertyValue('--stage').trim()); }

  press(event) {
    const {viewport} = this;
    const act = {ArrowLeft: () => viewport.turn(-6, 0), ArrowRight: () => viewport.turn(6, 0), ArrowUp: () => viewport.turn(0, 6), ArrowDown: () => viewport.turn(0, -6),
      '+': () => viewport.zoom(1.15), '=': () => viewport.zoom(1.15), '-': () => viewport.zoom(1 / 1.15), 0: () => viewport.home()}[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  }

  /** Where a point of the library is in the picture. */
  place(point) { return minus(point, this.frame.center).map((x) => x / this.frame.radius); }

  /** Looks against a direction, from so many degrees below it, so that faces across it are in the light. */
  lookFrom([x, y, z], below) {
    const elevation = Math.asin(z / Math.hypot(x, y, z)) * 180 / Math.PI;
    this.viewport.look(Math.atan2(x, -y) * 180 / Math.PI, Math.max(-80, elevation - below));
  }

  clear() {
    for (const group of this.own.splice(0)) {
      this.viewport.scene.remove(group);
      group.traverse((object) => {
        object.geometry?.dispose();
        object.material?.dispose();
      });
    }
    this.viewport.clearMarks();
  }

  /** A mesh of the library. */
  mesh({vertices, faces}, {color = CLAY, opacity = 1, order = 20, depth = 2, edges = true, closed = false} = {}) {
    const positions = new Float32Array(vertices.length);
    for (let v = 0; v < vertices.length / 3; ++v) positions.set(this.place(vertexOf(vertices, v)), 3 * v);
    const body = new Body({mesh: {positions, triangles: Uint32Array.from(faces)}, color, closed, order, depth});
    body.setOpacity(opacity);
    body.showEdges(edges);
    this.viewport.add(body);
    this.own.push(...body.groups);
    return body;
  }

  /** Lines between pairs of points, perhaps through all that is before them. */
  lines(points, color, width, isSeenThrough = false) {
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(points.flatMap((point) => this.place(point)));
    const lines = new LineSegments2(geometry, new LineMaterial({color: new THREE.Color(color), linewidth: width, depthTest: !isSeenThrough,
      polygonOffset: true, polygonOffsetFactor: -4}));
    lines.renderOrder = 60;
    lines.frustumCulled = false;
    this.viewport.scene.add(lines);
    this.own.push(lines);
  }

  mark(point, text, color) { this.viewport.mark(this.place(point), text, color); }
}

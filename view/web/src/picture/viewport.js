// The picture: camera, bodies, marks, the plane that cuts, and panels side by side.

import * as THREE from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {markSprite} from './marks.js';
import {plane} from './materials.js';
import {isCutAway} from './sight.js';
import {Spots} from './spots.js';

THREE.ColorManagement.enabled = false;  // colours are those of the screen everywhere

const FIELD_OF_VIEW = 26;  // degrees
const NO_CUT = 1e9;
export const calm = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

export class Viewport {
  constructor(canvas, radius) {
    this.canvas = canvas;
    this.radius = radius;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true, stencil: true});
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.autoClear = false;
    this.scene = new THREE.Scene();
    this.marks = new THREE.Group();
    this.lines = new THREE.Group();
    this.spots = new Spots();
    this.scene.add(this.marks, this.lines, this.spots.group);
    this.camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, radius / 1000, radius * 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.minDistance = radius / 500;
    this.controls.maxDistance = radius * 40;
    this.controls.addEventListener('change', () => this.changed());
    this.panels = null;
    this.markSize = 0.03;  // of the shorter side
    this.cut = null;
    this.plane = new THREE.Vector4(0, 0, 0, NO_CUT);  // the materials of all pictures of a page share one
    this.onChange = this.onDraw = () => {};
    this.isOrthographic = false;
    this.home();
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(canvas.parentElement);
  }

  add(body) { this.scene.add(...body.groups); }

  /** Gives back what it has of the graphics card; the canvas is of no more use. */
  end() {
    this.flight = this.onChange = this.onDraw = null;
    cancelAnimationFrame(this.waiting);
    this.waiting = true;
    this.observer.disconnect();
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  /** Draws once more, soon. */
  changed() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = null;
      this.draw();
      this.onChange();
    });
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.draw();
  }

  draw() {
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x === 0 || size.y === 0) return;
    plane.value.copy(this.plane);
    for (const mark of this.marks.children) mark.visible = !isCutAway(mark.position, this.cut);
    this.renderer.setScissorTest(false);
    this.renderer.setViewport(0, 0, size.x, size.y);
    this.renderer.clear();
    const panels = this.panels ?? [null];
    const shown = this.scene.children.filter((child) => child !== this.spots.group).map((child) => [child, child.visible]);
    panels.forEach((panel, i) => {
      const from = Math.round(size.x * i / panels.length), to = Math.round(size.x * (i + 1) / panels.length);
      if (panel) for (const [child, visible] of shown) child.visible = visible && panel.groups.includes(child);
      this.renderer.setViewport(from, 0, to - from, size.y);
      this.renderer.setScissor(from, 0, to - from, size.y);
      this.renderer.setScissorTest(true);
      this.aspect((to - from) / size.y);
      this.renderer.render(this.scene, this.camera);
    });
    for (const [child, visible] of shown) child.visible = visible;
    this.onDraw();
  }

  /** Sees as much across the shorter side, whatever the shape of the window; depth is as precise as can be. */
  aspect(aspect) {
    const far = this.camera.position.length() + 2 * this.radius;
    this.camera.near = Math.max(this.camera.position.length() - 1.05 * this.radius, far / 5000);
    this.camera.far = far;
    const half = Math.tan(FIELD_OF_VIEW * Math.PI / 360) / Math.min(1, aspect);
    this.camera.aspect = aspect;
    this.camera.fov = 2 * Math.atan(half) * 180 / Math.PI;
    this.camera.updateProjectionMatrix();
    this.halfHeight = half * this.camera.position.distanceTo(this.controls.target);  // at the target
    if (this.isOrthographic) this.projectParallel(this.halfHeight);
    const size = 2 * this.markSize * (this.isOrthographic ? this.halfHeight : half);
    for (const mark of [...this.marks.children, ...this.spots.marks]) mark.scale.setScalar(size);
  }

  /** Orthographic, from as far away as in perspective: what turns, moves and zooms knows nothing of it. The target has depth 0. */
  projectParallel(half) {
    const {camera, controls: {target}} = this, distance = camera.position.distanceTo(target);
    const wide = half * camera.aspect, reach = target.length() + 2 * this.radius;
    camera.projectionMatrix.makeOrthographic(-wide, wide, half, -half, distance - reach, distance + reach);
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
  }

  setOrthographic(is) {
    this.isOrthographic = is;
    this.changed();
  }

  /** How long a pixel is, at the target. */
  get pixel() { return 2 * this.halfHeight / this.canvas.clientHeight; }

  /** The directions of x, y and z on the screen: to the right, up, and towards the viewer. */
  axes() {
    const back = this.camera.quaternion.clone().invert();
    return [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => new THREE.Vector3(...axis).applyQuaternion(back).toArray());
  }

  get homeDistance() { return this.radius / Math.sin(FIELD_OF_VIEW * Math.PI / 360) * 1.02; }

  /** Angles in degrees, as `prohull render` has them: 0, 0 is the front. */
  look(azimuth, elevation, distance = this.homeDistance, target = [0, 0, 0]) {
    const a = azimuth * Math.PI / 180, e = Math.max(-89.9, Math.min(89.9, elevation)) * Math.PI / 180;
    const back = new THREE.Vector3(Math.sin(a) * Math.cos(e), -Math.cos(a) * Math.cos(e), Math.sin(e));
    this.controls.target.set(...target);
    this.camera.position.copy(this.controls.target).addScaledVector(back, distance);
    this.controls.update();
    this.changed();
  }

  /** What look() takes. */
  looking() {
    const back = this.camera.position.clone().sub(this.controls.target);
    const distance = back.length();
    return [Math.atan2(back.x, -back.y) * 180 / Math.PI, Math.asin(back.z / distance) * 180 / Math.PI, distance,
      this.controls.target.toArray()];
  }

  home() { this.look(35, 20); }

  turn(azimuth, elevation) {
    const [a, e, distance, target] = this.looking();
    this.look(a + azimuth, e + elevation, distance, target);
  }

  /** Nearer by this factor. */
  zoom(factor) {
    const [a, e, distance, target] = this.looking();
    this.look(a, e, Math.min(Math.max(distance / factor, this.radius / 500), this.radius * 40), target);
  }

  /** By parts of the distance, to the right and up. */
  shift(right, up) {
    const move = new THREE.Vector3(right, up, 0).multiplyScalar(this.looking()[2]).applyQuaternion(this.camera.quaternion);
    this.camera.position.add(move);
    this.controls.target.add(move);
    this.controls.update();
    this.changed();
  }

  /** Goes to a point and looks at it from outside, from the middle of the scene; near enough to see its surroundings. */
  fly(point) {
    const to = new THREE.Vector3(...point);
    const [a, e, distance, from] = this.looking();
    const start = new THREE.Vector3(...from), near = Math.min(distance, this.homeDistance / 3);
    const outwards = to.lengthSq() > 0 ? to.clone().normalize() : new THREE.Vector3(0, -1, 0);
    const goal = [Math.atan2(outwards.x, -outwards.y) * 180 / Math.PI, Math.asin(outwards.z) * 180 / Math.PI * 0.6 + 8];
    const turn = ((goal[0] - a) % 360 + 540) % 360 - 180;
    const step = (t) => {
      const s = t * t * (3 - 2 * t);
      this.look(a + s * turn, e + s * (goal[1] - e), distance * (near / distance) ** s,
          start.clone().lerp(to, s).toArray());
    };
    if (calm()) return step(1);
    const began = performance.now(), run = (this.flight = () => {
      if (this.flight !== run) return;
      const t = Math.min(1, (performance.now() - began) / 700);
      step(t);
      if (t < 1) requestAnimationFrame(run);
    });
    run();
  }

  mark(point, text, color) {
    const sprite = markSprite(text, color);
    sprite.position.set(...point);
    this.marks.add(sprite);
    return sprite;
  }

  /** A line between points; it stays until the marks are cleared. */
  line(points, color) {
    const geometry = new THREE.BufferGeometry().setFromPoints(points.map((point) => new THREE.Vector3(...point)));
    const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({color, depthTest: false, transparent: true}));
    line.renderOrder = 90;
    this.lines.add(line);
  }

  /** Where one looks from, and which way, at a place of the window. */
  ray(x, y) {
    const box = this.canvas.getBoundingClientRect(), across = (x - box.left) / box.width * (this.panels?.length ?? 1);
    const at = (depth) => new THREE.Vector3(2 * (across % 1) - 1, 1 - 2 * (y - box.top) / box.height, depth).unproject(this.camera);
    this.camera.updateMatrixWorld();
    const from = this.isOrthographic ? at(-1) : this.camera.position.clone();
    return new THREE.Ray(from, at(0.5).sub(from).normalize());
  }

  /** Of the window. */
  get middle() {
    const box = this.canvas.getBoundingClientRect();
    return [box.left + box.width / 2, box.top + box.height / 2];
  }

  /** What stands side by side at a place of the window, if anything does. */
  panelAt(x) {
    const box = this.canvas.getBoundingClientRect();
    return this.panels?.[Math.floor((x - box.left) / box.width * this.panels.length)] ?? null;
  }

  clearMarks() {
    for (const {material} of this.marks.children) material.map.dispose();
    this.marks.clear();
    this.lines.clear();
  }

  /** The mark at a place of the window, if there is one. */
  markAt(x, y) {
    const box = this.canvas.getBoundingClientRect();
    const away = (mark) => {
      const at = mark.position.clone().project(this.camera);
      return Math.hypot((at.x + 1) / 2 * box.width + box.left - x, (1 - at.y) / 2 * box.height + box.top - y);
    };
    return this.panels ? null : this.marks.children.find((mark) => mark.visible && away(mark) < 14);
  }

  /** Cuts away what is beyond a plane: a direction, and how far it is from the middle; null: nothing. */
  setCut(direction, distance, bodies) {
    if (direction === null) {
      this.plane.set(0, 0, 0, NO_CUT);
      this.cut = null;
    } else {
      const normal = new THREE.Vector3(...direction);
      this.plane.set(normal.x, normal.y, normal.z, distance);
      this.cut = {point: normal.clone().multiplyScalar(distance), direction: normal};
    }
    for (const body of bodies) body.showCap(this.cut);
    this.changed();
  }

  setBackground(color) {
    this.renderer.setClearColor(color, 1);
    this.changed();
  }

  /** The picture as a PNG. */
  picture() {
    this.draw();
    return new Promise((resolve) => this.canvas.toBlob(resolve, 'image/png'));
  }
}

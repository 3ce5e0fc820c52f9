// A mesh in the scene: its surface, its edges, and what caps its section.

import * as THREE from 'three';
import {openEdges, openings} from '../data/defects.js';
import {capMaterial, countingMaterial, defectMaterial, edgeMaterial, explosion, rgb, surfaceMaterial} from './materials.js';

/** Two ends for each edge of each face. */
function linesOf(corners, lines, count) {
  for (let c = 0; c < count; c += 3)
    for (let k = 0; k < 3; ++k) {
      lines[2 * (c + k)] = corners[c + k];
      lines[2 * (c + k) + 1] = corners[c + (k + 1) % 3];
    }
}

function geometryOf({positions, triangles, heat, shifts, tints}) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
  geometry.setAttribute('heat', new THREE.BufferAttribute(heat ?? new Float32Array(positions.length / 3), 1));
  if (shifts) {
    geometry.setAttribute('shift', new THREE.BufferAttribute(shifts, 3));
    geometry.setAttribute('tint', new THREE.BufferAttribute(tints, 3));
  }
  geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
  geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), Infinity);
  return geometry;
}

const INNERMOST = 45;
const LIT = '#d55e00';  // of Okabe and Ito: told apart from clay and blue by people with any kind of colour vision

export class Body {
  /**
   * `divided` is the same surface with distances; without it those of `mesh` are shown. `order`: from the outside to the
   * inside. Sections are painted in that order, one over the other; surfaces the other way round, as the outer ones are glass.
   */
  constructor({mesh, divided, color, closed, striped, order, depth = 1, label, source}) {
    this.mesh = mesh;
    this.label = label;
    this.source = source;  // what the page holds of it
    this.order = order;
    this.color = color;
    this.closed = closed;
    this.group = new THREE.Group();
    this.moved = new THREE.Group();  // all but the cap, which lies in the plane
    this.moved.matrixAutoUpdate = false;
    this.group.add(this.moved);
    this.geometry = geometryOf(mesh);
    this.material = surfaceMaterial(rgb(color), depth);
    this.surface = this.add(new THREE.Mesh(this.geometry, this.material), INNERMOST - order);
    if (divided) {
      this.divided = this.add(new THREE.Mesh(geometryOf(divided), this.material), INNERMOST - order);
      this.divided.visible = false;
    }
    this.counting = [
      [THREE.BackSide, THREE.IncrementWrapStencilOp], [THREE.FrontSide, THREE.DecrementWrapStencilOp],
    ].map(([side, operation]) =>
      this.add(new THREE.Mesh(this.geometry, countingMaterial(side, operation)), order + 0.1));
    for (const object of [this.surface, ...this.counting]) object.getVertexPosition = (v, to) => this.vertexAt(v, to);
    this.cap = this.add(new THREE.Mesh(new THREE.PlaneGeometry(8, 8), capMaterial(rgb(color), striped ? 1 : 0)),
        order + 0.2);
    this.group.add(this.cap);
    this.cap.onAfterRender = (renderer) => renderer.clearStencil();
    this.showCap(null);
  }

  get hasParts() { return Boolean(this.mesh.shifts); }

  add(object, order) {
    object.frustumCulled = false;
    object.renderOrder = order;
    if (object.geometry.attributes.shift) object.material.defines = {PARTS: 1};
    this.moved.add(object);
    return object;
  }

  get groups() { return [this.group]; }

  /** Moves it; the matrix is that of THREE.js. */
  move(matrix) {
    this.moved.matrix.copy(matrix);
    this.moved.matrixWorldNeedsUpdate = true;
  }

  /** How far explosion has moved a vertex. */
  shiftOf(v) {
    const {shift} = this.geometry.attributes, to = new THREE.Vector3();
    return shift ? to.fromBufferAttribute(shift, v).multiplyScalar(explosion.value) : to;
  }
  vertexAt(v, to) {
    to.fromBufferAttribute(this.geometry.attributes.position, v);
    return this.hasParts ? to.add(this.shiftOf(v)) : to;
  }

  /** How far its surface is from a point in its frame. */
  distanceTo(point) {
    const {index, drawRange, attributes: {position}} = this.geometry, face = new THREE.Triangle(), nearest = new THREE.Vector3();
    let least = Infinity;
    for (let c = 0; c < Math.min(index.count, drawRange.count); c += 3) {
      face.setFromAttributeAndIndices(position, index.getX(c), index.getX(c + 1), index.getX(c + 2));
      least = Math.min(least, face.closestPointToPoint(point, nearest).distanceToSquared(point));
    }
    return Math.sqrt(least);
  }

  get visible() { return this.group.visible; }
  set visible(is) { this.group.visible = is; }

  /** In the colour of what collides. */
  light(is) {
    if (this.isLit === is) return;
    this.isLit = is;
    this.material.uniforms.color.value.set(...rgb(is ? LIT : this.color));
    this.setOpacity(this.opacity);
  }

  setOpacity(wanted) {
    this.opacity = wanted;
    const opacity = this.isLit ? Math.max(wanted, 0.75) : wanted;
    this.material.uniforms.opacity.value = opacity;
    this.material.transparent = opacity < 1;
    this.material.depthWrite = opacity === 1;
    this.material.side = opacity < 1 && this.closed ? THREE.FrontSide : THREE.DoubleSide;
    this.material.needsUpdate = true;
  }

  showEdges(is) {
    if (is && !this.edges) this.makeEdges();
    if (this.edges) this.edges.visible = is;
    if (is) this.updateEdges();
  }

  makeEdges() {
    const geometry = this.sharing(new Uint32Array(2 * this.mesh.triangles.length));
    this.edges = this.add(new THREE.LineSegments(geometry, edgeMaterial()), 50);
  }

  updateEdges() {
    const corners = this.geometry.drawRange.count === Infinity ? this.mesh.triangles.length
                                                               : this.geometry.drawRange.count;
    const index = this.edges.geometry.index;
    linesOf(this.mesh.triangles, index.array, corners);
    this.edges.geometry.setDrawRange(0, 2 * corners);
    index.needsUpdate = true;
    // Many edges together would hide the surface.
    this.edges.material.uniforms.opacity.value = Math.min(0.5, Math.max(0.08, 0.5 * Math.sqrt(6000 / corners)));
  }

  /** Shows other faces of the same vertices; null: its own. */
  replaceFaces(triangles) {
    this.own ??= {triangles: this.mesh.triangles, index: this.geometry.index};
    this.mesh = {...this.mesh, triangles: triangles ?? this.own.triangles};
    this.geometry.setIndex(triangles ? new THREE.BufferAttribute(triangles, 1) : this.own.index);
  }

  /** Edges along which the mesh is not watertight. */
  showDefects(is) {
    if (this.closed) return;
    this.defects ??= this.makeDefects();
    this.defects.visible = is;
  }
  makeDefects() {
    return this.add(new THREE.LineSegments(this.sharing(this.openEdges), defectMaterial()), 60);
  }
  get openEdges() { return this.found ??= openEdges(this.mesh.triangles, this.mesh.positions.length / 3); }
  get openings() { return this.closed ? [] : openings(this.openEdges, this.mesh.positions); }

  /** Lines between its vertices. */
  sharing(index) {
    const geometry = new THREE.BufferGeometry();
    for (const [name, attribute] of Object.entries(this.geometry.attributes)) geometry.setAttribute(name, attribute);
    geometry.setIndex(new THREE.BufferAttribute(index, 1));
    return geometry;
  }

  setEdgeColor(color) {
    this.edgeColor = color;
    if (this.edges) this.edges.material.uniforms.color.value.set(...color);
  }

  showHeat(is) {
    this.material.uniforms.showsHeat.value = is;
    if (!this.divided) return;
    this.divided.visible = is;
    this.surface.visible = !is;
  }

  /** By how much the distances are less than those of the legend. */
  setHeatFactor(factor) { this.material.uniforms.heatFactor.value = factor; }

  /** The plane as a point on it and its direction; null: none. */
  showCap(cut) {
    const is = cut !== null && this.closed;
    this.cap.visible = is;
    for (const mesh of this.counting) mesh.visible = is;
    if (!is) return;
    this.cap.position.copy(cut.point);
    this.cap.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), cut.direction);
  }

  /** After vertices or faces have changed: the first `faces` are drawn. */
  update(faces) {
    this.geometry.setDrawRange(0, 3 * faces);
    this.geometry.index.needsUpdate = true;
    this.geometry.attributes.position.needsUpdate = true;
    this.geometry.attributes.heat.needsUpdate = true;
    if (this.edges?.visible) this.updateEdges();
  }
}

/** Several bodies that are switched together, such as those of a robot's links. */
export class Bodies {
  constructor(bodies, color) {
    this.bodies = bodies;
    this.color = color;
    this.hasParts = false;
  }

  get groups() { return this.bodies.flatMap((body) => body.groups); }
  get visible() { return this.bodies.some((body) => body.visible); }
  set visible(is) { this.each((body) => { body.visible = is; }); }
  each(act) { this.bodies.forEach(act); }
  setOpacity(opacity) { this.each((body) => body.setOpacity(opacity)); }
  showEdges(is) { this.each((body) => body.showEdges(is)); }
  showDefects(is) { this.each((body) => body.showDefects(is)); }
  setEdgeColor(color) { this.each((body) => body.setEdgeColor(color)); }
  showHeat(is) { this.each((body) => body.showHeat(is)); }
  setHeatFactor(factor) { this.each((body) => body.setHeatFactor(factor)); }
  showCap(cut) { this.each((body) => body.showCap(cut)); }
}

// Points that are picked on what is drawn, and the way from the first to the second.

import * as THREE from 'three';
import {byId} from '../panel/dom.js';
import {facesAlong, firstSeen} from '../picture/sight.js';

/** A point of a body, which moves with it. */
class Pick {
  constructor(hit, ray) {
    this.ray = ray;
    this.body = hit.body;
    this.set(hit);
  }

  set({point, face, faceIndex, distance}) {
    this.face = faceIndex;  // null: on the filling of a section
    this.corners = [face.a, face.b, face.c];
    this.depth = distance;
    this.local = point.clone().applyMatrix4(this.body.moved.matrix.clone().invert()).sub(this.body.shiftOf(face.a));
  }

  /** Where a point in the frame of the body is drawn. */
  drawn(local) { return local.clone().add(this.body.shiftOf(this.corners[0])).applyMatrix4(this.body.moved.matrix); }
  /** Where it is while parts are together. */
  get place() { return this.local.clone().applyMatrix4(this.body.moved.matrix); }

  vertex(v) { return new THREE.Vector3().fromArray(this.body.mesh.positions, 3 * v); }
  get nearestCorner() {
    const away = (v) => this.vertex(v).distanceToSquared(this.local);
    return this.corners.reduce((best, v) => away(v) < away(best) ? v : best);
  }
  /** The number of its piece, sphere or component. */
  get part() {
    const {mesh, source} = this.body;
    return source.kind === 'balls' ? Math.floor(3 * this.face * source.radii.count / mesh.triangles.length) : mesh.parts[this.corners[0]];
  }

  /** What the same line of sight meets nearest to it, after faces have changed; false if it meets nothing. */
  follow() {
    if (!this.body.source?.levels || this.face === null) return true;
    const near = (a, b) => Math.abs(a.distance - this.depth) <= Math.abs(b.distance - this.depth) ? a : b;
    const hits = facesAlong(this.body, this.ray);
    if (hits.length > 0) this.set(hits.reduce(near));
    return hits.length > 0;
  }

  /** Where the corners of its face are drawn. */
  get triangle() { return this.face === null ? [] : this.corners.map((v) => this.drawn(this.vertex(v))); }
}

export class Picks {
  constructor(view) {
    this.view = view;
    this.points = [];     // two at most
    this.next = 'first';  // what the next click finds: 'first' or 'second' point, or a 'ray'
  }

  pickAt(x, y, isSecond = false) {
    const {viewport, surfaces} = this.view, ray = viewport.ray(x, y), panel = viewport.panelAt(x);
    viewport.scene.updateMatrixWorld();
    const seen = firstSeen(surfaces.filter((body) => body.visible && (!panel || panel.groups.includes(body.group))), ray, viewport.cut);
    if (isSecond && !seen) return;
    this.points = [...(isSecond ? this.points.slice(0, 1) : []), ...(seen ? [new Pick(seen, ray)] : [])];
    if (this.next === 'second') this.setNext('first');
    this.show();
    byId('picked').scrollIntoView({block: 'nearest'});
  }
  pickInMiddle(isSecond) { this.pickAt(...this.view.viewport.middle, isSecond); }

  end() {
    this.points = [];
    if (this.next === 'second') this.setNext('first');
    this.show();
  }

  /** A second time, the next click finds the first point again. */
  setNext(next) {
    this.next = this.next === next ? 'first' : next;
    this.view.panel?.showNext();
  }

  /** After faces have changed. */
  follow() {
    this.points = this.points.filter((pick) => pick.follow());
    this.show();
  }

  show() {
    const {viewport, panel} = this.view, drawn = this.points.map((pick) => pick.drawn(pick.local));
    viewport.spots.show(drawn, this.points.flatMap((pick) => pick.triangle));
    viewport.changed();
    panel?.showPicked();
  }
  /** While faces change. */
  hide() { this.view.viewport.spots.show([], []); }

  /** In the unit of the meshes. */
  pointOf(place) { return this.view.space.point(place.toArray()); }

  /** What the distance of a pick is told to: of links the other geometry, of hulls the original, of that the hull; of two meshes the other. */
  partnerOf({body}) {
    const {bodies, active, hulls} = this.view, original = bodies.find(({role}) => role === 'original')?.body;
    const other = original ?? (hulls.length === 2 && hulls.find((hull) => hull.body !== body).body);
    const partner = body.partner ?? (body === original ? active.body : other);
    return partner?.distanceTo ? partner : null;
  }
}

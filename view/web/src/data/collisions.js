// Which links of a robot collide where they are drawn: meshes meet, or one solid lies within another.

import * as THREE from 'three';
/*! @license three-mesh-bvh, copyright 2018 Garrett Johnson, SPDX-License-Identifier: MIT */
import {MeshBVH} from 'three-mesh-bvh';
import {numbersOfParts} from './parts.js';

/** The collision geometry of a link. */
class Solid {
  constructor({positions, triangles}, closed) {
    this.closed = closed;
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    this.geometry.setIndex(new THREE.BufferAttribute(triangles.slice(), 1));  // the tree puts faces in another order
    this.geometry.computeBoundingBox();
    const parts = numbersOfParts(triangles, positions.length / 3), seen = new Set();
    // A point of each part.
    this.points = [...triangles].filter((v) => !seen.has(parts.of[v]) && seen.add(parts.of[v]))
        .map((v) => new THREE.Vector3(...positions.subarray(3 * v, 3 * v + 3)));
  }

  get box() { return this.geometry.boundingBox; }
  get tree() { return this.geometry.boundsTree; }
  /** Trees are made when they are first needed. */
  plant() { this.geometry.boundsTree ??= new MeshBVH(this.geometry); }

  /** Whether it winds around a point. */
  holds(point) {
    if (!this.closed || !this.box.containsPoint(point)) return false;
    const ray = new THREE.Ray(point, new THREE.Vector3(0.36, 0.48, 0.8));
    const windings = this.tree.raycast(ray, THREE.DoubleSide)
        .reduce((sum, {face}) => sum + Math.sign(face.normal.dot(ray.direction)), 0);
    return windings > 0;
  }

  /** `pose` puts the other one in the frame of this one. */
  meets(other, pose) {
    const box = other.box.clone().applyMatrix4(pose);
    if (!this.box.intersectsBox(box)) return false;
    this.plant();
    other.plant();
    if (this.tree.intersectsGeometry(other.geometry, pose)) return true;
    const back = pose.clone().invert();
    return other.points.some((point) => this.holds(point.clone().applyMatrix4(pose))) ||
        this.points.some((point) => other.holds(point.clone().applyMatrix4(back)));
  }
}

export class Collisions {
  /** `meshes` of all links, or null; `disabled` pairs may touch. */
  constructor(meshes, closed, disabled) {
    this.solids = meshes.map((mesh, i) => mesh && new Solid(mesh, closed[i]));
    const left = new Set(disabled.map(([a, b]) => `${a} ${b}`));
    this.pairs = [];
    for (let a = 0; a < meshes.length; ++a)
      for (let b = a + 1; b < meshes.length; ++b)
        if (meshes[a] && meshes[b] && !left.has(`${a} ${b}`)) this.pairs.push([a, b]);
    this.found = new Map();  // of each pair: whether it collides, and the pose in which that was asked
  }

  /** Asks about the pairs that have moved, until the time is up; returns whether all are known. */
  update(poses, until) {
    for (const pair of this.pairs) {
      const [a, b] = pair, pose = poses[a].clone().invert().multiply(poses[b]);
      if (this.found.get(pair)?.pose.equals(pose)) continue;
      if (performance.now() > until) return false;
      this.found.set(pair, {pose, collides: this.solids[a].meets(this.solids[b], pose)});
    }
    return true;
  }

  get colliding() { return this.pairs.filter((pair) => this.found.get(pair)?.collides); }
}

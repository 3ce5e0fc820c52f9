// A robot: forward kinematics, as robot/motion/motion.cpp has it. Links are meshes in frames of their own.

import * as THREE from 'three';
import {numbers} from './blocks.js';

const vector = (v) => new THREE.Vector3(...v);
const shifted = (v) => new THREE.Matrix4().makeTranslation(vector(v));

function originOf({rotation: [x, y, z], translation: t}) {
  return new THREE.Matrix4().set(...x, t[0], ...y, t[1], ...z, t[2], 0, 0, 0, 1);
}

function motionOf({motion, axis}, position) {
  if (motion === 'turn') return new THREE.Matrix4().makeRotationAxis(vector(axis), position);
  return motion === 'slide' ? shifted(axis.map((x) => x * position)) : new THREE.Matrix4();
}

export class Robot {
  constructor({links, joints}) {
    this.links = links;
    this.joints = joints;
    this.positions = joints.map((joint) => joint.rest);
  }

  /** The joints that a slider moves. */
  get free() {
    return this.joints.map((joint, i) => ({...joint, i})).filter(({motion, mimic}) => motion !== 'none' && !mimic);
  }

  /** Positions of a joint that a slider offers. */
  range({motion, lower, upper}) {
    const reach = motion === 'turn' ? Math.PI : 1;
    return [lower ?? (upper === null ? -reach : upper - 2 * reach), upper ?? (lower === null ? reach : lower + 2 * reach)];
  }

  position(i, steps = 0) {
    const {mimic} = this.joints[i];
    if (!mimic || steps > this.joints.length) return this.positions[i];
    return mimic.multiplier * this.position(mimic.joint, steps + 1) + mimic.offset;
  }

  /** Where each link is, in metres. */
  poses() {
    const poses = this.links.map(() => new THREE.Matrix4());
    let before = null;
    this.joints.forEach((joint, i) => {
      // A link with several joints has them in a row.
      const from = before?.child === joint.child ? poses[joint.child] : poses[joint.parent];
      const move = shifted(joint.anchor).multiply(motionOf(joint, this.position(i)))
          .multiply(shifted(joint.anchor.map((x) => -x)));
      poses[joint.child] = from.clone().multiply(originOf(joint)).multiply(move);
      before = joint;
    });
    return poses;
  }
}

/** The meshes of a link of the page, or null. */
export function linkMesh(facts, space, bytes) {
  if (!facts) return null;
  return {positions: space.drawn(numbers(bytes, facts.positions)), triangles: numbers(bytes, facts.triangles)};
}

/** What a pose in metres is where things are drawn. */
export function drawnPose(pose, space) {
  const zero = space.point([0, 0, 0]).map((x) => x / space.side);  // what is drawn at 0, in lengths that are drawn
  const [x, y, z] = pose.elements.slice(12, 15);
  const scaled = pose.clone().setPosition(x / space.side, y / space.side, z / space.side);
  return shifted(zero.map((c) => -c)).multiply(scaled).multiply(shifted(zero));
}

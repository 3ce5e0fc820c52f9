// Where the joints of robots are, and which links collide there.

import {Collisions} from '../data/collisions.js';
import {drawnPose} from '../data/robot.js';

const MILLISECONDS = 8;  // of each frame, for collisions

export class RobotControl {
  constructor(view) {
    this.view = view;
    this.shown = view.hulls.filter((hull) => hull.robot);
    for (const hull of this.shown) {
      hull.collisions = new Collisions(hull.collisionBodies.map((body) => body?.mesh ?? null),
          hull.collisionBodies.map((body) => body?.closed), hull.disabled);
    }
  }

  open() {
    const {robot} = this.view.active, positions = this.view.state.joints;
    if (!robot || positions?.length !== robot.free.length || !positions.every(Number.isFinite)) return;
    robot.free.forEach((joint, i) => {
      const [least, most] = robot.range(joint);
      this.set(joint.name, Math.min(most, Math.max(least, positions[i])));
    });
  }

  /** Moves the joints of that name of all robots. */
  set(name, position) {
    for (const {robot} of this.shown)
      robot.joints.forEach((joint, i) => { if (joint.name === name) robot.positions[i] = position; });
    this.move();
  }
  rest() {
    for (const {robot} of this.shown) robot.positions = robot.joints.map((joint) => joint.rest);
    this.move();
  }

  move() {
    for (const hull of this.shown) {
      hull.linkPoses = hull.robot.poses().map((pose) => drawnPose(pose, this.view.space));
      hull.linkPoses.forEach((pose, i) => hull.linkBodies[i].forEach((body) => body.move(pose)));
    }
    this.tell();
    this.view.picks.show();
    this.view.viewport.changed();
    this.collide();
  }

  /** Frame by frame, as long as pairs are left; what is known stays lit until then. */
  collide() {
    if (this.waiting || this.shown.length === 0) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = null;
      const until = performance.now() + MILLISECONDS;
      const known = this.shown.map(({collisions, linkPoses}) => collisions.update(linkPoses, until));
      if (known.every(Boolean)) this.light();
      else this.collide();
    });
  }

  light() {
    for (const {collisions, collisionBodies} of this.shown) {
      const lit = new Set(collisions.colliding.flat());
      collisionBodies.forEach((body, i) => body?.light(lit.has(i)));
    }
    this.view.panel?.showCollisions();
    this.view.viewport.changed();
  }

  tell() {
    this.view.panel?.showJoints();
    this.view.panel?.showCollisions();
  }
}

// Where the joints of robots are.

import {drawnPose} from '../data/robot.js';

export class RobotControl {
  constructor(view) {
    this.view = view;
    this.shown = view.hulls.filter((hull) => hull.robot);
  }

  open() {
    const {robot} = this.view.active, positions = this.view.state.joints;
    if (!robot || positions?.length !== robot.free.length || !positions.every(Number.isFinite)) return;
    robot.free.forEach((joint, i) => {
      const [least, most] = robot.range(joint);
      this.set(joint.name, Math.min(most, Math.max(least, positions[i])));
    });
  }

  /** Of all robots: the joints of that name. */
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
    for (const {robot, linkBodies} of this.shown)
      robot.poses().forEach((pose, i) => linkBodies[i].forEach((body) => body.move(drawnPose(pose, this.view.space))));
    this.tell();
    this.view.viewport.changed();
  }

  tell() { this.view.panel?.showJoints(); }
}

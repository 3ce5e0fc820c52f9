// Where a robot is on its path, at a time.

export class MotionControl {
  constructor(view) {
    this.view = view;
    this.object = view.hulls.find((hull) => hull.motion);
    this.motion = this.object?.motion;
    this.time = this.motion?.times[0];
  }

  get begin() { return this.motion.times[0]; }
  get end() { return this.motion.times.at(-1); }
  /** What is proven of the time: [begin, end, distance, pair], or nothing. */
  get bound() { return this.motion.bounds.find(([begin, end]) => begin <= this.time && this.time <= end); }

  open() {
    const {time, joints} = this.view.state;
    if (this.motion && (time !== null || !joints)) this.set(time ?? this.begin);
  }

  set(time) {
    const {times, positions} = this.motion, {robot} = this.object;
    this.time = Math.min(this.end, Math.max(this.begin, time));
    const next = Math.max(1, times.findIndex((t) => t >= this.time)), before = next - 1;
    if (times.length === 1) robot.positions = positions[0].slice();
    else {
      const share = (this.time - times[before]) / (times[next] - times[before]);
      robot.positions = positions[before].map((p, i) => p + share * (positions[next][i] - p));
    }
    this.view.robots.move();
    this.view.panel?.showMotion();
    this.view.remember();
  }

  /** In seconds, or a row each second. */
  play() {
    if (this.playing) return this.stop();
    const from = this.time < this.end ? this.time : this.begin, began = performance.now();
    this.view.panel.setMoving(true);
    const run = this.playing = () => {
      if (this.playing !== run || this.view.ended.signal.aborted) return;
      this.set(from + (performance.now() - began) / 1000);
      if (this.time === this.end) this.stop();
      else requestAnimationFrame(run);
    };
    run();
  }
  stop() {
    this.playing = null;
    this.view.panel?.setMoving(false);
  }
}

// Which level of the progressive hulls is shown.

const PLAY_SECONDS = 7;

export class LevelControl {
  constructor(view) { this.view = view; }

  get hulls() { return this.view.hulls.filter((hull) => hull.levels); }

  open() { for (const hull of this.hulls) this.show(hull, this.first(hull)); }
  first(hull) { return hull.levels.levelOf(this.view.state.faces ?? hull.base_faces); }

  show(hull, level) {
    this.view.rays.end();
    hull.levels.goTo(level);
    hull.body.update(hull.levels.faces);
  }

  /** Of all progressive hulls: the finest level of at most so many faces. */
  setFaces(faces) {
    for (const hull of this.hulls) this.show(hull, hull.levels.levelOf(faces));
    this.view.state.faces = faces;
    this.view.refresh();
  }

  /** 0: the base mesh, 1: the original; each step multiplies the faces. */
  setShare(share) {
    this.stop();
    this.setFaces(this.facesAt(share));
  }
  facesAt(share) {
    const {base_faces: base, original_faces: finest} = this.view.active;
    return Math.round(base * (finest / base) ** share);
  }
  share() {
    const {base_faces: base, original_faces: finest, levels} = this.view.active;
    return finest > base ? Math.log(levels.faces / base) / Math.log(finest / base) : 0;
  }
  step(by) {
    if (this.view.active.levels) this.setShare(Math.min(1, Math.max(0, this.share() + by)));
  }

  /** The finest level with a proven distance that is not finer than so many faces. */
  stopOf(faces) {
    const {stops} = this.view.active;
    return stops.findLast((stop) => stop.faces <= faces) ?? stops[0];
  }

  play() {
    if (!this.view.active.levels) return;
    if (this.playing) return this.stop();
    const from = this.share() > 0.999 ? 0 : this.share(), began = performance.now();
    this.view.panel.setPlaying(true);
    const run = this.playing = () => {
      if (this.playing !== run) return;
      const share = Math.min(1, from + (performance.now() - began) / 1000 / PLAY_SECONDS);
      this.setFaces(this.facesAt(share));
      if (share === 1) this.stop();
      else requestAnimationFrame(run);
    };
    run();
  }
  stop() {
    this.playing = null;
    this.view.panel?.setPlaying(false);
  }
}

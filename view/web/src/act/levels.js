// Which level of the progressive hulls is shown. Between two levels, vertices glide.

import {calm} from '../picture/viewport.js';

const PLAY_SECONDS = 7;
const FOLLOW = 90, SPREAD = 120, LAND = 260;  // milliseconds: to come near the wanted level, to begin to glide, to end it
const AHEAD = 0.12;                           // of the faces: these glide at once
const FASTEST = 0.006;                        // by how much the logarithm of the faces changes in a millisecond
const CLOSE = 1e-3;

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

  /** Shows the finest level of at most so many faces of all progressive hulls. */
  setFaces(faces) {
    if (this.hulls.length === 0) return;
    this.view.rays.end();
    const from = this.view.active.levels?.shownFaces ?? faces;
    this.view.state.faces = faces;
    if (calm()) return this.arrive();
    if (this.glide) return;
    this.view.picks.hide();
    this.glide = {faces: from, ahead: 0, time: performance.now()};
    const run = () => {
      if (!this.glide) return;
      if (this.advance(performance.now())) requestAnimationFrame(run);
      else this.arrive();
    };
    run();
  }

  /** Nearer to the wanted level; false if it is reached, and nothing glides. */
  advance(now) {
    const {glide} = this, wanted = Math.max(1, this.view.state.faces), elapsed = Math.min(100, now - glide.time + 1);
    const left = Math.log(wanted / glide.faces), near = Math.abs(left) < CLOSE;
    const most = FASTEST * elapsed, step = left * (1 - Math.exp(-elapsed / FOLLOW));
    glide.faces = near ? wanted : glide.faces * Math.exp(Math.min(most, Math.max(-most, step)));
    glide.ahead = near ? glide.ahead - AHEAD * elapsed / LAND : Math.min(AHEAD, glide.ahead + AHEAD * elapsed / SPREAD);
    glide.time = now;
    if (near && glide.ahead <= 0) return false;
    for (const {levels, body, base_faces: base} of this.hulls) {
      const faces = Math.min(levels.finestFaces, Math.max(base, glide.faces));
      levels.blend((faces - base) / 2, glide.ahead * faces / 2);
      body.update(levels.faces);
    }
    this.view.panel.showLevel();
    this.view.places.follow();
    this.view.look.caption();
    this.view.viewport.changed();
    return true;
  }

  /** Exactly the wanted level. */
  arrive() {
    this.glide = null;
    this.open();
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
  /** The place of the level that is wanted, between 0, the base, and 1, the finest. */
  share() {
    const {base_faces: base, original_faces: finest, levels} = this.view.active;
    const wanted = base + 2 * levels.levelOf(this.view.state.faces ?? base);
    return finest > base ? Math.log(wanted / base) / Math.log(finest / base) : 0;
  }
  step(by) {
    if (this.view.active.levels) this.setShare(Math.min(1, Math.max(0, this.share() + by)));
  }

  /** The finest level whose farthest point is known that is not finer than so many faces. */
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

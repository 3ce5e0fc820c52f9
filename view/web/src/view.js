// The page: what it shows, and everything that acts on it. Folders are the data flow: data/ is read from the page, picture/ draws
// it, act/ changes what is drawn, and panel/ tells and asks.

import {readFragment, readState, remembered, writeFragment} from './act/address.js';
import {Gauges} from './act/gauges.js';
import {listen} from './act/keys.js';
import {LevelControl} from './act/levels.js';
import {Look} from './act/look.js';
import {MotionControl} from './act/motion.js';
import {Picks} from './act/picks.js';
import {Places} from './act/places.js';
import {RayControl} from './act/rays.js';
import {RobotControl} from './act/robots.js';
import {Section} from './act/section.js';
import {byId} from './panel/dom.js';
import {Panel} from './panel/panel.js';
import {makeBodies} from './picture/bodies.js';
import {Viewport} from './picture/viewport.js';

export class View {
  /** Where its objects are drawn is `space`: data/objects.js has read them. `address` keeps what is shown. */
  constructor(scene, space, bytes, address = {read: readFragment, write: writeFragment}) {
    this.address = address;
    this.ended = new AbortController();
    this.scene = scene;
    this.hulls = scene.objects.filter((object) => object.role !== 'original');
    this.original = scene.objects.find((object) => object.role === 'original');
    this.space = space;
    this.state = readState(this, address.read());
    this.active = this.hulls[Math.round(this.state.active)];
    this.viewport = new Viewport(byId('canvas'), this.space.radius);
    Object.assign(this, makeBodies(this, bytes));
    this.levels = new LevelControl(this);
    this.rays = new RayControl(this);
    this.robots = new RobotControl(this);
    this.motion = new MotionControl(this);
    this.look = new Look(this);
    this.section = new Section(this);
    this.places = new Places(this);
    this.picks = new Picks(this);
    this.gauges = new Gauges(this);
    listen(this);
    this.open();
  }

  get allBodies() { return [...this.bodies.map((entry) => entry.body), ...(this.base ? [this.base] : [])]; }
  /** The same, those of links one by one. */
  get surfaces() { return this.allBodies.flatMap((body) => body.bodies ?? [body]); }

  open() {
    this.look.direct();
    this.levels.open();
    this.robots.open();
    this.panel = new Panel(this);
    this.robots.move();
    this.motion.open();
    this.look.open();
    this.section.cut();
    this.rays.open();
    this.refresh();
    this.viewport.onChange = () => this.remember();
    document.title = `${this.hulls.map((hull) => hull.name).join(', ')} – prohull view`;
  }

  /** The panel tells of another hull. */
  activate(i) {
    this.rays.end();
    this.rays.forget();
    this.picks.next = 'first';
    this.active = this.hulls[i];
    this.state.active = i;
    byId('content').replaceChildren();
    this.panel = new Panel(this);
    this.robots.tell();
    this.section.cut();
    this.refresh();
  }

  refresh() {
    this.panel?.showLevel();
    this.panel?.showFarthest();
    if (this.panel) this.places.mark();
    this.picks.follow();
    this.look.caption();
    this.viewport.changed();
    this.onRefresh?.();
  }

  /** Another one may then take its place, with a canvas of its own. */
  end() {
    clearTimeout(this.remembering);
    this.levels.playing = this.levels.glide = null;
    this.ended.abort();
    this.viewport.end();
    this.gauges.end();
    byId('content').replaceChildren();
  }

  remember() {
    clearTimeout(this.remembering);
    this.remembering = setTimeout(() => this.address.write(remembered(this)), 150);
  }
}

// Opens the page: reads its scene, and connects picture, panel, keys and address.

import {ballsMesh} from './balls.js';
import {numbers, readBlocks} from './blocks.js';
import {Bodies, Body} from './body.js';
import {byId, el, grouped} from './dom.js';
import {dividedMesh} from './heat.js';
import {Levels} from './levels.js';
import {Panel} from './panel.js';
import {explosion, showsParts} from './materials.js';
import {partsOf} from './parts.js';
import {Refinement} from './query.js';
import {Robot, drawnPose, linkMesh} from './robot.js';
import {Space} from './space.js';
import {between, numbersOf, readFragment, unitVector, writeFragment} from './state.js';
import {Viewport} from './viewport.js';

const CLAY = '#e0b48c', BLUE = '#6aa9e6';
const MORE = [BLUE, '#009e73', '#cc79a7', '#f0e442', '#0072b2', '#e69f00', '#56b4e9', '#999999'];
const FAR = '#c2410c', OUTSIDE = '#a3195b';
const FOUND = '#00664a', MISSED = '#a33600', RAY = '#5b2a86';
const PLAY_SECONDS = 7;
const AXES = {x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1]};

class View {
  constructor(scene, bytes) {
    this.scene = scene;
    this.hulls = scene.objects.filter((object) => object.role !== 'original');
    this.given = scene.objects.find((object) => object.role === 'original');
    this.active = this.hulls[0];
    this.readMeshes(bytes);
    this.readState(readFragment());
    this.viewport = new Viewport(byId('canvas'), this.space.radius);
    this.makeBodies(bytes);
    this.listen();
    this.apply();
  }

  get original() { return this.given; }
  get originalName() { return this.given?.name ?? 'the finest level'; }

  readMeshes(bytes) {
    for (const object of this.scene.objects) {
      if (object.kind === 'levels') object.levels = new Levels(object, bytes);
      else if (object.kind === 'robot') Object.assign(object, {robot: new Robot(object), steps: numbers(bytes, object.corners)});
      else if (object.kind === 'mesh') object.steps = numbers(bytes, object.positions);
      else Object.assign(object, {steps: numbers(bytes, object.centers), stepsAround: numbers(bytes, object.radii)});
    }
    this.space = new Space(this.scene.grid, this.scene.objects.map((o) => [o.levels?.steps ?? o.steps, o.stepsAround]));
    for (const object of this.scene.objects) {
      if (object.levels) object.levels.place(this.space);
      else if (object.kind === 'balls') object.mesh = ballsMesh(this.space.drawn(object.steps), this.space.lengths(object.stepsAround));
      else if (object.kind === 'mesh') object.mesh = {positions: this.space.drawn(object.steps), triangles: numbers(bytes, object.triangles)};
      object.steps = null;
    }
  }

  readState(text) {
    const robots = this.hulls.some((hull) => hull.robot);
    const alone = !this.given && !robots && !this.hulls.some((hull) => hull.levels);
    this.state = {
      faces: between(text.l, 0, 1e12, null),
      opacity: between(text.o, 0.05, 1, alone ? 1 : 0.4),
      edges: text.e ? text.e === '1' : !alone && !robots,
      heat: text.h === '1',
      beside: text.b === '1',
      parts: text.u !== '0',
      explosion: between(text.k, 0, 2, 0),
      cut: ['x', 'y', 'z', 'v'].includes(text.c) ? text.c : '',
      cutAt: between(text.a, -1, 1, 0),
      cutSign: text.s === '-1' ? -1 : 1,
      cutFacing: unitVector(numbersOf(text.d, 3)) ?? [0, -1, 0],
      hidden: (text.x ?? '').split(',').filter(Boolean).map(Number),
      active: between(text.n, 0, this.hulls.length - 1, 0),
      theme: ['dark', 'light'].includes(text.t) ? text.t : null,
      look: numbersOf(text.v, 6),
      joints: text.j ? text.j.split(',').map(Number) : null,
      ray: numbersOf(text.r, 6),
    };
    this.active = this.hulls[Math.round(this.state.active)];
  }

  /** Original first, then hulls; `sides` are what stands side by side. */
  makeBodies(bytes) {
    this.bodies = [];
    const volume = (object) => Math.abs(object.facts?.volume ?? object.verification?.hull_volume ?? 0);
    const order = (object) => {
      const sorted = [...this.scene.objects].sort((a, b) => volume(b) - volume(a));
      return 1 + sorted.indexOf(object);
    };
    const levels = this.hulls.find((hull) => hull.levels && !hull.original_shown);
    if (this.given) {
      const {mesh, facts} = this.given;
      this.addBody({label: this.given.name, role: 'original', depth: 3, mesh, color: CLAY, closed: facts.watertight,
        order: this.hulls.some((hull) => hull.side === 'inner' || hull.verification?.side === 'inner') ? 0 : 20});
    } else if (levels) {
      this.addBody({label: `${levels.name}, finest level`, role: 'original', depth: 3, mesh: levels.levels.copy(levels.levels.count),
        color: CLAY, closed: true, order: levels.side === 'inner' ? 0 : 20});
    }
    const isAlone = this.bodies.length === 0;
    this.hulls.forEach((hull, i) => {
      if (hull.robot) return this.addRobot(hull, MORE[i % MORE.length], bytes);
      const {levels} = hull;
      if (!levels) Object.assign(hull.mesh, partsOf(hull.mesh));
      const mesh = levels ? {positions: levels.positions, triangles: levels.corners, heat: levels.heat} : hull.mesh;
      const color = isAlone && this.hulls.length === 1 ? CLAY : MORE[i % MORE.length];
      hull.body = this.addBody({label: hull.name, role: 'hull', mesh, color, striped: !isAlone, order: order(hull),
        closed: hull.facts?.watertight ?? true,
        divided: hull.heat && !levels ? dividedMesh(hull.mesh, hull.heat, bytes) : null});
    });
    this.makeSides();
    this.heatMax = Math.max(0, ...this.hulls.map((hull) => hull.levels ? hull.heat_max : hull.heat?.max ?? 0));
    this.hasHeat = this.heatMax > 0;
    this.hasParts = this.hulls.some((hull) => hull.body.hasParts);
    this.scaleHeat();
    this.state.hidden.forEach((i) => { if (this.bodies[i]) this.bodies[i].body.visible = false; });
  }

  /** Its visual geometry in its collision geometry. */
  addRobot(hull, color, bytes) {
    const bodiesOf = (which, itsColor, depth) => {
      const bodies = hull.links.map((link) => link[which] && new Body({mesh: linkMesh(link[which], this.space, bytes), color: itsColor, depth,
        striped: which === 'collision', order: which === 'collision' ? 5 : 20, closed: link[which].facts.watertight}));
      return {bodies, all: new Bodies(bodies.filter(Boolean), itsColor)};
    };
    const visual = bodiesOf('visual', CLAY, 3), collision = bodiesOf('collision', color, 1);
    hull.linkBodies = hull.links.map((_, i) => [visual.bodies[i], collision.bodies[i]].filter(Boolean));
    for (const [role, word, {all}] of [['original', 'visual', visual], ['hull', 'collision', collision]]) {
      if (all.bodies.length === 0) continue;
      this.viewport.add(all);
      this.bodies.push({label: `${hull.name}, ${word}`, role, striped: role === 'hull', body: all});
    }
    hull.body = new Bodies([...visual.all.bodies, ...collision.all.bodies], color);
  }

  /** Of all robots: the joints of that name. */
  setJoint(name, position) {
    for (const {robot} of this.hulls) {
      robot?.joints.forEach((joint, i) => { if (joint.name === name) robot.positions[i] = position; });
    }
    this.moveRobots();
  }
  restRobots() {
    for (const {robot} of this.hulls) if (robot) robot.positions = robot.joints.map((joint) => joint.rest);
    this.moveRobots();
  }
  moveRobots() {
    for (const {robot, linkBodies} of this.hulls) {
      robot?.poses().forEach((pose, i) => linkBodies[i].forEach((body) => body.move(drawnPose(pose, this.space))));
    }
    this.panel?.showJoints();
    this.viewport.changed();
  }

  addBody({label, role, striped, ...options}) {
    const body = new Body({striped, ...options});
    this.viewport.add(body);
    this.bodies.push({label, role, striped, body});
    return body;
  }

  /** One legend for all hulls. */
  scaleHeat() {
    for (const hull of this.hulls) {
      const factor = (hull.levels ? hull.heat_max : hull.heat?.max ?? 0) / (this.heatMax || 1);
      hull.body.setHeatFactor(factor);
    }
  }

  /** For a progressive hull also its base mesh. */
  makeSides() {
    this.sides = this.hulls.map((hull) => ({hull, name: hull.name, groups: hull.body.groups}));
    const single = this.hulls.length === 1 && this.active.levels;
    if (single) {
      const base = new Body({mesh: this.active.levels.copy(0), color: BLUE, closed: true, striped: true, order: 30});
      base.visible = false;
      this.viewport.add(base);
      this.base = base;
      this.sides.unshift({name: `base, ${grouped(this.active.base_faces)} faces`, groups: base.groups});
    }
    const original = this.hulls.some((hull) => hull.robot) ? null : this.bodies.find((entry) => entry.role === 'original');
    if (original) this.sides.push({name: original.label, groups: original.body.groups});
  }

  get allBodies() { return [...this.bodies.map((entry) => entry.body), ...(this.base ? [this.base] : [])]; }

  /** All of the state, once the page is open. */
  apply() {
    const {state, viewport} = this;
    this.setTheme(state.theme);
    if (state.look) viewport.look(state.look[0], state.look[1], state.look[2] * this.space.radius,
        state.look.slice(3).map((x) => x * this.space.radius));
    for (const hull of this.hulls) if (hull.levels) this.setLevel(hull, this.firstLevel(hull));
    this.readJoints(state.joints);
    this.panel = new Panel(this);
    this.moveRobots();
    this.setOpacity(state.opacity);
    this.setEdges(state.edges);
    this.setHeat(state.heat && this.hasHeat);
    this.setBeside(state.beside && this.sides.length > 1);
    this.setParts(state.parts);
    this.setExplosion(state.explosion);
    this.setCut();
    if (state.ray) this.shoot({origin: state.ray.slice(0, 3), direction: state.ray.slice(3)});
    this.refresh();
    viewport.onChange = () => this.remember();
    document.title = `${this.hulls.map((hull) => hull.name).join(', ')} – prohull view`;
  }

  readJoints(positions) {
    const {robot} = this.active;
    if (!robot || positions?.length !== robot.free.length || !positions.every(Number.isFinite)) return;
    robot.free.forEach((joint, i) => {
      const [least, most] = robot.range(joint);
      this.setJoint(joint.name, Math.min(most, Math.max(least, positions[i])));
    });
  }

  firstLevel(hull) { return hull.levels.levelOf(this.state.faces ?? hull.base_faces); }

  // --- levels ---

  setLevel(hull, level) {
    this.endQuery();
    hull.levels.goTo(level);
    hull.body.update(hull.levels.faces);
  }

  /** Of all progressive hulls: the finest level of at most so many faces. */
  setFaces(faces) {
    for (const hull of this.hulls) if (hull.levels) this.setLevel(hull, hull.levels.levelOf(faces));
    this.state.faces = faces;
    this.refresh();
  }

  /** 0: the base mesh, 1: the original; each step multiplies the faces. */
  setLevelShare(share) {
    const {base_faces: base, original_faces: finest} = this.active;
    this.stop();
    this.setFaces(Math.round(base * (finest / base) ** share));
  }
  levelShare() {
    const {base_faces: base, original_faces: finest, levels} = this.active;
    return finest > base ? Math.log(levels.faces / base) / Math.log(finest / base) : 0;
  }
  step(by) {
    if (!this.active.levels) return;
    this.setLevelShare(Math.min(1, Math.max(0, this.levelShare() + by)));
  }

  /** The finest level with a proven distance that is not finer than so many faces. */
  stopOf(faces) { return this.active.stops.findLast((stop) => stop.faces <= faces) ?? this.active.stops[0]; }

  play() {
    if (!this.active.levels) return;
    if (this.playing) return this.stop();
    const from = this.levelShare() > 0.999 ? 0 : this.levelShare(), began = performance.now();
    this.panel.setPlaying(true);
    const run = this.playing = () => {
      if (this.playing !== run) return;
      const share = Math.min(1, from + (performance.now() - began) / 1000 / PLAY_SECONDS);
      this.setLevelShare(share);
      if (share === 1) return;
      this.playing = run;
      this.panel.setPlaying(true);
      requestAnimationFrame(run);
    };
    run();
  }
  stop() {
    this.playing = null;
    this.panel?.setPlaying(false);
  }

  // --- a ray ---

  /** A ray in the unit of the mesh; the hull is split only where the ray meets it. */
  shoot(ray) {
    const {levels, body} = this.active;
    if (!levels || !ray.direction.some((x) => x !== 0)) return;
    this.stop();
    this.endQuery();
    this.refinement ??= new Refinement(levels);
    const origin = this.space.steps(ray.origin);
    const tip = this.space.steps(ray.origin.map((x, k) => x + ray.direction[k]));
    const direction = tip.map((x, k) => x - origin[k]);
    const began = performance.now();
    this.query = {ray, hull: this.active, ...this.refinement.shoot({origin, direction})};
    this.query.milliseconds = performance.now() - began;
    for (const hit of this.query.hits) hit.point = ray.origin.map((x, k) => x + hit.t * ray.direction[k]);
    body.replaceFaces(this.refinement.triangles());
    body.update(this.query.faces);
    this.state.ray = [...ray.origin, ...ray.direction];
    this.refresh();
  }
  shootAt(x, y) {
    if (!this.active.levels || this.state.beside) return;
    const {origin, direction} = this.viewport.ray(x, y), from = this.space.point(origin);
    const to = this.space.point(origin.map((o, k) => o + direction[k]));
    this.shoot({origin: from, direction: to.map((x, k) => x - from[k])});
  }
  shootThroughMiddle() {
    const box = byId('canvas').getBoundingClientRect();
    this.shootAt(box.left + box.width / 2, box.top + box.height / 2);
  }

  /** The level is shown again that was shown before. */
  endQuery() {
    if (!this.query) return;
    const {hull} = this.query;
    this.refinement.rollBack();
    hull.body.replaceFaces(null);
    this.query = this.state.ray = null;
    this.setLevel(hull, this.firstLevel(hull));
    this.refresh();
  }

  markQuery() {
    if (!this.query) return;
    const {ray, hits} = this.query;
    const length = 2 * (this.viewport.homeDistance + this.viewport.radius) * this.space.side / Math.hypot(...ray.direction);
    this.viewport.line([ray.origin, ray.origin.map((x, k) => x + length * ray.direction[k])].map((p) => this.space.at(p)), RAY);
    hits.forEach((hit, i) => {
      this.viewport.mark(this.space.at(hit.point), String(i + 1), hit.found ? FOUND : MISSED).userData.point = hit.point;
    });
  }

  // --- what is shown, and how ---

  activate(i) {
    this.endQuery();
    this.refinement = null;
    this.active = this.hulls[i];
    this.state.active = i;
    byId('content').replaceChildren();
    this.panel = new Panel(this);
    this.refresh();
  }

  show(i, is) {
    this.bodies[i].body.visible = is;
    this.state.hidden = this.bodies.flatMap((entry, k) => entry.body.visible ? [] : [k]);
    this.viewport.changed();
  }

  setOpacity(opacity) {
    this.state.opacity = opacity;
    this.applyOpacity();
  }
  applyOpacity() {
    for (const {body, role} of this.bodies) {
      const isOver = role === 'hull' && !this.state.beside;
      body.setOpacity(isOver && !this.state.heat ? this.state.opacity : 1);
    }
    this.viewport.changed();
  }

  setEdges(is) {
    this.state.edges = is;
    for (const {body, role} of this.bodies) body.showEdges(is && (role === 'hull' || this.state.beside));
    this.base?.showEdges(is);
    this.colorEdges();
    this.viewport.changed();
  }
  colorEdges() {
    const color = this.isDark ? [0.02, 0.05, 0.1] : [0.05, 0.1, 0.18];
    for (const body of this.allBodies) body.setEdgeColor(color);
  }

  setHeat(is) {
    this.state.heat = is;
    for (const hull of this.hulls) hull.body.showHeat(is);
    byId('legend').hidden = !is;
    this.applyOpacity();
    this.viewport.changed();
  }

  setParts(is) {
    this.state.parts = is;
    showsParts.value = is;
    this.viewport.changed();
  }
  setExplosion(factor) {
    this.state.explosion = factor;
    explosion.value = factor;
    this.viewport.changed();
  }

  setBeside(is) {
    this.state.beside = is;
    this.viewport.panels = is ? this.sides : null;
    if (this.base) this.base.visible = is;
    byId('captions').replaceChildren(...(is ? this.sides.map(({name}) => el('span', {}, name)) : []));
    this.setEdges(this.state.edges);
    this.setOpacity(this.state.opacity);
    this.caption();
  }
  caption() {
    if (!this.state.beside) return;
    this.sides.forEach(({hull, name}, i) => {
      if (hull?.levels) byId('captions').children[i].textContent = `${name}, ${grouped(hull.levels.faces)} faces`;
    });
  }

  // --- section ---

  setCutAxis(axis) {
    this.state.cut = axis;
    const back = this.viewport.camera.position.clone().sub(this.viewport.controls.target).normalize().toArray();
    if (axis === 'v') this.state.cutFacing = back;
    // What is nearer to the viewer goes.
    this.state.cutSign = axis === 'v' || !axis || back['xyz'.indexOf(axis)] >= 0 ? 1 : -1;
    this.setCut();
  }
  setCutAt(at) {
    this.state.cutAt = Math.max(-1, Math.min(1, at));
    this.setCut();
  }
  flipCut() {
    this.state.cutSign = -this.state.cutSign;
    this.setCut();
  }
  setCut() {
    const {cut, cutAt, cutSign, cutFacing} = this.state;
    const axis = cut === 'v' ? cutFacing : AXES[cut];
    if (!axis) return this.viewport.setCut(null, 0, this.allBodies);
    const reach = axis.reduce((sum, x, k) => sum + Math.abs(x) * this.space.half[k], 0);
    this.viewport.setCut(axis.map((x) => x * cutSign), cutSign * cutAt * reach, this.allBodies);
    byId('cut').value = cut;
    byId('cut-at').value = cutAt;
  }

  // --- places ---

  flyTo(point) { this.viewport.fly(this.space.at(point)); }

  placeMarks() {
    const {viewport, active} = this;
    viewport.clearMarks();
    this.markQuery();
    const far = this.query ? null : this.panel.farthest();
    if (far && far.upper > 0) viewport.mark(this.space.at(far.farthest), '★', FAR).userData.point = far.farthest;
    (active.verification?.worst ?? []).forEach((o, i) => {
      viewport.mark(this.space.at(o.point), String(i + 1), OUTSIDE).userData.point = o.point;
    });
  }
  nextOutside() {
    const worst = this.active.verification?.worst ?? [];
    if (worst.length === 0) return;
    this.seen = ((this.seen ?? -1) + 1) % worst.length;
    this.flyTo(worst[this.seen].point);
  }

  refresh() {
    this.panel?.showLevel();
    this.panel?.showFarthest();
    if (this.panel) this.placeMarks();
    this.caption();
    this.viewport.changed();
  }

  // --- around it ---

  get isDark() {
    return (this.state.theme ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light')) === 'dark';
  }
  setTheme(theme) {
    this.state.theme = theme;
    document.documentElement.dataset.theme = this.isDark ? 'dark' : 'light';
    this.viewport.setBackground(this.isDark ? '#12161a' : '#f4f5f6');
    this.colorEdges();
  }
  toggleTheme() { this.setTheme(this.isDark ? 'light' : 'dark'); }

  async savePicture() {
    const blob = await this.viewport.picture();
    const link = el('a', {href: URL.createObjectURL(blob), download: 'prohull-view.png'});
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  remember() {
    clearTimeout(this.remembering);
    this.remembering = setTimeout(() => writeFragment(this.fragment()), 150);
  }
  fragment() {
    const {state, space} = this, [azimuth, elevation, distance, target] = this.viewport.looking();
    const round = (x) => Number(x.toPrecision(5));
    return {
      v: [azimuth, elevation, distance / space.radius, ...target.map((x) => x / space.radius)]
          .map((x) => Math.abs(x) < 1e-6 ? 0 : round(x)).join(','),
      l: this.active.levels ? this.active.levels.faces : null,
      o: state.opacity, e: state.edges ? 1 : 0, h: state.heat ? 1 : null, b: state.beside ? 1 : null,
      u: this.hasParts && !state.parts ? 0 : null, k: this.hasParts && state.explosion || null,
      c: state.cut, a: state.cut ? state.cutAt : null, s: state.cut && state.cutSign < 0 ? -1 : null,
      d: state.cut === 'v' ? state.cutFacing.map(round).join(',') : null,
      r: state.ray?.join(','),
      j: this.active.robot?.free.map(({i}) => round(this.active.robot.positions[i])).join(','),
      x: state.hidden.join(','), n: state.active || null, t: state.theme,
    };
  }

  listen() {
    const canvas = byId('canvas');
    let pressed = null;
    canvas.addEventListener('pointerdown', (e) => {
      this.viewport.flight = null;
      pressed = [e.clientX, e.clientY];
    });
    canvas.addEventListener('pointerup', (e) => {
      if (!pressed || Math.hypot(e.clientX - pressed[0], e.clientY - pressed[1]) > 4) return;
      const mark = this.viewport.markAt(e.clientX, e.clientY);
      if (mark) this.flyTo(mark.userData.point);
      else this.shootAt(e.clientX, e.clientY);
    });
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.setTheme(this.state.theme));
    addEventListener('keydown', (e) => this.key(e));
  }

  key(e) {
    if (e.ctrlKey || e.metaKey || e.altKey || ['INPUT', 'SELECT', 'TEXTAREA'].includes(e.target.tagName)) return;
    if (e.key === ' ' && e.target.tagName !== 'CANVAS' && e.target !== document.body) return;
    const act = this.actionOf(e.key, e.shiftKey);
    if (!act) return;
    e.preventDefault();
    this.viewport.flight = null;
    act();
  }
  actionOf(key, shift) {
    const {viewport, state} = this;
    const arrow = (right, up) => () => shift ? viewport.shift(right * 0.03, up * 0.03) : viewport.turn(right * 6, up * 6);
    const toggle = (id) => () => byId(id)?.click();
    const cut = (axis) => () => this.setCutAxisFromKey(axis);
    return {
      ArrowLeft: arrow(-1, 0), ArrowRight: arrow(1, 0), ArrowUp: arrow(0, 1), ArrowDown: arrow(0, -1),
      '+': () => viewport.zoom(1.15), '=': () => viewport.zoom(1.15), '-': () => viewport.zoom(1 / 1.15),
      0: () => viewport.home(), ',': () => this.step(-0.02), '.': () => this.step(0.02), ' ': () => this.play(),
      e: toggle('edges'), h: toggle('heat'), p: toggle('png'), f: toggle('fly-far'), n: () => this.nextOutside(),
      q: () => this.shootThroughMiddle(), Escape: () => this.endQuery(),
      x: cut('x'), y: cut('y'), z: cut('z'),
      '[': () => this.setCutAt(state.cutAt - 0.05), ']': () => this.setCutAt(state.cutAt + 0.05),
    }[key];
  }
  /** A second time, the key ends the section. */
  setCutAxisFromKey(axis) {
    const next = this.state.cut === axis ? '' : axis;
    byId('cut').value = next;
    this.setCutAxis(next);
  }
}

async function open() {
  const scene = JSON.parse(byId('scene').textContent);
  const bytes = await readBlocks(byId('blocks').textContent);
  byId('blocks').remove();
  globalThis.prohullView = new View(scene, bytes);  // for the browser's console, and for tests
  byId('message').hidden = true;
  document.documentElement.dataset.ready = 'yes';
}

open().catch((error) => {
  byId('message').hidden = false;
  byId('message').textContent = `This page cannot be shown: ${error.message}`;
  document.documentElement.dataset.ready = 'no';
  console.error(error);
});

// Which bodies stand for the objects of a page: the original first, then hulls.

import {dividedMesh} from '../data/heat.js';
import {linkMesh} from '../data/robot.js';
import {grouped} from '../panel/dom.js';
import {Bodies, Body} from './body.js';

const CLAY = '#e0b48c', BLUE = '#6aa9e6';
const MORE = [BLUE, '#009e73', '#cc79a7', '#f0e442', '#0072b2', '#e69f00', '#56b4e9', '#999999'];
// Where surfaces touch, the outer one is seen.
const DEPTH = {outer: 1, original: 3, inner: 5};

const isInner = (hull) => hull.side === 'inner' || hull.verification?.side === 'inner';
const heatMaxOf = (hull) => hull.levels ? hull.heat_max : hull.heat?.max ?? 0;

class Maker {
  constructor(view, bytes) {
    this.view = view;
    this.bytes = bytes;
    this.entries = [];
    this.hasInner = view.hulls.some(isInner);
  }

  add(entry, options) {
    const body = new Body({striped: entry.striped, label: entry.label, ...options});
    this.view.viewport.add(body);
    this.entries.push({...entry, body});
    return body;
  }

  /** From the outside to the inside. */
  order(object) {
    const volume = ({facts, verification}) => Math.abs(facts?.volume ?? verification?.hull_volume ?? 0);
    const sorted = [...this.view.scene.objects].sort((a, b) => volume(b) - volume(a));
    return (isInner(object) ? 21 : 1) + sorted.indexOf(object);
  }

  addOriginal() {
    const {original, hulls} = this.view, levels = hulls.find((hull) => hull.levels && !hull.original_shown);
    const how = {depth: DEPTH.original, color: CLAY, order: 20};
    const entry = {role: 'original', isGlass: this.hasInner};
    if (original) this.add({label: original.name, ...entry}, {...how, mesh: original.mesh, source: original, closed: original.facts.watertight});
    else if (levels) this.add({label: `${levels.name}, finest level`, ...entry},
        {...how, mesh: levels.levels.copy(levels.levels.count), closed: true});
  }

  addHull(hull, color) {
    const {levels} = hull, isAlone = this.entries.length === 0;
    const mesh = levels ? {positions: levels.positions, triangles: levels.corners, heat: levels.heat} : hull.mesh;
    hull.body = this.add({label: hull.name, role: 'hull', striped: !isAlone, isGlass: !isInner(hull)}, {
      mesh, source: hull, color: isAlone && this.view.hulls.length === 1 ? CLAY : color, order: this.order(hull),
      depth: isInner(hull) ? DEPTH.inner : DEPTH.outer,
      closed: hull.facts?.watertight ?? true,
      divided: hull.heat && !levels ? dividedMesh(hull.mesh, hull.heat, this.bytes) : null});
  }

  /** Adds the robot's visual geometry, and its collision geometry around it. */
  addRobot(hull, color) {
    const {space, viewport} = this.view;
    const bodiesOf = (which, how) => {
      const bodies = hull.links.map((link) => link[which] && new Body({mesh: linkMesh(link[which], space, this.bytes),
        label: `${link.name} of ${hull.name}, ${which}`, source: link[which], closed: link[which].facts.watertight, ...how}));
      return {bodies, all: new Bodies(bodies.filter(Boolean), how.color)};
    };
    const visual = bodiesOf('visual', {color: CLAY, depth: DEPTH.original, order: 20});
    const collision = bodiesOf('collision', {color, depth: DEPTH.outer, order: 5, striped: true});
    hull.linkBodies = hull.links.map((_, i) => [visual.bodies[i], collision.bodies[i]].filter(Boolean));
    for (const [a, b] of hull.linkBodies) if (b) [a.partner, b.partner] = [b, a];
    hull.collisionBodies = collision.bodies;
    for (const [role, word, {all}] of [['original', 'visual', visual], ['hull', 'collision', collision]]) {
      if (all.bodies.length === 0) continue;
      viewport.add(all);
      this.entries.push({label: `${hull.name}, ${word}`, role, striped: role === 'hull', isGlass: role === 'hull', body: all});
    }
    hull.body = new Bodies([...visual.all.bodies, ...collision.all.bodies], color);
  }

  /** What stands side by side; of a progressive hull that is alone also its base mesh. */
  sides() {
    const {hulls, viewport} = this.view, sides = hulls.map((hull) => ({hull, name: hull.name, groups: hull.body.groups}));
    const found = {sides, base: null};
    if (hulls.length === 1 && hulls[0].levels) {
      found.base = new Body({mesh: hulls[0].levels.copy(0), label: `${hulls[0].name}, base mesh`, color: BLUE, closed: true, striped: true, order: 30});
      found.base.visible = false;
      viewport.add(found.base);
      sides.unshift({name: `base, ${grouped(hulls[0].base_faces)} faces`, groups: found.base.groups});
    }
    const original = hulls.some((hull) => hull.robot) ? null : this.entries.find(({role}) => role === 'original');
    if (original) sides.push({name: original.label, groups: original.body.groups});
    return found;
  }
}

export function makeBodies(view, bytes) {
  const maker = new Maker(view, bytes), {hulls, scene, state} = view;
  maker.addOriginal();
  hulls.forEach((hull, i) => {
    if (hull.robot) maker.addRobot(hull, MORE[i % MORE.length]);
    else maker.addHull(hull, MORE[i % MORE.length]);
  });
  const heatMax = Math.max(0, ...hulls.map(heatMaxOf));
  for (const hull of hulls) hull.body.setHeatFactor(heatMaxOf(hull) / (heatMax || 1));  // one legend for all
  state.hidden.forEach((i) => { if (maker.entries[i]) maker.entries[i].body.visible = false; });
  const hasDefects = scene.objects.some((object) => object.mesh && object.facts && !object.facts.watertight);
  return {bodies: maker.entries, hasDefects, ...maker.sides(), heatMax, hasHeat: heatMax > 0,
    hasParts: hulls.some((hull) => hull.body.hasParts)};
}

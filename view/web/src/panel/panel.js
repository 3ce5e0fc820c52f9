// The panel beside the picture. It knows elements, and calls `view` for all else.

import {atLeast, atMost, byId, counted, el, grouped, percent, place, short, svg} from './dom.js';
import {pickedElements} from './picked.js';

const FINEST_LEVEL = {
  repaired: 'the repaired input', 'convex-hull': 'the convex hull of the input', wrap: 'a wrap of the input'};

const MOST_OPENINGS = 20;

const withUnit = (text, unit) => unit ? `${text} ${unit}` : text;
const table = (rows) => el('table', {}, ...rows.filter((row) => row && row[1] !== null).map(
    ([what, ...found]) => el('tr', {}, el('th', {scope: 'row'}, what), el('td', {}, ...found))));
const check = (attributes, text, swatch) =>
    el('label', {class: 'check'}, el('input', {type: 'checkbox', ...attributes}), swatch,
        el('span', {class: 'name'}, text));

export function swatch(color, striped) {
  const element = el('span', {class: striped ? 'swatch striped' : 'swatch'});
  element.style.backgroundColor = color;
  return element;
}

/** The verdict of a mesh that is compared with nothing. */
function verdictOfMesh({watertight, defects, first_defect: first}, alone) {
  if (watertight) return ['good', '✓', 'Watertight', alone];
  const counts = defects.map(({what, count}) => `${grouped(count)} ${what}`).join(', ');
  return ['bad', '✗', 'Not watertight', `${counts}.${first ? ` The first: ${first}.` : ''}`];
}

const ANSWERS = {yes: ['good', '✓', 'Yes'], no: ['bad', '✗', 'No'], undecided: ['open', '?', 'Undecided']};

/** What `prohull verify` would say, as a mark, a word and why. */
export function verdictOf(object, alone = 'It is compared with nothing: --original adds a mesh.') {
  const v = object.verification;
  if (object.robot) return ['open', '–', 'Robot', 'prohull urdf --check decides whether the collision geometry covers the visual geometry.'];
  if (!v && object.facts && !object.union) return verdictOfMesh(object.facts, alone);
  if (!v) return ['open', '–', 'Not compared', 'No original mesh is in this page: --original adds it.'];
  if (v.refused) return ['open', '?', 'Not decided', v.refused];
  const how = v.proof === 'replay' ? `; ${counted(v.splits, 'split', 'splits')} replayed, ${counted(v.signs, 'sign', 'signs')} exact` : ', exactly';
  return [...ANSWERS[v.answer], `${v.told}${v.answer === 'yes' ? how : `: ${v.why_not}`}.`];
}

export class Panel {
  constructor(view) {
    this.view = view;
    this.content = byId('content');
    this.live = {};
    byId('fold').onclick = () => this.fold(byId('fold').getAttribute('aria-expanded') === 'true');
    this.content.append(...[
      this.heading(), this.levelPart(), this.motionPart(), this.jointsPart(), this.collisionsPart(), this.pickedPart(),
      this.queryPart(), this.shownPart(), this.cutPart(), this.distancePart(), this.outsidePart(), this.openingsPart(), this.factsPart(), this.cameraPart(), this.notePart()].filter(Boolean));
  }

  get object() { return this.view.active; }
  get unit() { return this.view.scene.unit; }

  fold(folded) {
    byId('fold').setAttribute('aria-expanded', String(!folded));
    this.content.classList.toggle('folded', folded);
  }

  heading() {
    const {view} = this;
    const [kind, mark, word, why] = verdictOf(this.object, view.scene.alone);
    const choices = view.hulls.length > 1 && el('div', {class: 'row'},
        el('label', {}, 'Numbers of ', el('select', {id: 'active', onchange: (e) => view.activate(Number(e.target.value))},
            ...view.hulls.map((hull, i) => el('option', {value: i, selected: hull === this.object}, hull.name)))));
    return el('section', {},
        el('h1', {id: 'title'}, view.hulls.map((hull) => hull.name).join(', ')),
        choices || null,
        el('div', {class: `verdict ${kind}`, id: 'verdict'}, el('span', {'aria-hidden': 'true'}, mark),
            el('div', {}, word, el('small', {}, why))));
  }

  levelPart() {
    if (!this.object.levels) return null;
    const {view, live} = this;
    const slider = live.slider = el('input', {type: 'range', id: 'level', min: 0, max: 1000, step: 1,
      'aria-label': 'Level of the hull, from base to original', oninput: (e) => view.levels.setShare(e.target.value / 1000)});
    live.faces = el('b', {id: 'faces'});
    live.void = el('b', {id: 'void'});
    live.distance = el('b', {id: 'distance'});
    live.encloses = el('b', {id: 'encloses'});
    live.play = el('button', {type: 'button', id: 'play', onclick: () => view.levels.play()}, 'Play');
    live.wanted = el('input', {type: 'number', id: 'wanted', min: 0, step: 1, 'aria-label': 'Faces at most',
      onchange: (e) => view.levels.setFaces(Number(e.target.value))});
    const stops = this.object.stops.map((stop) => el('option', {value: stop.faces}, grouped(stop.faces)));
    live.stops = el('select', {id: 'stops', 'aria-label': 'Levels whose farthest point is known',
      onchange: (e) => e.target.value && view.levels.setFaces(Number(e.target.value))}, el('option', {value: ''}, 'Measured …'), ...stops);
    const box = (value, label) => el('div', {}, value, label);
    return el('section', {}, el('h2', {}, 'Level'), slider,
        el('div', {class: 'numbers'},
            box(live.faces, el('span', {}, 'faces')),
            box(live.void, el('span', {title: 'Volume between this level and the original, as a share of the original'}, 'void')),
            box(live.distance, el('span', {title: 'No point of this level is farther from the original'}, 'distance, proven')),
            box(live.encloses, el('span', {}, this.enclosed))),
        el('div', {class: 'row'}, live.play, live.wanted, live.stops));
  }

  /** What is asked of each level. */
  get enclosed() {
    const {side, verification: {solid_only: isSolid}} = this.object;
    if (side === 'inner') return `${isSolid ? 'its solid is ' : ''}enclosed by the original`;
    return `encloses ${isSolid ? 'the solid of ' : ''}the original`;
  }

  /** The numbers of the level that is shown. */
  showLevel() {
    if (!this.object.levels) return;
    this.showQuery();
    const {live, object} = this, {levels} = object;
    const stop = this.view.levels.stopOf(levels.shownFaces), v = object.verification;
    live.slider.value = Math.round(1000 * this.view.levels.share());
    live.slider.setAttribute('aria-valuetext', `${grouped(levels.shownFaces)} faces`);
    const {query} = this.view.rays;
    live.faces.textContent = grouped(query ? query.faces : levels.shownFaces);
    live.void.textContent = query ? '–' : levels.voids ? percent(levels.voids[levels.shown]) : '–';
    const isStop = stop.faces === levels.shownFaces && !query, bound = isStop ? stop.upper : stop.until_next;
    live.distance.textContent = query ? '–' : bound === undefined ? '…' : withUnit(`≤ ${atMost(bound)}`, this.unit);
    live.encloses.textContent = v.refused ? '?' : v.every_level || v.encloses && levels.shown === 0 ? '✓ yes' : '– not proven';
    live.wanted.value = levels.shownFaces;
    live.stops.value = isStop ? String(stop.faces) : '';
    this.showFarthest();
  }

  setPlaying(is) { this.live.play.textContent = is ? 'Pause' : 'Play'; }

  /** A path, its time, and what is proven of the distance of all bodies. */
  motionPart() {
    const {motion} = this.view, {object, live} = this;
    if (object !== motion.object) return null;
    const {begin, end} = motion, {bounds, verdict, is_good: good} = object.motion;
    live.time = el('input', {type: 'range', id: 'time', min: begin, max: end, step: 'any', 'aria-label': 'Time',
      oninput: (e) => { motion.stop(); motion.set(Number(e.target.value)); }});
    live.move = el('button', {type: 'button', id: 'move', onclick: () => motion.play()}, 'Play');
    live.apart = el('p', {id: 'apart', 'aria-live': 'polite'});
    live.now = svg('line', {y1: 0, y2: 60, class: 'now'});
    const x = this.timeToX = (time) => 300 * (time - begin) / (end - begin || 1);
    const most = Math.max(...bounds.map(([, , distance]) => distance), 1e-9);
    const steps = bounds.map(([from, to, distance]) => `${x(from)},${58 - 54 * distance / most} ${x(to)},${58 - 54 * distance / most}`);
    const curve = bounds.length > 0 && svg('svg', {viewBox: '0 0 300 60', preserveAspectRatio: 'none', class: 'curve', role: 'img',
      'aria-label': `Proven distance over time, at most ${atLeast(1000 * most)} mm`},
        svg('polyline', {points: `0,58 ${steps.join(' ')} ${x(bounds.at(-1)[1])},58`}), live.now);
    return el('section', {id: 'motion'}, el('h2', {}, 'Path'),
        el('p', {class: `verdict ${good ? 'good' : 'bad'}`, id: 'path-verdict'}, verdict), curve, live.time, live.apart, live.move);
  }

  showMotion() {
    const {live} = this, {motion} = this.view;
    if (!live.time) return;
    const {time, bound} = motion, {in_seconds: seconds} = motion.motion;
    live.time.value = time;
    for (const end of ['x1', 'x2']) live.now.setAttribute(end, this.timeToX(time));
    live.apart.textContent = (seconds ? `${time.toFixed(3)} s: ` : `row ${time.toFixed(2)}: `) +
        (bound?.[2] > 0 ? `at least ${atLeast(1000 * bound[2])} mm apart, proven; the nearest found: ${bound[3]}` : 'nothing is proven of it');
  }

  setMoving(is) { if (this.live.move) this.live.move.textContent = is ? 'Pause' : 'Play'; }

  jointsPart() {
    const {robot} = this.object;
    if (!robot || robot.free.length === 0) return null;
    this.live.joints = robot.free.map((joint, place) => {
      const [min, max] = robot.range(joint), value = el('output', {id: `joint-value-${place}`});
      const slider = el('input', {type: 'range', id: `joint-${place}`, min, max, step: 'any', value: robot.positions[joint.i],
        'aria-label': joint.name, oninput: (e) => this.view.robots.set(joint.name, Number(e.target.value))});
      return {joint, slider, value, row: el('div', {class: 'joint'}, el('span', {}, joint.name), value, slider)};
    });
    return el('section', {id: 'joints'}, el('h2', {}, 'Joints'), ...this.live.joints.map(({row}) => row),
        el('div', {class: 'row'}, el('button', {type: 'button', id: 'rest', onclick: () => this.view.robots.rest()}, 'Rest')));
  }

  /** Where the joints are. */
  showJoints() {
    for (const {joint, slider, value} of this.live.joints ?? []) {
      const position = this.object.robot.positions[joint.i];
      slider.value = position;
      value.textContent = joint.motion === 'turn' ? `${(position * 180 / Math.PI).toFixed(1)}°` : `${(1000 * position).toFixed(1)} mm`;
    }
  }

  collisionsPart() {
    if (!this.object.robot) return null;
    this.live.collisions = el('div', {id: 'collisions', 'aria-live': 'polite'});
    return el('section', {}, el('h2', {}, 'Collisions'), this.live.collisions);
  }

  /** Which links collide where the joints are. */
  showCollisions() {
    const {live, object} = this;
    if (!live.collisions) return;
    const {pairs, colliding} = object.collisions, names = object.links.map(({name}) => name);
    live.collisions.replaceChildren(
        el('p', {id: 'colliding'}, pairs.length === 0 ? 'No links to compare: fewer than two have collision geometry that may not touch.'
            : colliding.length === 0 ? '✓ No links collide.' : `✗ ${counted(colliding.length, 'pair collides', 'pairs collide')}:`),
        el('ul', {class: 'pairs'}, ...colliding.map(([a, b]) => el('li', {}, `${names[a]} – ${names[b]}`))),
        el('p', {class: 'soft'}, `${counted(pairs.length, 'pair', 'pairs')} of links compared as they are drawn. Left out: ` +
            (object.disabled_by_file ? 'the pairs that the SRDF file disables.' : 'neighbours, and pairs that touch in nearly all of 200 random positions.') +
            (this.view.hulls.some(({robot}) => !robot) ? ' Meshes beside the robot are not compared.' : '')));
  }

  pickedPart() {
    const {live, view: {picks}} = this;
    live.picked = el('div', {id: 'picked', 'aria-live': 'polite'});
    live.second = el('button', {type: 'button', id: 'second', 'aria-pressed': 'false', onclick: () => picks.setNext('second')}, 'Second point');
    live.endPick = el('button', {type: 'button', id: 'end-pick', onclick: () => picks.end()}, 'End');
    return el('section', {}, el('h2', {}, 'Points'), live.picked, el('div', {class: 'row'}, live.second, live.endPick));
  }

  /** Where the picked points are. Screen readers tell only what has changed. */
  showPicked() {
    const {live, view: {picks}} = this, told = el('div', {}, ...pickedElements(picks, table));
    for (const button of [live.second, live.endPick]) button.hidden = picks.points.length === 0;
    if (told.textContent !== live.picked.textContent) live.picked.replaceChildren(told);
  }
  showNext() {
    const {live, view: {picks: {next}}} = this;
    live.second.setAttribute('aria-pressed', String(next === 'second'));
    live.byClick?.setAttribute('aria-pressed', String(next === 'ray'));
  }

  queryPart() {
    if (!this.object.levels) return null;
    const {view, live} = this;
    live.query = el('div', {id: 'query', 'aria-live': 'polite'});
    return el('section', {}, el('h2', {}, 'A ray'), live.query, el('div', {class: 'row'},
        el('button', {type: 'button', id: 'shoot', onclick: () => view.rays.shootThroughMiddle()}, 'Through the middle'),
        live.byClick = el('button', {type: 'button', id: 'by-click', 'aria-pressed': 'false', onclick: () => view.picks.setNext('ray')}, 'By clicks'),
        live.endQuery = el('button', {type: 'button', id: 'end-query', onclick: () => view.rays.end()}, 'End')));
  }

  /** What the last ray has met, and what that took. */
  showQuery() {
    const {live, view} = this, {query} = view.rays;
    if (!live.query) return;
    live.endQuery.hidden = !query;
    if (!query) {
      live.query.replaceChildren(el('p', {class: 'soft'}, 'The base mesh is split only where a ray meets it.'));
      return;
    }
    const missed = query.hits.filter((hit) => !hit.found).length;
    const hits = query.hits.map((hit, i) => el('li', {}, el('button', {type: 'button', onclick: () => view.places.flyTo(hit.point)},
        el('span', {class: hit.found ? 'mark found' : 'mark missed'}, String(i + 1)),
        el('span', {}, `${hit.entering ? 'enters' : 'leaves'}${hit.found ? '' : ', passes below the hull: not found'}`,
            el('span', {class: 'where'}, place(hit.point))))));
    live.query.replaceChildren(
        el('p', {}, el('b', {id: 'tests'}, grouped(query.tests)), ` faces tested, `, el('b', {id: 'splits'}, grouped(query.splits)),
            ` vertices split, `, el('b', {id: 'hits'}, grouped(query.hits.length - missed)),
            ` ${query.hits.length - missed === 1 ? 'hit' : 'hits'} found${missed ? `, ${missed} missed` : ''}.`),
        el('ol', {class: 'places', id: 'query-hits'}, ...hits),
        el('details', {}, el('summary', {}, 'The same on the command line'),
            el('p', {class: 'soft'}, 'prohull query H.phull --engine paper-refinement --mode all --rays rays.csv, where rays.csv has the line'),
            el('p', {class: 'soft', id: 'ray'}, [...query.ray.origin, ...query.ray.direction].join(','))));
  }

  shownPart() {
    const {view} = this;
    const rows = view.bodies.map((entry, i) => {
      const input = check({id: `show-${i}`, checked: entry.body.visible, onchange: (e) => view.look.show(i, e.target.checked)},
          entry.label, swatch(entry.body.color, entry.striped));
      return input;
    });
    return el('section', {}, el('h2', {}, 'Shown'), ...rows,
        el('div', {class: 'row'}, el('label', {for: 'opacity'}, 'Opacity'),
            el('input', {type: 'range', id: 'opacity', min: 0.05, max: 1, step: 0.05, value: view.state.opacity,
              oninput: (e) => view.look.setOpacity(Number(e.target.value))})),
        check({id: 'edges', checked: view.state.edges, onchange: (e) => view.look.setEdges(e.target.checked)}, 'Edges'),
        view.hasDefects && check({id: 'defects', checked: view.state.defects, onchange: (e) => view.look.setDefects(e.target.checked)},
            'Edges that are not watertight'),
        view.hasHeat && check({id: 'heat', checked: view.state.heat, onchange: (e) => view.look.setHeat(e.target.checked)},
            'Distance as colour'),
        view.hasParts && check({id: 'parts', checked: view.state.parts, onchange: (e) => view.look.setParts(e.target.checked)},
            'Parts in colours'),
        view.hasParts && el('div', {class: 'row'}, el('label', {for: 'explosion'}, 'Apart'),
            el('input', {type: 'range', id: 'explosion', min: 0, max: 1.5, step: 0.01, value: view.state.explosion,
              oninput: (e) => view.look.setExplosion(Number(e.target.value))})),
        view.sides.length > 1 && check({id: 'beside', checked: view.state.beside, onchange: (e) => view.look.setBeside(e.target.checked)},
            'Side by side'));
  }

  cutPart() {
    const {view} = this;
    const axes = [['', 'None'], ['x', 'X'], ['y', 'Y'], ['z', 'Z'], ['v', 'Facing']];
    const select = el('select', {id: 'cut', 'aria-label': 'Direction of the section',
      onchange: (e) => view.section.setAxis(e.target.value)},
        ...axes.map(([value, name]) => el('option', {value, selected: value === view.state.cut}, name)));
    return el('section', {}, el('h2', {}, 'Section'), el('div', {class: 'row'}, select,
        el('button', {type: 'button', id: 'flip', onclick: () => view.section.flip()}, 'Flip')),
        el('input', {type: 'range', id: 'cut-at', min: -1, max: 1, step: 0.005, value: view.state.cutAt,
          'aria-label': 'Place of the section', oninput: (e) => view.section.setPlace(Number(e.target.value))}));
  }

  /** The farthest point of the hull, or of its level. */
  farthest() {
    const {object} = this;
    return object.levels ? this.view.levels.stopOf(object.levels.shownFaces) : object.distance;
  }

  distancePart() {
    if (!this.farthest()) return null;
    this.live.far = el('p', {id: 'far'});
    this.live.between = el('p', {id: 'between'});
    const fly = this.live.flyFar = el('button', {type: 'button', id: 'fly-far', onclick: () => this.view.places.flyTo(this.farthest().farthest)},
        el('span', {class: 'far-mark', 'aria-hidden': 'true'}, '★ '), 'Show the farthest point');
    return el('section', {}, el('h2', {}, this.object.union ? 'Reach out of the original' : 'Distance to the original'), this.live.between, this.live.far, fly);
  }

  showFarthest() {
    const found = this.farthest();
    if (!found || !this.live.far) return;
    const {levels} = this.object, of = levels ? ` of the level of ${grouped(found.faces)} faces` : '';
    this.live.between.hidden = !levels || levels.shownFaces === found.faces || found.until_next === undefined;
    if (!this.live.between.hidden) {
      const next = this.object.stops.find(({faces}) => faces > found.faces) ?? found;
      this.live.between.textContent = `All levels from ${grouped(found.faces)} to ${grouped(next.faces)} faces are within ` +
          `${withUnit(atMost(found.until_next), this.unit)} (proven).`;
    }
    this.live.flyFar.disabled = found.lower === 0;
    const most = `${withUnit(atMost(found.upper), this.unit)} away`;
    this.live.far.textContent = found.lower === 0 ? `No point${of} is more than ${most} (proven).` :
      `The farthest point${of} is between ${withUnit(atLeast(found.lower), this.unit)} and ${most} (proven), found at ${place(found.farthest)}.`;
  }

  outsidePart() {
    const v = this.object.verification;
    if (!v?.worst?.length) return null;
    const places = v.worst.map((o, i) => el('li', {}, el('button', {type: 'button', onclick: () => this.view.places.flyTo(o.point)},
        el('span', {class: 'mark'}, String(i + 1)),
        el('span', {}, `face ${grouped(o.face)}, ${withUnit(short(o.distance), this.unit)} outside`,
            el('span', {class: 'where'}, place(o.point))))));
    return el('section', {}, el('h2', {}, 'Outside'),
        el('p', {}, `${counted(v.faces_outside, 'face lies', 'faces lie')} outside${this.object.levels ? ' of some levels' : ''}, at least in part. ` +
            (v.worst.length < v.faces_outside ? 'The farthest:' : '')),
        el('ol', {class: 'places', id: 'outside'}, ...places));
  }

  /** Edges along which something is not watertight. */
  openingsPart() {
    const {view, unit} = this, all = view.surfaces.flatMap((body) => body.openings.map((opening) => ({body, ...opening})));
    if (all.length === 0) return null;
    const places = all.sort((a, b) => b.length - a.length).slice(0, MOST_OPENINGS).map(({body, edges, length, middle}) =>
        el('li', {}, el('button', {type: 'button', onclick: () => view.places.flyToPointOf(body, middle)},
            el('span', {}, `${counted(edges, 'edge', 'edges')}, ${withUnit(short(length * view.space.side), unit)} together`,
                el('span', {class: 'where'}, body.label)))));
    return el('section', {}, el('h2', {}, 'Not watertight'),
        el('p', {}, `Edges that are not watertight hang together in ${counted(all.length, 'place', 'places')}.` +
            (all.length > MOST_OPENINGS ? ' The longest:' : '')),
        el('ol', {class: 'places', id: 'openings'}, ...places));
  }

  factsPart() {
    const {object, unit} = this, {facts} = object, v = object.verification;
    const cubic = unit ? `${unit}³` : '';
    const rows = object.robot
        ? [['Links', grouped(object.links.length)], ['Joints', grouped(object.joints.length)],
          ['That move', grouped(object.robot.free.length)]]
        : object.levels
        ? [['Faces', `${grouped(object.base_faces)} to ${grouped(object.original_faces)}`],
          ['Vertex splits', grouped(object.levels.count)],
          ['Side', object.side],
          FINEST_LEVEL[object.finest_level] && ['Finest level', FINEST_LEVEL[object.finest_level]]]
        : !facts ? [['Parts', object.union]]
        : [['Parts', object.union ?? null], ['Faces', grouped(facts.faces)], ['Vertices', grouped(facts.vertices)],
          ['Watertight', facts.watertight ? 'yes' : 'no'],
          !object.union && facts.components > 1 && ['Components', grouped(facts.components)],
          facts.volume !== null && !object.union && ['Volume', withUnit(short(facts.volume, 7), cubic)],
          ['Size', withUnit(facts.size.map((x) => short(x)).join(' × '), unit)],
          ...facts.defects.map(({what, count}) => [what, grouped(count)]),
          object.left_out > 0 && ['Not finite, left out', counted(object.left_out, 'face', 'faces')]];
    const proof = v && !v.refused
        ? [!object.levels && v.void_ratio !== null && ['Void', percent(v.void_ratio)],
          v.hull_volume !== null && [object.levels ? 'Volume of the base' : 'Volume, verified', withUnit(short(v.hull_volume, 7), cubic)],
          v.original_volume !== null && ['Volume of the original', withUnit(short(v.original_volume, 7), cubic)],
          v.self_intersections !== undefined && [object.levels ? 'Self-intersections of the base' : 'Self-intersections', counted(v.self_intersections, 'pair', 'pairs')]]
        : [];
    return el('section', {id: 'facts'}, el('h2', {}, 'Numbers'), table([...rows, ...proof]),
        ...(v?.notes ?? []).map((note) => el('p', {class: 'soft'}, note)),
        ...this.originalFacts());
  }

  originalFacts() {
    const {original} = this.view;
    if (!original?.facts) return [];
    const {facts} = original;
    return [el('h2', {}, 'Original'), table([
      ['Name', original.name], ['Faces', grouped(facts.faces)], ['Watertight', facts.watertight ? 'yes' : 'no'],
      ...facts.defects.map(({what, count}) => [what, grouped(count)]),
      original.left_out > 0 && ['Not finite, left out', counted(original.left_out, 'face', 'faces')]])];
  }

  cameraPart() {
    const {view} = this;
    const button = (id, text, act) => el('button', {type: 'button', id, onclick: act}, text);
    return el('section', {}, el('h2', {}, 'Look'), el('div', {class: 'row'},
        button('home', 'All', () => view.viewport.home()),
        button('front', 'Front', () => view.viewport.look(0, 0)),
        button('right', 'Right', () => view.viewport.look(90, 0)),
        button('top', 'Top', () => view.viewport.look(0, 89.9)),
        el('button', {type: 'button', id: 'orthographic', 'aria-pressed': String(view.state.orthographic),
          onclick: () => view.look.toggleOrthographic()}, 'Orthographic')),
        el('div', {class: 'row'},
            button('png', 'Save PNG', () => view.look.savePicture()),
            button('theme', 'Dark or light', () => view.look.toggleTheme())));
  }

  notePart() {
    const {view} = this;
    const keys = [['arrows', 'turn'], ['shift + arrows', 'move'], ['+ −', 'zoom'], ['0', 'see all'], [', .', 'coarser, finer'],
      ['space', 'play'], ['e', 'edges'], ['h', 'distance as colour'], ['x y z', 'section'], ['[ ]', 'move the section'],
      ['f', 'farthest point'], ['n', 'next place outside'], ['c', 'pick in the middle'], ['m', 'second point in the middle'],
      ['q', 'ray through the middle'], ['Esc', 'end the points or the ray'], ['o', 'orthographic'], ['p', 'save PNG']];
    const step = view.scene.grid.step;
    return el('section', {},
        el('details', {}, el('summary', {}, 'Keys, mouse and touch'),
            el('p', {class: 'soft'}, 'Drag turns, the right button or two fingers move, the wheel or a pinch zooms. A click picks a face, and with shift a second point.'),
            el('dl', {class: 'keys'}, ...keys.flatMap(([key, what]) =>
              [el('dt', {}, el('kbd', {}, key)), el('dd', {}, what)]))),
        el('p', {class: 'soft', id: 'rounding'},
            `Verdicts and counts are exact, distances are proven bounds. What is drawn is rounded: to steps of ${withUnit(short(step, 2), this.unit)}, ` +
            'a billionth of the longest side. Between its points, colour is interpolated. ' +
            (this.unit ? '' : 'Lengths are in the unit of the mesh. ') + `Made by prohull ${view.scene.version}.`));
  }
}

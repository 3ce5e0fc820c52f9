// The page for teaching: the paper's figures, drawn of what the library answers. Nothing here decides anything about a mesh.

import * as prohull from 'prohull';
import {byId, counted, el, grouped, percent, short} from '../src/panel/dom.js';
import {BLUE, frameOf, GREEN, minus, ORANGE, Picture, plus, PURPLE, RED, vertexOf} from './picture.js';

/** One call after the other, so that one worker answers all. */
let last = Promise.resolve();
const ask = (work) => last = last.catch(() => {}).then(work);
const figure = (name, ...args) => ask(() => prohull.figure(name, args));
const level = (levels, faces) => ask(() => prohull.level(levels, faces));

const records = new Map();

/** The record of a sample's hull, which is made once. */
function recordOf(sample, sampleFaces, options) {
  const key = JSON.stringify([sample, sampleFaces, options]);
  if (!records.has(key)) records.set(key, ask(async () => {
    const mesh = await prohull.sample(sample, sampleFaces);
    return {mesh, levels: await prohull.figure('recordOfHull', [mesh, options])};
  }));
  return records.get(key);
}

const collapsesOf = ({splits}) => splits.length / 6;
const facesAfter = (levels, collapses) => levels.baseCorners.length / 3 - 2 * collapses;
const rock = (strategy) => recordOf('asteroid', 400, {targetFaces: 60, strategy});

/** The star of a vertex: its link, closed, and the vertex. */
function starAt(place, {vertices}) {
  const link = vertices.length / 3 - 2, faces = [];
  for (let k = 1; k <= link; ++k) faces.push(0, k, k % link + 1);
  return {vertices: [...place, ...vertices.slice(6)], faces};
}

/** A figure: what it holds by class, its picture, and what it tells. `draw` is called anew when a control has changed. */
class Figure {
  constructor(section, draw) {
    this.section = section;
    this.draw = draw;
    this.picture = new Picture(section);
    this.tell('The library computes it now.');
    for (const control of section.querySelectorAll('input, select')) control.addEventListener('input', () => this.refresh());
  }

  find(name) { return this.section.querySelector(`.${name}`); }
  value(name) { return Number(this.find(name).value); }
  tell(text) { this.find('told').textContent = text; }

  /** One drawing at a time: what was changed meanwhile is drawn after it. */
  async refresh() {
    if (this.section.dataset.busy === 'yes') return void (this.isStale = true);
    this.section.dataset.busy = 'yes';
    try {
      do {
        this.isStale = false;
        await this.draw(this);
        this.picture.viewport.changed();
      } while (this.isStale);
    } catch (error) {
      complain(error.message);
    }
    this.section.dataset.busy = 'no';
  }
}

function complain(text) {
  byId('problem').hidden = false;
  byId('problem').textContent = text;
}

/** Shows the surroundings of a collapse, from outside; a view that was turned by hand stays until the next collapse. */
function frameStar({picture}, i, {star, steepest}, below, room) {
  const {center, radius} = frameOf(star.vertices);
  picture.frame = {center, radius: room * radius};
  if (picture.shown !== i) picture.lookFrom(steepest, below);
  picture.shown = i;
}

/** The collapse that the slider names, with the new vertex at a place; null: where the collapse put it. */
async function studied(own, place) {
  const {levels} = await rock('paper1');
  own.find('collapse').max = collapsesOf(levels);
  const i = own.value('collapse') - 1;
  return {levels, i, study: await figure('collapseOf', levels, i, place)};
}

async function drawCollapse(own) {
  const {picture} = own, isMade = own.find('made').getAttribute('aria-pressed') === 'true';
  const {levels, i, study} = await studied(own, null), {star, made} = study;
  const mesh = await level(levels, facesAfter(levels, isMade ? i + 1 : i));
  frameStar(own, i, study, 20, 1.15);
  picture.clear();
  picture.mesh(mesh, {depth: 4});
  picture.mesh(isMade ? starAt(made, star) : star, {color: BLUE, depth: 1});
  const o = vertexOf(star.vertices, 0), d = vertexOf(star.vertices, 1), r = vertexOf(star.vertices, star.faces.at(-1));
  if (!isMade) picture.lines([o, d], RED, 5);
  const names = isMade ? [[made, 's', GREEN]] : [[o, 'o', RED], [d, 'd', RED]];
  for (const [point, name, color] of [...names, [vertexOf(star.vertices, 2), 'l', '#555555'], [r, 'r', '#555555']]) picture.mark(point, name, color);
  const valence = star.vertices.length / 3 - 2;
  own.tell(`Collapse ${i + 1} of ${grouped(collapsesOf(levels))}: ${grouped(facesAfter(levels, i))} faces become ${grouped(facesAfter(levels, i + 1))}. ` +
      `The star of the edge has ${valence + 2} faces, that of s has ${valence}.`);
}

async function drawProgram(own) {
  const {picture} = own, {i, study: best} = await studied(own, null);
  const {center, radius} = frameOf(best.star.vertices), ends = [0, 1].map((v) => vertexOf(best.star.vertices, v));
  const edge = minus(ends[1], ends[0]).map((x) => x / Math.hypot(...minus(ends[1], ends[0])));
  const place = plus(plus([...best.optimum], best.steepest, own.value('outwards') * radius), edge, own.value('along') * radius);
  const {study} = await studied(own, Float64Array.from(place)), {star, sides} = study;
  frameStar(own, i, study, 55, 0.8);
  own.place = place;
  const cut = (is) => ({vertices: star.vertices, faces: star.faces.filter((_, c) => (sides[Math.floor(c / 3)] < 0) === is)});
  const violated = sides.filter((side) => side < 0).length;
  picture.clear();
  picture.mesh(cut(false));
  picture.mesh(cut(true), {color: RED});
  picture.mesh(starAt(place, star), {color: BLUE, opacity: 0.2, order: 1, depth: 1, edges: false});
  for (let v = 2; v < star.vertices.length / 3; ++v) picture.lines([place, vertexOf(star.vertices, v)], BLUE, 3);
  picture.mark(place, violated ? '×' : 's', violated ? RED : GREEN);
  own.tell(violated === 0
    ? `s is outside of all ${sides.length} planes, or on them. It adds a volume of ${short(study.addedVolume)}; the least possible is ${short(study.optimalVolume)}.`
    : `s is inside of ${violated} of ${sides.length} planes: the hull would cut the mesh there. The collapse is refused.`);
}

const REFUSALS = {link_condition: 'the surface would be pinched', valence: 'too many faces around s', no_room_outside: 'no place is outside of all planes',
  compactness: 'a face would be too thin', normal_deviation: 'a face would turn too far', certificate: 'not certainly outside'};

async function drawQueue(own) {
  const {picture} = own, strategy = own.find('strategy').value, {levels} = await rock(strategy);
  own.find('collapse').max = collapsesOf(levels);
  const i = own.value('collapse'), {ends, priorities, refusals, renewed} = await figure('queueOf', levels, i, {strategy});
  const mesh = await level(levels, facesAfter(levels, i)), at = (v) => vertexOf(levels.positions, v);
  const linesOf = (wanted) => [...priorities.keys()].filter(wanted).flatMap((e) => [at(ends[2 * e]), at(ends[2 * e + 1])]);
  picture.frame = frameOf(levels.positions);
  const made = i > 0 ? at(levels.originalVertices + i - 1) : at(ends[0]);
  if (picture.shown !== `${i} ${strategy}`) picture.lookFrom(minus(made, picture.frame.center), 0);
  picture.shown = `${i} ${strategy}`;
  picture.clear();
  picture.mesh(mesh);
  picture.lines(linesOf((e) => renewed[e]), ORANGE, 3);
  picture.lines(linesOf((e) => e === 0 && refusals[e] === ''), GREEN, 6, true);
  if (i > 0) picture.mark(made, 's', BLUE);
  const count = renewed.reduce((sum, is) => sum + is, 0), waiting = refusals.filter((why) => why === '').length;
  own.tell(`${counted(priorities.length, 'edge', 'edges')}; ${i > 0 ? `the last collapse changed the stars of ${count} of them` : 'no collapse is made yet'}. ` +
      `${grouped(priorities.length - waiting)} may not be collapsed${whyNot(refusals)}.`);
  own.find('queue').replaceChildren(...[...priorities.slice(0, Math.min(6, waiting))].map((priority, e) =>
    el('li', {}, `${short(priority)}, edge ${ends[2 * e]}–${ends[2 * e + 1]}${renewed[e] ? ', evaluated anew' : ''}${e === 0 ? ': the next collapse' : ''}`)));
}

function whyNot(refusals) {
  const counts = {};
  for (const why of refusals) if (why) counts[why] = (counts[why] ?? 0) + 1;
  const told = Object.entries(counts).sort((a, b) => b[1] - a[1]).map(([why, count]) => `${count}: ${REFUSALS[why] ?? why}`);
  return told.length ? ` (${told.join('; ')})` : '';
}

const tellCrossings = (t) => t.length === 0 ? 'no crossing' : `${counted(t.length, 'crossing', 'crossings')}, at ${[...t].map((x) => short(x, 4)).join(', ')} of the way`;

/** The segment, and where it crosses the mesh. */
function markCrossings(picture, segment, {found, missed}) {
  const from = segment.slice(0, 3), to = segment.slice(3), at = (t) => plus(from, minus(to, from), t);
  picture.lines([from, to], PURPLE, 4, true);
  for (const t of found) picture.mark(at(t), '•', GREEN);
  for (const t of missed) picture.mark(at(t), '?', RED);
}

async function drawRefinement(own) {
  const {picture} = own, {mesh, levels} = await recordOf('pony', 8000, {targetFaces: 300, strategy: 'paper1'});
  picture.frame = frameOf(mesh.vertices);
  const {center, radius} = picture.frame, angle = own.value('direction') * Math.PI / 180;
  const middle = plus(center, [0, 0, own.value('height')], radius), way = [Math.sin(angle), -Math.cos(angle), 0];
  const segment = [...plus(middle, way, 1.1 * radius), ...plus(middle, way, -1.1 * radius)];
  const refined = await figure('refinedAlong', levels, Float64Array.from(segment));
  own.segment = segment;
  picture.clear();
  picture.mesh(refined, {color: BLUE});
  markCrossings(picture, segment, refined);
  const base = facesAfter(levels, collapsesOf(levels)), faces = refined.faces.length / 3;
  own.tell(`The coarse hull has ${grouped(base)} faces, the refined one ${grouped(faces)}: ${grouped((faces - base) / 2)} of ${grouped(collapsesOf(levels))} splits were made. ` +
      `Found: ${tellCrossings(refined.found)}.${refined.missed.length ? ` Missed, as in Figure 5: ${tellCrossings(refined.missed)}.` : ''}`);
}

// Passes below the hull of a gyroid, in a plane that lies across the fold.
const FOLDED = [1.8302, 0.4348, 0.7301, -2.5137, -0.8071, -0.9969];

const coarsest = (levels) => level(levels, facesAfter(levels, collapsesOf(levels)));

async function drawMissed(own) {
  const {picture} = own, walks = own.find('engine').value === 'walk', sample = ['gyroid', 6000];
  const {mesh, levels: outer} = await recordOf(...sample, {targetFaces: 500, strategy: 'paper1'});
  const {levels: inner} = await recordOf(...sample, {targetFaces: 500, side: 'inner', strategy: 'paper1'});
  const way = minus(FOLDED.slice(3), FOLDED.slice(0, 3)), flat = Math.hypot(way[0], way[1]), across = [-way[1] / flat, way[0] / flat, 0];
  const segment = [0, 3].flatMap((k) => plus(FOLDED.slice(k, k + 3), across, own.value('shift')));
  const numbers = Float64Array.from(segment), refined = walks ? await coarsest(outer) : await figure('refinedAlong', outer, numbers);
  const found = walks ? (await figure('walkHits', outer, inner, numbers)).t : refined.found, missed = refined.missed ?? [];
  own.segment = segment;
  picture.frame = frameOf(mesh.vertices);
  picture.clear();
  const bodies = [picture.mesh(mesh, {closed: true, edges: false}), picture.mesh(refined, {color: BLUE, opacity: 0.3, order: 1, depth: 1, closed: true, edges: false})];
  if (walks) bodies.push(picture.mesh(await coarsest(inner), {color: GREEN, order: 30, depth: 4, closed: true, edges: false}));
  showSection(picture, segment, bodies);
  markCrossings(picture, segment, {found, missed});
  own.tell(`Found: ${tellCrossings(found)}. ${missed.length ? `Missed: ${tellCrossings(missed)}.` : 'None is missed.'}`);
}

/** Cuts bodies by a plane through the segment, and looks at the plane. */
function showSection(picture, segment, bodies) {
  const from = picture.place(segment.slice(0, 3)), to = picture.place(segment.slice(3)), [x, y] = minus(to, from);
  const normal = [-y / Math.hypot(x, y), x / Math.hypot(x, y), 0];
  picture.viewport.setCut(normal, normal.reduce((sum, n, k) => sum + n * from[k], 0), bodies);
  if (!picture.shown) picture.lookFrom(normal, -12);
  picture.shown = true;
}

const FEWEST = 100;

async function drawStrategies(own) {
  const {picture} = own, options = (strategy) => ['pony', 20000, {targetFaces: FEWEST, strategy}];
  const [first, second] = [await recordOf(...options('paper1')), await recordOf(...options('paper2'))];
  const all = first.mesh.faces.length / 3, faces = 2 * Math.round(FEWEST * (all / FEWEST) ** own.value('faces') / 2);
  const hulls = [await level(first.levels, faces), await level(second.levels, faces)];
  const volumes = [];
  for (const mesh of [first.mesh, ...hulls]) volumes.push((await ask(() => prohull.inspect(mesh))).volume);
  picture.frame = frameOf(first.mesh.vertices);
  picture.clear();
  const bodies = [picture.mesh(first.mesh, {edges: false}), ...hulls.map((mesh) => picture.mesh(mesh, {color: BLUE}))];
  picture.viewport.panels = bodies;
  own.tell([first, second].map(({levels}, k) => `${['First', 'Second'][k]} strategy: ${grouped(hulls[k].faces.length / 3)} faces, ` +
      `void ${percent(volumes[k + 1] / volumes[0] - 1)}; ${short(levels.linearPrograms / collapsesOf(levels), 3)} linear programs for each collapse.`).join(' '));
}

/** A figure begins when it comes near. */
function open() {
  const dark = matchMedia('(prefers-color-scheme: dark)'), figures = globalThis.prohullFigures = [];
  const setTheme = () => {
    document.documentElement.dataset.theme = dark.matches ? 'dark' : 'light';
    for (const {picture} of figures) picture.setTheme();
  };
  setTheme();
  dark.addEventListener('change', setTheme);
  document.documentElement.dataset.ready = 'yes';
  if (typeof WebAssembly !== 'object') return complain('This browser has no WebAssembly, in which the figures are computed. The text and the code are here all the same.');
  const draws = {'figure-1': drawCollapse, 'figure-2': drawProgram, 'figure-3': drawQueue, 'figure-4': drawRefinement, 'figure-5': drawMissed, 'figure-6': drawStrategies};
  const watch = new IntersectionObserver((entries) => {
    for (const {target, isIntersecting} of entries) {
      if (!isIntersecting) continue;
      watch.unobserve(target);
      try {
        figures.push(new Figure(target, draws[target.id]));
        figures.at(-1).refresh();
      } catch (error) {
        complain(`${error.message}: the pictures need WebGL.`);
      }
    }
  }, {rootMargin: '200px'});
  for (const id of Object.keys(draws)) watch.observe(byId(id));
  const made = byId('figure-1').querySelector('.made');
  made.onclick = () => {
    made.setAttribute('aria-pressed', made.getAttribute('aria-pressed') !== 'true');
    figures.find(({section}) => section.id === 'figure-1')?.refresh();
  };
}

open();

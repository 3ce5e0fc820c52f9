// A robot on the page: its links become hulls, one after the other, and all of them a zip.

import {strToU8, zipSync} from 'fflate';
import * as prohull from 'prohull';
import {atMost, byId, counted, el, grouped, percent} from '../../src/panel/dom.js';
import {formText, robotOptions} from '../wanted.js';
import {packagesOf} from './folder.js';
import {planOf, scaled, whyLeft, withHulls} from './urdf.js';

const MOST_URDF = 2 ** 25;  // bytes
const SCOPE = 'Proven of each hull, as written: what its summary calls certified, of the mesh file that is named beside it, scaled as the URDF says. Poses are the URDF\'s, and joints are not looked at.';

const text8 = (bytes) => new TextDecoder('utf-8', {fatal: true, ignoreBOM: true}).decode(bytes);  // so that all bytes come back
const plainName = (path) => path.slice(path.lastIndexOf('/') + 1).replace(/[\\:*?"<>|\x00-\x1f]/g, '_');
const withoutViews = (key, value) => ArrayBuffer.isView(value) ? [...value] : value;

/** `page` has what main.js does: run, beside, setCurrent, draw, clear, save, refuseFaces. */
export class Robots {
  #page;
  #robot = null;  // {tree, packages, urdf, plan, outcomes, shown}: of the work whose hull is shown, what came of it

  constructor(page) {
    this.#page = page;
    byId('robot-file').onchange = ({target}) => page.run((running) => this.#take({...this.#robot, urdf: target.value}, running));
    byId('save-robot').onclick = () => this.#save();
  }

  get isOpen() {
    return this.#robot !== null;
  }

  close() {
    this.#robot = null;
    byId('robot').hidden = true;
  }

  async open(tree, running) {
    const urdfs = [...tree.keys()].filter((path) => /\.urdf$/i.test(path)).sort();
    if (urdfs.length === 0)
      throw new prohull.InputError('There is no .urdf file among these files. Drop meshes one at a time. SDF, MJCF and xacro files are read by the program prohull.');
    byId('robot-file').replaceChildren(...urdfs.map((path) => el('option', {value: path}, path)));
    byId('robot-file').hidden = urdfs.length === 1;
    const packages = await packagesOf(tree);
    running.signal.throwIfAborted();
    await this.#take({tree, packages, urdf: urdfs[0]}, running);
  }

  async #take({tree, packages, urdf}, running) {
    const robot = this.#robot = {tree, packages, urdf, plan: null, outcomes: new Map()};
    this.#page.clear('');
    byId('robot').hidden = byId('name').hidden = false;
    byId('name').textContent = urdf;
    byId('found').textContent = '';
    this.#tell();
    if (tree.get(urdf).size > MOST_URDF) throw new prohull.InputError(`${urdf}: it is too large for the file of a robot.`);
    const bytes = await tree.get(urdf).read();
    running.signal.throwIfAborted();
    try {
      robot.plan = planOf(text8(bytes), {robot: urdf, paths: new Set(tree.keys()), packages});
    } catch (error) {
      throw new prohull.InputError(`${urdf}: ${error instanceof TypeError ? 'it is no UTF-8 text' : error.message}`);
    }
    const {links, works} = robot.plan;
    byId('found').textContent = `${counted(links.length, 'link', 'links')}, ${counted(works.length, 'mesh', 'meshes')}.`;
    await this.make(running);
  }

  /** Makes all hulls anew. What is wrong with one mesh concerns its links alone. */
  async make(running) {
    const robot = this.#robot, form = formText(), want = robotOptions();
    if (!robot.plan) return;
    this.#page.setCurrent(null);
    robot.outcomes = new Map();
    this.#tell();
    const {works} = robot.plan;
    for (const [i, work] of works.entries()) {
      const progress = (stage, fraction) => running.progress(`mesh ${i + 1} of ${works.length}, of ${work.link}: ${stage}`, (i + fraction) / works.length);
      const outcome = await this.#hulled(work, want, {signal: running.signal, progress}).catch((error) => ({why: error.message}));
      running.signal.throwIfAborted();
      robot.outcomes.set(work, outcome);
      this.#tell();
    }
    const all = works.filter((work) => robot.outcomes.get(work).bytes), isShown = (work) => robot.outcomes.get(work) === robot.shown;
    if (all.length > 0 && !all.some(isShown)) await this.#show(all[0], running);
    this.#page.setCurrent(form);
  }

  async #meshOf({path, scale}, running) {
    const mesh = await prohull.read(await this.#robot.tree.get(path).read(), path, running);
    this.#page.refuseFaces(path, mesh.faces.length / 3);
    return scaled(mesh, scale);
  }

  /** {bytes} of a hull that the file as written certifies, or {why} there is none; and what is told of it. */
  async #hulled(work, {faces, share, options}, running) {
    const mesh = await this.#meshOf(work, running), bound = share ? {maxDistance: await prohull.length(share, mesh)} : {};
    const hull = await prohull.build(mesh, faces, {...options, ...bound, summaryOf: work.out, ...running});
    if (!hull.certified) return {why: 'no hull of it was certified', hull};
    const bytes = await prohull.write(hull, work.out);
    const verdict = await prohull.verify(await prohull.read(bytes, work.out, {signal: running.signal}), mesh, {finiteOnly: true, ...running});
    return verdict.holds ? {bytes, hull, verdict} : {why: `its hull as written is not certified: ${verdict.whyNot}`, hull, verdict};
  }

  async #show(work, running = {}) {
    const robot = this.#robot, outcome = robot.shown = robot.outcomes.get(work), {hull} = outcome;
    const mesh = await this.#meshOf(work, running);
    const scene = await prohull.scene({name: work.out, vertices: hull.vertices, faces: hull.faces}, {...mesh, name: work.path}, running);
    if (robot !== this.#robot || outcome !== robot.shown) return;  // meanwhile another one was pressed
    await this.#page.draw(scene, {});
    for (const button of byId('links').querySelectorAll('button')) button.setAttribute('aria-pressed', button.dataset.hull === work.out);
  }

  #row(link, work) {
    const {outcomes, shown} = this.#robot, outcome = outcomes.get(work), {hull, why} = outcome ?? {};
    if (!hull || why) return el('tr', {}, el('th', {scope: 'row'}, link.name), el('td', {colspan: 4}, why ?? '…'));
    const show = () => this.#page.beside(() => this.#show(work));
    const name = el('button', {'type': 'button', 'aria-pressed': String(outcome === shown), 'data-hull': work.out, 'title': work.path, 'onclick': show}, link.name);
    return el('tr', {}, el('th', {scope: 'row'}, name), el('td', {}, grouped(hull.faces.length / 3)),
        el('td', {}, Number.isFinite(hull.voidRatio) ? percent(hull.voidRatio) : '–'),
        el('td', {}, `${atMost(1000 * (hull.distanceToSolid ?? hull.distanceToTriangles))}${hull.withinBounds ? '' : ' (NOT within the bound)'}`), el('td', {}, 'yes'));
  }

  /** What `prohull urdf` notes of a hull, and what is proven of it where that is less than that it encloses the mesh. */
  #notes({link, out}, {hull, bytes} = {}) {
    if (!bytes) return [];
    const {distanceToTriangles: far, distanceToSolid: near = far, notes, summary} = hull;
    const openings = atMost(1000 * far) === atMost(1000 * near) ? []
        : [`its openings count as closed, and from its triangles alone it is at most ${atMost(1000 * far)} mm`];
    const proof = summary.find((line) => line.startsWith('certified: ')).replace('certified: yes, the file as written', 'proven: it');
    return [...openings, ...notes, ...(/encloses the original$/.test(proof) ? [] : [proof])].map((note) => el('li', {}, `${link}, ${out}: ${note}`));
  }

  #tell() {
    const {plan, outcomes} = this.#robot, isDone = plan !== null && plan.works.every((work) => outcomes.has(work));
    const left = (plan?.links ?? []).filter(({why}) => why);
    byId('links').replaceChildren(...(plan?.links ?? []).filter(({why}) => !why)
        .flatMap((link) => [...new Set(link.shapes.flatMap(({work}) => work ?? []))].map((work) => this.#row(link, work))));
    byId('link-notes').replaceChildren(...(plan?.works ?? []).flatMap((work) => this.#notes(work, outcomes.get(work))));
    byId('left-out').replaceChildren(...left.map(({name, why}) => el('li', {}, `${name} keeps what it has: ${why}`)));
    byId('save-robot').disabled = !isDone || withHulls(plan, outcomes).works.length === 0;
  }

  #report(name) {
    const {plan: {links}, outcomes, urdf} = this.#robot;
    const hullOf = ({uri, scale, work}) => {
      const {hull: {vertices, faces, ...facts} = {}, verdict = null, why} = outcomes.get(work);
      return {file: why ? null : `meshes/collision/${work.out}`, why_not: why ?? null, mesh: uri, read_from: work.path, scale,
        faces: faces ? faces.length / 3 : null, ...facts, verdict};
    };
    return JSON.stringify({robot: name, read_from: urdf, scope: SCOPE,
      left_out: links.filter((link) => whyLeft(link, outcomes)).map((link) => ({link: link.name, why: whyLeft(link, outcomes)})),
      links: links.map((link) => ({name: link.name, from: link.from, certified: whyLeft(link, outcomes) === null,
        hulls: link.shapes.filter(({work}) => work).map(hullOf)}))}, withoutViews, 2);
  }

  #save() {
    const {plan, outcomes, urdf} = this.#robot, name = plainName(urdf), made = withHulls(plan, outcomes);
    const files = {[name]: strToU8(made.text), 'report.json': strToU8(this.#report(name))};
    for (const work of made.works) files[`meshes/collision/${work.out}`] = outcomes.get(work).bytes;
    this.#page.save(zipSync(files, {mtime: new Date(1980, 0, 1, 12)}), name.replace(/\.urdf$/i, '_hulls.zip'));
  }
}

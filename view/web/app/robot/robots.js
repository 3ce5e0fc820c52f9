// A robot on the page: its links become hulls, one after the other, and all of them a zip.

import {strToU8, zipSync} from 'fflate';
import * as prohull from 'prohull';
import {atMost, byId, counted, el, grouped, percent} from '../../src/panel/dom.js';
import {Hulls} from '../hulls.js';
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
  #robot = null;  // {tree, packages, urdf, text, plan, hulls}
  kind = 'robot';  // of its options in the form

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
      throw new prohull.InputError('There is no .urdf file among these files, and no mesh that is read here. SDF, MJCF and xacro files are read by the program prohull.');
    byId('robot-file').replaceChildren(...urdfs.map((path) => el('option', {value: path}, path)));
    byId('robot-file').hidden = urdfs.length === 1;
    const packages = await packagesOf(tree);
    running.signal.throwIfAborted();
    await this.#take({tree, packages, urdf: urdfs[0]}, running);
  }

  async #take({tree, packages, urdf}, running) {
    const robot = this.#robot = {tree, packages, urdf, text: null, plan: null, hulls: new Hulls(this.#page, [], null)};
    this.#page.clear('');
    byId('robot').hidden = byId('name').hidden = false;
    byId('name').textContent = urdf;
    byId('found').textContent = '';
    this.#tell();
    if (tree.get(urdf).size > MOST_URDF) throw new prohull.InputError(`${urdf}: it is too large for the file of a robot.`);
    const bytes = await tree.get(urdf).read();
    running.signal.throwIfAborted();
    try {
      robot.text = text8(bytes);
    } catch {
      throw new prohull.InputError(`${urdf}: it is no UTF-8 text`);
    }
    await this.make(running);
  }

  #plan(robot, from) {
    const {tree, packages, urdf, text} = robot;
    try {
      robot.plan = planOf(text, {robot: urdf, paths: new Set(tree.keys()), packages}, from);
    } catch (error) {
      throw new prohull.InputError(`${urdf}: ${error.message}`);
    }
    const {links, works} = robot.plan, hulls = robot.hulls = new Hulls(this.#page, works.map((work) => Object.assign(work, {title: work.link})),
        {mesh: (work, running) => this.#meshOf(tree, work, running), isOpen: () => hulls === this.#robot?.hulls, tell: () => this.#tell(),
          verify: async (bytes, {out}, mesh, running) =>
            prohull.verify(await prohull.read(bytes, out, {signal: running.signal}), mesh, {finiteOnly: true, ...running})});
    byId('found').textContent = `${counted(links.length, 'link', 'links')}, ${counted(works.length, 'mesh', 'meshes')}.`;
  }

  /** Makes all hulls anew. */
  async make(running) {
    const robot = this.#robot, form = formText(), {from, faces, share, options} = robotOptions();
    if (robot.text === null) return;
    this.#page.setCurrent(null);
    this.#plan(robot, from);
    await robot.hulls.make(running, async (mesh) => ({faces, options: {...options, ...(share ? {maxDistance: await prohull.length(share, mesh)} : {})}}));
    this.#page.setCurrent(form);
  }

  async #meshOf(tree, {path, scale}, running) {
    const mesh = await prohull.read(await tree.get(path).read(), path, running);
    this.#page.refuseFaces(path, mesh.faces.length / 3);
    return scaled(mesh, scale);
  }

  #row(link, work) {
    return this.#robot.hulls.row(link.name, work, 4, (hull) => [grouped(hull.faces.length / 3),
      Number.isFinite(hull.voidRatio) ? percent(hull.voidRatio) : '–',
      `${atMost(1000 * (hull.distanceToSolid ?? hull.distanceToTriangles))}${hull.withinBounds ? '' : ' (NOT within the bound)'}`, 'yes']);
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
    const {plan, hulls: {outcomes, isDone}} = this.#robot;
    const left = (plan?.links ?? []).filter(({why}) => why);
    byId('links').replaceChildren(...(plan?.links ?? []).filter(({why}) => !why)
        .flatMap((link) => [...new Set(link.shapes.flatMap(({work}) => work ?? []))].map((work) => this.#row(link, work))));
    byId('link-notes').replaceChildren(...(plan?.works ?? []).flatMap((work) => this.#notes(work, outcomes.get(work))));
    byId('left-out').replaceChildren(...left.map(({name, why}) => el('li', {}, `${name} keeps what it has: ${why}`)));
    byId('save-robot').disabled = !plan || !isDone || withHulls(plan, outcomes).works.length === 0;
  }

  #report(name) {
    const {plan: {links}, hulls: {outcomes}, urdf} = this.#robot;
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
    const {plan, hulls: {outcomes}, urdf} = this.#robot, name = plainName(urdf), made = withHulls(plan, outcomes);
    const files = {[name]: strToU8(made.text), 'report.json': strToU8(this.#report(name))};
    for (const work of made.works) files[`meshes/collision/${work.out}`] = outcomes.get(work).bytes;
    this.#page.save(zipSync(files, {mtime: new Date(1980, 0, 1, 12)}), name.replace(/\.urdf$/i, '_hulls.zip'));
  }
}

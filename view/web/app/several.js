// Several meshes on the page: each becomes a hull, and all of them a zip, as `prohull build *.stl -o hulls/` makes them.

import {zipSync} from 'fflate';
import * as prohull from 'prohull';
import {byId, counted} from '../src/panel/dom.js';
import {Hulls} from './hulls.js';
import {formText, optionsFor, readingOptions, severalCommand, wanted} from './wanted.js';

export class Several {
  #page;
  #hulls = null;
  #want = null;
  kind = 'several';  // of its options in the form

  constructor(page) {
    this.#page = page;
    byId('save-several').onclick = () => this.#save();
  }

  get isOpen() {
    return this.#hulls !== null;
  }

  close() {
    this.#hulls = null;
    byId('several').hidden = true;
  }

  /** `paths` are those of the meshes among the files. */
  async open(tree, running, paths) {
    const works = paths.sort().map((path) => ({path, title: path.slice(path.lastIndexOf('/') + 1), make: 'hull', read: tree.get(path).read}));
    const hulls = this.#hulls = new Hulls(this.#page, works, {mesh: (work, own) => this.#meshOf(work, own), isOpen: () => hulls === this.#hulls, tell: () => this.#tell()});
    byId('several').hidden = byId('name').hidden = false;
    byId('name').textContent = counted(works.length, 'mesh', 'meshes');
    const others = tree.size - works.length;
    byId('found').textContent = others === 0 ? '' : `${counted(others, 'file', 'files')} of other kinds ${others === 1 ? 'is' : 'are'} left out.`;
    await this.make(running);
  }

  async make(running) {
    const hulls = this.#hulls, form = formText(), first = new Map();
    for (const work of hulls.works) {
      const want = this.#want = wanted({...work, name: work.title});
      work.out = `${want.stem}.${want.to}`;
      const other = first.get(work.out.toLowerCase());
      if (other) throw new prohull.InputError(`${other} and ${work.path}: the hulls of both would be called ${work.out}; rename one of them`);
      first.set(work.out.toLowerCase(), work.path);
    }
    this.#page.setCurrent(null);
    await hulls.make(running, async (mesh, work) => ({faces: Number(this.#want.faces), options: await optionsFor({...this.#want, out: work.out}, {mesh})}));
    this.#page.setCurrent(form);
  }

  async #meshOf({path, title, read}, running) {
    const mesh = await prohull.read(await read(), title, {...readingOptions(), ...running});
    this.#page.refuseFaces(path, mesh.faces.length / 3);
    return mesh;
  }

  #tell() {
    const {works, outcomes, isDone} = this.#hulls;
    byId('meshes').replaceChildren(...works.map((work) => this.#hulls.row(work.title, work, 5, (hull) => hull.tableRow)));
    byId('several-command').textContent = severalCommand(this.#want, works.map(({path}) => path));
    byId('save-several').disabled = !isDone || !works.some((work) => outcomes.get(work).bytes);
  }

  #save() {
    const {works, outcomes} = this.#hulls, certified = works.filter((work) => outcomes.get(work).bytes);
    this.#page.save(zipSync(Object.fromEntries(certified.map((work) => [work.out, outcomes.get(work).bytes])), {mtime: new Date(1980, 0, 1, 12)}), 'hulls.zip');
  }
}

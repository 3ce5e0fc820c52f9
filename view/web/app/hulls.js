// Hulls of several meshes, one after the other. What is wrong with one of them concerns that one alone.

import * as prohull from 'prohull';
import {el} from '../src/panel/dom.js';

export class Hulls {
  /** Of each work that is done {bytes, hull, verdict}, or {why} there is no hull. */
  outcomes = new Map();
  #shown = null;

  /** A work is {title, path, out}: how its mesh is called, and the file of its hull. `page` has what main.js does; `source` has `mesh(work, running)`,
   * `isOpen()`, `tell()`, which shows the table anew, and may have `verify`, which decides again of the file. */
  constructor(page, works, source) {
    Object.assign(this, {page, works, source});
  }

  get isDone() {
    return this.works.every((work) => this.outcomes.has(work));
  }

  /** Makes all of them anew; `wanted` gives {faces, options} of a mesh. */
  async make(running, wanted) {
    this.outcomes = new Map();
    this.source.tell();
    for (const [i, work] of this.works.entries()) {
      const progress = (stage, fraction) => running.progress(`mesh ${i + 1} of ${this.works.length}, of ${work.title}: ${stage}`, (i + fraction) / this.works.length);
      const outcome = await this.#hulled(work, wanted, {signal: running.signal, progress}).catch((error) => ({why: error.message}));
      running.signal.throwIfAborted();
      this.outcomes.set(work, outcome);
      this.source.tell();
    }
    const all = this.works.filter((work) => this.outcomes.get(work).bytes);
    if (all.length > 0 && !all.some((work) => this.outcomes.get(work) === this.#shown)) await this.#show(all[0], running);
  }

  /** The outcome has bytes if the file as written is certified. */
  async #hulled(work, wanted, running) {
    const mesh = await this.source.mesh(work, running), {faces, options} = await wanted(mesh, work);
    const hull = await prohull.build(mesh, faces, {...options, summaryOf: work.out, ...running});
    if (!hull.certified) return {why: 'no hull of it was certified', hull};
    const bytes = await prohull.write(hull, work.out), verdict = await this.source.verify?.(bytes, work, mesh, running);
    return verdict?.holds === false ? {why: `its hull as written is not certified: ${verdict.whyNot}`, hull, verdict} : {bytes, hull, verdict, side: options.side};
  }

  async #show(work, running = {}) {
    const outcome = this.#shown = this.outcomes.get(work), {hull: {vertices, faces}, side} = outcome;
    const mesh = await this.source.mesh(work, running);
    const scene = await prohull.scene({name: work.out, vertices, faces}, {...mesh, name: work.path}, {side, ...running});
    if (!this.source.isOpen() || outcome !== this.#shown) return;  // meanwhile another one was pressed
    await this.page.draw(scene, {});
    for (const button of document.querySelectorAll('[data-hull]')) button.setAttribute('aria-pressed', String(button.dataset.hull === work.out));
  }

  /** A row of a table: the name shows the hull, where there is one. `cells` gives what is told of it. */
  row(title, work, count, cells) {
    const outcome = this.outcomes.get(work);
    if (!outcome?.bytes) return el('tr', {}, el('th', {scope: 'row'}, title), el('td', {colspan: count}, outcome?.why ?? '…'));
    const show = () => this.page.beside(() => this.#show(work));
    const name = el('button', {'type': 'button', 'aria-pressed': String(outcome === this.#shown), 'data-hull': work.out, 'title': work.path, 'onclick': show}, title);
    return el('tr', {}, el('th', {scope: 'row'}, name), ...cells(outcome.hull).map((cell) => el('td', {}, cell)));
  }
}

// What is to be made, as the form of the page has it, as options of the library, and as a command line.

import * as prohull from 'prohull';
import {byId} from '../src/panel/dom.js';

const DEFAULTS = {make: 'hull', faces: '500', count: '16', distance: '', void: '', side: 'outer', gap: '', tight: '', to: 'stl'};
const field = (name) => byId(`want-${name}`);
const kept = (name) => field(name).type === 'checkbox' ? (field(name).checked ? '1' : '') : field(name).value.trim();

/** What the form holds, for the address: what is not as it is at first. */
export const formValues = () => Object.fromEntries(Object.keys(DEFAULTS)
    .map((name) => [name, kept(name)]).filter(([name, value]) => value !== DEFAULTS[name]));

/** Values that the form does not take are left. */
export function fillForm(values) {
  for (const name of Object.keys(DEFAULTS)) {
    if (values[name] === undefined) continue;
    if (field(name).type === 'checkbox') field(name).checked = values[name] === '1';
    else field(name).value = values[name];
    if (field(name).value === '' || !field(name).checkValidity()) field(name).value = DEFAULTS[name];
  }
  showOptions();
}

/** Only the options of what is to be made. */
export function showOptions() {
  for (const element of document.querySelectorAll('[data-for]'))
    element.hidden = !element.dataset.for.split(' ').includes(kept('make'));
}

const quoted = (text) => /^[\w.%+:,/-]+$/.test(text) && !text.startsWith('-') ? text : `'${text.replaceAll("'", "'\\''")}'`;

/** The name without its suffix. */
const stem = (name) => name.replace(/\.gz$/i, '').replace(/\.[^.]*$/, '') || 'part';

/** What the form asks for; lengths are as they were written, and become numbers in `optionsFor`. */
export function wanted(part) {
  const values = Object.fromEntries(Object.keys(DEFAULTS).map((name) => [name, kept(name)]));
  for (const name of ['faces', 'count', 'void']) {
    const {validationMessage, labels: [label]} = field(name);
    if (!label.hidden && validationMessage) throw new prohull.InputError(`${label.textContent.trim()}: ${validationMessage}`);
  }
  const suffix = values.make === 'spheres' ? 'json' : values.to;
  return {...values, isTight: values.tight === '1', out: `${stem(part.name)}_${values.make}.${suffix}`, stem: stem(part.name)};
}

async function lengthOf(text, part) {
  return text === '' ? undefined : prohull.length(text, part.mesh);
}

/** For the functions of the library; options that are not given are left out. */
export async function optionsFor(want, part) {
  const maxDistance = await lengthOf(want.distance, part);
  const gap = want.make === 'hull' ? await lengthOf(want.gap, part) : undefined;
  const maxVoidPercent = want.void === '' || want.make === 'spheres' ? undefined : Number(want.void);
  const float32Coordinates = ['stl', 'glb'].includes(want.to);
  const all = want.make === 'hull' ? {side: want.side, tight: want.isTight, gap, maxDistance, maxVoidPercent, float32Coordinates, summaryOf: want.out}
      : want.make === 'pieces' ? {pieces: Number(want.count), maxDistance, maxVoidPercent, float32Coordinates}
      : {count: Number(want.count), maxDistance};
  return Object.fromEntries(Object.entries(all).filter(([, value]) => value !== undefined));
}

const flags = (pairs) => pairs.filter(([, value]) => value !== '' && value !== false)
    .map(([flag, value]) => value === true ? flag : `${flag} ${quoted(value)}`).join(' ');

/** What does the same; `faces` are those of a finer level, or null. */
export function commandOf(want, part, faces) {
  const sample = part.sample ? `prohull sample ${part.sample} --faces ${part.sampleFaces} -o ${quoted(part.name)}\n` : '';
  const file = quoted(part.name), bounds = [['--max-distance', want.distance], ['--max-void', want.void]];
  if (want.make === 'spheres')
    return `${sample}prohull spheres ${file} -o ${quoted(want.out)} ${flags([['--count', want.count], bounds[0]])}`;
  if (want.make === 'pieces') return `${sample}prohull convex ${file} -o ${quoted(want.out)} ${flags([['--pieces', want.count], ...bounds])}`;
  const levels = quoted(`${want.stem}.phull`);
  const build = `${sample}prohull build ${file} -o ${quoted(want.out)} ` +
      flags([['--faces', want.faces], ...bounds, ['--side', want.side === 'inner' && 'inner'], ['--tight', want.isTight], ['--gap', want.gap]]);
  return faces === null ? build : `${build} --hierarchy ${levels}\nprohull lod ${levels} -o ${quoted(want.out)} --faces ${faces}`;
}

// What is to be made, as the form of the page has it, as options of the library, and as a command line.

import * as prohull from 'prohull';
import {byId, grouped} from '../src/panel/dom.js';

const DEFAULTS = {make: 'hull', faces: '500', count: '16', distance: '', void: '', side: 'outer', gap: '', shells: 'close', unit: '', tight: '0', cavities: '0',
  levels: '1', to: 'stl', from: 'visual'};
const field = (name) => byId(`want-${name}`);
const kept = (name) => field(name).type === 'checkbox' ? (field(name).checked ? '1' : '0') : field(name).value.trim();

/** What the form holds, for the address: what is not as it is at first. */
export const formValues = () => Object.fromEntries(Object.keys(DEFAULTS)
    .map((name) => [name, kept(name)]).filter(([name, value]) => value !== DEFAULTS[name]));

/** All that it holds, to be compared. */
export const formText = () => JSON.stringify(formValues());

/** Values that the form does not take are left. */
export function fillForm(values) {
  for (const name of Object.keys(DEFAULTS)) {
    if (values[name] === undefined) continue;
    if (field(name).type === 'checkbox') field(name).checked = values[name] === '1';
    else field(name).value = values[name];
    if (field(name).value === '' || !field(name).checkValidity()) field(name).value = DEFAULTS[name];
  }
  byId('more').open = Object.keys(DEFAULTS).some((name) => byId('more').contains(field(name)) && kept(name) !== DEFAULTS[name]);
  showOptions();
}

/** Other hulls have none, or are larger if they have. */
const canHaveLevels = () => ['side', 'tight', 'gap', 'distance', 'void'].every((name) => kept(name) === DEFAULTS[name]);

/** Only the options of what is to be made: the form says that of parts, but not of a robot and of the levels of a file. */
export function showOptions(of = kept('make')) {
  for (const element of document.querySelectorAll('[data-for]')) element.hidden = !element.dataset.for.split(' ').includes(of);
  if (!canHaveLevels()) field('levels').labels[0].hidden = true;
  field('distance').placeholder = of === 'robot' ? 'any; mm or 1%' : 'any; 0.5 or 1%';
}

const quoted = (text) => /^[\w.%+:,/-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
const plain = (name) => name.startsWith('-') ? `./${name}` : name;
const quotedFile = (name) => quoted(plain(name));

/** The name without its suffix. */
export const stem = (name) => name.replace(/\.gz$/i, '').replace(/\.[^.]*$/, '') || 'part';

/** What the command line takes, and how it says so. */
const RANGES = {faces: [4, 1e9], pieces: [1, 1000], spheres: [1, 100000], void: null};

/** Why a number is not taken; empty if it is. */
function whyNot({value, validity, required}, range) {
  if (value === '') return validity.badInput || required ? 'it must be a number' : '';
  const number = Number(value);
  if (!range) return number > 0 ? '' : `it must be greater than 0, not ${value}`;
  const [least, most] = range;
  if (number < least || number > most) {
    const limits = most < 1e6 ? `between ${least} and ${grouped(most)}` : number < least ? `at least ${least}` : `at most ${grouped(most)}`;
    return `it must be ${limits}, not ${value}`;
  }
  return Number.isInteger(number) ? '' : `it must be a whole number, not ${value}`;
}

/** Whether the command writes one file; of pieces in other formats it writes a file each. */
export const isOneFile = ({make, to}) => make !== 'pieces' || ['obj', 'glb'].includes(to);

/** As the command names the pieces in its file. */
export function pieceName({stem, count}, i) {
  const name = `${stem}_pieces`, digits = Math.max(2, String(Number(count)).length);
  return Number(count) === 1 ? name : `${name}_${String(i + 1).padStart(digits, '0')}`;
}

/** What the form asks for; lengths are as they were written, and become numbers in `optionsFor`. */
export function wanted(part) {
  const values = Object.fromEntries(Object.keys(DEFAULTS).map((name) => [name, kept(name)]));
  for (const name of ['faces', 'count', 'void']) check(name, RANGES[name === 'count' ? values.make : name]);
  const make = part.make ?? values.make, suffix = make === 'spheres' ? 'json' : values.to;
  const own = stem(part.name).replace(/[{}]/g, '_');  // the command fills in {name}
  return {...values, make, isTight: values.tight === '1', hasLevels: !field('levels').labels[0].hidden && values.levels === '1', out: `${own}_${make}.${suffix}`, stem: own};
}

/** How the file of a part is read. */
export const readingOptions = () => kept('unit') === '' ? {} : {unit: kept('unit')};

function check(name, range) {
  const why = field(name).labels[0].hidden ? '' : whyNot(field(name), range);
  if (why) refuse(name, why);
}

function refuse(name, why) {
  throw new prohull.InputError(`${field(name).labels[0].firstChild.textContent.trim()}: ${why}`);
}

async function lengthOf(name, text, part) {
  if (text === '') return undefined;
  const length = await prohull.length(text, part.mesh, {inMetres: part.mesh.inMetres});
  if (length === 0) refuse(name, `it must be greater than 0, not ${text}`);
  return length;
}

/** For the functions of the library; options that are not given are left out. */
export async function optionsFor(want, part) {
  const float32Coordinates = ['stl', 'glb'].includes(want.to), summaryOf = want.out;
  if (want.make === 'level') return {float32Coordinates, summaryOf};
  const maxDistance = await lengthOf('distance', want.distance, part);
  const gap = want.make === 'hull' ? await lengthOf('gap', want.gap, part) : undefined;
  const maxVoidPercent = want.void === '' || want.make === 'spheres' ? undefined : Number(want.void);
  const all = want.make === 'hull' ? {side: want.side, tight: want.isTight, levels: want.hasLevels, gap, maxDistance, maxVoidPercent,
    openShells: want.shells, keepCavities: want.cavities === '1', float32Coordinates}
      : want.make === 'pieces' ? {pieces: Number(want.count), maxDistance, maxVoidPercent, float32Coordinates}
      : {count: Number(want.count), maxDistance};
  return Object.fromEntries(Object.entries({...all, summaryOf}).filter(([, value]) => value !== undefined));
}

/** For each mesh of a robot, whose lengths are in metres: bare numbers are millimetres. */
export function robotOptions() {
  check('faces', RANGES.faces);
  const [, number, unit] = /^([\d.]+)\s*(%|mm)?$/.exec(kept('distance')) ?? [];
  if (kept('distance') !== '' && !(Number(number) > 0)) refuse('distance', `expected millimetres, or a share of the diagonal, as 1%, not ${kept('distance')}`);
  const isShare = unit === '%', bounds = number === undefined || isShare ? {} : {maxDistance: Number(number) / 1000};
  return {from: kept('from'), faces: Number(kept('faces')), share: isShare ? `${number}%` : null,
    options: {tight: kept('tight') === '1', float32Coordinates: true, relaxGuards: true, ...bounds}};
}

const flags = (pairs) => pairs.filter(([, value]) => value !== '' && value !== false)
    .map(([flag, value]) => value === true ? flag : `${flag} ${quoted(value)}`).join(' ');

const levelCommand = (levels, out, faces) => `prohull lod ${quotedFile(levels)} -o ${out}${faces === null ? '' : ` --faces ${faces}`}`;

const buildCommand = (want, files, out) => `prohull build ${files} -o ${out} ` +
    flags([['--unit', want.unit], ['--faces', want.faces], ['--max-distance', want.distance], ['--max-void', want.void], ['--side', want.side === 'inner' && 'inner'],
      ['--tight', want.isTight], ['--gap', want.gap], ['--open-shells', want.shells === 'keep' && 'keep'], ['--keep-cavities', want.cavities === '1'],
      ['--hierarchy', want.hasLevels && plain(`${want.stem}.phull`)]]);

/** What does the same; `faces` are those of a finer level, or null. */
export function commandOf(want, part, faces) {
  const sample = part.sample ? `prohull sample ${part.sample} --faces ${part.sampleFaces} -o ${quotedFile(part.name)}\n` : '';
  const file = quotedFile(part.name), out = quotedFile(want.out), bounds = [['--max-distance', want.distance], ['--max-void', want.void]], unit = ['--unit', want.unit];
  if (want.make === 'level') return levelCommand(part.name, out, faces);
  if (want.make === 'spheres')
    return `${sample}prohull spheres ${file} -o ${out} ${flags([unit, ['--count', want.count], bounds[0]])}`;
  const each = isOneFile(want) ? '' : `# writes a file for each piece\n`;
  if (want.make === 'pieces') return `${sample}${each}prohull convex ${file} -o ${out} ${flags([unit, ['--pieces', want.count], ...bounds])}`;
  const levels = `${want.stem}.phull`, build = sample + buildCommand(want, file, out);
  return faces === null ? build : `${build}\n${levelCommand(levels, out, faces)}`;
}

/** What makes a hull of each of these files. */
export const severalCommand = (want, files) => buildCommand(want, files.map(quotedFile).join(' '), `hulls/ --out-format ${want.to}`);

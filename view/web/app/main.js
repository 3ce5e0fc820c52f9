// The page: a part is dropped, and a hull of it is made, shown, told of and saved. What draws is that of `prohull view`.

import * as prohull from 'prohull';
import {readFragment, writeFragment} from '../src/act/address.js';
import {readObjects} from '../src/data/objects.js';
import {byId, counted, el, grouped, save, short} from '../src/panel/dom.js';
import {View} from '../src/view.js';
import {MOST_MEGABYTES, bytesOf, treeOfEntries, treeOfFiles, treeOfZip} from './robot/folder.js';
import {Robots} from './robot/robots.js';
import {Several} from './several.js';
import {READ} from './robot/urdf.js';
import {commandOf, fillForm, formText, formValues, isOneFile, optionsFor, pieceName, readingOptions, showOptions, stem, wanted} from './wanted.js';

const MOST_FACES = 7e6;         // of the 4 GB that WebAssembly has, the scene of a hull takes 540 bytes for each face
const SAMPLES = {bracket: 20000, pony: 100000, knot: 20000, asteroid: 20000, gyroid: 40000, torus: 5000};
const REST = 300;              // milliseconds after which a level is measured
const CAMERA = 'vtcadsp';       // of the address: what of a picture holds for any other part, too
const CERTIFIED = /\.(stl|obj|ply|off)(\.gz)?$/i;  // files that prohull_check reads

const WELCOME = byId('message').textContent;

let part = null;               // {name, bytes, mesh, reading, inspection}, and of a sample what it is called; of a .phull file also its levels, and `mesh` is the finest
let made = null;               // {want, hull}, and of the levels of a file the one of which is told
let current = null;            // formText() of what is shown, if that was made to the end
let view = null, job = null, aside = 0;
let batches = [];              // what makes several hulls: of the links of a robot, and of several meshes
let shown = {};                // of the address: what the picture shows

const openBatch = () => batches.find(({isOpen}) => isOpen);

const cameraOf = (values) => Object.fromEntries(Object.entries(values).filter(([key]) => CAMERA.includes(key)));

function remember() {
  writeFragment({...formValues(), ...(part?.sample ? {sample: part.sample} : {}), ...shown});
}

function complain(text) {
  byId('problem').hidden = !text;
  byId('problem').textContent = text;
  if (text) byId('problem').scrollIntoView({block: 'nearest'});
}

function setRunning(is) {
  byId('running').hidden = !is;
  document.documentElement.dataset.busy = is ? 'yes' : 'no';
}

function tellProgress(stage, fraction) {
  byId('progress').value = fraction;
  byId('stage-name').textContent = stage;
}

/** Where the form asks for something else than is shown, a button makes that. */
function tellAge() {
  const isOld = (part || openBatch()) && current !== formText();
  byId('old').hidden = !isOld || (job !== null && current === null);
  byId('age').textContent = current === null ? 'Nothing was made to the end.' : 'The result was made with other settings.';
  byId('make').hidden = job !== null;
}

function setCurrent(form) {
  current = form;
  tellAge();
}

/** A worker that still does work beside is left alone. */
function releaseIfIdle() {
  if (!job && aside === 0) prohull.release();
}

/** Does this while other work goes on. */
async function beside(work) {
  ++aside;
  try {
    await work();
  } catch (error) {
    complain(error.message.replaceAll('\n', ' '));
  }
  --aside;
  releaseIfIdle();
}

/** Does this and nothing else; what ran before ends. */
async function run(work) {
  job?.abort();
  const own = job = new AbortController();
  complain('');
  tellProgress('read', 0);
  setRunning(true);
  tellAge();
  try {
    await work({signal: own.signal, progress: tellProgress});
  } catch (error) {
    if (own === job) complain(error.name === 'AbortError' ? 'Cancelled.' : error.message.replaceAll('\n', ' '));
  }
  if (own !== job) return;
  job = null;
  releaseIfIdle();
  setRunning(false);
  tellAge();
  refreshed();  // a level that was chosen meanwhile is measured now
}

/** No picture; the canvas is a new one. */
function clear(message) {
  view?.end();
  view = null;
  byId('slider').replaceChildren();
  const canvas = byId('canvas'), isFocused = document.activeElement === canvas;
  canvas.replaceWith(canvas.cloneNode());
  if (isFocused) byId('canvas').focus();
  byId('message').hidden = !message;
  byId('message').textContent = message;
}

/** A picture of the scene in place of the one before. */
async function draw({facts, blocks}, fragment) {
  const scene = JSON.parse(facts);
  scene.alone = 'No hull of it is shown.';
  const space = await readObjects(scene, blocks);
  clear('');
  view = globalThis.prohullView = new View(scene, space, blocks, {read: () => fragment, write: (values) => {
    shown = values;
    remember();
  }});
}

function showPart() {
  const {name, inspection: {faces, components, defects, diagonal}} = part, found = Object.entries(defects);
  byId('name').hidden = false;
  byId('name').textContent = name;
  const wrong = found.length === 0 ? 'no defects' : found.map(([what, count]) => `${grouped(count)} ${what}`).join(', ');
  byId('found').textContent = `${counted(faces, 'face', 'faces')}, ${counted(components, 'component', 'components')}, ` +
      `${Number.isFinite(diagonal) ? `diagonal ${short(diagonal)}` : 'too large to be measured'}; ${wrong}.`;
}

function refuseFaces(name, faces) {
  if (faces > MOST_FACES)
    throw new prohull.InputError(`${name} has ${grouped(faces)} faces, and this page takes parts of at most ` +
        `${grouped(MOST_FACES)}. The program prohull takes larger ones.`);
}

const showForm = () => showOptions(openBatch()?.kind ?? part?.make);

/** An empty page. */
function forget() {
  for (const id of ['result', 'name']) byId(id).hidden = true;
  byId('found').textContent = byId('sample').value = '';
  part = made = current = null;
  clearTimeout(resting);
  for (const batch of batches) batch.close();
  showOptions();
  clear(WELCOME);
}

/** Shows a file, and makes what is wanted of it. `read` gives its name and its bytes, and what else a part has. */
const take = (read, fragment = cameraOf(shown)) => run(async (running) => {
  forget();
  await takePart(await read(running), fragment, running);
});

/** The mesh that the file of a part holds, in metres if the form knows its unit. */
async function readPart(next, running) {
  next.reading = readingOptions();
  next.mesh = await prohull.read(next.bytes, next.name, {...next.reading, ...running});
  next.inspection = await prohull.inspect(next.mesh, running);
  running.signal.throwIfAborted();
  refuseFaces(next.name, next.inspection.faces);
}

async function takePart(next, fragment, running) {
  if (/\.phull$/i.test(next.name)) return takeLevels(next, fragment, running);
  await readPart(next, running);
  part = next;
  byId('sample').value = part.sample ?? '';
  showPart();
  const alone = prohull.scene(null, {...part.mesh, name: part.name}, {signal: running.signal})
      .then((scene) => made || running.signal.aborted ? null : draw(scene, cameraOf(fragment)));
  for (const {reason} of await Promise.allSettled([make(running, fragment), alone])) if (reason) throw reason;
}

/** Shows the levels that a .phull file holds. */
async function takeLevels(next, fragment, running) {
  next.make = 'level';
  next.levels = await prohull.readLevels(next.bytes, next.name, running);
  next.mesh = await prohull.level(next.levels, Infinity, running);
  running.signal.throwIfAborted();
  refuseFaces(next.name, next.mesh.faces.length / 3);
  part = next;
  showForm();
  byId('name').hidden = false;
  byId('name').textContent = part.name;
  byId('found').textContent = `Levels of an ${part.levels.side} hull, up to ${counted(part.mesh.faces.length / 3, 'face', 'faces')}. ` +
      'The part that they were made of is not in the file: distances and the verdict are about the finest level.';
  await make(running, fragment);
}

/** Shows a folder or an archive: a robot, meshes, or the only mesh in it. */
const takeTree = (read) => run(async (running) => {
  forget();
  const tree = await read();
  running.signal.throwIfAborted();
  const paths = [...tree.keys()], meshes = paths.filter((path) => READ.test(path));
  const isRobot = meshes.length === 0 || paths.some((path) => /\.(urdf|xacro|sdf|xml)$/i.test(path));
  if (meshes.length === 1 && !isRobot)
    return takePart({name: meshes[0].slice(meshes[0].lastIndexOf('/') + 1), bytes: await tree.get(meshes[0]).read()}, cameraOf(shown), running);
  const batch = batches[isRobot ? 0 : 1];
  showOptions(batch.kind);
  await batch.open(tree, running, meshes);
});

async function sampleOf(name) {
  const faces = SAMPLES[name], file = `${name}.ply`;
  return {name: file, bytes: await prohull.write(await prohull.sample(name, faces), file), sample: name, sampleFaces: faces};
}

const makers = {
  hull: (want, options) => prohull.build(part.mesh, Number(want.faces), options),
  pieces: (want, options) => prohull.convexPieces(part.mesh, options),
  spheres: (want, options) => prohull.spheres(part.mesh, options),
  level: async (want, {signal, progress}) => ({levels: part.levels, ...await prohull.level(part.levels, 0, {signal, progress})}),
};

/** What the library's drawing of scenes takes of a result. */
function sceneOf(want, hull) {
  const name = want.make === 'level' ? part.name : want.out;
  if (want.make === 'pieces') return {name, pieces: hull.pieces};
  if (want.make === 'spheres') return {name, balls: hull.balls};
  return hull.levels ? {name, levels: hull.levels} : {name, vertices: hull.vertices, faces: hull.faces};
}

async function make({signal, progress}, fragment) {
  const form = formText(), want = wanted(part), own = part;
  if (want.make !== 'level' && want.unit !== (own.reading.unit ?? '')) {
    await readPart(own, {signal, progress});
    showPart();
  }
  const hull = await makers[want.make](want, {...await optionsFor(want, part), signal, progress});
  const original = want.make === 'level' ? null : {...part.mesh, name: part.name};
  const scene = await prohull.scene(sceneOf(want, hull), original, {side: want.side, signal, progress});
  signal.throwIfAborted();
  made = {want, hull};
  await draw(scene, fragment);
  view.onRefresh = refreshed;
  showResult();
  remember();
  setCurrent(form);
  if (want.make === 'level') await judge(null);
}

/** Makes what the form asks for now. */
const makeAgain = () => run((running) => openBatch()?.make(running) ?? make(running, cameraOf(shown)));

const tell = (lines) => byId('summary').replaceChildren(...lines.map((line) => el('li', {}, line)));

function showResult() {
  const {want, hull} = made;
  byId('result').hidden = false;
  byId('slider').replaceChildren(...[byId('level')?.closest('section')].filter(Boolean));  // the levels stand above the rest
  const missed = want.make === 'hull' || hull.withinBounds !== false ? [] : ['NOT within the bounds asked for; allow a larger number, or larger bounds'];
  if (want.make !== 'level') tell([...hull.summary, ...missed]);
  byId('save-levels').hidden = !(want.hasLevels && hull.levels && hull.certified);
  byId('save-certificate').hidden = !(want.make === 'hull' && hull.certified && CERTIFIED.test(part.name) && want.to !== 'glb');
  byId('save').disabled = !hull.certified && want.make !== 'level';  // which the command writes, and says so
  refreshed();
}

/** The level that the slider shows, if that is finer than the hull. */
function finerFaces() {
  const {levels} = made.hull, faces = levels && view?.active.levels?.shownFaces;
  return faces && faces !== made.hull.faces.length / 3 ? faces : null;
}

let resting;

/** After the slider was moved: the command, what is saved, and, once it rests, how far that level is. */
function refreshed() {
  if (!made) return;
  const faces = finerFaces();
  byId('command').textContent = commandOf(made.want, part, faces);
  byId('save').textContent = `Save ${made.want.out}${faces ? `, ${grouped(faces)} faces` : ''}`;
  byId('save-certificate').disabled = faces !== null;
  const isNew = made.want.make === 'level' && made.judged !== faces;
  if (isNew) tell(['…']);
  clearTimeout(resting);
  if (!job && (isNew || faces !== null))
    resting = setTimeout(() => beside(() => Promise.all([isNew && judge(faces), faces !== null && measure(faces)])), REST);
}

/** Tells of a level of a file what the command tells of it. Not every level has coordinates that STL and GLB files can hold. */
async function judge(faces) {
  const own = made;
  own.judged = faces;
  complain('');
  tell([]);
  const {summary} = await prohull.level(own.hull.levels, faces ?? 0, await optionsFor(own.want, part));
  if (made === own && own.judged === faces) tell(summary);
}

/** Bounds the distance of a level, which then counts among those of the panel. */
async function measure(faces) {
  const {active} = view, {levels} = made.hull;
  if (active.stops.some((stop) => stop.faces === faces)) return;
  const {lower, upper, farthest} = await prohull.level(levels, faces).then((level) => prohull.distance(level, part.mesh, {relativeGap: 0.02, finiteOnly: true}));
  if (active !== view.active) return;
  active.stops.push({faces, lower, upper, farthest: [...farthest]});
  active.stops.sort((a, b) => a.faces - b.faces);
  view.refresh();
}

function merged(pieces) {
  const vertices = pieces.flatMap((piece) => [...piece.vertices]), faces = [];
  let before = 0;
  for (const piece of pieces) {
    for (const v of piece.faces) faces.push(v + before);
    before += piece.vertices.length / 3;
  }
  return {vertices, faces};
}

/** What is saved: the bytes that the command writes, where that writes one file. */
async function contentOf({want, hull}, faces) {
  if (want.make === 'spheres') return prohull.spheresJson(hull.balls, stem(part.name));
  const float32Coordinates = ['stl', 'glb'].includes(want.to);
  if (faces || want.make === 'level') return prohull.write(await prohull.level(hull.levels, faces ?? 0, {float32Coordinates}), want.out);
  if (want.make === 'hull') return prohull.write(hull, want.out);
  if (!isOneFile(want)) return prohull.write(merged(hull.pieces), want.out);
  return prohull.writeSeveral(hull.pieces.map((piece, i) => ({...piece, name: pieceName(want, i)})), want.out);
}

const saveHull = async () => {
  const {out} = made.want;
  save(await contentOf(made, finerFaces()), out);
};

const saveLevels = async () => {
  const {want, hull} = made;
  save(await prohull.writeLevels(hull.levels), `${want.stem}.phull`);
};

const saveCertificate = async () => {
  const {want, hull} = made, {bytes, name} = part, {gap = 0, maxDistance} = await optionsFor(want, part);
  save(await prohull.certificate({vertices: hull.vertices, faces: hull.faces}, bytes, name, {
    ...part.reading, side: want.side, isStl: /\.stl(\.gz)?$/i.test(name), gap, provenGap: hull.gap, distance: hull.distanceToTriangles,
    ...(maxDistance === undefined ? {} : {maxDistance})}), `${want.stem}_hull.phcert`);
};

async function copyCommand({target}) {
  const command = byId(target.dataset.copies);
  try {
    await navigator.clipboard.writeText(command.textContent);
    target.textContent = 'Copied';
  } catch {
    getSelection().selectAllChildren(command);
  }
}

function listen() {
  const takeFiles = (files) => {
    const [file] = files;
    if (files.length > 1 || /\.urdf$/i.test(file?.name)) takeTree(() => treeOfFiles(files));
    else if (/\.zip$/i.test(file?.name)) takeTree(async () => treeOfZip(file.name, await bytesOf(file)));
    else if (file) take(async () => ({name: file.name, bytes: await bytesOf(file)}));
  };
  for (const [button, input] of [['open', 'file'], ['open-folder', 'folder']]) {
    byId(button).onclick = () => byId(input).click();
    byId(input).onchange = (event) => {
      const files = [...event.target.files];
      event.target.value = '';
      if (input === 'folder') takeTree(() => treeOfFiles(files));
      else takeFiles(files);
    };
  }
  byId('sample').onchange = (event) => {
    const name = event.target.value;  // the box is emptied before the sample is made
    if (name) take(() => sampleOf(name));
  };
  byId('part').onsubmit = (event) => event.preventDefault();
  byId('options').addEventListener('change', () => {
    showForm();
    remember();
    if (part || openBatch()) makeAgain();
  });
  byId('make').onclick = makeAgain;
  byId('cancel').onclick = () => job?.abort();
  for (const [id, saving] of [['save', saveHull], ['save-levels', saveLevels], ['save-certificate', saveCertificate]])
    byId(id).onclick = () => beside(saving);
  for (const button of document.querySelectorAll('[data-copies]')) button.onclick = copyCommand;
  const over = (is) => (event) => {
    event.preventDefault();
    byId('stage').classList.toggle('over', is);
  };
  addEventListener('dragover', over(true));
  addEventListener('dragleave', over(false));
  addEventListener('drop', (event) => {
    over(false)(event);
    const {files, items} = event.dataTransfer, entries = [...items].map((item) => item.webkitGetAsEntry()).filter(Boolean);
    if (entries.some((entry) => entry.isDirectory)) takeTree(() => treeOfEntries(entries));
    else takeFiles([...files]);
  });
}

/** After the first visit, the page opens without a network. A page that is a file needs no network anyway. */
function keepOffline() {
  if (location.protocol.startsWith('http')) navigator.serviceWorker?.register('app_offline.js').catch(() => {});
}

function open() {
  const dark = matchMedia('(prefers-color-scheme: dark)'), fragment = readFragment();
  document.documentElement.dataset.theme = fragment.t ?? (dark.matches ? 'dark' : 'light');
  byId('most').textContent = `${MOST_MEGABYTES} MB and ${grouped(MOST_FACES)} faces`;
  byId('sample').append(...Object.keys(SAMPLES).map((name) => el('option', {value: name}, name)));
  fillForm(fragment);
  const page = {run, beside, setCurrent, draw, clear, save, refuseFaces};
  batches = [new Robots(page), new Several(page)];
  document.documentElement.dataset.ready = 'yes';
  if (typeof WebAssembly !== 'object') return complain('This browser has no WebAssembly, which this page needs to build hulls. Use another browser, or the program prohull.');
  listen();
  keepOffline();
  if (!Object.hasOwn(SAMPLES, fragment.sample ?? '')) return;
  take(() => sampleOf(fragment.sample), fragment);
}

open();

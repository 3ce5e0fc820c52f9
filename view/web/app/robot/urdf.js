// A URDF in, a list of work out; hulls in, a new URDF out. Nothing here needs a browser.

import {placeOf} from './places.js';
import {UrdfError, childrenCalled, edited, parseXml} from './xml.js';

export const READ = /\.(stl|obj|ply|off|glb|dae)(\.gz)?$/i;
const PRIMITIVES = ['box', 'sphere', 'cylinder', 'capsule'];
const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const LONGEST = 100;  // characters of a name, as of the command

/** Three numbers, or one for all axes; null of anything else. */
export function scaleOf(text = '1 1 1') {
  const words = text.trim().split(/\s+/), numbers = (words.length === 1 ? [words[0], words[0], words[0]] : words).map(Number);
  const isFine = words.every((word) => NUMBER.test(word)) && numbers.length === 3 && numbers.every((x) => x !== 0 && Math.abs(x) <= 1e100);
  return isFine ? numbers : null;
}

/** The triangles that a link has of a mesh file. A mirror image is turned, so that its faces look outwards again. */
export function scaled({vertices, faces}, scale) {
  const turned = faces.slice();
  if (scale[0] * scale[1] * scale[2] < 0)
    for (let i = 0; i < turned.length; i += 3) [turned[i + 1], turned[i + 2]] = [turned[i + 2], turned[i + 1]];
  return {vertices: vertices.map((x, i) => x * scale[i % 3]), faces: turned};
}

/** A function that makes names of files of any names: letters, digits and _-. alone, and each of them once. */
export function fileNames(taken) {
  const known = new Set(taken.map((name) => name.toLowerCase()));
  return (wanted, suffix) => {
    const plain = wanted.replace(/[^\w.-]/g, '_').replace(/^\./, '_.').slice(0, LONGEST) || '_';
    let name = plain + suffix;
    for (let i = 2; known.has(name.toLowerCase()); ++i) name = `${plain}_${i}${suffix}`;
    known.add(name.toLowerCase());
    return name;
  };
}

/** A visual or collision element: {element, geometry, mesh, uri, scale}, without the last three of a primitive; or {why} it is not read. */
function shapeOf(element) {
  const geometry = childrenCalled(element, 'geometry')[0], form = geometry?.children[0];
  if (!form) return {why: `a <${element.name}> has no geometry`};
  if (PRIMITIVES.includes(form.name)) return {element, geometry};
  if (form.name !== 'mesh') return {why: `geometry of type ${form.name} is not read`};
  const uri = form.attributes.get('filename'), scale = scaleOf(form.attributes.get('scale'));
  if (!uri) return {why: 'a <mesh> names no file'};
  return scale ? {element, geometry, mesh: form, uri, scale} : {why: `the scale of ${uri} is not three numbers other than 0`};
}

function linkOf(element, from) {
  const link = {name: element.attributes.get('name'), element, from, shapes: [], why: null};
  if (childrenCalled(element, 'visual').length === 0) link.from = 'collision';
  link.shapes = childrenCalled(element, link.from).map(shapeOf);
  link.why = link.shapes.find(({why}) => why)?.why ?? (link.shapes.some(({uri}) => uri) ? null : `its ${link.from} geometry has no mesh`);
  return link;
}

function linksOf(text, from) {
  const root = parseXml(text), names = new Set(), all = [root];
  for (let element; (element = all.pop());) {
    if (element.name.startsWith('xacro:')) throw new UrdfError(text, element.begin, 'xacro is not read here; the program prohull expands it');
    all.push(...element.children);
  }
  if (root.name !== 'robot') throw new UrdfError(text, root.begin, `<${root.name}> is no URDF; the program prohull also reads SDF and MJCF`);
  const links = childrenCalled(root, 'link').map((link) => linkOf(link, from));
  for (const {name, element} of links) {
    if (!name) throw new UrdfError(text, element.begin, 'a link has no name');
    if (names.has(name)) throw new UrdfError(text, element.begin, `there are two links called ${name}`);
    names.add(name);
  }
  if (links.length === 0) throw new UrdfError(text, root.begin, 'the robot has no links');
  return links;
}

function fileOf(uri, tree) {
  return READ.test(uri) ? placeOf(uri, tree) : {why: 'files of this format are not read here'};
}

/** {text, links, works}: a work is a hull, and the shapes of links name theirs. Links with the same mesh and scale share it. A link that
 * cannot have all of its hulls has none, and says why. `tree` is {robot, paths, packages}, as placeOf takes it; `from` is the geometry that
 * hulls are made of: visual, or collision where a link has nothing else, or collision. */
export function planOf(text, tree, from = 'visual') {
  const links = linksOf(text, from), works = new Map();
  const beside = tree.robot.slice(0, tree.robot.lastIndexOf('/') + 1) + 'meshes/collision/';
  const name = fileNames([...tree.paths].filter((path) => path.startsWith(beside)).map((path) => path.slice(beside.length)));
  for (const link of links.filter(({why}) => !why)) {
    const meshes = link.shapes.filter(({uri}) => uri), files = meshes.map(({uri}) => fileOf(uri, tree));
    const missing = files.findIndex(({why}) => why);
    if (missing >= 0) link.why = `${meshes[missing].uri}: ${files[missing].why}`;
    else meshes.forEach((shape, i) => {
      const key = JSON.stringify([files[i].path, shape.scale]);
      if (!works.has(key)) works.set(key, {link: link.name, path: files[i].path, scale: shape.scale, out: name(link.name, '_hull.stl')});
      shape.work = works.get(key);
    });
  }
  return {text, links, works: [...works.values()]};
}

/** The end of line and the blanks before an element, if it begins its line. */
function breakBefore(text, {begin}) {
  const end = text.lastIndexOf('\n', begin - 1), blanks = text.slice(end + 1, begin);
  if (end < 0 || end >= begin || /[^ \t]/.test(blanks)) return '';
  return (text[end - 1] === '\r' ? '\r\n' : '\n') + blanks;
}

function newElement(text, shape, neighbour, tag) {
  const outer = breakBefore(text, neighbour), inner = outer && `${outer}  `, origin = childrenCalled(shape.element, 'origin')[0];
  const geometry = shape.work ? `<geometry>${inner && `${inner}  `}${meshElement(shape)}${inner}</geometry>` : text.slice(shape.geometry.begin, shape.geometry.end);
  return `${tag}${origin ? inner + text.slice(origin.begin, origin.end) : ''}${inner}${geometry}${outer}</collision>`;
}

const meshElement = ({work}) => `<mesh filename="meshes/collision/${work.out}"/>`;

/** Hulls of visual meshes take the place of all collision elements; hulls of collision meshes that of the mesh alone. */
function editsOf(text, {element, from, shapes}) {
  if (from === 'collision') return shapes.filter(({work}) => work).map((shape) => [shape.mesh.begin, shape.mesh.end, meshElement(shape)]);
  const old = childrenCalled(element, 'collision'), [first, ...others] = old, neighbour = first ?? shapes[shapes.length - 1].element;
  const tag = first && first.inner < first.end ? text.slice(first.begin, first.inner) : '<collision>';  // with its name
  const made = shapes.map((shape, i) => newElement(text, shape, neighbour, i === 0 ? tag : '<collision>'));
  const before = breakBefore(text, neighbour), content = made.join(before);
  const removed = others.map((other) => [other.begin - breakBefore(text, other).length, other.end, '']);
  return [first ? [first.begin, first.end, content] : [neighbour.end, neighbour.end, before + content], ...removed];
}

/** Why a link keeps its collision geometry, or null. `outcomes` has {why} or {bytes} of each work. */
export const whyLeft = (link, outcomes) =>
  link.why ?? link.shapes.filter(({work}) => work).map(({work}) => outcomes.get(work) ?? {why: 'it was not made'}).find(({why}) => why)?.why ?? null;

/** The new URDF, and the works whose hulls it names. Poses and all else are those of the old one. */
export function withHulls({text, links}, outcomes) {
  const hulled = links.filter((link) => whyLeft(link, outcomes) === null);
  return {text: edited(text, hulled.flatMap((link) => editsOf(text, link))),
    works: [...new Set(hulled.flatMap(({shapes}) => shapes.flatMap(({work}) => work ?? [])))]};
}

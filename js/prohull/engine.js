// The library on the thread that calls it: what index.js has workers do. For programs that have a worker of their own.
import makeModule from './module.js';

/** What is wrong with a mesh, a file or an option; the message says what, where, and what to do. */
export class InputError extends Error {
  name = 'InputError';
}

/** An error of the class that `name` tells. */
export function errorOf(name, message) {
  if (name === 'InputError') return new InputError(message);
  if (name === 'AbortError') return new DOMException(message, 'AbortError');
  return name === 'RangeError' ? new RangeError(message) : new Error(message);
}

const NOT_NUMBERS = [DataView, BigInt64Array, BigUint64Array];

function numbers(values, name) {
  if (Array.isArray(values)) {
    if (!values.every((value) => typeof value === 'number')) throw new InputError(`${name}: expected numbers only`);
    return Float64Array.from(values);
  }
  if (ArrayBuffer.isView(values) && !NOT_NUMBERS.some((kind) => values instanceof kind)) return values;
  throw new InputError(`${name}: expected an array of numbers, three for each, one after the other`);
}

function meshOf(mesh, name) {
  if (typeof mesh !== 'object' || mesh === null) throw new InputError(`${name}: expected an object with vertices and faces`);
  return {vertices: numbers(mesh.vertices, `${name}.vertices`), faces: numbers(mesh.faces, `${name}.faces`)};
}

function textOf(text, name) {
  if (typeof text !== 'string') throw new InputError(`${name}: expected a text`);
  return text;
}

/** A copy of options, which are an object. */
export function optionsOf(options) {
  if (typeof options !== 'object' || options === null || Array.isArray(options)) throw new InputError('options: expected an object');
  const given = {...options};
  if (given.tolerances !== undefined) given.tolerances = numbers(given.tolerances, 'tolerances');
  return given;
}

function refuseOptions(options) {
  for (const name of Object.keys(optionsOf(options))) throw new InputError(`${name}: there is no such option, only signal and progress`);
}

function levelsOf(levels) {
  if (levels === undefined || levels === null) throw new InputError('levels: there are none; build with levels: true');
  const numbersOf = (name) => numbers(levels[name], `levels.${name}`);
  return {...levels, positions: numbersOf('positions'), baseCorners: numbersOf('baseCorners'), splits: numbersOf('splits')};
}

/** Of {name} and one of `levels`, `pieces`, `balls`, or vertices and faces. */
function shownOf(hull) {
  if (typeof hull !== 'object') throw new InputError('hull: expected an object with a name, or null');
  const name = textOf(hull.name, 'hull.name'), {levels, pieces, balls} = hull;
  if (levels !== undefined) return {name, levels: levelsOf(levels)};
  if (pieces !== undefined) return {name, pieces: meshesOf(pieces, 'hull.pieces')};
  return balls === undefined ? {name, ...meshOf(hull, 'hull')} : {name, balls: numbers(balls, 'hull.balls')};
}

const originalOf = (mesh) => ({...meshOf(mesh, 'original'), name: textOf(mesh.name, 'original.name')});

function meshesOf(meshes, name) {
  if (!Array.isArray(meshes)) throw new InputError(`${name}: expected an array of meshes`);
  return meshes.map((mesh, i) => meshOf(mesh, `${name}[${i}]`));
}

function bytesOf(bytes) {
  if (bytes instanceof ArrayBuffer) return new Uint8Array(bytes);
  if (!ArrayBuffer.isView(bytes)) throw new InputError('bytes: expected an ArrayBuffer or a Uint8Array');
  return new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength);
}

const CHECKED = /\.(stl|obj|ply|off)(\.gz)?$/i;  // files that prohull_check reads
const kMostOutput = (compressed) => 2 ** 26 + 200 * compressed;  // as the library has it

/** The content of a file, gzipped or not. */
async function contentOf(file, name) {
  const bytes = bytesOf(file);
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return bytes;
  const parts = [];
  let size = 0;
  try {
    for await (const part of new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))) {
      size += part.length;
      if (size > kMostOutput(bytes.length)) throw new Error('too much comes out of it; decompress it first if it is right');
      parts.push(part);
    }
  } catch (error) {
    throw new InputError(`${name}: cannot decompress: ${error.message}`);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

/** Loads the library: `wasm` is a WebAssembly.Module of module.wasm. */
export async function loadEngine(wasm) {
  const module = await new Promise((resolve, reject) => makeModule({
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(wasm, imports).then(done).catch(reject);  // of which makeModule would never hear
      return {};
    },
  }).then(resolve, reject));
  const call = (name, ...args) => {
    const result = module[name](...args);
    if (result.error !== undefined) throw errorOf(result.name, result.error);
    return result;
  };
  return {
    build(mesh, targetFaces = 2000, options = {}, progress) {
      const several = typeof targetFaces === 'object' && targetFaces !== null;
      const targets = numbers(several ? targetFaces : [targetFaces], 'targetFaces');
      const hulls = call('build', meshOf(mesh, 'mesh'), targets, optionsOf(options), progress);
      return several ? hulls : hulls[0];
    },
    level: (levels, faces = 0, options = {}, progress) => call('level', levelsOf(levels), Number(faces), optionsOf(options), progress),
    verify: (hull, original, options = {}, progress) =>
      call('verify', meshOf(hull, 'hull'), meshOf(original, 'original'), optionsOf(options), progress),
    distance: (from, to, options = {}, progress) =>
      call('distance', meshOf(from, 'from'), meshOf(to, 'to'), optionsOf(options), progress),
    convexPieces: (mesh, options = {}, progress) => call('convexPieces', meshOf(mesh, 'mesh'), optionsOf(options), progress),
    spheres: (mesh, options = {}, progress) => call('spheres', meshOf(mesh, 'mesh'), optionsOf(options), progress),
    repair: (mesh, options = {}, progress) => call('repair', meshOf(mesh, 'mesh'), optionsOf(options), progress),
    inspect(mesh, options = {}) {
      refuseOptions(options);
      return call('inspect', meshOf(mesh, 'mesh'));
    },
    read: async (bytes, name, options = {}) => call('read', await contentOf(bytes, textOf(name, 'name')), name, optionsOf(options)),
    readLevels(bytes, name, options = {}) {
      refuseOptions(options);
      return call('readLevels', bytesOf(bytes), textOf(name, 'name'));
    },
    sample: (name, faces = 20000) => call('sample', textOf(name, 'name'), Number(faces)),
    length: (text, mesh, options = {}) => call('length', String(text), meshOf(mesh, 'mesh'), optionsOf(options)).length,
    async certificate(hull, original, name, options = {}) {
      if (!CHECKED.test(textOf(name, 'name')))
        throw new InputError(`${name}: prohull_check reads .stl, .obj, .ply and .off files only; make the hull of one of these`);
      const content = await contentOf(original, name);
      return call('certificate', meshOf(hull, 'hull'), content, name, optionsOf(options)).bytes;
    },
    scene(hull, original, options = {}, progress) {
      const shown = hull === undefined || hull === null ? null : shownOf(hull);
      return call('scene', shown, shown && original === null ? null : originalOf(original), optionsOf(options), progress);
    },
    writeLevels: (levels) => call('writeLevels', levelsOf(levels)).bytes,
    write: (mesh, name) => call('write', meshOf(mesh, 'mesh'), textOf(name, 'name')).bytes,
    writeSeveral(meshes, name) {
      const all = meshesOf(meshes, 'meshes'), names = meshes.map((mesh, i) => textOf(mesh.name, `meshes[${i}].name`));
      return call('writeSeveral', all, names, textOf(name, 'name')).bytes;
    },
    /** One of the functions of bindings/figures.cpp, by its name and its arguments. */
    figure: (name, args) => call(name, ...args),
    spheresJson: (balls, link) => call('spheresJson', numbers(balls, 'balls'), textOf(link, 'link')).bytes,
    /** Bytes of memory that the library has taken; it keeps them for later calls. */
    memory: () => module.memory(),
  };
}

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

function numbers(values, name) {
  if (Array.isArray(values)) {
    if (!values.every((value) => typeof value === 'number')) throw new InputError(`${name}: expected numbers only`);
    return Float64Array.from(values);
  }
  if (ArrayBuffer.isView(values) && !(values instanceof DataView) && typeof values[0] !== 'bigint') return values;
  throw new InputError(`${name}: expected an array of numbers, three for each, one after the other`);
}

function meshOf(mesh, name) {
  if (typeof mesh !== 'object' || mesh === null) throw new InputError(`${name}: expected an object with vertices and faces`);
  return {vertices: numbers(mesh.vertices, `${name}.vertices`), faces: numbers(mesh.faces, `${name}.faces`)};
}

function optionsOf(options) {
  if (typeof options !== 'object' || options === null) throw new InputError(`options: expected an object`);
  const given = {...options};
  if (given.tolerances !== undefined) given.tolerances = numbers(given.tolerances, 'tolerances');
  return given;
}

function bytesOf(bytes) {
  if (bytes instanceof ArrayBuffer) return new Uint8Array(bytes);
  if (!ArrayBuffer.isView(bytes)) throw new InputError('bytes: expected an ArrayBuffer or a Uint8Array');
  return new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength);
}

const kMostOutput = (compressed) => 2 ** 26 + 200 * compressed;  // as the library has it

async function gunzipped(bytes, name) {
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
  const module = await makeModule({
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(wasm, imports).then(done);
      return {};
    },
  });
  const call = (name, ...args) => {
    const result = module[name](...args);
    if (result.error !== undefined) throw errorOf(result.name, result.error);
    return result;
  };
  return {
    build(mesh, targetFaces = 2000, options = {}, progress) {
      const several = Array.isArray(targetFaces);
      const targets = numbers(several ? targetFaces : [targetFaces], 'targetFaces');
      const hulls = call('build', meshOf(mesh, 'mesh'), targets, optionsOf(options), progress);
      return several ? hulls : hulls[0];
    },
    level: (levels, faces, options = {}) => call('level', levels, Number(faces), optionsOf(options)),
    verify: (hull, original, options = {}, progress) =>
      call('verify', meshOf(hull, 'hull'), meshOf(original, 'original'), optionsOf(options), progress),
    distance: (from, to, options = {}, progress) =>
      call('distance', meshOf(from, 'from'), meshOf(to, 'to'), optionsOf(options), progress),
    convexPieces: (mesh, options = {}, progress) => call('convexPieces', meshOf(mesh, 'mesh'), optionsOf(options), progress),
    spheres: (mesh, options = {}, progress) => call('spheres', meshOf(mesh, 'mesh'), optionsOf(options), progress),
    repair: (mesh, options = {}, progress) => call('repair', meshOf(mesh, 'mesh'), optionsOf(options), progress),
    inspect: (mesh) => call('inspect', meshOf(mesh, 'mesh')),
    async read(bytes, name) {
      const content = bytesOf(bytes);
      const isGzip = content[0] === 0x1f && content[1] === 0x8b;
      return call('read', isGzip ? await gunzipped(content, name) : content, String(name));
    },
    sample: (name, faces = 20000) => call('sample', String(name), Number(faces)),
    length: (text, mesh) => call('length', String(text), meshOf(mesh, 'mesh')).length,
    certificate: (hull, original, name, options = {}) =>
      call('certificate', {...hull, ...meshOf(hull, 'hull')}, bytesOf(original), String(name), optionsOf(options)).bytes,
    scene: (hull, original, options = {}, progress) => call('scene', hull, original, optionsOf(options), progress),
    write: (mesh, name) => call('write', meshOf(mesh, 'mesh'), String(name)).bytes,
    /** Bytes of memory that the library has taken; it keeps them for later calls. */
    memory: () => module.memory(),
  };
}

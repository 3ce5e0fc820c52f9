// The library in workers: each call is a promise, and calls that run at the same time have a worker each.
import {InputError, errorOf} from './engine.js';

export {InputError};

const isNode = typeof process === 'object' && typeof process.versions?.node === 'string';

/** How workers are started here, and the compiled library, one for all of them. */
async function prepared() {
  const {startWorker, wasmModule} = isNode ? await import('./platform_node.js') : await import('./platform_browser.js');
  return {startWorker, wasm: await wasmModule()};
}

let preparation;
const idle = [];
const kMostIdle = 1;

function newWorker(startWorker) {
  const worker = {onMessage: null, onFailure: null};
  worker.thread = startWorker((message) => worker.onMessage(message), (error) => worker.onFailure(error));
  return worker;
}

function retire(worker) {
  worker.thread.setBusy(false);
  if (idle.length < kMostIdle) idle.push(worker);
  else worker.thread.end();
}

async function call(name, args, {signal, progress} = {}) {
  signal?.throwIfAborted();
  const {startWorker, wasm} = await (preparation ??= prepared());
  signal?.throwIfAborted();
  const worker = idle.pop() ?? newWorker(startWorker);
  worker.thread.setBusy(true);
  return new Promise((resolve, reject) => {
    const abort = () => {  // the work cannot be asked to stop while it runs: its worker ends
      worker.thread.end();
      reject(signal.reason);
    };
    signal?.addEventListener('abort', abort, {once: true});
    const finish = (settle, value, isBroken) => {
      signal?.removeEventListener('abort', abort);
      if (isBroken) worker.thread.end();
      else retire(worker);
      settle(value);
    };
    worker.onFailure = (error) => finish(reject, error, true);
    worker.onMessage = (message) => {
      if (message.progress) progress?.(...message.progress);
      else if (message.error) finish(reject, errorOf(message.error.name, message.error.message), message.isBroken);
      else finish(resolve, message.result, false);
    };
    try {
      worker.thread.post({wasm, name, args});
    } catch (error) {  // what cannot be copied, such as functions among the options
      finish(reject, new InputError(error.message), false);
    }
  });
}

/** `signal` and `progress` stand among the options of the library. */
const separated = ({signal, progress, ...options} = {}) => [options, {signal, progress}];

const withOptions = (name, meshes) => (...args) => {
  const [options, running] = separated(args[meshes] ?? {});
  return call(name, [...args.slice(0, meshes), options], running);
};

export const build = (mesh, targetFaces = 2000, given = {}) => {
  const [options, running] = separated(given);
  return call('build', [mesh, targetFaces, options], running);
};
export const verify = withOptions('verify', 2);
export const distance = withOptions('distance', 2);
export const convexPieces = withOptions('convexPieces', 1);
export const spheres = withOptions('spheres', 1);
export const repair = withOptions('repair', 1);
export const level = (levels, faces, options = {}) => call('level', [levels, faces, options]);
export const inspect = (mesh, running) => call('inspect', [mesh], running);
export const read = (bytes, name, running) => call('read', [bytes, name], running);
export const sample = (name, faces = 20000) => call('sample', [name, faces]);
export const length = (text, mesh) => call('length', [text, mesh]);
export const certificate = (hull, original, name, options = {}) => call('certificate', [hull, original, name, options]);
export const scene = withOptions('scene', 2);
export const write = (mesh, name) => call('write', [mesh, name]);

/** Ends idle workers, which keep the memory of their last call. Later calls start new ones. */
export function release() {
  for (const worker of idle.splice(0)) worker.thread.end();
}

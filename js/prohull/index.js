// The library in workers: each call is a promise, and calls that run at the same time have a worker each.
import {InputError, errorOf, optionsOf} from './engine.js';

export {InputError};

const isNode = typeof process === 'object' && typeof process.versions?.node === 'string';

/** How workers are started here, and the compiled library, one for all of them. */
async function prepared() {
  const {startWorker, wasmModule} = isNode ? await import('./platform_node.js') : await import('./platform_browser.js');
  return {startWorker, wasm: await wasmModule()};
}

let preparation;

/** What could not be prepared, as where a fetch fails, is tried again by the next call. */
const ready = () => preparation ??= prepared().catch((error) => {
  preparation = undefined;
  throw error;
});

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
  else end(worker);
}

const end = (worker) => worker.thread.end();
const ignored = () => {};

async function call(name, args, {signal, progress}) {
  signal?.throwIfAborted();
  const {startWorker, wasm} = await ready();
  signal?.throwIfAborted();
  const worker = idle.pop() ?? newWorker(startWorker);
  worker.thread.setBusy(true);
  return new Promise((resolve, reject) => {
    const finish = (settle, value, leave) => {
      signal?.removeEventListener('abort', abort);
      worker.onMessage = worker.onFailure = ignored;  // of a worker that has ended, a message may still be under way
      leave(worker);
      settle(value);
    };
    const abort = () => finish(reject, signal.reason, end);  // the work cannot be asked to stop while it runs
    const tell = (stage, fraction) => {
      try {
        progress?.(stage, fraction);
      } catch (error) {
        finish(reject, error, end);
      }
    };
    signal?.addEventListener('abort', abort, {once: true});
    worker.onFailure = (error) => finish(reject, error, end);
    worker.onMessage = (message) => {
      if (message.progress) tell(...message.progress);
      else if (message.error) finish(reject, errorOf(message.error.name, message.error.message), message.isBroken ? end : retire);
      else finish(resolve, message.result, retire);
    };
    try {
      worker.thread.post({wasm, name, args});
    } catch (error) {
      finish(reject, new InputError(`${error.message} Workers take plain objects and arrays, no functions or proxies.`), retire);
    }
  });
}

/** `signal` and `progress` stand among the options of the library. */
function separated(given = {}) {
  const {signal, progress, ...options} = optionsOf(given);
  if (progress !== undefined && progress !== null && typeof progress !== 'function')
    throw new InputError('progress: expected a function');
  if (signal !== undefined && signal !== null && typeof signal.throwIfAborted !== 'function')
    throw new InputError('signal: expected an AbortSignal');
  return [options, {signal, progress}];
}

const firstOf = (args, count) => Array.from({length: count}, (_, i) => args[i]);

/** A function of so many arguments, and of options. */
const withOptions = (name, count) => async (...args) => {
  const [options, running] = separated(args[count]);
  return call(name, [...firstOf(args, count), options], running);
};

const withoutOptions = (name, count) => async (...args) => call(name, firstOf(args, count), {});

export const build = withOptions('build', 2);
export const verify = withOptions('verify', 2);
export const distance = withOptions('distance', 2);
export const convexPieces = withOptions('convexPieces', 1);
export const spheres = withOptions('spheres', 1);
export const repair = withOptions('repair', 1);
export const level = withOptions('level', 2);
export const inspect = withOptions('inspect', 1);
export const read = withOptions('read', 2);
export const length = withOptions('length', 2);
export const readLevels = withOptions('readLevels', 2);
export const certificate = withOptions('certificate', 3);
export const scene = withOptions('scene', 2);
export const sample = withoutOptions('sample', 2);
export const write = withoutOptions('write', 2);
export const writeLevels = withoutOptions('writeLevels', 1);
export const writeSeveral = withoutOptions('writeSeveral', 2);
export const figure = withoutOptions('figure', 2);
export const spheresJson = withoutOptions('spheresJson', 2);

/** Ends idle workers, which keep the memory of their last call. Later calls start new ones. */
export function release() {
  for (const worker of idle.splice(0)) end(worker);
}

// What node has in place of a browser's workers and fetch.
import {readFile} from 'node:fs/promises';
import {Worker} from 'node:worker_threads';

export const wasmModule = async () => WebAssembly.compile(await readFile(new URL('./module.wasm', import.meta.url)));

/** A worker that does not keep the program from ending while it is idle. */
export function startWorker(onMessage, onFailure) {
  const worker = new Worker(new URL('./worker_node.js', import.meta.url));
  worker.on('message', onMessage);
  worker.on('error', onFailure);
  return {
    post: (message) => worker.postMessage(message),
    end: () => worker.terminate(),
    setBusy: (busy) => (busy ? worker.ref() : worker.unref()),
  };
}

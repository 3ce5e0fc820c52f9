// What the package has in platform_browser.js, out of the page itself: nothing is fetched.

import {readBlocks} from '../src/data/blocks.js';

const textOf = (id) => document.getElementById(id).textContent;

export const wasmModule = async () => WebAssembly.compile(await readBlocks(textOf('module')));

let script;

export function startWorker(onMessage, onFailure) {
  script ??= URL.createObjectURL(new Blob([textOf('worker')], {type: 'text/javascript'}));
  const worker = new Worker(script);
  worker.onmessage = (event) => onMessage(event.data);
  worker.onerror = (event) => onFailure(new Error(event.message || 'the worker of this page cannot be started'));
  return {
    post: (message) => worker.postMessage(message),
    end: () => worker.terminate(),
    setBusy: () => {},
  };
}

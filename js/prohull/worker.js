// What a worker does with one call after the other; worker_node.js and worker_browser.js receive them.
import {loadEngine} from './engine.js';

let engine;

/** The arrays of a result, which go to the caller without a copy. */
function buffersOf(value, found = new Set()) {
  if (ArrayBuffer.isView(value)) found.add(value.buffer);
  else if (typeof value === 'object' && value !== null) for (const part of Object.values(value)) buffersOf(part, found);
  return found;
}

export async function answer({wasm, name, args}, reply) {
  try {
    engine ??= await loadEngine(wasm);
    const progress = (stage, fraction) => reply({progress: [stage, fraction]}, []);
    const result = await engine[name](...args, progress);
    reply({result}, [...buffersOf(result)]);
  } catch (error) {
    reply({error: {name: error.name, message: error.message}, isBroken: error instanceof WebAssembly.RuntimeError}, []);
  }
}

// What browsers have for platform_node.js.
export const wasmModule = async () => {
  const response = await fetch(new URL('./module.wasm', import.meta.url));
  if (!response.ok) throw new Error(`prohull: cannot fetch ${response.url}: ${response.status}`);
  return WebAssembly.compile(await response.arrayBuffer());
};

export function startWorker(onMessage, onFailure) {
  const worker = new Worker(new URL('./worker_browser.js', import.meta.url), {type: 'module'});
  worker.onmessage = (event) => onMessage(event.data);
  worker.onerror = (event) => onFailure(new Error(event.message || 'prohull: its worker cannot be loaded'));
  return {
    post: (message) => worker.postMessage(message),
    end: () => worker.terminate(),
    setBusy: () => {},
  };
}

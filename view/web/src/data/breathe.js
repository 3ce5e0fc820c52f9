// Long work in parts, between which the browser draws and answers.

const MILLISECONDS = 20;
let until = 0;

/** To be awaited often: it waits only where the work has kept the browser busy for long. */
export async function breathe() {
  if (performance.now() < until) return;
  await new Promise((resolve) => setTimeout(resolve));
  until = performance.now() + MILLISECONDS;
}

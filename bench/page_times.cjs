// How soon a page of `prohull view` shows its first picture, and what a frame of its slider takes, in headless Chromium:
//     NODE_PATH=build/release/view/web/node_modules node bench/page_times.cjs build/release/bin/prohull [CHROMIUM]
// The page has all levels of a hull of 100,000 faces. Without a GPU, Chromium draws by software. What that alone takes to start
// tells a page that clears its canvas by WebGL and does nothing else, opened in turns with ours.
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const {withBrowser} = require('../tests/view/chromium.cjs');

const [, , program, chromium = '/usr/bin/chromium'] = process.argv;
if (!program) {
  console.error('usage: page_times.cjs PROHULL [CHROMIUM]');
  process.exit(2);
}
const prohull = path.resolve(program);
const RUNS = 7, FRAMES = 150;
const EMPTY = `<!doctype html><canvas id="canvas"></canvas><script>
const gl = document.getElementById('canvas').getContext('webgl2');
gl.clearColor(1, 0, 0, 1);
gl.clear(gl.COLOR_BUFFER_BIT);
gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
document.documentElement.dataset.ready = 'yes';
</script>`;

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

function makePage(folder) {
  const run = (...args) => execFileSync(prohull, args, {cwd: folder, stdio: ['ignore', 'ignore', 'inherit']});
  run('sample', 'asteroid', '--faces', '100000', '-o', 'rock.ply');
  run('build', 'rock.ply', '--faces', '1000', '-o', 'hull.stl', '--hierarchy', 'rock.phull');
  run('view', 'rock.phull', '-o', 'page.html');
  fs.writeFileSync(path.join(folder, 'empty.html'), EMPTY);
  return fs.statSync(path.join(folder, 'page.html')).size;
}

/** Notes, before anything else runs, when the picture is drawn, and how long the longest task is. */
function watch() {
  globalThis.longest = 0;
  new PerformanceObserver((list) => {
    for (const entry of list.getEntries()) globalThis.longest = Math.max(globalThis.longest, entry.duration);
  }).observe({type: 'longtask', buffered: true});
  const drawn = () => {
    const gl = document.getElementById('canvas').getContext('webgl2');
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // waits until all is drawn
    globalThis.readyAt = performance.now();
  };
  const observer = new MutationObserver(() => {
    if (!document.documentElement.dataset.ready) return;
    observer.disconnect();
    requestAnimationFrame(() => requestAnimationFrame(drawn));  // the page draws in the first frame after it is ready
  });
  observer.observe(document, {attributes: true, subtree: true});
}

async function opened(browser, file) {
  const page = await browser.newPage({viewport: {width: 1200, height: 800}});
  await page.addInitScript(watch);
  await page.goto(`file://${file}`);
  await page.waitForFunction(() => globalThis.readyAt, null, {timeout: 60000});
  await page.waitForTimeout(300);  // until the observer has been told
  return page;
}

/** The slider goes from the base mesh to the original: milliseconds of script in each frame, and between frames. */
const slide = (page, frames) => page.evaluate(async (count) => {
  const {levels, viewport} = prohullView, script = [], between = [];
  const draw = viewport.draw.bind(viewport);
  let spent = 0;
  viewport.draw = (...args) => {
    const began = performance.now();
    draw(...args);
    spent += performance.now() - began;
  };
  globalThis.longest = 0;
  let last = await new Promise(requestAnimationFrame);
  for (let i = 0; i <= count; ++i) {
    const began = performance.now();
    levels.setShare(i / count);
    spent += performance.now() - began;
    const now = await new Promise(requestAnimationFrame);
    script.push(spent);
    between.push(now - last);
    [spent, last] = [0, now];
  }
  return {script, between, faces: prohullView.active.levels.faces};
}, frames);

async function measure(browser) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'prohull-page-'));
  try {
    const bytes = makePage(folder), empty = [], ready = [], stalls = [];
    let page;
    for (let i = 0; i < RUNS; ++i) {
      page = await opened(browser, path.join(folder, 'empty.html'));
      empty.push(await page.evaluate(() => readyAt));
      await page.close();
      page = await opened(browser, path.join(folder, 'page.html'));
      ready.push(await page.evaluate(() => readyAt));
      stalls.push(await page.evaluate(() => longest));
      if (i + 1 < RUNS) await page.close();
    }
    const {script, between, faces} = await slide(page, FRAMES);
    const renderer = await page.evaluate(() => {
      const gl = document.createElement('canvas').getContext('webgl2');
      return gl.getParameter(gl.getExtension('WEBGL_debug_renderer_info').UNMASKED_RENDERER_WEBGL);
    });
    console.log(`drawn by ${renderer}; medians of ${RUNS} runs`);
    console.log(`${(bytes / 1e6).toFixed(1)} MB: all levels from 1,000 to 100,000 faces; ${faces} faces at the end of the slider`);
    console.log(`first picture: ${median(ready).toFixed(0)} ms; of a page that only clears its canvas: ${median(empty).toFixed(0)} ms`);
    console.log(`longest task of the page until then: ${median(stalls).toFixed(0)} ms`);
    const longest = await page.evaluate(() => globalThis.longest);  // 0 unless a task takes 50 ms
    console.log(`slider, ${script.length} frames: script ${median(script).toFixed(1)} ms a frame, at most ` +
      `${Math.max(...script).toFixed(1)} ms; ${median(between).toFixed(0)} ms from frame to frame; ` +
      `longest task ${longest > 0 ? longest.toFixed(0) : 'below 50'} ms`);
  } finally {
    fs.rmSync(folder, {recursive: true, force: true});
  }
}

withBrowser(chromium, measure);

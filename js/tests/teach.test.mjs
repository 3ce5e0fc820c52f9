// teach.html in headless Chromium: what the figures tell is what the library says, and exact numbers and the program agree.
import assert from 'node:assert/strict';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import {fileURLToPath} from 'node:url';
import {engine, run, sample, scratch} from './package.mjs';
import {inBrowser} from './pages.mjs';

const {skip, opened, closed} = await inBrowser('teach.html');
const pictureFile = process.env.PROHULL_TEACH_PICTURE;  // where the picture of docs/browser.md goes, if it is to be made
const kFigures = [1, 2, 3, 4, 5, 6].map((i) => `figure-${i}`);

const told = (page, id, part = '.told') => page.evaluate(([name, wanted]) => document.getElementById(name).querySelector(wanted).textContent, [id, part]);
const drawn = (page, id) => page.waitForFunction((name) => document.getElementById(name).dataset.busy === 'no', id);

async function shown(page, id) {
  await page.evaluate((name) => document.getElementById(name).scrollIntoView(), id);
  await drawn(page, id);
}

/** Moves a control as a user does. */
async function set(page, id, control, value) {
  await page.evaluate(([name, wanted, to]) => {
    const element = document.getElementById(name).querySelector(wanted);
    element.value = to;
    element.dispatchEvent(new Event('input', {bubbles: true}));
  }, [id, `.${control}`, value]);
  await drawn(page, id);
}

/** What the page handed to the library. */
const given = (page, id, what) => page.evaluate(([name, wanted]) =>
  prohullFigures.find(({section}) => section.id === name)[wanted], [id, what]);

const recordOf = (name, faces, options) => engine.figure('recordOfHull', [engine.sample(name, faces), options]);
const rock = (strategy) => recordOf('asteroid', 400, {targetFaces: 60, strategy});
const grouped = (count) => count.toLocaleString('en');
const short = (number) => String(Number(number.toPrecision(4)));

/** A double as a whole number of units of 2^-400, exactly. */
function exact(x) {
  let shift = 400n;
  for (; !Number.isInteger(x); x *= 2) --shift;
  return BigInt(x) << shift;
}

/** The sign of orient3d, by whole numbers: on which side of the plane of a face a point lies. */
function sideOf({vertices, faces}, f, point) {
  const [p, ...corners] = [point, ...[0, 1, 2].map((c) => vertices.slice(3 * faces[3 * f + c], 3 * faces[3 * f + c] + 3))].map((q) => [...q].map(exact));
  const [a, b, c] = corners.map((q) => q.map((x, k) => x - p[k]));
  const volume = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  return volume < 0n ? 1 : volume > 0n ? -1 : 0;  // as seen from the point, faces turn the other way
}

const sidesOf = (star, point) => Array.from({length: star.faces.length / 3}, (_, f) => sideOf(star, f, point));

test('all collapses put their vertex outside of all planes of the star, or on them, exactly', {skip}, () => {
  const levels = rock('paper1');
  for (let i = 0; i < levels.splits.length / 6; ++i) {
    const {star, made, optimum, sides} = engine.figure('collapseOf', [levels, i, null]);
    assert.deepEqual([...sides], sidesOf(star, made));
    assert.ok(!sides.includes(-1));
    assert.ok(Math.hypot(...made.map((x, k) => x - optimum[k])) < 1e-9);
  }
});

test('Figure 1 makes a collapse and undoes it', {skip}, async () => {
  const page = await opened(), levels = rock('paper1'), faces = levels.baseCorners.length / 3;
  await shown(page, 'figure-1');
  await set(page, 'figure-1', 'collapse', '30');
  const {star} = engine.figure('collapseOf', [levels, 29, null]), valence = star.vertices.length / 3 - 2;
  assert.equal(await told(page, 'figure-1'), `Collapse 30 of ${levels.splits.length / 6}: ${faces - 58} faces become ${faces - 60}. ` +
      `The star of the edge has ${valence + 2} faces, that of s has ${valence}.`);
  const names = () => page.evaluate(() => prohullFigures[0].picture.viewport.marks.children.length);
  assert.equal(await names(), 4);
  await page.click('#figure-1 .made');
  await drawn(page, 'figure-1');
  assert.equal(await names(), 3);
  await closed(page);
});

test('Figure 2 tells how many planes are violated, and what is added', {skip}, async () => {
  const page = await opened(), levels = rock('paper1');
  await shown(page, 'figure-2');
  const seen = new Set();
  for (const [collapse, outwards, along] of [[12, 0, 0], [12, 0.3, 0], [12, -0.02, 0], [40, 0, 0.2], [100, -0.5, 0], [100, 0.5, 0.1]]) {
    await set(page, 'figure-2', 'collapse', String(collapse));
    await set(page, 'figure-2', 'outwards', String(outwards));
    await set(page, 'figure-2', 'along', String(along));
    const place = Float64Array.from(await given(page, 'figure-2', 'place'));
    const {star, addedVolume, optimalVolume} = engine.figure('collapseOf', [levels, collapse - 1, place]);
    const sides = sidesOf(star, place), violated = sides.filter((side) => side < 0).length;
    seen.add(violated > 0);
    assert.equal(await told(page, 'figure-2'), violated > 0
      ? `s is inside of ${violated} of ${sides.length} planes: the hull would cut the mesh there. The collapse is refused.`
      : `s is outside of all ${sides.length} planes, or on them. It adds a volume of ${short(addedVolume)}; the least possible is ${short(optimalVolume)}.`);
  }
  assert.equal(seen.size, 2);
  await closed(page);
});

test('the first edge of each queue is the one that is collapsed next', {skip}, () => {
  for (const strategy of ['paper1', 'paper2']) {
    const levels = rock(strategy);
    for (let i = 0; i < levels.splits.length / 6; ++i) {
      const {ends, refusals} = engine.figure('queueOf', [levels, i, {strategy}]);
      assert.deepEqual([...ends.slice(0, 2)].sort(), [...levels.splits.slice(6 * i, 6 * i + 2)].sort());
      assert.equal(refusals[0], '');
    }
  }
});

test('what is no figure is refused', {skip}, () => {
  const levels = rock('paper1');
  for (const [name, ...args] of [['collapseOf', levels, 9999, null], ['collapseOf', levels, 0.5, null], ['collapseOf', levels, 0, [1, 2]], ['queueOf', levels, 0, {strategy: 'lazy'}],
    ['refinedAlong', levels, Float64Array.of(1, 2, 3)], ['walkHits', levels, levels, Float64Array.of(0, 0, -9, 0, 0, 9)], ['recordOfHull', engine.sample('torus', 100), {targetFaces: 1}]])
    assert.throws(() => engine.figure(name, args), {name: 'InputError'}, name);
});

test('Figure 3 has the edge first that is collapsed next', {skip}, async () => {
  const page = await opened();
  await shown(page, 'figure-3');
  for (const strategy of ['paper1', 'paper2']) {
    const {splits} = rock(strategy);
    await set(page, 'figure-3', 'strategy', strategy);
    for (const made of [0, 7, 80]) {
      await set(page, 'figure-3', 'collapse', String(made));
      const first = await told(page, 'figure-3', '.queue li'), [, a, b] = /edge (\d+)–(\d+)/.exec(first);
      assert.deepEqual([a, b].map(Number).sort(), [...splits.slice(6 * made, 6 * made + 2)].sort());
      assert.match(await told(page, 'figure-3'), made === 0 ? /no collapse is made yet/ : /the last collapse changed the stars of [1-9]\d* of them/);
    }
  }
  await closed(page);
});

/** Where the program finds that a segment crosses a sample, testing each face. */
function crossings(name, faces, segment) {
  const [segments, hits] = ['segment.csv', 'hits.csv'].map((file) => join(scratch, file));
  writeFileSync(segments, `${segment.join()}\n`);
  run('query', sample(name, faces), '--segments', segments, '-o', hits, '--mode', 'all', '--engine', 'brute');
  return readFileSync(hits, 'utf8').trim().split('\n').slice(1).map((line) => Number(line.split(',')[1]));
}

const sorted = (numbers) => [...numbers].sort((a, b) => a - b);

test('Figure 4 refines the hull where the segment is, and finds what the program finds', {skip}, async () => {
  const page = await opened(), levels = recordOf('pony', 8000, {targetFaces: 300, strategy: 'paper1'}), mesh = engine.level(levels, 1e9);
  await shown(page, 'figure-4');
  for (const [height, direction] of [[0.2, 10], [0, 60], [0.88, 0]]) {
    await set(page, 'figure-4', 'height', String(height));
    await set(page, 'figure-4', 'direction', String(direction));
    const segment = await given(page, 'figure-4', 'segment');
    const refined = engine.figure('refinedAlong', [levels, Float64Array.from(segment)]), faces = refined.faces.length / 3;
    assert.deepEqual(sorted([...refined.found, ...refined.missed]), crossings('pony', 8000, segment));
    assert.ok(engine.verify(refined, mesh).encloses);
    const text = await told(page, 'figure-4');
    assert.match(text, new RegExp(`^The coarse hull has 300 faces, the refined one ${grouped(faces)}: ${grouped((faces - 300) / 2)} of `));
    for (const t of refined.found) assert.ok(text.includes(short(t)));
  }
  await closed(page);
});

test('Figure 5: the outer hull misses crossings, and with the inner one none is missed', {skip}, async () => {
  const page = await opened();
  await shown(page, 'figure-5');
  const segment = await given(page, 'figure-5', 'segment'), all = crossings('gyroid', 6000, segment);
  const [, found, missed] = /^Found: (\d) crossings.*Missed: (\d) crossings/.exec(await told(page, 'figure-5')).map(Number);
  assert.ok(missed > 0);
  assert.equal(found + missed, all.length);
  await set(page, 'figure-5', 'engine', 'walk');
  const walked = await told(page, 'figure-5');
  assert.equal(walked, `Found: ${all.length} crossings, at ${all.map(short).join(', ')} of the way. None is missed.`);
  await set(page, 'figure-5', 'shift', '-0.05');
  const moved = crossings('gyroid', 6000, await given(page, 'figure-5', 'segment'));
  assert.ok((await told(page, 'figure-5')).startsWith(`Found: ${moved.length} crossings, at ${moved.map(short).join(', ')} of`));
  await closed(page);
});

test('Figures 6 and 7 tell the void of both strategies', {skip}, async () => {
  const page = await opened();
  await shown(page, 'figure-6');
  for (const value of ['0.13', '0.56']) {
    await set(page, 'figure-6', 'faces', value);
    const text = await told(page, 'figure-6'), voids = [...text.matchAll(/([\d,]+) faces, void ([\d.]+) %/g)];
    assert.equal(voids.length, 2);
    for (const [k, strategy] of ['paper1', 'paper2'].entries()) {
      const levels = recordOf('pony', 20000, {targetFaces: 100, strategy}), faces = Number(voids[k][1].replace(',', ''));
      const verdict = engine.verify(engine.level(levels, faces), engine.level(levels, 1e9));
      assert.ok(verdict.encloses);
      assert.equal(voids[k][2], short(100 * verdict.voidRatio));
    }
    assert.ok(Number(voids[0][2]) < Number(voids[1][2]));
  }
  await closed(page);
});

test('the code in the page is that of the repository', {skip}, async () => {
  const page = await opened(), root = fileURLToPath(new URL('../..', import.meta.url));
  const shownCode = await page.evaluate(() => [...document.querySelectorAll('.code')].map((details) =>
    [details.querySelector('summary code:last-child').textContent, details.querySelector('pre').textContent]));
  assert.ok(shownCode.length >= kFigures.length);
  for (const [file, code] of shownCode) {
    const unindented = (text) => text.split('\n').map((line) => line.trim()).join('\n');
    assert.ok(unindented(readFileSync(join(root, file), 'utf8')).includes(unindented(code)), file);
    assert.match(code, /\{[^]*\n\}$/);
  }
  await closed(page);
});

test('on a phone, by keys, in the dark', {skip}, async () => {
  const page = await opened({width: 390, height: 800, scheme: 'dark'});
  for (const id of kFigures) await shown(page, id);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
  const reached = new Set();
  for (let i = 0; i < 60; ++i) {
    await page.keyboard.press('Tab');
    const {figure, name, outline, label} = await page.evaluate(() => {
      const element = document.activeElement;
      return {figure: element.closest('section')?.id, name: element.className || element.tagName, outline: getComputedStyle(element).outlineStyle,
        label: element.ariaLabel || element.labels?.[0]?.textContent || element.textContent};
    });
    if (figure) assert.ok(outline !== 'none' && label, `${figure} ${name}`);
    reached.add(`${figure} ${name}`);
  }
  for (const place of ['figure-1 made', 'figure-2 outwards', 'figure-3 strategy', 'figure-4 CANVAS', 'figure-5 engine', 'figure-6 faces'])
    assert.ok(reached.has(place), place);
  const looking = () => page.evaluate(() => prohullFigures[0].picture.viewport.looking()[0]);
  const before = await looking();
  await page.focus('#figure-1 canvas');
  await page.keyboard.press('ArrowRight');
  assert.notEqual(await looking(), before);
  await closed(page);
});

test('without WebAssembly, the page says so', {skip}, async () => {
  const page = await opened({script: 'delete globalThis.WebAssembly'});
  assert.match(await page.evaluate(() => document.getElementById('problem').textContent), /^This browser has no WebAssembly/);
  await closed(page);
});

test('the picture of docs/browser.md', {skip: skip || (!pictureFile && 'PROHULL_TEACH_PICTURE names no file')}, async () => {
  const page = await opened({width: 1000, height: 760});
  await shown(page, 'figure-5');
  await page.waitForTimeout(1000);
  await page.screenshot({path: pictureFile});
  await closed(page);
});

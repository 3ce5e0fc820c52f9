// What the package promises to programs that call it.
import assert from 'node:assert/strict';
import test from 'node:test';
import {gzipSync} from 'node:zlib';
import {cube, engine, prohull} from './package.mjs';

const refused = (call, says) => assert.rejects(call, (error) => {
  assert.equal(error.name, 'InputError');
  assert.ok(error instanceof prohull.InputError);
  assert.match(error.message, says);
  return true;
});

/** A sphere of about so many faces. */
function ball(faces) {
  const rows = Math.max(3, Math.round(Math.sqrt(faces / 4))), columns = 2 * rows;
  const vertices = [0, 0, 1], triangles = [];
  for (let i = 1; i < rows; ++i)
    for (let j = 0; j < columns; ++j) {
      const a = (Math.PI * i) / rows, b = (2 * Math.PI * j) / columns;
      vertices.push(Math.sin(a) * Math.cos(b), Math.sin(a) * Math.sin(b), Math.cos(a));
    }
  vertices.push(0, 0, -1);
  const at = (i, j) => 1 + (i - 1) * columns + (j % columns), south = vertices.length / 3 - 1;
  for (let j = 0; j < columns; ++j) {
    triangles.push(0, at(1, j), at(1, j + 1), south, at(rows - 1, j + 1), at(rows - 1, j));
    for (let i = 1; i + 1 < rows; ++i)
      triangles.push(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1));
  }
  return {vertices: Float64Array.from(vertices), faces: Uint32Array.from(triangles)};
}

test('a hull is certified, and verify says the same', async () => {
  const part = ball(2000), stages = new Set();
  const hull = await prohull.build(part, 100, {progress: (stage) => stages.add(stage)});
  assert.ok(hull.certified && hull.targetReached && hull.faces.length <= 300);
  assert.ok(stages.has('build'));
  assert.ok((await prohull.verify(hull, part)).holds);
  const inside = await prohull.verify(part, hull);
  assert.ok(!inside.holds && inside.worst[0].distance > 0 && inside.whyNot.length > 0);
  const {lower, upper} = await prohull.distance(hull, part);
  assert.ok(0 < lower && lower <= upper && upper < 0.2);
});

test('several numbers of faces give several hulls', async () => {
  const hulls = await prohull.build(ball(1000), [200, 50]);
  assert.deepEqual(hulls.map((hull) => hull.faces.length / 3 <= 200), [true, true]);
});

test('levels nest', async () => {
  const part = ball(2000), hull = await prohull.build(part, 60, {levels: true});
  const finer = await prohull.level(hull.levels, 500);
  assert.ok(finer.faces.length / 3 <= 500 && finer.faces.length / 3 > 490);
  assert.ok((await prohull.verify(hull, finer)).holds && (await prohull.verify(finer, part)).holds);
  await refused(prohull.level({...hull.levels, splits: hull.levels.splits.slice(6)}, 500), /do not belong together/);
  await refused(prohull.level({...hull.levels, splits: hull.levels.splits.map(() => 7)}, 500), /split/);
  await refused(prohull.level(undefined, 500), /levels/);
});

test('covers and repairs', async () => {
  const pieces = await prohull.convexPieces(ball(500), {pieces: 2, shape: 'sphere'});
  assert.ok(pieces.certified && pieces.pieces[0].primitive.kind === 'sphere');
  const balls = await prohull.spheres(cube, {count: 8});
  assert.ok(balls.certified && balls.balls.length % 4 === 0);
  const open = {vertices: cube.vertices, faces: cube.faces.slice(6)};
  assert.equal((await prohull.inspect(open)).defects['open edges'], 4);
  const solid = await prohull.repair(open);
  assert.ok(solid.certified && (await prohull.inspect(solid)).closedManifold);
});

test('files', async () => {
  for (const suffix of ['ply', 'obj', 'off', 'stl', 'glb']) {
    const bytes = await prohull.write(cube, `cube.${suffix}`);
    for (const file of [bytes, gzipSync(bytes), bytes.slice().buffer])
      assert.equal((await prohull.read(file, `cube.${suffix}`)).faces.length, 36);
    await refused(prohull.read(bytes.slice(0, 30), `cube.${suffix}`), /cube/);
  }
  const third = {vertices: cube.vertices.map((x) => x / 3), faces: cube.faces};
  assert.deepEqual([...(await prohull.read(await prohull.write(third, 'a.obj'), 'a.obj')).vertices], third.vertices);
  await refused(prohull.write(third, 'a.stl'), /float32/);
  await refused(prohull.read(new Uint8Array([0x50, 0x4b, 3, 4]), 'a.zip'), /compressed/);
  await refused(prohull.read(gzipSync('solid').subarray(0, 12), 'a.stl'), /cannot decompress/);
  await refused(prohull.read(new Uint8Array(0), 'a.stl'), /a.stl/);
  await refused(prohull.read('text', 'a.stl'), /bytes/);
});

test('numbers are read and written as by the program', async () => {
  const numbers = [0.1, -0, 1e-7, 1.5e300, 5e-324, 123456789012345680, 1e22, 0.001, 100000, 1 / 3, 2 ** 53, -1e5];
  const mesh = {vertices: numbers, faces: [0, 1, 2, 1, 2, 3]};
  const text = new TextDecoder().decode(await prohull.write(mesh, 'a.obj'));
  assert.deepEqual(text.split('\n').filter((line) => line.startsWith('v ')).join(' ').split(/ ?v ?| /).filter((x) => x),
    ['0.1', '-0', '1e-07', '1.5e+300', '5e-324', '123456789012345677', '1e+22', '0.001', '1e+05', '0.3333333333333333',
      '9007199254740992', '-1e+05'].map((x) => (x === '123456789012345677' ? '123456789012345680' : x)));
  const read = await prohull.read(new TextEncoder().encode(text), 'a.obj');
  assert.deepEqual([...read.vertices].map(Object.is.bind(null)), numbers.map(Object.is.bind(null)));
  assert.ok(numbers.every((x, i) => Object.is(x, read.vertices[i])));
});

test('a summary has the lines of the program, and lengths are as it reads them', async () => {
  const part = await prohull.sample('torus', 2000);
  const hull = await prohull.build(part, 200, {summaryOf: 'hull.stl', float32Coordinates: true});
  assert.match(hull.summary[0], /^hull\.stl: outer hull of 200 faces, void [\d.]+ %, at most [\d.]+ from the mesh$/);
  assert.equal(hull.summary.at(-1), 'certified: yes, the file as written encloses the original');
  assert.ok(hull.distance > 0 && hull.distance < 0.2);
  const unrounded = await prohull.build(part, 200, {summaryOf: 'hull.stl'}).catch((error) => error);
  assert.match(unrounded.message, /float32|STL|stl/);
  const {diagonal} = await prohull.inspect(part);
  assert.equal(await prohull.length('1%', part), diagonal / 100);
  assert.equal(await prohull.length('0.25', part), 0.25);
  await refused(prohull.length('1mm', part), /1mm: expected a number/);
  await refused(prohull.length('wide', part), /wide: expected a number/);
  await refused(prohull.sample('cow', 2000), /cow/);
  const bytes = await prohull.write(part, 'part.ply');
  assert.ok((await prohull.certificate(hull, bytes, 'part.ply', {distance: hull.distance})).length > 0);
});

test('what is wrong is said in one line', async () => {
  const {vertices, faces} = cube;
  await refused(prohull.build(undefined), /mesh: expected an object/);
  await refused(prohull.build({vertices}), /mesh.faces: expected an array of numbers/);
  await refused(prohull.build({vertices: 'abc', faces}), /mesh.vertices/);
  await refused(prohull.build({vertices: vertices.map(String), faces}), /numbers only/);
  await refused(prohull.build({vertices: vertices.slice(1), faces}), /three numbers for each vertex, not 23/);
  await refused(prohull.build({vertices, faces: [0, 1]}), /three numbers for each face, not 2/);
  for (const index of [8, -1, 0.5, NaN, 4294967296])
    await refused(prohull.build({vertices, faces: [0, 1, index]}), /mesh.faces\[2\]=.*one of 8 vertices/);
  await refused(prohull.build({vertices: [], faces: []}), /no faces/);
  await refused(prohull.build({vertices: vertices.map(() => NaN), faces}), /finite/);
  await refused(prohull.build({vertices: vertices.map(() => Infinity), faces}), /finite/);
  await refused(prohull.build({vertices: new BigInt64Array(3), faces: [0, 0, 0]}), /array of numbers/);
  await refused(prohull.verify(cube, {vertices: [], faces: []}), /./);
  for (const targets of [0, -1, 2.5, NaN, '8', [], [8, 'x']]) await refused(prohull.build(cube, targets), /./);
  await refused(prohull.build(cube, 8, {tigth: true}), /tigth: there is no such option, only .*tight/);
  await refused(prohull.build(cube, 8, {tight: 1}), /tight=1: expected true or false/);
  await refused(prohull.build(cube, 8, {side: 'left'}), /side=left: expected one of outer, inner/);
  await refused(prohull.build(cube, 8, {maxDistance: -1}), /maxDistance=-1: expected a number, at least 0/);
  await refused(prohull.build(cube, 8, {gap: '1'}), /gap=1: expected a number/);
  await refused(prohull.build(cube, 8, {bestOf: 0.5}), /bestOf=0.5: expected a whole number/);
  await refused(prohull.build(cube, 8, {tolerances: [1]}), /./);
  await refused(prohull.build(cube, 8, {side: () => 0}), /./);
  await refused(prohull.convexPieces(cube, {pieces: 0}), /pieces=0: expected a whole number, at least 1/);
  assert.ok((await prohull.build(cube, 12)).certified, 'and the next call is done');
});

test('a signal ends the work at once', async () => {
  const part = ball(100000), stop = new AbortController();
  const began = new Promise((resolve) => setTimeout(resolve, 300));
  const built = prohull.build(part, 100, {tight: true, signal: stop.signal});
  await began;
  const at = performance.now();
  stop.abort();
  await assert.rejects(built, {name: 'AbortError'});
  assert.ok(performance.now() - at < 200);
  await assert.rejects(prohull.build(cube, 8, {signal: AbortSignal.abort()}), {name: 'AbortError'});
  assert.throws(() => engine.build(part, 100, {}, () => false), {name: 'AbortError'});
});

test('calls at the same time do not disturb each other', async () => {
  const part = ball(1000), alone = await prohull.build(part, 80);
  for (const hull of await Promise.all([1, 2, 3].map(() => prohull.build(part, 80))))
    assert.deepEqual(hull.vertices, alone.vertices);
});

test('memory does not grow', () => {
  const part = ball(1000);
  const once = () => engine.build(part, 200);
  for (let i = 0; i < 3; ++i) once();
  const before = engine.memory();
  for (let i = 0; i < 20; ++i) once();
  assert.equal(engine.memory(), before);
});

test.after(() => prohull.release());

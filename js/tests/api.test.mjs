// What the package promises to programs that call it.
import assert from 'node:assert/strict';
import test from 'node:test';
import {execFileSync} from 'node:child_process';
import {gzipSync} from 'node:zlib';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {collada, cube, engine, hasProgram, loadEngine, prohull, run, sample, scratch} from './package.mjs';

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
  const gaps = await Promise.all([0, 1e-9, 1].map((gap) => prohull.verify(hull, part, {gap})));
  assert.deepEqual([gaps[0].keepsGap, gaps[2].keepsGap], [null, false]);
  assert.equal(gaps[1].keepsGap, gaps[1].facesTooNear === 0);
  const {lower, upper} = await prohull.distance(hull, part);
  const broken = {vertices: [...part.vertices, NaN, 0, 0], faces: [...part.faces, 0, 1, part.vertices.length / 3]};
  await refused(prohull.distance(hull, broken), /not finite/);
  assert.equal((await prohull.distance(hull, broken, {finiteOnly: true})).upper, upper);
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
  for (const splits of [hull.levels.splits.slice(6), [...hull.levels.splits, 1]])
    await refused(prohull.level({...hull.levels, splits}, 500), /do not belong together/);
  await refused(prohull.level({...hull.levels, positions: [...hull.levels.positions, 1]}, 500), /do not belong together/);
  await refused(prohull.level({...hull.levels, splits: hull.levels.splits.map(() => 7)}, 500), /split/);
  await refused(prohull.level(undefined, 500), /levels/);
  await refused(prohull.level(hull.levels, 59), /faces=59: the coarsest level has 60 faces/);
  assert.ok(!('levels' in await prohull.build(part, 60)), 'only where they are asked for');
});

test('the program reads the file of all levels, of one block and of several', {skip: !hasProgram && 'there is no program to compare with'}, async () => {
  for (const [name, faces, target] of [['box', 12, 12], ['knot', 500, 60], ['knot', 20000, 100]]) {
    const part = await prohull.sample(name, faces), {levels} = await prohull.build(part, target, {levels: true});
    const [input, all, level] = ['levels_part.ply', 'page.phull', 'level.ply'].map((name) => join(scratch, name));
    writeFileSync(input, await prohull.write(part, input));
    writeFileSync(all, await prohull.writeLevels(levels));
    assert.ok(run('verify', all, input), `${name} ${faces}`);
    for (const some of [part.faces.length / 3, (part.faces.length / 3 + target) >> 1]) {
      run('lod', all, '-o', level, '--faces', String(some));
      assert.deepEqual(new Uint8Array(readFileSync(level)), await prohull.write(await prohull.level(levels, some), level));
    }
    const damaged = readFileSync(all);
    damaged[damaged.length - 20] ^= 1;
    writeFileSync(all, damaged);
    assert.throws(() => run('verify', all, input), /damaged/, 'by the checksum');
  }
});

test('the file of all levels that the program compresses is read, and none that is damaged', {skip: !hasProgram && 'there is no program to compare with'}, async () => {
  for (const [name, side] of [['knot', 'outer'], ['box', 'outer'], ['bracket', 'inner']]) {
    const [all, hull, level] = ['all.phull', 'all.ply', 'level.stl'].map((name) => join(scratch, name));
    run('build', sample(name, 20000), '-o', hull, '--faces', '300', '--side', side, '--hierarchy', all);
    const bytes = readFileSync(all), levels = await prohull.readLevels(bytes, 'all.phull');
    assert.equal(levels.side, side);
    const coarsest = await prohull.level(levels);
    assert.deepEqual(Buffer.from(await prohull.write(coarsest, 'all.ply')), readFileSync(hull));
    const {summary, certified, ...finer} = await prohull.level(levels, 900, {float32Coordinates: true, summaryOf: level});
    const printed = execFileSync(process.env.PROHULL, ['lod', all, '-o', level, '--faces', '900'], {encoding: 'utf8'});
    assert.deepEqual(Buffer.from(await prohull.write(finer, level)), readFileSync(level));
    assert.deepEqual(summary, printed.trim().split('\n').map((line) => line.trim()));
    assert.equal(certified, summary.at(-1).startsWith('certified: yes'));
    for (let at = 12; at < bytes.length; at += 1 + bytes.length / 60 | 0) {
      const damaged = Uint8Array.from(bytes);
      damaged[at] ^= 1 << at % 8;
      assert.throws(() => engine.readLevels(damaged, 'b.phull'), /^InputError: b\.phull: .*(damaged|truncated|too many)/);
      assert.throws(() => engine.readLevels(bytes.subarray(0, at), 'b.phull'), /^InputError: b\.phull: it is truncated/);
    }
  }
  await refused(prohull.readLevels(new Uint8Array([31, 139, 8]), 'a.phull'), /a\.phull: it is gzipped.*gunzip/);
  await refused(prohull.readLevels(await prohull.write(cube, 'a.stl'), 'a.phull'), /this is not a \.phull file/);
});

test('a file with a unit is read in metres, and lengths may then have units', async () => {
  const bytes = await prohull.write(cube, 'a.obj'), inches = await prohull.read(bytes, 'a.obj', {unit: 'in'});
  assert.equal(Math.max(...inches.vertices), 0.0254);
  assert.equal(await prohull.length('5mm', inches, {inMetres: true}), 0.005);
  await refused(prohull.length('5mm', inches), /5mm: expected a number in the unit of the mesh/);
  await refused(prohull.read(bytes, 'a.obj', {unit: 'mile'}), /unit=mile: expected one of mm, cm, m, in, ft/);
});

test('COLLADA is in metres, and what is cut off or holds itself is refused at once', async () => {
  const read = (text, options) => engine.read(new TextEncoder().encode(text), 'a.dae', options), metres = await read(collada);
  assert.ok(metres.inMetres && Math.max(...metres.vertices) < 0.1);
  assert.deepEqual((await prohull.read(gzipSync(collada), 'a.dae.gz')).vertices, metres.vertices);
  await assert.rejects(read(collada, {unit: 'mm'}), /^InputError: a\.dae: a unit is for files that do not say theirs/);
  for (let at = 0; at < collada.length - 1; at += 3) await assert.rejects(read(collada.slice(0, at)), /^InputError: a\.dae: [^\n]+$/, String(at));
  for (const [old, next, says] of [
    ['<scale>-1 1 1.1</scale>', '<instance_node url="#again"/>'.repeat(2), /more than the limit for its size/],
    ['<?xml', '<!DOCTYPE a [<!ENTITY b "c">]><?xml', /line 1: document types are not read/], ['5 0 6 11', '5 0 6 12', /it has no position 12/],
    ['count="36"', 'count="4000000000"', /a number was expected/], ['<vcount>6 6', '<vcount>6 5', /other numbers of indices/], ['3.1415926', '3.14x', /a number was expected where 'x 0/],
    ['#scene', 'scene', /refers to/], ['"#numbers"', '"#none"', /positions are not there/], ['stride="3"', 'stride="4294967295"', /no position/], ['COLLADA xmlns', 'collada xmlns', /closes nothing/]])
    await assert.rejects(read(collada.replace(old, next)), says, next);
});

test('distances from an open mesh are told from its triangles, and from its solid with the openings closed', async () => {
  const open = {vertices: cube.vertices, faces: cube.faces.slice(6)};
  const pieces = await prohull.convexPieces(open, {pieces: 1, summaryOf: 'a.obj'}), balls = await prohull.spheres(open, {count: 8, summaryOf: 'a.json'});
  const hull = await prohull.build(open, 12, {summaryOf: 'a.ply'});
  for (const {distanceToTriangles, distanceToSolid, summary} of [pieces, balls, hull]) {
    assert.ok(distanceToTriangles > distanceToSolid && distanceToTriangles > 0.49);
    assert.match(summary.join('\n'), /; its openings count as closed, and from its triangles alone it is at most [\d.]+\n/);
    assert.match(summary.at(-1), /^certified: yes, .* covers every triangle of the original/);
  }
  assert.match(pieces.summary.at(-1), /, and its inside with its openings closed by 2 faces$/);
  assert.match(balls.summary[1], /^volume: .* more than the solid's$/);
  const flat = await prohull.convexPieces({vertices: [0, 0, 0, 1, 0, 0, 0, 1, 0], faces: [0, 1, 2]}, {pieces: 1});
  assert.ok(!('distanceToSolid' in flat) && flat.distanceToTriangles < 0.1);
});

test('coordinates for STL are those of every level, the finest included', async () => {
  const part = ball(500), hull = await prohull.build(part, 60, {levels: true});
  for (const faces of [200, Infinity]) {
    const level = await prohull.level(hull.levels, faces, {float32Coordinates: true});
    await prohull.write(level, 'a.stl');
    assert.ok((await prohull.verify(level, part)).holds);
  }
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
  const turned = {vertices: cube.vertices, faces: [...cube.faces].reverse()};
  assert.deepEqual((await prohull.inspect(turned)).defects, {'mesh inside out': 1});
  assert.deepEqual((await prohull.inspect(cube)).defects, {});
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
  await refused(prohull.write(third, 'a.stl'), /float32Coordinates/);
  const zip = new Uint8Array([0x50, 0x4b, 3, 4]), xml = new TextEncoder().encode('<?xml version="1.0"?>');
  await refused(prohull.read(zip, 'a.zip'), /a.zip: a zip archive, which is not read here; take the file out of it/);
  for (const [bytes, name] of [[zip, 'a.3mf'], [xml, 'a.fbx']]) await refused(prohull.read(bytes, name), /only the program prohull reads/);
  await refused(prohull.read(new TextEncoder().encode('ISO-10303-21;'), 'a.step'), /export it as STL/);
  await refused(prohull.read(xml, 'a.urdf'), /it is a robot and no mesh/);
  const two = [{...cube, name: 'a'}, {...third, name: 'b'}], text = new TextDecoder().decode(await prohull.writeSeveral(two, 'a.obj'));
  assert.deepEqual(text.match(/^o .*/gm), ['o a', 'o b']);
  await refused(prohull.writeSeveral(two, 'a.ply'), /hold one mesh each/);
  await refused(prohull.writeSeveral([], 'a.obj'), /meshes: there is none/);
  for (const balls of [[1, 2, 3, NaN], [1, 2, 3, -1], [1, 2, 3, 4, 5]]) {
    await refused(prohull.spheresJson(balls, 'a'), /balls: expected finite numbers/);
    await refused(prohull.scene({name: 'a', balls}, null), /balls: expected finite numbers/);
  }
  await refused(prohull.certificate(cube, await prohull.write(cube, 'a.glb'), 'a.glb'), /a.glb: prohull_check reads/);
  await refused(prohull.read(new TextEncoder().encode('hello'), 'a.txt'), /give it the suffix of its format$/);
  assert.deepEqual(JSON.parse(new TextDecoder().decode(await prohull.spheresJson([1, 2, 3, 4], 'a'))),
    {link: 'a', spheres: [{center: [1, 2, 3], radius: 4}]});
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
  assert.ok(hull.distanceToTriangles > 0 && hull.distanceToTriangles < 0.2);
  const unrounded = await prohull.build(part, 200, {summaryOf: 'hull.stl'}).catch((error) => error);
  assert.match(unrounded.message, /float32|STL|stl/);
  const {diagonal} = await prohull.inspect(part);
  assert.equal(await prohull.length('1%', part), diagonal / 100);
  assert.equal(await prohull.length('0.25', part), 0.25);
  await refused(prohull.length('1mm', part), /1mm: expected a number/);
  await refused(prohull.length('wide', part), /wide: expected a number/);
  await refused(prohull.sample('cow', 2000), /cow/);
  const bytes = await prohull.write(part, 'part.ply');
  const certificate = await prohull.certificate(hull, bytes, 'part.ply', {distance: hull.distanceToTriangles});
  assert.deepEqual(await prohull.certificate(hull, gzipSync(bytes), 'part.ply.gz', {distance: hull.distanceToTriangles}), certificate);
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
  await refused(prohull.build({vertices, faces: new BigUint64Array(0)}), /array of numbers/);
  await refused(prohull.build({vertices: new BigInt64Array(3), faces: [0, 0, 0]}), /array of numbers/);
  await refused(prohull.verify(cube, {vertices: [], faces: []}), /./);
  for (const targets of [0, -1, 2.5, NaN, [8, 3]]) await refused(prohull.build(cube, targets), /targetFaces=.*: expected a whole number, at least 4/);
  for (const targets of ['8', [], [8, 'x']]) await refused(prohull.build(cube, targets), /./);
  assert.equal((await prohull.build(cube, new Uint32Array([12, 8]))).length, 2);
  for (const faces of [-5, 2.7, NaN]) await refused(prohull.sample('torus', faces), /faces=.*: expected a whole number, at least 4/);
  for (const faces of [5e8, 1e10]) await refused(prohull.sample('torus', faces), /faces=.*: expected a whole number, at most 20000000/);
  assert.ok((await prohull.build(cube, 12, {seed: 5e9})).certified);
  await refused(prohull.build(cube, 8, {bestOf: 1e10}), /bestOf=10000000000: expected a whole number, at most 4294967295/);
  await refused(prohull.build(cube, 8, {gap: Infinity}), /the gap is inf/);
  await refused(prohull.build(cube, 8, {maxNormalDeviationDegrees: -10}), /between 0 and 90 degrees/);
  await refused(prohull.build(cube, 8, {threads: 4}), /threads: there is no such option/);
  await refused(prohull.build(cube, 8, {tigth: true}), /tigth: there is no such option, only .*tight/);
  await refused(prohull.build(cube, 8, {tight: 1}), /tight=1: expected true or false/);
  await refused(prohull.build(cube, 8, {side: 'left'}), /side=left: expected one of outer, inner/);
  await refused(prohull.build(cube, 8, {maxDistance: -1}), /maxDistance=-1: expected a number, at least 0/);
  await refused(prohull.build(cube, 8, {gap: '1'}), /gap=1: expected a number/);
  await refused(prohull.build(cube, 8, {bestOf: 0.5}), /bestOf=0.5: expected a whole number/);
  await refused(prohull.build(cube, 8, {tolerances: [1]}), /./);
  await refused(prohull.build(cube, 8, {side: () => 0}), /no functions or proxies/);
  await refused(prohull.build(new Proxy(cube, {}), 8), /no functions or proxies/);
  await refused(prohull.convexPieces(cube, {pieces: 0}), /pieces=0: expected a whole number, at least 1/);
  assert.ok((await prohull.build(cube, 12)).certified, 'and the next call is done');
});

test('what is no option is said, by a rejected promise', async () => {
  for (const options of [null, 5, [], 'abc']) {
    await refused(prohull.build(cube, 8, options), /options: expected an object/);
    await refused(prohull.inspect(cube, options), /options: expected an object/);
    await refused(prohull.read(new Uint8Array(3), 'a.stl', options), /options: expected an object/);
  }
  await refused(prohull.inspect(cube, {x: 1}), /x: there is no such option, only signal and progress/);
  await refused(prohull.build(cube, 8, {signal: 5}), /signal: expected an AbortSignal/);
  await refused(prohull.build(cube, 8, {progress: {}}), /progress: expected a function/);
  await refused(prohull.level({}, 5), /levels.positions: expected an array of numbers/);
  await refused(prohull.scene(null, null), /original: expected an object with vertices and faces/);
  await refused(prohull.scene(null, cube), /original.name: expected a text/);
  await refused(prohull.read(new Uint8Array(3)), /name: expected a text/);
  assert.ok((await prohull.scene({...cube, name: 'hull'}, {...cube, name: 'part'})).blocks.length > 0, 'plain arrays are a mesh');
});

test('a progress that throws rejects the call, and the next one is done', async () => {
  const broken = new Error('mine');
  await assert.rejects(prohull.build(ball(2000), 100, {progress: () => { throw broken; }}), broken);
  assert.ok((await prohull.build(cube, 12)).certified);
});

test('a worker that was ended while its result was under way is not used again', {timeout: 60000}, async () => {
  const stop = new AbortController(), built = prohull.build(ball(200), 100, {signal: stop.signal});
  await Promise.all([assert.rejects(built, {name: 'AbortError'}), (async () => {
    await new Promise((resolve) => setTimeout(resolve, 10));
    for (const began = Date.now(); Date.now() - began < 1500;);  // the result arrives, and nobody reads it
    stop.abort();
  })()]);
  await new Promise((resolve) => setTimeout(resolve, 200));
  assert.ok((await prohull.build(cube, 12)).certified);
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

test('a library that cannot be started is an error, and no call without an end', {timeout: 10000}, async () => {
  const other = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 2, 7, 1, 1, 120, 1, 121, 0, 0);  // imports a function that is not there
  await assert.rejects(loadEngine(await WebAssembly.compile(other)), TypeError);
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

// The module and the program make the same bits: of each mesh, with several options, the bytes of the files they write.
import assert from 'node:assert/strict';
import {existsSync, readdirSync, readFileSync, writeFileSync} from 'node:fs';
import {basename, join} from 'node:path';
import test from 'node:test';
import {bytesOf, collada, engine, hasImporter, hasProgram, run, sample, scratch} from './package.mjs';

const models = process.env.PROHULL_MODELS;

/** Options of a build for the module and for the program; `diagonal` is that of the mesh. */
const builds = [
  ['default', 300, () => ({}), () => []],
  ['tight', 100, () => ({tight: true}), () => ['--tight']],
  ['inner', 200, () => ({side: 'inner'}), () => ['--side', 'inner']],
  ['gap', 200, (diagonal) => ({gap: diagonal / 128}), (diagonal) => ['--gap', String(diagonal / 128)]],
  ['distance', 50, (diagonal) => ({maxDistance: diagonal / 64}), (diagonal) => ['--max-distance', String(diagonal / 64)]],
  ['stl', 200, () => ({float32Coordinates: true}), () => [], '.stl'],
  ['best of 2', 200, () => ({bestOf: 2, seed: 7}), () => ['--best-of', '2', '--seed', '7']],
];

function isSame(made, written, name) {
  const native = bytesOf(written);
  assert.equal(made !== undefined, native !== undefined, `${name}: one of the two has certified its hull, the other has not`);
  if (native) assert.ok(Buffer.compare(Buffer.from(made), native) === 0, `${name}: other bits`);
}

/** What the module writes; nothing if it does not certify, or refuses, as the program does then. */
function attempt(work) {
  try {
    return work();
  } catch (error) {
    if (error.name !== 'InputError') throw error;
  }
}

function compareBuild(file, mesh, [what, faces, options, args, suffix = '.ply'], name) {
  const {diagonal} = engine.inspect(mesh), written = join(scratch, `${name}_${what.replaceAll(' ', '_')}${suffix}`);
  const made = attempt(() => {
    const hull = engine.build(mesh, faces, options(diagonal));
    return hull.certified ? engine.write(hull, written) : undefined;
  });
  try {
    run('build', file, '-o', written, '--faces', String(faces), ...args(diagonal));
  } catch (error) {
    if (made) throw error;
  }
  isSame(made, written, `${name}, ${what}`);
}

function comparePieces(file, mesh, name) {
  const cover = engine.convexPieces(mesh, {pieces: 6});
  const report = join(scratch, `${name}_pieces.json`);
  run('convex', file, '-o', join(scratch, `${name}_piece.ply`), '--pieces', '6', '--report', report);
  assert.equal(JSON.parse(readFileSync(report)).verdict.certified, cover.certified);
  if (!cover.certified) return;
  const written = readdirSync(scratch).filter((f) => f.startsWith(`${name}_piece_`)).sort();
  assert.equal(written.length, cover.pieces.length, `${name}: number of pieces`);
  cover.pieces.forEach((piece, i) => isSame(engine.write(piece, written[i]), join(scratch, written[i]), `${name}, piece ${i}`));
}

function compareSpheres(file, mesh, name) {
  const cover = engine.spheres(mesh, {count: 6});
  const written = join(scratch, `${name}.json`), report = join(scratch, `${name}_spheres.json`);
  run('spheres', file, '-o', written, '--count', '6', '--report', report);
  const native = JSON.parse(readFileSync(report)).spheres.flatMap(({center, radius}) => [...center, radius]);
  assert.deepEqual([...cover.balls], native, `${name}: spheres`);
}

async function compare(t, file, what) {
  const name = basename(file).replace(/\..*/, '');
  const mesh = await engine.read(readFileSync(file), basename(file));
  for (const build of builds)
    if (what(build[0])) await t.test(`${name}: ${build[0]}`, () => compareBuild(file, mesh, build, name));
  if (what('pieces')) await t.test(`${name}: convex pieces`, () => comparePieces(file, mesh, name));
  if (what('spheres')) await t.test(`${name}: spheres`, () => compareSpheres(file, mesh, name));
}

for (const name of ['sphere', 'torus', 'knot', 'asteroid', 'box', 'bracket', 'gyroid', 'pony'])
  test(`sample ${name}`, {skip: !hasProgram && 'there is no program to compare with'},
    (t) => compare(t, sample(name, 1500), () => true));

test('COLLADA', {skip: !hasImporter && 'there is no program that reads it'}, async (t) => {
  const file = join(scratch, 'brackets.dae');
  writeFileSync(file, collada);
  const {vertices, faces, inMetres} = await engine.read(readFileSync(file), 'brackets.dae');
  assert.deepEqual([vertices.length / 3, faces.length / 3, inMetres], [24, 40, true]);
  await compare(t, file, (what) => what === 'default' || what === 'stl');  // a hull of 300 faces is the mesh itself
});

test('distances of a summary, down to their rounding', {skip: !hasProgram && 'there is no program to compare with'}, async () => {
  const file = sample('torus', 2000), mesh = await engine.read(readFileSync(file), 'torus.ply'), report = join(scratch, 'far.json');
  for (const faces of [5000, 100]) {
    run('build', file, '-o', join(scratch, 'far.ply'), '--faces', String(faces), '--report', report);
    assert.equal(engine.build(mesh, faces, {summaryOf: 'far.ply'}).distanceToTriangles, JSON.parse(readFileSync(report)).hull.verdict.distance_to_triangles.upper);
  }
});

const hasModels = models !== undefined && existsSync(models);
test('models', {skip: !(hasModels && hasProgram) && 'PROHULL_MODELS names no folder'}, async (t) => {
  for (const file of readdirSync(models).filter((f) => /\.(obj|off|stl|ply|dae)(\.gz)?$/.test(f))) {
    const [, faces] = /_(\d+)/.exec(file) ?? [];
    const isLarge = !(Number(faces) < 60000);
    await compare(t, join(models, file), (what) => what === 'default' || (what === 'stl' && !isLarge));
  }
});

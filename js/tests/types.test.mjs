// The declarations of the package compile, and a program that keeps to them does, too.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {cpSync, mkdirSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import {folder, scratch} from './package.mjs';

const kCompiler = 'typescript@5.9.2';
const kProgram = `
import {build, certificate, InputError, length, level, read, readLevels, sample, scene, spheresJson, write, writeLevels, writeSeveral, type Hull, type Levels} from 'prohull';
import {loadEngine, type Engine} from 'prohull/engine';
const stop = new AbortController();
const part = await read(new Uint8Array(84), 'part.stl', {signal: stop.signal});
const hull: Hull = await build(part, 500, {tight: true, maxDistance: await length('1%', part), summaryOf: 'hull.stl',
  signal: stop.signal, progress: (stage, fraction) => console.log(stage.length + fraction)});
const lines: string[] = hull.summary ?? [], hulls: Hull[] = await build(await sample('knot'), [500, 50]);
const levels: Levels | undefined = hull.levels;
if (levels) await level(await readLevels(await writeLevels(levels), 'a.phull', {signal: stop.signal}));
const told: string[] | undefined = levels && (await level(levels, 500, {summaryOf: 'a.stl'})).summary;
await length('5mm', await read(new Uint8Array(84), 'part.stl', {unit: 'mm'}), {inMetres: true});
if (levels) await write(await level(levels, 2000, {float32Coordinates: true, signal: stop.signal}), lines[0] ?? 'hull.stl');
const proof: Uint8Array = await certificate(hull, new Uint8Array(84), 'part.stl', {isStl: true, side: 'outer'});
const files: Uint8Array[] = [await writeSeveral([{...part, name: 'a'}], 'a.obj'), await spheresJson([0, 0, 0, 1], 'a')];
const {facts, blocks} = told ? await scene({levels: levels!, name: 'a'}, null) : await scene({...hulls[0]!, name: 'hull'}, {...part, name: 'part'}, {side: 'inner'});
const engine: Engine = await loadEngine(new WebAssembly.Module(proof as BufferSource));
const found = engine.inspect(part).defects['open edges'] ?? facts.length + blocks.length + files.length;
if (new InputError('') instanceof Error && found > 0) engine.write(engine.level(levels!, 10), 'a.ply');
// @ts-expect-error: there is no such option
await build(part, 500, {tigth: true});
// @ts-expect-error: nor such a side
await build(part, 500, {side: 'left'});
// @ts-expect-error: what runs on this thread has no signal
await engine.certificate(hull, new Uint8Array(84), 'part.stl', {signal: stop.signal});
`;

const project = join(scratch, 'types');

/** Why the compiler is not there; undefined if it is. */
function missing() {
  mkdirSync(project);
  writeFileSync(join(project, 'package.json'), '{"name": "types", "private": true, "type": "module"}');
  try {
    execFileSync('npm', ['install', kCompiler, '--no-audit', '--no-fund', '--prefer-offline', '--fetch-retries=0'], {cwd: project, stdio: 'pipe'});
  } catch (error) {
    return `npm cannot fetch ${kCompiler}: ${String(error.stderr ?? error).split('\n')[0]}`;
  }
}

test('the types compile', {skip: missing() ?? false}, () => {
  cpSync(folder, join(project, 'node_modules/prohull'), {recursive: true});
  writeFileSync(join(project, 'main.ts'), kProgram);
  writeFileSync(join(project, 'tsconfig.json'), JSON.stringify({compilerOptions: {strict: true, noEmit: true, noUncheckedIndexedAccess: true,
    module: 'nodenext', target: 'es2022', lib: ['es2022', 'dom'], types: []}, files: ['main.ts']}));
  try {
    execFileSync('node', ['node_modules/typescript/bin/tsc', '-p', '.'], {cwd: project, encoding: 'utf8', stdio: 'pipe'});
  } catch (error) {
    assert.fail(error.stdout);
  }
});

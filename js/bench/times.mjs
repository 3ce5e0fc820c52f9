// Time of the module in node against the program, both with one thread, in the same run: the best of three, of building and verifying.
//   node js/bench/times.mjs build/release/bin/prohull build/wasm/js/package [MESH...]
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {basename, join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

const [program, folder, ...meshes] = process.argv.slice(2);
const part = (name) => import(pathToFileURL(join(resolve(folder), name)));
const {wasmModule} = await part('platform_node.js');
const {loadEngine} = await part('engine.js');
const engine = await loadEngine(await wasmModule());
const scratch = mkdtempSync(join(tmpdir(), 'prohull-times-'));
process.on('exit', () => rmSync(scratch, {recursive: true}));

const kRuns = 3;
const least = (time) => Math.min(...Array.from({length: kRuns}, time));

function nativeSeconds(file, args) {
  const report = join(scratch, 'report.json');
  const rest = ['-o', join(scratch, 'hull.ply'), '--threads', '1', '--report', report, '--quiet'];
  execFileSync(program, ['build', file, ...args, ...rest]);
  const {seconds} = JSON.parse(readFileSync(report));
  return seconds.repair + seconds.build + seconds.verify;
}

function moduleSeconds(mesh, faces, options) {
  const begin = performance.now();
  engine.build(mesh, faces, options);
  return (performance.now() - begin) / 1000;
}

const samples = [['knot', 20000], ['pony', 100000], ['bracket', 20000]].map(([name, faces]) => {
  const file = join(scratch, `${name}.ply`);
  execFileSync(program, ['sample', name, '--faces', String(faces), '-o', file, '--quiet']);
  return file;
});
console.log('| mesh | faces | hull | native, s | node, s | node / native |\n|---|---|---|---|---|---|');
for (const file of [...samples, ...meshes]) {
  const mesh = await engine.read(readFileSync(file), basename(file));
  for (const [what, options, args] of [['500 faces', {}, []], ['500 faces, tight', {tight: true}, ['--tight']]]) {
    const native = least(() => nativeSeconds(file, ['--faces', '500', ...args]));
    const node = least(() => moduleSeconds(mesh, 500, options));
    const row = [basename(file).replace(/[_.].*/, ''), mesh.faces.length / 3, what, native.toFixed(2), node.toFixed(2), (node / native).toFixed(2)];
    console.log(`| ${row.join(' | ')} |`);
  }
}

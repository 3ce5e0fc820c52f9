// What tests share: the package that was built, and the program that was built.
import {execFileSync} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';

export const folder = process.env.PROHULL_PACKAGE;
const program = process.env.PROHULL;

const part = (name) => import(pathToFileURL(join(folder, name)));

export const prohull = await part('index.js');
const {wasmModule} = await part('platform_node.js');
const {loadEngine} = await part('engine.js');
export const engine = await loadEngine(await wasmModule());
export {loadEngine, wasmModule};

export const hasProgram = program !== undefined && existsSync(program);

/** Runs the program; true unless its exit code is 1, an answer of no. */
export function run(...args) {
  try {
    execFileSync(program, [...args, '--quiet'], {stdio: ['ignore', 'ignore', 'pipe']});
    return true;
  } catch (error) {
    if (error.status !== 1) throw new Error(`prohull ${args.join(' ')}: ${error.stderr}`);
    return false;
  }
}

export const scratch = mkdtempSync(join(tmpdir(), 'prohull-js-'));
process.on('exit', () => rmSync(scratch, {recursive: true, force: true}));

export function sample(name, faces) {
  const file = join(scratch, `${name}_${faces}.ply`);
  if (!existsSync(file)) run('sample', name, '--faces', String(faces), '-o', file);
  return file;
}

export const bytesOf = (file) => (existsSync(file) ? readFileSync(file) : undefined);

export const cube = {
  vertices: [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1],
  faces: [0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7],
};

// What tests share: the package that was built, and the program that was built.
import {execFileSync} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
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
export const hasImporter = hasProgram && existsSync(join(dirname(program), 'prohull-import'));

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

/** Two brackets in inches, one of them a mirror image: of polygons that are not convex, in nodes within each other. */
export const collada = `<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="inch" meter="0.0254"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="bracket"><mesh>
<source id="at"><float_array id="numbers" count="36">0 0 0 3.1415926 0 0 3.1415926 1.0625e0 0 1.3 1.0625e0 0 1.3 2.7182818 0 0 2.7182818 0
0 0 7.77e-1 3.1415926 0 .777 3.1415926 1.0625 .777 1.3 1.0625 .777 1.3 2.7182818 .777 0 2.7182818 .777</float_array>
<technique_common><accessor source="#numbers" count="12" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="corners"><input semantic="POSITION" source="#at"/></vertices>
<polylist count="2"><input semantic="VERTEX" source="#corners" offset="0"/><vcount>6 6</vcount><p>5 4 3 2 1 0 6 7 8 9 10 11</p></polylist>
<polygons count="6"><input semantic="VERTEX" source="#corners" offset="0"/><!-- the sides -->
<p>0 1 7 6</p><p>1 2 8 7</p><p>2 3 9 8</p><p>3 4 10 9</p><p>4 5 11 10</p><p>5 0 6 11</p></polygons>
</mesh></geometry></library_geometries>
<library_nodes><node id="again"><scale>-1 1 1.1</scale><instance_geometry url="#bracket"/></node></library_nodes>
<library_visual_scenes><visual_scene id="scene"><node><translate>0.1 -3 1e-3</translate><rotate>0.6 0.8 0 13.7</rotate>
<instance_geometry url="#bracket"><bind_material/></instance_geometry>
<node><matrix>1 0 0 -.3 0 1 0 0.003 0 0 1 0 0 0 0 1</matrix><instance_node url="#again"/></node></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>`;

export const cube = {
  vertices: [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1],
  faces: [0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7],
};

// What the page holds, as meshes that can be drawn: `levels`, `robot` or `mesh` of each object of the scene.

import {ballsMesh} from './balls.js';
import {numbers} from './blocks.js';
import {breathe} from './breathe.js';
import {Levels} from './levels.js';
import {partsOf} from './parts.js';
import {Robot} from './robot.js';
import {Space} from './space.js';

/** Points of an object as steps of the grid, and how far it reaches around them. */
async function stepsOf(object, bytes) {
  await breathe();
  if (object.kind === 'levels') return [(object.levels = await Levels.read(object, bytes)).steps];
  if (object.kind === 'robot') {
    object.robot = new Robot(object);
    return [numbers(bytes, object.corners)];
  }
  if (object.kind === 'mesh') return [numbers(bytes, object.positions)];
  return [numbers(bytes, object.centers), numbers(bytes, object.radii)];
}

function place(object, [steps, around], space, bytes) {
  if (object.levels) return object.levels.place(space);
  if (object.kind === 'balls') object.mesh = ballsMesh(space.drawn(steps), space.lengths(around));
  else if (object.kind === 'mesh') object.mesh = {positions: space.drawn(steps), triangles: numbers(bytes, object.triangles)};
  if (object.mesh && object.role !== 'original') Object.assign(object.mesh, partsOf(object.mesh));
}

/** Reads all objects; returns where they are drawn. */
export async function readObjects({objects, grid}, bytes) {
  const all = [];
  for (const object of objects) all.push(await stepsOf(object, bytes));
  const space = new Space(grid, all);
  for (const [i, object] of objects.entries()) {
    await breathe();
    place(object, all[i], space, bytes);
  }
  return space;
}

// Opens the page: reads its scene and shows it.

import {readBlocks} from './data/blocks.js';
import {breathe} from './data/breathe.js';
import {readObjects} from './data/objects.js';
import {byId} from './panel/dom.js';
import {View} from './view.js';

async function open() {
  await breathe();
  const scene = JSON.parse(byId('scene').textContent);
  const bytes = await readBlocks(byId('blocks').textContent);
  byId('blocks').remove();
  const space = await readObjects(scene, bytes);
  await breathe();
  globalThis.prohullView = new View(scene, space, bytes);  // for the browser's console, and for tests
  byId('message').hidden = true;
  document.documentElement.dataset.ready = 'yes';
}

open().catch((error) => {
  byId('message').hidden = false;
  byId('message').textContent = `This page cannot be shown: ${error.message}`;
  document.documentElement.dataset.ready = 'no';
  console.error(error);
});

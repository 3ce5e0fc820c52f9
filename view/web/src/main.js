// Opens the page: reads its scene and shows it.

import {readBlocks} from './data/blocks.js';
import {byId} from './panel/dom.js';
import {View} from './view.js';

async function open() {
  const scene = JSON.parse(byId('scene').textContent);
  const bytes = await readBlocks(byId('blocks').textContent);
  byId('blocks').remove();
  globalThis.prohullView = new View(scene, bytes);  // for the browser's console, and for tests
  byId('message').hidden = true;
  document.documentElement.dataset.ready = 'yes';
}

open().catch((error) => {
  byId('message').hidden = false;
  byId('message').textContent = `This page cannot be shown: ${error.message}`;
  document.documentElement.dataset.ready = 'no';
  console.error(error);
});

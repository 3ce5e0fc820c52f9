// What is dropped or chosen, as a map from paths to functions that read the files. Nothing is read before it is needed.

import {unzipSync} from 'fflate';
import {InputError} from 'prohull';
import {tidied} from './places.js';

export const MOST_MEGABYTES = 500;
const MOST_FILES = 20000, MOST_PACKAGE_XML = 2 ** 20;

export function refuseLarge(name, bytes) {
  const megabytes = Math.ceil(bytes / 1e6);
  if (megabytes > MOST_MEGABYTES)
    throw new InputError(`${name} has ${megabytes.toLocaleString('en')} MB, and this page takes files of at most ${MOST_MEGABYTES} MB. The program prohull takes larger ones.`);
}

export async function bytesOf(file) {
  refuseLarge(file.name, file.size);
  try {
    return new Uint8Array(await file.arrayBuffer());
  } catch {
    throw new InputError(`${file.name}: it cannot be read.`);
  }
}

const refuseMany = (count) => {
  if (count > MOST_FILES) throw new InputError(`There are more than ${MOST_FILES.toLocaleString('en')} files. Drop the folder of one robot.`);
};

const OF_MACOS = /(^|\/)(__MACOSX\/|\._[^/]*$)/;  // with which it accompanies each file

/** Of files with their paths; paths that lead out are left out, and of two files with one path the first is taken. */
function treeOf(files) {
  const tree = new Map();
  for (const {path, size, read} of files) {
    const tidy = tidied(path.replaceAll('\\', '/'));
    if (tidy && !OF_MACOS.test(tidy) && !tree.has(tidy)) tree.set(tidy, {size, read});
  }
  return tree;
}

/** What an input or an old browser gives: files that may know their paths. */
export function treeOfFiles(files) {
  refuseMany(files.length);
  return treeOf([...files].map((file) => ({path: file.webkitRelativePath || file.name, size: file.size, read: () => bytesOf(file)})));
}

const entriesOf = (reader) => new Promise((resolve, reject) => reader.readEntries(resolve, reject));
const fileOf = (entry) => new Promise((resolve, reject) => entry.file(resolve, reject));

/** Of entries that were dropped; folders are looked through. */
export async function treeOfEntries(entries) {
  const left = [...entries], files = [];
  for (let entry; (entry = left.pop());) {
    if (entry.isFile) {
      const file = await fileOf(entry);
      files.push({path: entry.fullPath, size: file.size, read: () => bytesOf(file)});
      refuseMany(files.length);
    } else {
      const reader = entry.createReader();
      for (let some; (some = await entriesOf(reader)).length > 0;) left.push(...some);
    }
  }
  return treeOf(files);
}

function unzipped(name, bytes, filter) {
  try {
    return unzipSync(bytes, {filter});
  } catch (error) {
    throw error instanceof InputError ? error : new InputError(`${name}: it cannot be unpacked: ${error.message}`);
  }
}

/** Of an archive; a file is unpacked when it is read. */
export function treeOfZip(name, bytes) {
  const files = [];
  const readOf = (wanted, size) => async () => {
    refuseLarge(wanted, size);
    let isFound = false;
    return Object.values(unzipped(wanted, bytes, (file) => file.name === wanted && !isFound && (isFound = true)))[0];
  };
  unzipped(name, bytes, ({name: path, originalSize}) => {
    if (!path.endsWith('/')) files.push({path, size: originalSize, read: readOf(path, originalSize)});
    refuseMany(files.length);
    return false;
  });
  return treeOf(files);
}

/** The names that package.xml files tell, by their folders. */
export async function packagesOf(tree) {
  const packages = new Map();
  for (const [path, {size, read}] of tree) {
    if (!/(^|\/)package\.xml$/.test(path) || size > MOST_PACKAGE_XML) continue;
    const name = /<name>\s*([^<\s]+)\s*<\/name>/.exec(new TextDecoder().decode(await read()));
    if (name) packages.set(path.slice(0, -'package.xml'.length), name[1]);
  }
  return packages;
}

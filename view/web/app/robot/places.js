// Where the files are that a robot names: of a folder, only the paths of its files are known.

const folderOf = (path) => path.slice(0, path.lastIndexOf('/') + 1);

/** A path without "." and ".."; null if it leads out. */
export function tidied(path) {
  const parts = [];
  for (const part of path.split('/')) {
    if (part === '..' && parts.pop() === undefined) return null;
    if (part !== '' && part !== '.' && part !== '..') parts.push(part);
  }
  return parts.join('/');
}

function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

function common(a, b) {
  const left = a.split('/'), right = b.split('/');
  let count = 0;
  while (count < left.length && left[count] === right[count]) ++count;
  return count;
}

/** Of folders that end in a slash, those that share most of their path with the robot's. */
function nearest(folders, robot) {
  const most = Math.max(...folders.map((folder) => common(folder, folderOf(robot))));
  return folders.filter((folder) => common(folder, folderOf(robot)) === most);
}

/** A package is the folder of that name, or whose package.xml says it; else any folder without a package.xml that has the file. */
function inPackage(name, inside, {robot, paths, packages}) {
  const rest = tidied(inside);
  if (!name || !rest) return {why: 'expected package://PACKAGE/FILE, within the package'};
  const folders = [...paths].filter((path) => `/${path}`.endsWith(`/${rest}`)).map((path) => path.slice(0, path.length - rest.length));
  const isNamed = (folder) => `/${folder}`.endsWith(`/${name}/`) || packages.get(folder) === name;
  const named = folders.filter(isNamed), found = named.length > 0 ? nearest(named, robot) : folders.filter((folder) => !packages.has(folder));
  if (found.length === 1) return {path: found[0] + rest};
  return {why: found.length === 0 ? `there is no file ${rest} of the package ${name}` : `there are ${found.length} files that may be ${rest} of the package ${name}`};
}

/** {path} of the file that a robot names, or {why} it is not found. `packages` has the names that package.xml files tell, by their folders. */
export function placeOf(uri, tree) {
  const [, scheme = '', rest] = /^(?:([a-z][a-z0-9+.-]*):\/\/)?([\s\S]*)$/i.exec(uri);
  if (scheme && !['package', 'model'].includes(scheme)) return {why: `${scheme}:// is not read, only package://, model:// and relative paths`};
  if (!scheme && /^(\/|file:|[a-z]:)/i.test(rest)) return {why: 'it is a place on another machine: only package:// and relative paths are read'};
  let last;
  for (const way of [rest, decoded(rest)]) {
    if (scheme) {
      last = inPackage(way.split('/')[0], way.slice(way.split('/')[0].length), tree);
    } else {
      const path = tidied(folderOf(tree.robot) + way);
      last = path !== null && tree.paths.has(path) ? {path} : {why: path === null ? 'it leads out of the folder' : `there is no file ${path}`};
    }
    if (last.path !== undefined) break;
  }
  return last;
}

// app.html in headless Chromium, as a user has it: what is dropped, made, saved and refused.
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import {createHash} from 'node:crypto';
import {copyFileSync, cpSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {createServer} from 'node:http';
import {createRequire} from 'node:module';
import {basename, dirname, join, relative} from 'node:path';
import test from 'node:test';
import {app, inBrowser, kPatience} from './pages.mjs';
import {collada, hasImporter, hasProgram, run, scratch} from './package.mjs';

const cases = process.env.PROHULL_CASES, checker = process.env.PROHULL_CHECK;
const pictureFile = process.env.PROHULL_PICTURE;  // where the picture of docs/browser.md goes, if it is to be made
const kTypes = {'.js': 'text/javascript', '.html': 'text/html'};

const hash = (bytes) => createHash('sha256').update(bytes).digest('hex');

const {skip, opened, closed} = await inBrowser('app.html');

const text = (page, id) => page.evaluate((name) => document.getElementById(name).textContent, id);
const settled = (page, timeout = kPatience) => page.waitForFunction(() => document.documentElement.dataset.busy === 'no', null, {timeout});

/** Drops a file as the mouse does; returns after how many milliseconds its hull is shown. */
async function dropped(page, path) {
  const began = Date.now();
  const data = await page.evaluateHandle(([base64, name]) => {
    const transfer = new DataTransfer(), bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    transfer.items.add(new File([bytes], name));
    return transfer;
  }, [readFileSync(path).toString('base64'), basename(path)]);
  await page.dispatchEvent('#stage', 'drop', {dataTransfer: data});
  await settled(page);
  return Date.now() - began;
}

async function saved(page, id) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.click(`#${id}`)]);
  const path = join(scratch, download.suggestedFilename());
  await download.saveAs(path);
  return {path, bytes: readFileSync(path)};
}

/** Has a shell run the command lines that the page shows; returns the bytes of the file that was saved, as they write it. */
async function commanded(page, {path}) {
  rmSync(path);
  const PATH = `${dirname(process.env.PROHULL)}:${process.env.PATH}`;
  const {stderr} = spawnSync('sh', ['-c', await text(page, 'command')], {cwd: scratch, env: {...process.env, PATH}, encoding: 'utf8'});
  assert.ok(existsSync(path), stderr);
  return readFileSync(path);
}

function sampleFile(name, faces, as) {
  const path = join(scratch, as);
  if (!existsSync(path)) run('sample', name, '--faces', String(faces), '-o', path);
  return path;
}

test('a dropped part of 100,000 faces is a certified hull of 500, with the bytes of the program', {skip}, async () => {
  const page = await opened(), part = sampleFile('pony', 100000, 'part.stl');
  const milliseconds = await dropped(page, part);
  console.log(`a dropped STL of 100,000 faces is a hull of 500 after ${milliseconds} ms`);
  assert.equal(await text(page, 'problem'), '');
  assert.match(await text(page, 'found'), /^10\d,\d{3} faces, 1 component, diagonal .*; no defects\.$/);
  assert.match(await text(page, 'summary'), /outer hull of 500 faces, void [\d.]+ %, at most [\d.]+ from the mesh/);
  assert.match(await text(page, 'summary'), /certified: yes, the file as written encloses the original/);
  assert.equal(await text(page, 'command'), 'prohull build part.stl -o part_hull.stl --faces 500 --hierarchy part.phull');
  const hull = await saved(page, 'save'), own = hash(hull.bytes);
  assert.equal(own, hash(await commanded(page, hull)));
  const certificate = await saved(page, 'save-certificate');
  run('build', part, '-o', join(scratch, 'same.stl'), '--faces', '500', '--hierarchy', join(scratch, 'same.phull'), '--certificate', join(scratch, 'same.phcert'));
  assert.equal(hash(certificate.bytes), hash(readFileSync(join(scratch, 'same.phcert'))));
  if (existsSync(checker ?? '')) execFileSync(checker, [certificate.path, hull.path, part]);
  // The levels are there at once, and what is saved is the level that is shown.
  await page.fill('#wanted', '2000');
  await page.dispatchEvent('#wanted', 'change');
  await settled(page);
  assert.equal(await text(page, 'faces'), '2,000');
  assert.match(await text(page, 'save'), /2,000 faces/);
  const level = await saved(page, 'save');
  assert.equal(hash(level.bytes), hash(await commanded(page, level)));
  await page.waitForFunction(() => document.getElementById('distance').textContent.startsWith('≤'));
  assert.match(await page.evaluate(() => location.hash), /l=2000/);
  await closed(page);
});

test('the slider shows a level, which is saved, and the level box is that of the hull', {skip}, async () => {
  const page = await opened({fragment: '#sample=torus&faces=500'});
  await settled(page);
  await page.fill('#want-faces', '300');
  await page.press('#want-faces', 'Enter');
  await settled(page);
  assert.equal(await page.locator('#level').count(), 1);
  assert.equal(await text(page, 'faces'), '300');
  await page.evaluate(() => {
    const slider = document.getElementById('level');
    slider.value = 600;
    for (const type of ['input', 'change']) slider.dispatchEvent(new Event(type, {bubbles: true}));
  });
  await settled(page);
  const faces = await text(page, 'faces');
  assert.notEqual(faces, '300');
  assert.equal(await text(page, 'save'), `Save torus_hull.stl, ${faces} faces`);
  const level = await saved(page, 'save');
  assert.equal(String(level.bytes.readUInt32LE(80)), faces.replace(',', ''));
  assert.equal(hash(level.bytes), hash(await commanded(page, level)));
  const all = await saved(page, 'save-levels'), again = join(scratch, 'again.stl');
  assert.equal(basename(all.path), 'torus.phull');
  run('lod', all.path, '-o', again, '--faces', faces.replace(',', ''));
  assert.equal(hash(level.bytes), hash(readFileSync(again)));
  await page.setChecked('#want-levels', false);
  await settled(page);
  assert.equal(await page.locator('#level').count(), 0);
  assert.ok(await page.isHidden('#save-levels'));
  assert.equal((await text(page, 'command')).split('\n')[1], 'prohull build torus.ply -o torus_hull.stl --faces 300');
  const hull = await saved(page, 'save');
  assert.equal(hash(hull.bytes), hash(await commanded(page, hull)));
  assert.match(await page.evaluate(() => location.hash), /levels=0/);
  await page.selectOption('#want-make', 'spheres');
  await settled(page);
  assert.equal(await page.locator('#level').count(), 0);
  await closed(page);
});

test('a dropped file of levels shows them, and tells of each what the command tells', {skip}, async () => {
  const page = await opened({fragment: '#make=spheres'}), part = sampleFile('bracket', 3000, 'bracket.stl'), all = join(scratch, 'core.phull');
  run('build', part, '-o', join(scratch, 'core.ply'), '--faces', '200', '--side', 'inner', '--hierarchy', all);
  const told = async () => {
    const lines = await page.locator('#summary li').allTextContents();
    const made = await saved(page, 'save'), own = execFileSync('sh', ['-c', (await text(page, 'command')).replace('prohull', '"$PROHULL"')], {cwd: scratch, encoding: 'utf8'});
    assert.equal(hash(made.bytes), hash(readFileSync(made.path)));
    assert.deepEqual(lines, own.trim().split('\n').map((line) => line.trim()));
    return lines;
  };
  await dropped(page, all);
  assert.match((await told())[0], /^core_level\.stl: 200 faces of 2,976$/);
  await page.selectOption('#want-to', 'ply');
  await settled(page);
  assert.equal(await text(page, 'problem'), '');
  assert.match(await text(page, 'found'), /^Levels of an inner hull, up to 2,976 faces\. The part that they were made of is not in the file: /);
  assert.match(await text(page, 'content'), /every level of .* is enclosed by the finest level; 1,\d{3} splits replayed/);
  assert.ok(await page.isVisible('#want-to') && await page.isHidden('#want-faces') && await page.isHidden('#save-levels') && await page.isHidden('#save-certificate'));
  assert.match((await told())[0], /^core_level\.ply: 200 faces of 2,976$/);
  assert.equal(await text(page, 'command'), 'prohull lod core.phull -o core_level.ply');
  await page.fill('#wanted', '701');
  await page.dispatchEvent('#wanted', 'change');
  await page.waitForFunction(() => document.getElementById('summary').textContent.includes('certified'));
  assert.match((await told())[0], /^core_level\.ply: 700 faces of 2,976$/);
  assert.equal(await text(page, 'command'), 'prohull lod core.phull -o core_level.ply --faces 700');
  await page.waitForFunction(() => document.getElementById('distance').textContent.startsWith('≤'));
  await page.selectOption('#want-to', 'obj');
  await settled(page);
  assert.match(await text(page, 'save'), /^Save core_level\.obj/);
  writeFileSync(all, readFileSync(all).subarray(0, 999));
  await dropped(page, all);
  assert.match(await text(page, 'problem'), /^core\.phull: it is truncated after 999 bytes/);
  await dropped(page, part);
  assert.ok(await page.isVisible('#want-count'), 'the form is as it was');
  await closed(page);
});

test('what the command refuses is refused, and names of parts are quoted', {skip}, async () => {
  const page = await opened(), part = join(scratch, '-a {faces}.stl');
  copyFileSync(sampleFile('bracket', 3000, 'bracket.stl'), part);
  await dropped(page, part);
  const made = await saved(page, 'save');
  assert.equal(hash(made.bytes), hash(await commanded(page, made)));
  for (const [make, name, value, says] of [
    ['hull', 'faces', '4294967295', 'Faces at most: it must be at most 1,000,000,000, not 4294967295'],
    ['hull', 'void', '0', 'Void at most, %: it must be greater than 0, not 0'],
    ['hull', 'gap', '0', 'Gap: it must be greater than 0, not 0'],
    ['pieces', 'count', '1e9', 'Number at most: it must be between 1 and 1,000, not 1e9'],
    ['spheres', 'distance', '0', 'Distance at most: it must be greater than 0, not 0']]) {
    await page.selectOption('#want-make', make);
    const before = await page.inputValue(`#want-${name}`);
    await page.fill(`#want-${name}`, value);
    await page.press(`#want-${name}`, 'Enter');
    await settled(page);
    assert.equal(await text(page, 'problem'), says);
    await page.fill(`#want-${name}`, before);
    await page.press(`#want-${name}`, 'Enter');
    await settled(page);
    assert.equal(await text(page, 'problem'), '');
  }
  await page.selectOption('#want-make', 'pieces');
  await page.fill('#want-distance', '0.0001');
  await page.press('#want-distance', 'Enter');
  await settled(page);
  assert.match(await text(page, 'summary'), /NOT within the bounds asked for/);
  await closed(page);
});

test('options make what the command line makes of them', {skip}, async () => {
  const page = await opened({fragment: '#sample=bracket&faces=200&distance=1%25&to=ply'});
  await settled(page);
  for (const [id, value] of [['side', 'inner'], ['side', 'outer'], ['tight', true], ['tight', false], ['gap', '0.05'], ['make', 'pieces'], ['to', 'obj'], ['to', 'glb'], ['make', 'spheres']]) {
    if (typeof value === 'boolean') await page.setChecked(`#want-${id}`, value);
    else if (id === 'gap') await page.fill(`#want-${id}`, value);
    else await page.selectOption(`#want-${id}`, value);
    if (id === 'gap') await page.press('#want-gap', 'Enter');
    await settled(page);
    assert.equal(await text(page, 'problem'), '', `${id}=${value}`);
    const made = await saved(page, 'save');
    if (value === 'pieces') assert(run('verify', '--union', made.path, join(scratch, 'bracket.ply')), value);
    else assert.equal(hash(made.bytes), hash(await commanded(page, made)), `${id}=${value}`);
  }
  assert.match(await page.evaluate(() => location.hash), /make=spheres.*distance=1%25.*gap=0\.05.*sample=bracket/);
  await closed(page);
});

test('the unit of the file, open shells and cavities are as the command has them, and stand in the address', {skip}, async () => {
  const plain = await opened();
  assert.ok(await plain.isHidden('#want-unit'), 'seldom options are folded, unless the address has them');
  await closed(plain);
  const page = await opened({fragment: '#shells=keep&unit=mm&cavities=1&faces=60&gap=5mm&to=obj'}), part = join(scratch, 'case.off');
  const cube = (least, most) => [...Array(8).keys()].map((i) => [i & 1, i >> 1 & 1, i >> 2].map((bit) => bit ? most : least).join(' ')).join('\n');
  const sides = [[0, 2, 3], [0, 3, 1], [0, 1, 5], [0, 5, 4], [1, 3, 7], [1, 7, 5], [3, 2, 6], [3, 6, 7], [2, 0, 4], [2, 4, 6], [4, 5, 7], [4, 7, 6]];
  const faces = (of, first) => of.map((side) => `3 ${side.map((v) => v + first).join(' ')}\n`).join('');
  writeFileSync(part, `OFF\n16 22 0\n${cube(0, 100)}\n${cube(40, 60)}\n${faces(sides.slice(0, 10), 0)}${faces(sides, 8)}`);
  await dropped(page, part);
  const made = async () => {
    assert.equal(await text(page, 'problem'), '');
    const hull = await saved(page, 'save'), own = hash(hull.bytes);
    assert.equal(own, hash(await commanded(page, hull)));
    return own;
  };
  const hulls = new Set([await made()]);
  assert.match(await text(page, 'found'), /diagonal 0\.173/);
  assert.equal(await text(page, 'command'), 'prohull build case.off -o case_hull.obj --unit mm --faces 60 --gap 5mm --open-shells keep --keep-cavities');
  const certificate = await saved(page, 'save-certificate');
  run('build', part, '-o', join(scratch, 'same.obj'), '--unit', 'mm', '--faces', '60', '--gap', '5mm', '--open-shells', 'keep', '--keep-cavities', '--certificate', join(scratch, 'same.phcert'));
  assert.equal(hash(certificate.bytes), hash(readFileSync(join(scratch, 'same.phcert'))));
  await page.selectOption('#want-shells', 'close');
  await settled(page);
  hulls.add(await made());
  assert.match(await page.evaluate(() => location.hash), /gap=5mm&unit=mm&cavities=1/);
  await page.fill('#want-gap', '');
  await page.press('#want-gap', 'Enter');
  await settled(page);
  hulls.add(await made());
  await page.setChecked('#want-cavities', false);
  await settled(page);
  hulls.add(await made());
  await page.selectOption('#want-unit', '');
  await settled(page);
  hulls.add(await made());
  assert.match(await text(page, 'found'), /diagonal 173/);
  await page.fill('#want-gap', '5mm');
  await page.press('#want-gap', 'Enter');
  await settled(page);
  assert.match(await text(page, 'problem'), /^5mm: expected a number in the unit of the mesh/);
  assert.equal(hulls.size, 5, 'each option changes the hull');
  await closed(page);
});

test('cancel answers at once', {skip}, async () => {
  const page = await opened();
  await page.setChecked('#want-tight', true);
  await page.setInputFiles('#file', sampleFile('pony', 100000, 'part.stl'));
  await page.waitForFunction(() => document.getElementById('stage-name').textContent === 'build');
  const milliseconds = await page.evaluate(async () => {
    const began = performance.now();
    document.getElementById('cancel').click();
    while (document.documentElement.dataset.busy === 'yes') await new Promise((resolve) => setTimeout(resolve));
    return performance.now() - began;
  });
  console.log(`cancel answers after ${milliseconds.toFixed(1)} ms`);
  assert.equal(await text(page, 'problem'), 'Cancelled.');
  await closed(page);
});

test('saving does not end what is made, and a result of other settings is marked', {skip}, async () => {
  const page = await opened(), isMarked = () => page.isVisible('#old');
  await page.setInputFiles('#file', sampleFile('pony', 100000, 'part.stl'));
  await settled(page);
  assert.ok(!await isMarked());
  await page.setChecked('#want-tight', true);
  await page.waitForFunction(() => document.getElementById('stage-name').textContent === 'build');
  assert.ok(await isMarked());
  const before = await saved(page, 'save');
  assert.equal(await page.evaluate(() => document.documentElement.dataset.busy), 'yes');
  await settled(page);
  assert.ok(!await isMarked());
  assert.match(await text(page, 'command'), /--tight/);
  assert.notEqual(hash((await saved(page, 'save')).bytes), hash(before.bytes));
  await page.fill('#want-faces', '3');
  await page.press('#want-faces', 'Enter');
  await settled(page);
  assert.ok(await isMarked());
  assert.equal(await text(page, 'age'), 'The result was made with other settings.');
  await page.fill('#want-faces', '400');
  await page.press('#want-faces', 'Enter');
  await page.click('#cancel');
  await settled(page);
  assert.ok(await isMarked());
  await page.click('#make');
  await settled(page);
  assert.ok(!await isMarked());
  assert.match(await text(page, 'summary'), /outer hull of 400 faces/);
  await closed(page);
});

test('distances from an open part are those that the commands tell', {skip}, async () => {
  const page = await opened({fragment: '#make=pieces&to=obj'}), part = join(scratch, 'open.off');
  writeFileSync(part, 'OFF\n8 10 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n' +
      [[0, 2, 1], [0, 3, 2], [0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7]].map((f) => `3 ${f.join(' ')}\n`).join(''));
  await dropped(page, part);
  for (const [make, command, args] of [['pieces', 'convex', ['--pieces', '16']], ['spheres', 'spheres', ['--count', '16']]]) {
    await page.selectOption('#want-make', make);
    await settled(page);
    const out = `open_${make}.${make === 'pieces' ? 'obj' : 'json'}`, lines = execFileSync(process.env.PROHULL, [command, part, '-o', out, ...args], {cwd: scratch, encoding: 'utf8'}).split('\n');
    for (const line of await page.locator('#summary li').allTextContents()) assert.ok(lines.some((own) => own.trim() === line), `${make}: ${line}`);
    assert.match(await text(page, 'summary'), /its openings count as closed, and from its triangles alone it is at most/);
  }
  await closed(page);
});

test('a level that was chosen just before another part is taken is not measured', {skip}, async () => {
  const page = await opened({fragment: '#sample=torus'});
  await settled(page);
  await page.evaluate(() => {
    const wanted = document.getElementById('wanted'), sample = document.getElementById('sample');
    wanted.value = 900;
    wanted.dispatchEvent(new Event('change'));
    sample.value = 'pony';
    sample.dispatchEvent(new Event('change'));
  });
  await settled(page);
  assert.equal(await text(page, 'problem'), '');
  await closed(page);
});

test('a part that was dropped is no sample, and one that is too large has no diagonal', {skip}, async () => {
  const page = await opened({fragment: '#sample=torus'});
  await settled(page);
  assert.equal(await page.inputValue('#sample'), 'torus');
  const part = join(scratch, 'far.obj');
  writeFileSync(part, 'v 0 0 1e200\nv 1 0 0\nv 0 1 0\nf 1 2 3\n');
  await dropped(page, part);
  assert.equal(await page.inputValue('#sample'), '');
  assert.match(await text(page, 'found'), /^1 face, 1 component, too large to be measured; /);
  await closed(page);
});

/** Drops a folder: entries as a browser makes them, which give what is in a folder piece by piece. */
async function droppedFolder(page, folder) {
  const files = readdirSync(folder, {recursive: true, withFileTypes: true}).filter((entry) => entry.isFile())
      .map((entry) => join(entry.parentPath ?? entry.path, entry.name))
      .map((path) => [relative(dirname(folder), path), readFileSync(path).toString('base64')]);
  await page.evaluate((given) => {
    const folderEntry = (path, inside) => {
      const names = [...new Set(inside.map(([name]) => name.split('/')[0]))];
      const left = names.map((name) => {
        const found = inside.find(([whole]) => whole === name), fullPath = `${path}/${name}`;
        if (!found) return folderEntry(fullPath, inside.filter(([whole]) => whole.startsWith(`${name}/`)).map(([whole, content]) => [whole.slice(name.length + 1), content]));
        const file = new File([Uint8Array.from(atob(found[1]), (c) => c.charCodeAt(0))], name);
        return {isFile: true, isDirectory: false, fullPath, file: (resolve) => resolve(file)};
      });
      const createReader = () => {
        const rest = [...left];
        return {readEntries: (resolve) => resolve(rest.splice(0, 2))};
      };
      return {isFile: false, isDirectory: true, fullPath: path, createReader};
    };
    const items = [{webkitGetAsEntry: () => folderEntry('', given)}];
    const event = new Event('drop', {bubbles: true, cancelable: true});
    document.getElementById('stage').dispatchEvent(Object.assign(event, {dataTransfer: {files: [], items}}));
  }, files);
}

const rows = (page) => page.evaluate(() => [...document.querySelectorAll('#links tr')].map((row) => [...row.cells].map((cell) => cell.textContent)));

/** Unpacks an archive into a folder; returns the paths of its files. */
function unpacked(bytes, folder) {
  const files = createRequire(import.meta.url)('fflate').unzipSync(bytes);
  for (const [name, content] of Object.entries(files)) {
    mkdirSync(dirname(join(folder, name)), {recursive: true});
    writeFileSync(join(folder, name), content);
  }
  return Object.keys(files);
}

test('several meshes become a hull each, told of and written as the command does', {skip}, async () => {
  const page = await opened({fragment: '#make=pieces&faces=100&void=200&distance=2%25'}), folder = join(scratch, 'parts');
  mkdirSync(folder, {recursive: true});
  run('sample', 'bracket', '--faces', '3000', '-o', join(folder, 'bracket.stl'));
  run('sample', 'torus', '--faces', '2000', '-o', join(folder, 'torus.ply'));
  writeFileSync(join(folder, 'open.off'), 'OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n');
  writeFileSync(join(folder, 'broken.obj'), 'v 1 2\nf 1 2 3\n');
  writeFileSync(join(folder, 'notes.txt'), 'x');
  await droppedFolder(page, folder);
  await settled(page);
  const table = () => page.evaluate(() => [...document.querySelectorAll('#several tr')].map((row) => [...row.cells].map((cell) => cell.textContent)));
  const compared = async () => {
    assert.equal(await text(page, 'problem'), '');
    const PATH = `${dirname(process.env.PROHULL)}:${process.env.PATH}`, own = join(scratch, 'hulls');
    rmSync(own, {recursive: true, force: true});
    const {stdout, stderr} = spawnSync('sh', ['-c', await text(page, 'several-command')], {cwd: scratch, env: {...process.env, PATH}, encoding: 'utf8'});
    const lines = stdout.trim().split('\n').map((line) => line.trim().split(/ {2,}/)), shown = await table();
    assert.deepEqual(shown[0].map((word) => word.toLowerCase()), lines[0]);
    for (const cells of lines.slice(1, -1)) assert.deepEqual(shown.find(([name]) => name === cells[0]), cells);
    assert.equal(shown.length, lines.length, 'the mesh that is not read has a row, and the last line is none of a mesh');
    const [, why] = shown.find(([name]) => name === 'broken.obj');
    assert.ok(stderr.includes(why), why);
    const made = join(scratch, 'zip'), zip = await saved(page, 'save-several');
    const names = unpacked(zip.bytes, made).sort();
    assert.deepEqual(names, readdirSync(own).sort());
    for (const name of names) assert.equal(hash(readFileSync(join(made, name))), hash(readFileSync(join(own, name))), name);
    return names;
  };
  assert.match(await text(page, 'found'), /^1 file of other kinds is left out\.$/);
  assert.deepEqual(await compared(), ['bracket.stl', 'open.stl', 'torus.stl']);
  assert.match((await table()).find(([name]) => name === 'open.off').at(-1), /^yes, with openings closed/);
  await page.click('#meshes tr:last-child button');
  await page.waitForSelector('#meshes tr:last-child button[aria-pressed=true]');
  assert.match(await text(page, 'content'), /torus\.stl encloses parts\/torus\.ply, exactly/);
  assert.ok(await page.isHidden('#want-levels') && await page.isHidden('#want-make') && await page.isVisible('#want-side'));
  await page.selectOption('#want-to', 'obj');
  await settled(page);
  await page.selectOption('#want-side', 'inner');
  await settled(page);
  assert.ok((await compared()).includes('torus.obj'));
  writeFileSync(join(folder, 'torus.off'), readFileSync(join(folder, 'open.off')));
  await page.setInputFiles('#file', ['torus.ply', 'torus.off'].map((name) => join(folder, name)));
  await settled(page);
  assert.equal(await text(page, 'problem'), 'torus.off and torus.ply: the hulls of both would be called torus.obj; rename one of them');
  await closed(page);
});

/** The folder of a robot of three links: a mesh, two meshes of which one is a mirror image in millimetres, and one that is not there. */
function robotFolder() {
  const folder = join(scratch, 'arm');
  run('sample', 'arm', '-o', folder);
  const names = ['base_link', 'link1', 'link2'], text = readFileSync(join(folder, 'arm.urdf'), 'utf8');
  writeFileSync(join(folder, 'arm.urdf'), text
      .replaceAll(/  <(link|joint) name="([^"]*)"[\s\S]*?<\/\1>\n/g, (whole, tag, name) =>
        (tag === 'link' ? names.includes(name) : /child link="link[12]"/.test(whole)) ? whole : '')
      .replace('"meshes/visual/link2_cover.stl"', '"package://arm/meshes/visual/link2_cover.stl" scale="1 -1 0.5"'));
  return folder;
}

test('the folder of a robot becomes a zip with a certified hull of each mesh, and a URDF that the command reads', {skip}, async () => {
  const page = await opened({fragment: '#faces=100'}), folder = robotFolder();
  await droppedFolder(page, folder);
  await page.waitForFunction(() => document.getElementById('stage-name').textContent.startsWith('mesh 2 of 4'));
  await page.click('#cancel');
  await settled(page);
  assert.equal(await text(page, 'problem'), 'Cancelled.');
  assert.ok(await page.isDisabled('#save-robot'));
  assert.equal(await text(page, 'age'), 'Nothing was made to the end.');
  await page.evaluate(() => new MutationObserver((records, observer) => {
    const button = document.querySelector('#links button');
    if (button) {
      observer.disconnect();
      button.click();  // does not end the work
    }
  }).observe(document.getElementById('links'), {childList: true}));
  await page.click('#make');
  await settled(page);
  assert.equal(await text(page, 'problem'), '');
  assert.equal(await text(page, 'found'), '3 links, 4 meshes.');
  const shown = await rows(page);
  assert.deepEqual(shown.map(([link, faces,,, certified]) => [link, faces, certified]),
    ['base_link', 'link1', 'link2', 'link2'].map((link) => [link, '100', 'yes']));
  await page.click('#links tr:last-child button');
  await page.waitForSelector('#links tr:last-child button[aria-pressed=true]');
  assert.match(await text(page, 'content'), /link2_2_hull\.stl covers every triangle of arm\/meshes\/visual\/link2_cover\.stl, exactly/);
  const zip = await saved(page, 'save-robot'), own = join(scratch, 'arm_own');
  assert.equal(basename(zip.path), 'arm_hulls.zip');
  run('urdf', join(folder, 'arm.urdf'), '-o', own, '--faces', '100', '--configurations', '0', '--prove', '0', '--no-pictures', '--no-cache');
  const old = readFileSync(join(folder, 'arm.urdf'), 'utf8'), hulls = ['base_link', 'link1', 'link2_2', 'link2'].map((name) => `meshes/collision/${name}_hull.stl`);
  assert.deepEqual(unpacked(zip.bytes, folder).sort(), ['arm.urdf', ...hulls, 'report.json']);
  const withoutCollisions = (urdf) => urdf.replaceAll(/\s*<collision>[^]*?<\/collision>/g, '');
  assert.equal(withoutCollisions(readFileSync(join(folder, 'arm.urdf'), 'utf8')), withoutCollisions(old));
  const report = JSON.parse(readFileSync(join(folder, 'report.json')));
  assert.deepEqual([report.left_out, report.links.map(({certified}) => certified)], [[], [true, true, true]]);
  for (const {file, read_from, scale, verdict} of report.links.flatMap((link) => link.hulls)) {
    assert.ok(verdict.holds);
    if (scale.every((x) => x === 1)) assert.ok(run('verify', join(folder, file), join(dirname(folder), read_from)), file);
  }
  for (const link of ['base_link', 'link1'])  // the command makes one hull of both meshes of link2
    assert.equal(hash(readFileSync(join(folder, `meshes/collision/${link}_hull.stl`))), hash(readFileSync(join(own, `meshes/collision/${link}.stl`))), link);
  assert.ok(run('urdf', '--check', join(folder, 'arm.urdf')));  // of the mirror image, too
  await closed(page);
});

test('the hulls of a robot are of its collision meshes, if the form says so', {skip}, async () => {
  const page = await opened({fragment: '#faces=60&from=collision'}), folder = join(scratch, 'two'), own = join(scratch, 'two_own');
  mkdirSync(folder);
  const mesh = (tag, file) => `<${tag}><geometry><mesh filename="${file}"/></geometry></${tag}>`;
  run('sample', 'bracket', '--faces', '3000', '-o', join(folder, 'seen.stl'));
  run('sample', 'torus', '--faces', '1000', '-o', join(folder, 'felt.stl'));
  writeFileSync(join(folder, 'two.urdf'), `<robot name="two"><link name="a">${mesh('visual', 'seen.stl')}${mesh('collision', 'felt.stl')}</link></robot>`);
  for (const [from, has] of [['collision', 'two/felt.stl'], ['visual', 'two/seen.stl']]) {
    await (from === 'collision' ? droppedFolder(page, folder) : page.selectOption('#want-from', from));
    await settled(page);
    assert.equal(await text(page, 'problem'), '');
    assert.match(await text(page, 'content'), new RegExp(`a_hull\\.stl encloses ${has}, exactly`));
    const files = createRequire(import.meta.url)('fflate').unzipSync((await saved(page, 'save-robot')).bytes);
    rmSync(own, {recursive: true, force: true});
    run('urdf', join(folder, 'two.urdf'), '-o', own, '--from', from, '--faces', '60', '--configurations', '0', '--prove', '0', '--no-pictures', '--no-cache');
    assert.equal(hash(files['meshes/collision/a_hull.stl']), hash(readFileSync(join(own, 'meshes/collision/a.stl'))), from);
    assert.equal(JSON.parse(Buffer.from(files['report.json'])).links[0].from, from);
  }
  assert.ok(!/from=/.test(await page.evaluate(() => location.hash)), 'the default needs no place in the address');
  await closed(page);
});

test('COLLADA is read as the command reads it, alone and of a robot', {skip: skip || (!hasImporter && 'there is no program that reads it')}, async () => {
  const page = await opened({fragment: '#faces=30&gap=1mm'}), folder = join(scratch, 'dae'), own = join(scratch, 'dae_own'), part = join(folder, 'part.dae');
  mkdirSync(folder);
  writeFileSync(part, collada);
  copyFileSync(part, join(scratch, 'part.dae'));
  await dropped(page, part);
  assert.equal(await text(page, 'problem'), '');
  const hull = await saved(page, 'save');
  assert.equal(hash(hull.bytes), hash(await commanded(page, hull)));
  assert.ok(await page.isHidden('#save-certificate'), 'prohull_check does not read it');
  writeFileSync(join(folder, 'a.urdf'), '<robot name="a"><link name="a"><visual><geometry><mesh filename="part.dae" scale="2 2 2"/></geometry></visual></link></robot>');
  await droppedFolder(page, folder);
  await settled(page);
  assert.equal(await text(page, 'left-out'), '');
  const files = createRequire(import.meta.url)('fflate').unzipSync((await saved(page, 'save-robot')).bytes);
  run('urdf', join(folder, 'a.urdf'), '-o', own, '--faces', '30', '--configurations', '0', '--prove', '0', '--no-pictures', '--no-cache');
  assert.equal(hash(files['meshes/collision/a_hull.stl']), hash(readFileSync(join(own, 'meshes/collision/a.stl'))));
  await closed(page);
});

test('a robot of a stranger stays harmless', {skip}, async () => {
  const {strToU8, zipSync} = createRequire(import.meta.url)('fflate'), page = await opened({fragment: '#faces=100&distance=5'});
  const tetrahedron = strToU8('v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n'), html = '<img src=x onerror=alert(1)>';
  const link = (name, file) => `<link name="${name.replaceAll('<', '&lt;')}"><visual><geometry><mesh filename="${file}"/></geometry></visual></link>`;
  const files = {'../up.obj': tetrahedron, '/etc/a.obj': tetrahedron, [`b/${html}.obj`]: tetrahedron, 'b/broken.stl': strToU8('x'), 'b/z.urdf': strToU8('<robot/>'), 'b/report.json': strToU8('{}'), '__MACOSX/b/._a.urdf': strToU8('x'), 'b/._d.urdf': strToU8('x'),
    [`b/${html}.urdf`]: strToU8(`<robot>${link('../../up', '../etc/a.obj')}${link(html, `${html.replaceAll('<', '&lt;')}.obj`)}${link('c', '../../up.obj')}${link('d', 'broken.stl')}${link('e', 'e.dae')}</robot>`)};
  const path = join(scratch, 'stranger.zip');
  writeFileSync(path, zipSync(files));
  await page.setInputFiles('#file', path);
  await settled(page);
  assert.equal(await text(page, 'problem'), '');
  assert.equal(await page.locator('img').count(), 0);
  assert.deepEqual((await rows(page)).map((cells) => [cells[0], cells.length > 2 ? cells[4] : cells[1].slice(0, 12)]),
    [['../../up', 'yes'], [html, 'yes'], ['d', 'b/broken.stl']]);
  assert.match(await text(page, 'left-out'), /^c keeps what it has: .*it leads out of the folder.*there is no file b\/e\.dae/);
  const zip = await saved(page, 'save-robot');
  const made = createRequire(import.meta.url)('fflate').unzipSync(zip.bytes);
  assert.deepEqual(Object.keys(made).sort(), ['_img src=x onerror=alert(1)_.urdf', 'meshes/collision/_.._.._up_hull.stl', 'meshes/collision/_img_src_x_onerror_alert_1___hull.stl', 'report.json']);
  assert.deepEqual(JSON.parse(Buffer.from(made['report.json'])).left_out.map((left) => left.link), ['c', 'd', 'e']);
  await page.selectOption('#robot-file', 'b/z.urdf');
  await settled(page);
  assert.match(await text(page, 'problem'), /^b\/z\.urdf: line 1: the robot has no links/);
  for (const [name, content, says] of [['noise.zip', Buffer.alloc(99), /^noise\.zip: it cannot be unpacked/], ['none.zip', zipSync({'a.txt': tetrahedron}), /^There is no \.urdf file/],
    ['mesh.zip', zipSync({'x/a.obj': tetrahedron, '__MACOSX/x/._a.obj': tetrahedron}), /^$/]]) {
    writeFileSync(join(scratch, name), content);
    await page.setInputFiles('#file', join(scratch, name));
    await settled(page);
    assert.match(await text(page, 'problem'), says, name);
  }
  assert.match(await text(page, 'summary'), /certified: yes/);
  await closed(page);
});

test('of a robot with dirty meshes it is told what is proven', {skip}, async () => {
  const {strToU8, zipSync} = createRequire(import.meta.url)('fflate'), page = await opened();
  const corners = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv nan 0 0\n', faces = ['f 1 3 2', 'f 1 2 4', 'f 1 4 3', 'f 2 3 4', 'f 1 2 5'];
  const meshes = {whole: faces.slice(0, 4), open: faces.slice(0, 3), nan: faces, flat: faces.slice(0, 1)};
  const links = Object.keys(meshes).map((name) => `<link name="${name}"><visual><geometry><mesh filename="${name}.obj"/></geometry></visual></link>`);
  const path = join(scratch, 'dirty.zip');
  writeFileSync(path, zipSync({'dirty.urdf': strToU8(`<robot name="dirty">${links.join('')}</robot>`),
    ...Object.fromEntries(Object.entries(meshes).map(([name, own]) => [`${name}.obj`, strToU8(corners + own.join('\n'))]))}));
  await page.setInputFiles('#file', path);
  await settled(page);
  assert.deepEqual((await rows(page)).map((cells) => cells[4]), ['yes', 'yes', 'yes', 'yes']);
  const notes = await page.locator('#link-notes li').allTextContents();
  for (const [i, says] of [
    /^open, .*: its openings count as closed, and from its triangles alone it is at most [\d.]+ mm$/,
    /^open, .*: proven: it covers every triangle of the original, and its inside with its openings closed by 1 face$/,
    /^nan, .*: proven: it encloses the finite triangles of the original$/,
    /^flat, .*: the triangles are flat: the hull is one of a thin solid around them$/,
    /^flat, .*: proven: it covers every triangle of the original$/].entries()) assert.match(notes[i], says);
  assert.equal(notes.length, 5);
  await closed(page);
});

/** Files that are no meshes, or not what they say. */
function hostileFiles() {
  const stl = readFileSync(sampleFile('bracket', 3000, 'bracket.stl')), huge = Buffer.from(stl.subarray(0, 1000));
  huge.writeUInt32LE(42949670, 80);  // of 50 bytes each
  const files = {'truncated.stl': stl.subarray(0, stl.length - 1234), 'huge.stl': huge, 'empty.stl': Buffer.alloc(0), 'empty.glb': Buffer.alloc(0),
    'text.ply': 'no mesh at all\n', 'text.obj': 'v 1 2\nf 1 2 3\n', 'nan.obj': 'v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n',
    'noise.glb': Buffer.from(Array.from({length: 5000}, (_, i) => (i * 7919) & 255)), 'picture.png': 'x', 'noise.stl.gz': Buffer.from([31, 139, 8, 0, 1])};
  return Object.entries(files).map(([name, bytes]) => {
    const path = join(scratch, name);
    writeFileSync(path, bytes);
    return path;
  });
}

test('hostile files end in one clear line', {skip}, async () => {
  const page = await opened();
  for (const path of hostileFiles()) {
    await page.setInputFiles('#file', path);
    await settled(page);
    const says = await text(page, 'problem');
    assert.match(says, /^[^\n]{10,}$/, basename(path));
    assert.doesNotMatch(says, /RuntimeError|unreachable|undefined|\bat /, `${basename(path)}: ${says}`);
  }
  await dropped(page, sampleFile('bracket', 3000, 'bracket.stl'));
  assert.match(await text(page, 'summary'), /certified: yes/, 'and the next file is read');
  await closed(page);
});

const kMostOfCase = 20000;  // milliseconds: then the cancel button has to end it
test('known hard cases', {skip: skip || (!existsSync(cases ?? '') && `there is no folder ${cases}`)}, async () => {
  const page = await opened();
  for (const name of readdirSync(cases)) {
    const path = join(cases, name);
    if (!/\.(off|ply|obj|stl|gltf|phull)(\.gz)?$/.test(name)) {
      console.log(`left out: ${name}`);
      continue;
    }
    await page.setInputFiles('#file', path);
    await settled(page, kMostOfCase).catch(() => page.click('#cancel'));
    await settled(page);
    const says = await text(page, 'problem');
    if (says === 'Cancelled.') console.log(`cancelled: ${name}`);
    assert.doesNotMatch(says, /\n|RuntimeError|unreachable/, `${name}: ${says}`);
    assert.ok(says || /certified: /.test(await text(page, 'summary')), name);
  }
  await closed(page);
});

test('memory returns after ten parts', {skip}, async () => {
  const page = await opened(), client = await page.context().newCDPSession(page);
  const heap = async () => {
    await client.send('HeapProfiler.collectGarbage');
    return (await client.send('Runtime.getHeapUsage')).usedSize;
  };
  const used = [];
  for (let i = 0; i < 10; ++i) {
    await page.setInputFiles('#file', sampleFile('bracket', 20000, 'large.stl'));
    await settled(page);
    while (page.workers().length > 0) await page.waitForTimeout(50);  // with the workers goes the memory of the library
    used.push(await heap());
  }
  console.log(`heap of the page after each of ten parts, MB: ${used.map((bytes) => (bytes / 1e6).toFixed(1)).join(' ')}`);
  assert.ok(used[9] < 1.2 * used[1]);
  await closed(page);
});

test('on a phone, by keys, in the dark', {skip}, async () => {
  const page = await opened({width: 390, height: 800, scheme: 'dark', fragment: '#sample=torus&unit=m'});
  await settled(page);
  const inside = () => page.evaluate(() => document.documentElement.scrollWidth <= innerWidth);
  assert.ok(await inside());
  const reached = new Set();
  for (let i = 0; i < 60; ++i) {
    await page.keyboard.press('Tab');
    const {id, outline, label} = await page.evaluate(() => {
      const element = document.activeElement;
      return {id: element.id, outline: getComputedStyle(element).outlineStyle,
        label: element.ariaLabel || element.labels?.[0]?.textContent || element.textContent};
    });
    if (id) assert.ok(outline !== 'none' && label, id);
    reached.add(id);
  }
  for (const id of ['open', 'sample', 'want-make', 'want-faces', 'want-distance', 'want-side', 'want-gap', 'want-shells', 'want-unit', 'want-tight', 'want-cavities', 'want-levels', 'want-to', 'save', 'save-levels', 'level'])
    assert.ok(reached.has(id), id);
  assert.ok(await inside());
  await closed(page);
});

test('an address with the name of no sample opens the empty page', {skip}, async () => {
  const page = await opened({fragment: '#sample=constructor'});
  assert.match(await text(page, 'message'), /^Drop a part/);
  assert.notEqual(await page.evaluate(() => document.documentElement.dataset.busy), 'yes');
  await closed(page);
});

test('without WebAssembly, the page says so', {skip}, async () => {
  const page = await opened({script: 'delete globalThis.WebAssembly'});
  assert.match(await text(page, 'problem'), /^This browser has no WebAssembly/);
  await closed(page);
});

test('after the first visit it opens without a network, and asks nobody else', {skip}, async () => {
  const asked = [];
  const server = createServer((request, response) => {
    const path = join(app, new URL(request.url, 'http://a').pathname);
    asked.push(basename(path));
    if (!existsSync(path)) return response.writeHead(404).end();
    response.writeHead(200, {'content-type': kTypes[/\.[a-z]+$/.exec(path)[0]]});
    response.end(readFileSync(path));
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const url = `http://127.0.0.1:${server.address().port}/app.html`;
  const page = await opened({url});
  await page.evaluate(async () => (await navigator.serviceWorker.ready).active);
  server.closeAllConnections();
  await new Promise((resolve) => server.close(resolve));
  await page.reload();
  await page.selectOption('#sample', 'torus');
  await settled(page);
  assert.match(await text(page, 'summary'), /certified: yes/);
  assert.deepEqual([...new Set(asked)].filter((name) => name !== 'favicon.ico').sort(), ['app.html', 'app_offline.js']);
  await page.close();
});

test('the picture of docs/browser.md', {skip: skip || (!pictureFile && 'PROHULL_PICTURE names no file')}, async () => {
  const page = await opened({width: 1100, height: 760, fragment: '#sample=pony'});
  await settled(page);
  await page.evaluate(() => document.getElementById('name').scrollIntoView());
  await page.waitForTimeout(1000);
  await page.screenshot({path: pictureFile});
  await closed(page);
});

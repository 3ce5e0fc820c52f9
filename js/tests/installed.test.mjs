// The package as npm packs it, in a project that has nothing else.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, statSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import {cube, folder, scratch} from './package.mjs';

const kMostBytes = 1.5e6;

const npm = (where, ...args) =>
  execFileSync('npm', [...args, '--offline', '--no-audit', '--no-fund', '--cache', join(scratch, 'npm')], {cwd: where, encoding: 'utf8'});

test('npm pack gives what another project installs and calls', () => {
  const [packed] = JSON.parse(npm(folder, 'pack', '--json', '--pack-destination', scratch));
  const tarball = join(scratch, packed.filename), size = statSync(tarball).size;
  console.log(`${packed.filename}: ${size} bytes`);
  assert.ok(size <= kMostBytes);
  const files = packed.files.map(({path}) => path);
  for (const name of ['LICENSE', 'README.md', 'index.d.ts', 'module.wasm']) assert.ok(files.includes(name), name);
  const project = join(scratch, 'project');
  mkdirSync(project);
  writeFileSync(join(project, 'package.json'), '{"name": "project", "private": true, "type": "module"}');
  npm(project, 'install', tarball);
  writeFileSync(join(project, 'main.js'), `
    import {build} from 'prohull';
    const hull = await build(${JSON.stringify(cube)}, 12);
    console.log(hull.certified, hull.faces.length);`);
  assert.equal(execFileSync('node', ['main.js'], {cwd: project, encoding: 'utf8', timeout: 60000}), 'true 36\n');
});

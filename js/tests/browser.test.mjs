// The package in headless Chromium, as the files lie: the same bits as in node, no request but for its own files, and an end on demand.
import assert from 'node:assert/strict';
import {createHash} from 'node:crypto';
import {createReadStream, existsSync} from 'node:fs';
import {createServer} from 'node:http';
import {createRequire} from 'node:module';
import {extname, join} from 'node:path';
import test from 'node:test';
import {bytesOf, engine, folder, hasProgram, sample} from './package.mjs';

const kTypes = {'.js': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html'};
const kPolicy = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; connect-src 'self'";

const hash = (bytes) => createHash('sha256').update(bytes).digest('hex');

/** Of the package, and of an empty page. The module is not there when it is asked for first. */
async function served() {
  let refusals = 1;
  const server = createServer((request, response) => {
    if (request.url.endsWith('.wasm') && refusals-- > 0) return response.writeHead(503).end();
    const path = join(folder, new URL(request.url, 'http://a').pathname), isPage = request.url === '/';
    if (!isPage && !existsSync(path)) return response.writeHead(404).end();
    response.writeHead(200, {'content-type': kTypes[isPage ? '.html' : extname(path)] ?? '', 'content-security-policy': kPolicy});
    return isPage ? response.end('<!doctype html><title>prohull</title>') : createReadStream(path).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return server;
}

async function launched() {
  try {
    const {chromium} = createRequire(import.meta.url)('playwright-core');
    return await chromium.launch({executablePath: process.env.PROHULL_CHROMIUM, args: ['--no-sandbox']});
  } catch (error) {
    return {missing: error.message.split('\n')[0]};
  }
}

/** Runs in the page. */
async function inPage(file) {
  const {build, read, sample, write} = await import('/index.js');
  const unfetched = await sample('torus', 500).catch(({message}) => message);
  const bytes = Uint8Array.from(atob(file), (c) => c.charCodeAt(0));
  const mesh = await read(bytes, 'part.ply'), hull = await build(mesh, 200);
  const stop = new AbortController();
  const stopped = build(mesh, 50, {tight: true, signal: stop.signal}).catch((error) => error.name);
  setTimeout(() => stop.abort(), 100);
  const error = await build({vertices: [1], faces: []}).catch(({name}) => name);
  const written = await write(hull, 'hull.ply');
  return {hull: [...written], certified: hull.certified, stopped: await stopped, error, unfetched};
}

const browser = await launched();
test('in Chromium', {skip: browser.missing ?? (!hasProgram && 'there is no program that makes samples')}, async (t) => {
  const server = await served(), own = `http://127.0.0.1:${server.address().port}/`;
  t.after(() => (browser.close(), server.close()));
  const page = await browser.newPage(), foreign = [];
  page.on('request', (request) => request.url().startsWith(own) || foreign.push(request.url()));
  await page.goto(own);
  const file = bytesOf(sample('knot', 5000));
  const found = await page.evaluate(inPage, file.toString('base64'));
  const hull = engine.build(await engine.read(file, 'part.ply'), 200);
  assert.equal(hash(Buffer.from(found.hull)), hash(engine.write(hull, 'hull.ply')));
  assert.deepEqual([found.certified, found.stopped, found.error], [true, 'AbortError', 'InputError']);
  assert.match(found.unfetched, /cannot fetch .*module\.wasm: 503/);
  assert.deepEqual(foreign, []);
});

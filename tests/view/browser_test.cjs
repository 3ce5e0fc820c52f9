// Opens pages of `prohull view` in headless Chromium: node browser_test.cjs PROHULL [CHROMIUM]
const assert = require('node:assert/strict');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const {withBrowser} = require('./chromium.cjs');

const [, , prohull, browserPath] = process.argv;
const work = fs.mkdtempSync(path.join(os.tmpdir(), 'prohull-view-'));
const at = (name) => path.join(work, name);
const run = (...args) => execFileSync(prohull, args, {encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe']});

/** A command that exits with 1 where its answer is yes. */
function ask(...args) {
  try {
    run(...args);
  } catch (error) {
    if (error.status !== 1) throw error;
  }
}

let browser;

/** A page that is open; `complaints` collects what must not happen: errors, dialogs, requests. */
async function opened(file, {fragment = '', width = 900, height = 640, scheme = 'light', motion = 'reduce'} = {}) {
  const page = await browser.newPage({viewport: {width, height}, colorScheme: scheme, reducedMotion: motion});
  page.complaints = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver Message/.test(message.text()))
      page.complaints.push(message.text());
  });
  page.on('pageerror', (error) => page.complaints.push(error.message));
  page.on('dialog', (dialog) => page.complaints.push(`dialog: ${dialog.message()}`));
  const url = `file://${encodeURI(at(file)).replaceAll('#', '%23')}`;
  page.on('request', (request) => {
    if (!request.isNavigationRequest()) page.complaints.push(`request: ${request.url()}`);
  });
  await page.goto(url + fragment);
  await page.waitForFunction(() => document.documentElement?.dataset.ready, null, {timeout: 60000});
  return page;
}

async function closed(page) {
  assert.deepEqual(page.complaints, []);
  await page.close();
}

const text = (page, id) => page.evaluate((name) => document.getElementById(name).textContent, id);
const number = async (page, id) => Number((await text(page, id)).replace(/[^0-9.eE+-]/g, ''));
const fragment = async (page) => {
  await page.waitForTimeout(300);
  return page.evaluate(() => location.hash);
};

/** Of the picture, without what is in front of it: how many colours it has, a sum that tells pictures apart, and a small
 * copy. */
const picture = (page) => page.evaluate(async () => {
  const bitmap = await createImageBitmap(await prohullView.viewport.picture());
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height), draw = canvas.getContext('2d', {willReadFrequently: true});
  draw.drawImage(bitmap, 0, 0);
  const pixels = new Uint32Array(draw.getImageData(0, 0, bitmap.width, bitmap.height).data.buffer);
  let sum = 0;
  for (const pixel of pixels) sum = (Math.imul(sum, 31) + pixel) | 0;
  draw.drawImage(bitmap, 0, 0, 40, 30);
  return {colors: new Set(pixels).size, sum, small: [...draw.getImageData(0, 0, 40, 30).data]};
});

/** The volume of the level that is shown, in the unit of the mesh. */
const shownVolume = (page) => page.evaluate(() => {
  const {levels} = prohullView.active, {positions, corners} = levels;
  const p = (corner, k) => positions[3 * corners[corner] + k];
  let sum = 0;
  for (let c = 0; c < 3 * levels.faces; c += 3)
    for (let k = 0; k < 3; ++k) {
      const i = (k + 1) % 3, j = (k + 2) % 3;
      sum += p(c, k) * (p(c + 1, i) * p(c + 2, j) - p(c + 1, j) * p(c + 2, i));
    }
  return sum / 6 * prohullView.space.side ** 3;
});

// Forward kinematics of a URDF without mimicking joints, on its own: rows of rotation matrices, and where origins are.
const times = (a, b) => a.map((row) => [0, 1, 2].map((j) => row.reduce((sum, x, k) => sum + x * b[k][j], 0)));
const turnedBy = (r, v) => r.map((row) => row.reduce((sum, x, k) => sum + x * v[k], 0));
/** Rodrigues' formula. */
function rotation([x, y, z], angle) {
  const c = Math.cos(angle), s = Math.sin(angle), t = 1 - c;
  return [[t * x * x + c, t * x * y - s * z, t * x * z + s * y], [t * x * y + s * z, t * y * y + c, t * y * z - s * x],
    [t * x * z - s * y, t * y * z + s * x, t * z * z + c]];
}
function jointsOf(urdf) {
  const numbersOf = (text, otherwise) => text ? text.trim().split(/\s+/).map(Number) : otherwise;
  return [...urdf.matchAll(/<joint name="([^"]*)" type="([^"]*)">(.*?)<\/joint>/gs)].map(([, name, type, body]) => {
    const found = (pattern) => body.match(pattern)?.[1];
    return {name, type, parent: found(/parent link="([^"]*)"/), child: found(/child link="([^"]*)"/),
      xyz: numbersOf(found(/<origin[^>]*xyz="([^"]*)"/), [0, 0, 0]), rpy: numbersOf(found(/<origin[^>]*rpy="([^"]*)"/), [0, 0, 0]),
      axis: numbersOf(found(/<axis xyz="([^"]*)"/), [1, 0, 0])};
  });
}
const transposed = (r) => r[0].map((_, k) => r.map((row) => row[k]));
function linkPoses(joints, positions) {
  const poses = {};
  const poseOf = (link) => {
    const joint = joints.find(({child}) => child === link);
    if (!joint) return {r: rotation([1, 0, 0], 0), t: [0, 0, 0]};
    if (poses[link]) return poses[link];
    const parent = poseOf(joint.parent), [roll, pitch, yaw] = joint.rpy;
    const own = times(rotation([0, 0, 1], yaw), times(rotation([0, 1, 0], pitch), rotation([1, 0, 0], roll)));
    const angle = ['revolute', 'continuous'].includes(joint.type) ? positions[joint.name] ?? 0 : 0;
    const shift = turnedBy(parent.r, joint.xyz);
    return poses[link] = {r: times(parent.r, times(own, rotation(joint.axis, angle))), t: parent.t.map((x, k) => x + shift[k])};
  };
  return Object.fromEntries(joints.flatMap(({parent, child}) => [parent, child]).map((link) => [link, poseOf(link)]));
}

/** A table of the page as an object. */
const tableOf = (page, selector) => page.evaluate((place) => Object.fromEntries([...document.querySelectorAll(`${place} tr`)]
    .map((row) => [...row.children].map(({textContent}) => textContent))), selector);
const pointOf = (told) => /\(([^)]*)\)/.exec(told)[1].split(', ').map(Number);
const apart = (p, q) => Math.hypot(...p.map((x, k) => x - q[k]));
const isNear = (p, q, most = 1e-5) => assert.ok(apart(p, q) < most, `${p} is not near ${q}`);

// Meshes as OBJ files have them.
const meshOf = (file) => {
  const rows = (mark) => [...fs.readFileSync(at(file), 'utf8').matchAll(new RegExp(`^${mark} (.*)$`, 'gm'))].map(([, row]) => row.split(' '));
  const points = rows('v').map((row) => row.map(Number));
  return {points, faces: rows('f').map((row) => row.map((v) => parseInt(v, 10) - 1))};
};
const QUADS = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
const ORDER = [7, 0, 5, 2, 3, 6, 1, 4];  // not that in which the faces use the corners
function writeBox(file, half, without = []) {
  const points = ORDER.map((corner) => `v ${[0, 1, 2].map((k) => corner >> k & 1 ? half : -half).join(' ')}`);
  const faces = QUADS.filter((_, i) => !without.includes(i)).flatMap(([a, b, c, d]) => [[a, b, c], [a, c, d]]);
  fs.writeFileSync(at(file), [...points, ...faces.map((face) => `f ${face.map((corner) => ORDER.indexOf(corner) + 1).join(' ')}`)].join('\n'));
}
/** Whether a point lies in a triangle: the areas that it makes with the sides are that of the triangle together. */
function isIn(point, [a, b, c]) {
  const area = (p, q, r) => {
    const u = q.map((x, k) => x - p[k]), v = r.map((x, k) => x - p[k]);
    return Math.hypot(...[0, 1, 2].map((k) => u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3])) / 2;
  };
  return Math.abs(area(point, a, b) + area(point, b, c) + area(point, c, a) - area(a, b, c)) < 1e-5 * (1 + area(a, b, c));
}
/** The picked point, after a look at whether it is on the face that is told, and the corner that is told is the nearest. */
function checkPicked(told, {points, faces}) {
  const number = (text) => Number(text.split(', at')[0].replaceAll(',', ''));
  const point = pointOf(told.Position), face = faces[number(told.Face)], corner = number(told['Nearest corner']);
  assert.ok(isIn(point, face.map((v) => points[v])), `${point} is on face ${told.Face}`);
  assert.ok(face.includes(corner) && face.every((v) => apart(points[v], point) >= apart(points[corner], point) - 1e-5));
  isNear(pointOf(told['Nearest corner']), points[corner]);
  return point;
}

function makeFiles() {
  run('sample', 'pony', '-o', at('pony.ply'), '--faces', '6000');
  run('build', at('pony.ply'), '--faces', '400', '-o', at('hull.stl'), '--hierarchy', at('pony.phull'));
  run('build', at('pony.ply'), '--faces', '400', '--side', 'inner', '-o', at('inner.stl'), '--hierarchy', at('inner.phull'));
  run('sample', 'sphere', '-o', at('sphere.ply'), '--faces', '500');
}

const tests = {
  async 'the slider shows the levels that lod extracts'() {
    run('view', at('pony.phull'), '-o', at('levels.html'));
    const page = await opened('levels.html');
    assert.equal(await number(page, 'faces'), 400);
    const base = await picture(page);
    assert.ok(base.colors > 50, 'the picture is not blank');
    for (const wanted of [401, 1000, 2345, 6000]) {
      await page.fill('#wanted', String(wanted));
      await page.press('#wanted', 'Enter');
      run('lod', at('pony.phull'), '--faces', String(wanted), '-o', at('level.ply'), '--report', at('level.json'));
      const level = JSON.parse(fs.readFileSync(at('level.json')));
      assert.equal(await number(page, 'faces'), level.faces);
      assert.ok(Math.abs(await shownVolume(page) / level.volume - 1) < 1e-4, `the volume of ${wanted} faces`);
    }
    assert.equal(await number(page, 'void'), 0);
    assert.notEqual((await picture(page)).sum, base.sum);
    await page.focus('#level');
    await page.keyboard.press('Home');
    assert.equal(await number(page, 'faces'), 400);
    assert.equal((await picture(page)).sum, base.sum, 'forth and back gives the same picture');
    await page.keyboard.press('End');
    assert.equal(await number(page, 'faces'), await page.evaluate(() => prohullView.active.original_faces));
    assert.match(await text(page, 'encloses'), /yes/);
    await closed(page);
  },

  async 'vertices glide between levels, and numbers are those of true levels'() {
    const still = await opened('levels.html', {fragment: '#l=2000'}), page = await opened('levels.html', {motion: 'no-preference'});
    const volumeOf = (level, ahead) => page.evaluate((args) => prohullView.active.levels.blend(...args), [level, ahead]).then(() => shownVolume(page));
    const coarse = await volumeOf(300, 0), fine = await volumeOf(420, 0), between = await volumeOf(300, 120);
    assert.ok(fine < between && between < coarse, 'a blend lies between its levels');
    for (const [level, ahead] of [[300, 120], [310.5, 40.25], [420, 3]]) {
      const change = Math.abs(await volumeOf(level + 0.01, ahead) - await volumeOf(level, ahead));
      assert.ok(change < 1e-3 * (coarse - fine), `nothing jumps at ${level}`);
    }
    assert.equal(await volumeOf(420, 0), fine, 'blends leave no trace');
    const seen = await page.evaluate(async () => {
      const numbers = new Set();
      prohullView.levels.setFaces(2000);
      while (prohullView.levels.glide) {
        numbers.add(document.getElementById('faces').textContent);
        await new Promise(requestAnimationFrame);
      }
      return [...numbers];
    });
    assert.ok(seen.length > 2, 'levels between are shown on the way');
    assert.equal(await number(page, 'faces'), 2000);
    assert.equal(await shownVolume(page), await shownVolume(still), 'at rest, it is exactly the level');
    assert.equal((await picture(page)).sum, (await picture(still)).sum);
    await closed(still);
    await closed(page);
  },

  async 'the distance of each level is bounded'() {
    const page = await opened('levels.html');
    run('lod', at('pony.phull'), '--faces', '6000', '-o', at('finest.ply'));
    for (const wanted of [430, 777, 3456]) {
      run('lod', at('pony.phull'), '--faces', String(wanted), '-o', at('level.ply'));
      run('view', at('level.ply'), '--original', at('finest.ply'), '-o', at('level.html'));
      const lower = Number(fs.readFileSync(at('level.html'), 'utf8').match(/"distance":\{[^}]*"lower":([^,}]*)/)[1]);
      await page.fill('#wanted', String(wanted));
      await page.press('#wanted', 'Enter');
      const bound = await number(page, 'distance');
      assert.ok(lower > 0 && lower <= bound && bound < 3 * lower, `${wanted} faces: ${lower} <= ${bound}`);
      assert.match(await text(page, 'between'), /^All levels from/);
    }
    await page.fill('#wanted', '6000');
    await page.press('#wanted', 'Enter');
    assert.equal(await number(page, 'distance'), 0, 'the finest level is the original');
    await closed(page);
  },

  async 'a ray takes as many tests and splits as prohull query counts'() {
    const page = await opened('levels.html');
    const base = await picture(page);
    await page.click('#by-click');
    for (const [x, y, key] of [[260, 310], [300, 330, 'o'], [335, 290, 'o'], [10, 10]]) {
      if (key) await page.keyboard.press(key);  // orthographic, and back
      await page.mouse.click(x, y);
      const ray = await text(page, 'ray');
      fs.writeFileSync(at('ray.csv'), `${ray}\n`);
      run('query', at('pony.phull'), '--rays', at('ray.csv'), '--mode', 'all', '--engine', 'paper-refinement', '--report', at('query.json'));
      const counted = JSON.parse(fs.readFileSync(at('query.json')));
      const shown = {tests: await number(page, 'tests'), splits: await number(page, 'splits'), hits: await number(page, 'hits')};
      assert.deepEqual(shown, {tests: counted.tests, splits: counted.splits, hits: counted.hits}, ray);
      if (shown.splits > 0) assert.notEqual((await picture(page)).sum, base.sum);
      assert.equal(await number(page, 'faces'), 400 + 2 * shown.splits);
    }
    await page.mouse.click(280, 330);
    assert.ok(await page.locator('#query-hits li').count() >= 2, 'the ray through the pony enters and leaves');
    const again = await opened('levels.html', {fragment: await fragment(page)});
    assert.equal(await text(again, 'tests'), await text(page, 'tests'), 'the address has the ray');
    await closed(again);
    await page.focus('#canvas');
    await page.keyboard.press('Escape');
    assert.equal(await number(page, 'faces'), 400);
    assert.equal((await picture(page)).sum, base.sum, 'the base mesh comes back');
    await closed(page);
  },

  async 'void and distance are those of verify and distance bounds'() {
    run('view', at('pony.phull'), '--original', at('pony.ply'), '-o', at('both.html'));
    run('lod', at('pony.phull'), '-o', at('base.ply'));
    run('verify', at('base.ply'), at('pony.ply'), '--report', at('verify.json'));
    const found = JSON.parse(fs.readFileSync(at('verify.json')));
    const page = await opened('both.html');
    assert.ok(Math.abs(await number(page, 'void') - 100 * found.void_ratio) < 0.01);
    const stop = await page.evaluate(() => prohullView.active.stops[0]);
    assert.equal(stop.faces, 400);
    assert.ok(stop.lower > 0 && stop.lower <= stop.upper && stop.upper <= 1.05 * stop.lower);
    assert.ok(await number(page, 'distance') >= stop.upper, 'a bound is not rounded down');
    await closed(page);
  },

  async 'an inner hull is enclosed'() {
    run('view', at('inner.phull'), at('pony.phull'), '--original', at('pony.ply'), '-o', at('inner.html'));
    const page = await opened('inner.html');
    assert.match(await text(page, 'verdict'), /^✓Yesevery level of inner\.phull is enclosed by pony\.ply; .* splits replayed, .* signs exact\.$/);
    assert.match(await text(page, 'content'), /enclosed by the original/);
    assert.ok((await text(page, 'void')).startsWith('-'), 'an inner hull has less volume');
    await page.selectOption('#active', '1');
    assert.match(await text(page, 'content'), /encloses the original/);
    await closed(page);
  },

  async 'what lies outside is listed, and a click goes there'() {
    run('view', at('inner.stl'), '--original', at('pony.ply'), '-o', at('outside.html'));
    const page = await opened('outside.html');
    assert.match(await text(page, 'verdict'), /^✗Noinner\.stl does not enclose pony\.ply: /);
    const worst = await page.evaluate(() => prohullView.active.verification.worst);
    assert.equal(await page.locator('#outside li').count(), worst.length);
    const before = await picture(page);
    await page.locator('#outside button').nth(2).click();
    const target = await page.evaluate(() => prohullView.space.point(prohullView.viewport.looking()[3]));
    target.forEach((x, k) => assert.ok(Math.abs(x - worst[2].point[k]) < 1e-5, 'the camera looks at the place'));
    assert.notEqual((await picture(page)).sum, before.sum);
    await closed(page);
  },

  async 'colours, edges, section and panels change the picture'() {
    run('view', at('hull.stl'), '--original', at('pony.ply'), '-o', at('hull.html'));
    const page = await opened('hull.html');
    const seen = new Set([(await picture(page)).sum]);
    const changes = async (what, act) => {
      await act();
      const {sum} = await picture(page);
      assert.ok(!seen.has(sum), `${what} changes the picture`);
      seen.add(sum);
    };
    await changes('heat', () => page.check('#heat'));
    assert.ok(await page.isVisible('#legend'));
    await changes('edges', () => page.uncheck('#edges'));
    await changes('a section', () => page.selectOption('#cut', 'y'));
    await changes('its other side', () => page.click('#flip'));
    await changes('its place', () => page.locator('#cut-at').fill('0.2'));
    await changes('hiding the original', () => page.uncheck('#show-0'));
    await changes('side by side', () => page.check('#beside'));
    await changes('the theme', () => page.click('#theme'));
    const address = await fragment(page), again = await opened('hull.html', {fragment: address});
    const {small} = await picture(page);
    const differs = (await picture(again)).small.filter((value, i) => Math.abs(value - small[i]) > 12).length;
    assert.ok(differs < small.length / 100, 'the address leads to the same picture');
    assert.equal(await fragment(again), address);
    await closed(again);
    await closed(page);
  },

  async 'a section is capped'() {
    const page = await opened('hull.html', {fragment: '#c=y&a=0&s=-1&e=0&v=0,0,4,0,0,0'});
    const clay = await page.evaluate(async () => {
      const bitmap = await createImageBitmap(await prohullView.viewport.picture());
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height), draw = canvas.getContext('2d', {willReadFrequently: true});
      draw.drawImage(bitmap, 0, 0);
      return [...draw.getImageData(bitmap.width / 2, bitmap.height / 2, 1, 1).data];
    });
    assert.deepEqual(clay, [0xe0, 0xb4, 0x8c, 255], 'the middle of the pony is the colour of its section');
    await closed(page);
  },

  async 'pieces and spheres have colours and move apart'() {
    run('convex', at('pony.ply'), '--pieces', '4', '-o', at('pieces.obj'));
    run('view', '--union', at('pieces.obj'), '--original', at('pony.ply'), '-o', at('pieces.html'));
    fs.writeFileSync(at('spheres.yaml'), `collision_spheres: {pony: [${
        [0, 1, 2].map((i) => `{center: [${i}, 0, 0], radius: 0.4}`).join(', ')}]}\n`);
    run('view', '--union', at('spheres.yaml'), '--original', at('sphere.ply'), '-o', at('spheres.html'));
    const checkPiece = (told) => {
      checkPicked(told, meshOf('pieces.obj'));
      assert.match(told.Piece, /^[0-3]$/);
    };
    const checkSphere = (told) => {
      const [x, y, z] = pointOf(told.Position), away = Math.hypot(x - Number(told.Sphere), y, z);
      assert.ok(away <= 0.4 + 1e-6 && away > 0.39 && !told.Face, 'it is on the sphere that is told, where that is while together');
    };
    for (const [file, parts, verdict, checkPart] of [['pieces.html', '4 pieces', /^✓Yesthe union of 4 pieces encloses .*, exactly\.$/, checkPiece], ['spheres.html', '3 spheres', /^✗Nothe union of 3 spheres does not cover every triangle of /, checkSphere]]) {
      const page = await opened(file);
      assert.match(await text(page, 'verdict'), verdict);
      assert.ok((await text(page, 'facts')).includes(`Parts${parts}`));
      const together = await picture(page);
      await page.locator('#explosion').fill('0.5');
      const apart = await picture(page);
      assert.notEqual(apart.sum, together.sum);
      await page.uncheck('#parts');
      assert.notEqual((await picture(page)).sum, apart.sum);
      await page.uncheck('#show-0');
      await page.focus('#canvas');
      for (const [x, y] of [[150, 400], [400, 200], [290, 320], [230, 320], [330, 320]]) {
        await page.mouse.click(x, y);
        if (await page.isVisible('#end-pick')) break;
      }
      checkPart(await tableOf(page, '#picked'));
      await closed(page);
    }
  },

  async 'joint sliders move links to where forward kinematics puts them'() {
    run('sample', 'arm', '-o', at('arm'));
    run('view', at('arm/arm.urdf'), '-o', at('arm.html'));
    const page = await opened('arm.html');
    const rest = await picture(page), joints = jointsOf(fs.readFileSync(at('arm/arm.urdf'), 'utf8'));
    const positions = {};
    for (const [i, name] of (await page.evaluate(() => prohullView.active.robot.free.map(({name}) => name))).entries()) {
      await page.locator(`#joint-${i}`).focus();
      for (let k = 0; k <= i; ++k) await page.keyboard.press('PageUp');
      positions[name] = await page.evaluate((at) => Number(document.getElementById(`joint-${at}`).value), i);
    }
    assert.ok(Object.values(positions).some((x) => x !== 0));
    const expected = linkPoses(joints, positions);
    const shown = await page.evaluate(() => {
      const {links, linkBodies} = prohullView.active, {space} = prohullView;
      const local = space.at([0, 0, 0]);
      return links.map(({name}, i) => {
        const m = linkBodies[i][0]?.moved.matrix.elements;
        return [name, m && space.point([0, 1, 2].map((k) => m[k] * local[0] + m[4 + k] * local[1] + m[8 + k] * local[2] + m[12 + k]))];
      });
    });
    let compared = 0;
    for (const [name, point] of shown) {
      if (!point || !expected[name]) continue;
      ++compared;
      point.forEach((x, k) => assert.ok(Math.abs(x - expected[name].t[k]) < 1e-6, `${name}: ${point} is not ${expected[name].t}`));
    }
    assert.ok(compared >= 7, 'all links of the arm are compared');
    assert.notEqual((await picture(page)).sum, rest.sum);
    const again = await opened('arm.html', {fragment: await fragment(page)});
    assert.equal(await text(again, 'joint-value-0'), await text(page, 'joint-value-0'), 'the address has the joints');
    await closed(again);
    await page.click('#rest');
    assert.equal((await picture(page)).sum, rest.sum);
    await closed(page);
  },

  async 'links that collide are lit, as prohull collide decides'() {
    const page = await opened('arm.html'), joints = jointsOf(fs.readFileSync(at('arm/arm.urdf'), 'utf8'));
    await page.waitForFunction(() => document.getElementById('colliding'));
    const rest = await picture(page);
    const names = await page.evaluate(() => prohullView.active.robot.free.map(({name}) => name));
    const positions = [[0, 0, 0, 0, 0, 0, 0], [-2.2, 0.32, -2.54, 0.93, -1.08, -3.32, -1.75], [0, 1.8, 0, 0, 0, 0, 0],
      [1, -1, 2.5, 0, 2, 1, 0], [0, 0, -2.8, 0, 0, 0, 0], [0, 0.5, 2.7, 0.4, -1.5, 0, 0]];
    const shown = [];
    for (const position of positions) {
      shown.push(await page.evaluate(async ([names, position]) => {
        const {robots, active} = prohullView;
        names.forEach((name, i) => robots.set(name, position[i]));
        while (robots.waiting) await new Promise(requestAnimationFrame);
        return active.collisions.colliding.map((pair) => pair.map((i) => active.links[i].name).join(' '));
      }, [names, position]));
    }
    assert.equal(shown[0].length, 0, 'the arm at rest is free');
    assert.equal(await page.locator('#collisions li').count(), shown.at(-1).length);
    const expected = positions.map(() => []);
    const links = ['base', 'link1', 'link2', 'link4', 'link5', 'link6', 'link7'].filter((name) => fs.existsSync(at(`arm/meshes/collision/${name}.stl`)));
    const compared = await page.evaluate(() => prohullView.active.collisions.pairs.map((pair) => pair.map((i) => prohullView.active.links[i].name)));
    for (const [a, b] of compared.filter((pair) => pair.every((name) => links.includes(name)))) {
      const rows = positions.map((position) => {
        const poses = linkPoses(joints, Object.fromEntries(names.map((name, i) => [name, position[i]]))), back = transposed(poses[a].r);
        const r = times(back, poses[b].r), t = turnedBy(back, poses[b].t.map((x, k) => x - poses[a].t[k]));
        return r.map((row, k) => [...row, t[k]]).flat().join(',');
      });
      fs.writeFileSync(at('poses.csv'), rows.join('\n'));
      ask('collide', at(`arm/meshes/collision/${a}.stl`), at(`arm/meshes/collision/${b}.stl`), '--poses', at('poses.csv'), '--report', at('collide.json'));
      JSON.parse(fs.readFileSync(at('collide.json'))).collide.forEach((is, i) => { if (is) expected[i].push(`${a} ${b}`); });
    }
    const known = (pairs) => pairs.filter((pair) => pair.split(' ').every((name) => links.includes(name)));
    assert.deepEqual(shown.map(known), expected);
    assert.ok(expected[1].includes('link1 link6') && expected[1].includes('link2 link6'), 'the folded arm collides');
    assert.notEqual((await picture(page)).sum, rest.sum);
    await closed(page);
  },

  async 'a link within another one collides, and pairs of the SRDF do not'() {
    const link = (name, size) => `<link name="${name}"><collision><geometry><box size="${size} ${size} ${size}"/></geometry></collision></link>`;
    fs.writeFileSync(at('boxes.urdf'), `<robot name="boxes">${link('crate', 1)}${link('far', 0.1)}${link('coin', 0.1)}
      <joint name="off" type="fixed"><parent link="crate"/><child link="far"/><origin xyz="3 0 0"/></joint>
      <joint name="slide" type="prismatic"><parent link="far"/><child link="coin"/><axis xyz="1 0 0"/><limit lower="-3" upper="-1" effort="1" velocity="1"/></joint></robot>`);
    for (const disabled of [false, true]) {
      if (disabled) fs.writeFileSync(at('boxes.srdf'), '<robot name="boxes"><disable_collisions link1="coin" link2="crate" reason="User"/><disable_collisions link1="coin" link2="x"/></robot>');
      run('view', at('boxes.urdf'), '-o', at('boxes.html'));
      const page = await opened('boxes.html');
      const moved = async (key) => {
        await page.locator('#joint-0').press(key);
        await page.waitForFunction(() => !prohullView.robots.waiting);
        return text(page, 'collisions');
      };
      if (disabled) assert.match(await moved('Home'), /✓ No links collide.*pairs that the SRDF/);
      else assert.match(await moved('Home'), /✗ 1 pair collides:crate – coin/);
      if (!disabled) assert.match(await moved('End'), /✓ No links collide/);
      assert.doesNotMatch(await text(page, 'collisions'), /not compared/);
      await closed(page);
    }
    run('sample', 'box', '--faces', '12', '-o', at('beside.off'));
    run('view', at('boxes.urdf'), at('beside.off'), '-o', at('beside.html'));
    const page = await opened('beside.html');
    await page.waitForFunction(() => document.getElementById('colliding'));
    assert.match(await text(page, 'collisions'), /Meshes beside the robot are not compared/);
    await closed(page);
  },

  async 'a slider of time moves a robot along a path, with what is proven'() {
    const link = (name) => `<link name="${name}"><collision><geometry><box size="1 1 1"/></geometry></collision></link>`;
    fs.writeFileSync(at('slide.urdf'), `<robot name="slide">${link('base')}${link('rail')}${link('cart')}
      <joint name="up" type="fixed"><parent link="base"/><child link="rail"/><origin xyz="0 0 3"/></joint>
      <joint name="out" type="prismatic"><parent link="rail"/><child link="cart"/><origin xyz="1 0 -3"/><axis xyz="1 0 0"/>
        <limit lower="-3" upper="5" effort="1" velocity="1"/></joint></robot>`);
    fs.writeFileSync(at('meets.csv'), 'time,out\n0,3\n3,0.5\n4,-0.5\n');
    ask('motion', at('slide.urdf'), at('meets.csv'), '--page', at('motion.html'));
    const page = await opened('motion.html');
    const out = () => page.evaluate(() => prohullView.active.robot.positions[1]);
    assert.match(await text(page, 'path-verdict'), /^MEETS at 3\.5.* s: base and cart; proven free before/);
    assert.equal(await out(), 3);
    assert.match(await text(page, 'apart'), /^0\.000 s: at least \d+(\.\d+)? mm apart, proven; the nearest found: base and cart$/);
    assert.ok(await page.evaluate(() => prohullView.motion.bound[2] <= 3), 'no more than the distance');
    await page.locator('#time').fill('1.5');
    assert.ok(Math.abs(await out() - 1.75) < 1e-9);
    await page.locator('#time').press('End');
    assert.equal(await out(), -0.5);
    assert.match(await text(page, 'apart'), /^4\.000 s: nothing is proven of it$/);
    await page.waitForFunction(() => !prohullView.robots.waiting);
    assert.match(await text(page, 'colliding'), /✗ 1 pair collides/);
    assert.match(await fragment(page), /m=4/);
    await page.locator('#move').click();
    await page.waitForFunction(() => prohullView.motion.time > 0 && prohullView.motion.time < 3);
    await page.locator('#move').click();
    await closed(page);
  },

  async 'a click picks a face, a second one measures'() {
    writeBox('within.obj', 1);
    writeBox('around.obj', 1.25);
    run('view', at('around.obj'), '--original', at('within.obj'), '-o', at('two_boxes.html'));
    const page = await opened('two_boxes.html', {fragment: '#v=0,0,4,0,0,0'}), told = () => tableOf(page, '#picked');
    const bare = await picture(page);
    await page.mouse.click(240, 250);
    const a = checkPicked(await told(), meshOf('around.obj')), {On, 'To within.obj': away} = await told();
    assert.equal(On, 'around.obj');
    assert.equal(away, '0.25');
    assert.equal(a[1], -1.25, 'it is the nearest face');
    const marked = await picture(page);
    assert.notEqual(marked.sum, bare.sum);
    await page.mouse.move(300, 300);
    await page.mouse.down();
    await page.mouse.move(330, 300, {steps: 3});
    await page.mouse.up();
    isNear(pointOf((await told()).Position), a);  // a drag picks nothing
    await page.evaluate(() => prohullView.viewport.look(0, 0));
    await page.uncheck('#show-1');
    await page.click('#second');
    await page.mouse.click(330, 400);
    const found = await told(), b = checkPicked(found, meshOf('within.obj'));
    assert.equal(found['To around.obj'], '0.25');
    assert.equal(b[1], -1);
    isNear(['dx', 'dy', 'dz'].map((name) => Number(found[name])), b.map((x, k) => x - a[k]));
    assert.ok(Math.abs(await number(page, 'measured-distance') - apart(a, b)) < 1e-5);
    await page.keyboard.down('Shift');
    await page.mouse.click(300, 250);
    await page.keyboard.up('Shift');
    assert.ok((await told()).dz !== found.dz, 'shift and click moves the second point');
    await page.focus('#opacity');
    await page.keyboard.press('Escape');
    assert.match(await text(page, 'picked'), /^A click picks/);
    await page.check('#show-1');
    await page.evaluate(() => prohullView.viewport.look(0, 0, 4 * prohullView.space.radius));
    assert.equal((await picture(page)).sum, bare.sum);
    await page.focus('#canvas');
    for (const key of ['c', 'ArrowLeft', 'm']) await page.keyboard.press(key);
    assert.ok(await number(page, 'measured-distance') > 0, 'keys pick, too');
    await page.check('#beside');
    await page.mouse.click(480, 300);
    assert.equal((await told()).On, 'within.obj', 'side by side, what is in the panel is picked');
    await page.selectOption('#cut', 'y');
    await page.mouse.click(200, 320);
    assert.deepEqual(await told(), {'Section of': 'around.obj', Position: (await told()).Position, 'To within.obj': (await told())['To within.obj']});
    assert.equal(pointOf((await told()).Position)[1], 0, 'a section is picked in its plane');
    await closed(page);
    run('view', at('around.obj'), at('within.obj'), '-o', at('two_meshes.html'));
    const two = await opened('two_meshes.html');
    await two.mouse.click(290, 320);
    assert.equal((await tableOf(two, '#picked'))['To within.obj'], '0.25', 'of two meshes, the distance to the other one');
    await closed(two);
  },

  async 'what is picked follows the level'() {
    const page = await opened('levels.html', {fragment: '#l=1000'});
    const isOnLevel = (told, most) => {
      run('lod', at('pony.phull'), '--faces', String(most), '-o', at('picked.obj'));
      const {points, faces} = meshOf('picked.obj'), point = pointOf(told.Position), corner = pointOf(told['Nearest corner']);
      const face = faces.map((corners) => corners.map((v) => points[v])).find((corners) => isIn(point, corners));
      assert.ok(face && face.some((p) => apart(p, corner) < 1e-5), `${point} is on the level`);
      return point;
    };
    await page.mouse.click(290, 330);
    const places = [];
    for (const faces of [1000, 400, 2345]) {
      await page.fill('#wanted', String(faces));
      await page.press('#wanted', 'Enter');
      places.push(isOnLevel(await tableOf(page, '#picked'), faces));
    }
    const to = places.map((place) => place.map((x, k) => x - places[0][k])).slice(1), [u, v] = to;
    const sine = Math.hypot(...[0, 1, 2].map((k) => u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3])) /
        Math.hypot(...u) / Math.hypot(...v);
    assert.ok(sine < 1e-2, 'it stays on the line of sight');
    await page.uncheck('#show-1');
    await page.mouse.click(290, 330);
    isOnLevel(await tableOf(page, '#picked'), 6000);
    await closed(page);
  },

  async 'a picked point of a link moves with it'() {
    const link = (name) => `<link name="${name}"><collision><geometry><box size="1 1 1"/></geometry></collision></link>`;
    fs.writeFileSync(at('turns.urdf'), `<robot name="turns">${link('a <b>x</b>')}${link('b')}
      <joint name="out" type="prismatic"><parent link="a &lt;b>x&lt;/b>"/><child link="b"/><origin xyz="2 0 0"/><axis xyz="0 0 1"/>
        <limit lower="-2" upper="0.5" effort="1" velocity="1"/></joint></robot>`.replace('name="a <b>x</b>"', 'name="a &lt;b>x&lt;/b>"'));
    run('view', at('turns.urdf'), '-o', at('turns.html'));
    const page = await opened('turns.html', {fragment: '#v=0,0,4,0,0,0'});
    await page.mouse.click(110, 320);
    assert.equal((await tableOf(page, '#picked')).On, 'a <b>x</b> of turns.urdf, collision');
    await page.click('#second');
    await page.mouse.click(470, 320);
    const before = await tableOf(page, '#picked');
    await page.locator('#joint-0').press('End');
    const after = await tableOf(page, '#picked');
    assert.equal(after.On, 'b of turns.urdf, collision');
    assert.equal(after.dx, before.dx);
    assert.ok(Math.abs(parseFloat(after.dz) - parseFloat(before.dz) - 0.5) < 1e-5);
    await closed(page);
  },

  async 'an orthographic view has a ruler, and keeps lengths'() {
    const page = await opened('two_boxes.html', {fragment: '#v=0,0,4,0,0,0'});
    const placeAt = async (x, y) => {
      await page.mouse.click(x, y);
      return pointOf((await tableOf(page, '#picked')).Position);
    };
    assert.equal(await page.locator('#gauges svg line').count(), 3);
    assert.ok(await page.isHidden('#ruler'), 'in perspective there is none');
    const perspective = await picture(page);
    await page.focus('#canvas');
    await page.keyboard.press('o');
    assert.notEqual((await picture(page)).sum, perspective.sum);
    const parallel = await picture(page), again = await opened('two_boxes.html', {fragment: await fragment(page)});
    assert.equal((await picture(again)).sum, parallel.sum, 'the address has it');
    assert.equal(await again.getAttribute('#orthographic', 'aria-pressed'), 'true');
    await closed(again);
    const width = await page.evaluate(() => parseFloat(document.getElementById('ruler').style.width));
    const left = await placeAt(240, 250), right = await placeAt(240 + width, 250);
    isNear(right.map((x, k) => x - left[k]), [await number(page, 'ruler'), 0, 0]);
    await page.uncheck('#show-1');
    const behind = await placeAt(240, 250);
    isNear(behind, [left[0], -1, left[2]]);
    await page.mouse.move(240, 250);
    await page.mouse.wheel(0, -200);
    await page.waitForTimeout(200);
    const nearer = await placeAt(240, 250);
    assert.ok(apart(nearer, behind) > 0 && apart(nearer, behind) < 0.02, 'the wheel zooms to the pointer');
    const turned = await page.evaluate(() => {
      prohullView.viewport.look(90, 0);
      return new Promise(requestAnimationFrame).then(() => prohullView.viewport.axes().map((axis) => axis.map(Math.round)));
    });
    assert.deepEqual(turned.map((axis) => axis.map((x) => x + 0)), [[0, 0, 1], [1, 0, 0], [0, 1, 0]], 'from the right, x comes and y goes to the right');
    await closed(page);
  },

  async 'openings are listed, and a click goes there'() {
    writeBox('open.obj', 1, [2, 3]);
    run('view', at('open.obj'), '-o', at('open.html'));
    const page = await opened('open.html');
    assert.deepEqual(await page.locator('#openings button').allTextContents(), Array(2).fill('4 edges, 8 togetheropen.obj'));
    const middles = [];
    for (const i of [0, 1]) {
      await page.locator('#openings button').nth(i).click();
      middles.push(await page.evaluate(() => prohullView.space.point(prohullView.viewport.looking()[3])));
    }
    middles.sort((a, b) => a[1] - b[1]).forEach((middle, i) => isNear(middle, [0, 2 * i - 1, 0]));
    await closed(page);
  },

  async 'marks that a section cuts away are hidden'() {
    const page = await opened('hull.html'), far = await page.evaluate(() => prohullView.active.distance.farthest);
    const marks = () => page.evaluate(() => prohullView.viewport.marks.children.map(({visible}) => visible));
    await page.selectOption('#cut', 'z');
    const kept = {1: [], '-1': []};
    for (const at of ['-1', '1', '-1']) {
      await page.locator('#cut-at').fill(at);
      await picture(page);
      kept[at].push(...await marks());
    }
    assert.deepEqual(kept, {1: [true], '-1': [false, false]});
    await page.click('#flip');
    await picture(page);
    assert.deepEqual(await marks(), [true], `${far} is on the other side`);
    await closed(page);
  },

  async 'marks and texts follow the level while the slider moves'() {
    const page = await opened('levels.html', {motion: 'no-preference'});
    const seen = await page.evaluate(async () => {
      const text = (id) => document.getElementById(id).textContent, {levels, viewport, active} = prohullView, seen = [];
      levels.setFaces(active.original_faces);
      while (levels.glide) {
        const told = Number(/level of ([\d,]+) faces/.exec(text('far'))[1].replaceAll(',', ''));
        const stop = active.stops.find(({faces}) => faces === told), mark = viewport.marks.children[0];
        const shown = Number(text('faces').replaceAll(',', ''));
        seen.push([told <= shown && active.stops.every(({faces}) => faces <= told || faces > shown),
          stop.upper === 0 ? !mark : mark.userData.point === stop.farthest]);
        await new Promise(requestAnimationFrame);
      }
      return seen;
    });
    assert.ok(seen.length > 2);
    assert.deepEqual(seen.filter((both) => both.includes(false)), []);
    assert.equal(await page.evaluate(() => prohullView.viewport.marks.children.length), 0, 'the finest level has no farthest point');
    assert.ok(await page.isDisabled('#fly-far'));
    await closed(page);
    run('lod', at('pony.phull'), '--faces', '6000', '-o', at('stray.obj'));
    fs.appendFileSync(at('stray.obj'), '\nv 3 0 0\nv 4 0 0\nv 4 1 0\nf -3 -2 -1\n');
    run('view', at('pony.phull'), '--original', at('stray.obj'), '-o', at('other.html'));
    const other = await opened('other.html', {fragment: '#l=1000'});
    assert.match(await text(other, 'verdict'), /^✗No.* does not cover every triangle of stray\.obj: /);
    assert.match(await text(other, 'encloses'), /not proven/);  // one level decides nothing about the others
    assert.match(await text(other, 'content'), /1 face lies outside of some levels/);
    await closed(other);
  },

  async 'the picture of docs/guides/view.md'() {
    const file = process.env.PROHULL_PICTURE;  // where it goes, if it is to be made
    if (!file) return;
    fs.mkdirSync(at('docs'));
    run('sample', 'pony', '-o', at('docs/pony.ply'));
    run('build', at('docs/pony.ply'), '--faces', '600', '-o', at('docs/hull.stl'), '--hierarchy', at('docs/pony.phull'));
    run('view', at('docs/pony.phull'), '-o', at('docs/levels.html'));
    const page = await opened('docs/levels.html', {width: 1100, height: 720, fragment: '#l=900&p=1'});
    await page.mouse.click(250, 300);
    await page.click('#second');
    await page.mouse.click(565, 305);
    await page.mouse.move(20, 20);
    await page.waitForTimeout(1000);
    await page.screenshot({path: file});
    await closed(page);
  },

  async 'keys do what the mouse does'() {
    const page = await opened('levels.html');
    await page.focus('#canvas');
    const looking = () => page.evaluate(() => prohullView.viewport.looking().flat());
    const home = await looking();
    for (const key of ['ArrowLeft', 'Shift+ArrowUp', '+']) {
      const before = await looking();
      await page.keyboard.press(key);
      assert.notDeepEqual(await looking(), before, key);
    }
    await page.keyboard.press('0');
    (await looking()).forEach((x, i) => assert.ok(Math.abs(x - home[i]) < 1e-6, '0 shows all'));
    await page.keyboard.press('.');
    assert.ok(await number(page, 'faces') > 400);
    await page.keyboard.press('h');
    assert.ok(await page.isChecked('#heat'));
    await page.keyboard.press('x');
    assert.equal(await page.inputValue('#cut'), 'x');
    for (let i = 0; i < 60; ++i) await page.keyboard.press('Tab');
    await closed(page);
  },

  async 'the mouse turns the picture, and a picture is saved'() {
    const page = await opened('levels.html');
    const before = await picture(page);
    await page.mouse.move(300, 300);
    await page.mouse.down();
    await page.mouse.move(400, 320, {steps: 4});
    await page.mouse.up();
    assert.notEqual((await picture(page)).sum, before.sum);
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#png')]);
    assert.equal(download.suggestedFilename(), 'prohull-view.png');
    assert.equal(fs.readFileSync(await download.path()).subarray(1, 4).toString(), 'PNG');
    await closed(page);
  },

  async 'a narrow window has room for all'() {
    const page = await opened('hull.html', {width: 360, height: 640, fragment: '#h=1', scheme: 'dark'});
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'nothing is beside the window');
    const height = () => page.evaluate(() => document.getElementById('canvas').clientHeight);
    const before = await height();
    await page.click('#fold');
    await page.waitForTimeout(100);
    assert.ok(await height() > before, 'without the panel the picture is larger');
    assert.ok((await picture(page)).colors > 50);
    await closed(page);
  },

  async 'hostile names are text'() {
    const name = '"><img src=x onerror=alert(1)><script>alert(2)<&amp; .phull';
    fs.copyFileSync(at('pony.phull'), at(name));
    run('view', at(name), '-o', at('hostile.html'));
    const page = await opened('hostile.html', {fragment: '#l=<img src=x onerror=alert(3)>&c=__proto__&v=NaN,1,2&x=999,-1&n=77&t=red&c=v&d=0,0,0&r=1,2,3,0,0,0&j=1'});
    assert.equal(await text(page, 'title'), name);
    assert.equal(await page.locator('img').count(), 0);
    assert.ok((await picture(page)).colors > 50);
    await closed(page);
  },

  async 'a broken mesh is shown, and what is wrong with it'() {
    const faces = fs.readFileSync(at('sphere.ply'));
    assert.ok(faces.length > 0);
    run('sample', 'sphere', '-o', at('sphere.obj'), '--faces', '500');
    const lines = fs.readFileSync(at('sphere.obj'), 'utf8').trim().split('\n');
    const broken = [...lines.slice(0, -40), 'v nan 0 0', 'f -1 1 2'].join('\n');
    fs.writeFileSync(at('broken.obj'), broken);
    run('view', at('broken.obj'), '-o', at('broken.html'));
    const page = await opened('broken.html');
    assert.match(await text(page, 'verdict'), /✗Not watertight.*open edges/);
    const marked = await picture(page);
    await page.uncheck('#defects');
    assert.notEqual((await picture(page)).sum, marked.sum, 'open edges are marked');
    assert.match(await text(page, 'facts'), /open edges/);
    assert.match(await text(page, 'facts'), /Not finite, left out1 face/);
    await page.mouse.click(290, 320);
    assert.match(await text(page, 'picked'), /Numbers count from 0, without 1 face that is not finite/);
    await page.keyboard.press('Escape');
    assert.ok((await picture(page)).colors > 50);
    run('view', at('broken.obj'), '--original', at('sphere.ply'), '-o', at('refused.html'));
    const refused = await opened('refused.html');
    assert.match(await text(refused, 'verdict'), /Not decided/);
    await closed(refused);
    await closed(page);
  },
};

async function runAll(launched) {
  browser = launched;
  makeFiles();
  let failures = 0;
  for (const [name, test] of Object.entries(tests)) {
    try {
      await test();
      console.log(`passed: ${name}`);
    } catch (error) {
      ++failures;
      console.log(`FAILED: ${name}\n${error.stack}`);
    }
  }
  assert.equal(failures, 0);
}

withBrowser(browserPath, runAll).finally(() => fs.rmSync(work, {recursive: true, force: true}));

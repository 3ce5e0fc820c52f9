// What the page does without a browser. With robots' files: a URDF in, a list of work out; hulls in, a new URDF out.
import assert from 'node:assert/strict';
import test from 'node:test';
import {placeOf, tidied} from '../../view/web/app/robot/places.js';
import {fileNames, planOf, scaleOf, scaled, whyLeft, withHulls} from '../../view/web/app/robot/urdf.js';
import {parseXml} from '../../view/web/app/robot/xml.js';
import {atLeast, atMost} from '../../view/web/src/panel/dom.js';

const robot = (links) => `<?xml version="1.0"?>\n<!-- <link name="none"/> -->\n<robot name="r">\n${links}</robot>\n`;
const visual = (mesh, more = '') => `<visual>${more}<geometry>${mesh}</geometry></visual>`;
const mesh = (file, more = '') => `<mesh filename="${file}"${more}/>`;
const treeOf = (paths, packages = {}, urdf = 'r/r.urdf') => ({robot: urdf, paths: new Set(paths), packages: new Map(Object.entries(packages))});
const planned = (links, paths = ['r/a.stl', 'r/b.stl']) => planOf(robot(links), treeOf(paths));
const made = (plan) => new Map(plan.works.map((work) => [work, {bytes: new Uint8Array()}]));

test('collision elements alone change, and all else stays byte for byte', () => {
  const before = '\ufeff<robot name="&#228;">\r\n\t<link name="a">\r\n\t\t<visual name=\'v\'>\r\n\t\t\t<origin xyz="1 2 3"/>\r\n\t\t\t<geometry><mesh filename="a.stl"/></geometry>\r\n' +
      '\t\t</visual>\r\n\t\t<visual><geometry>\r\n\t\t\t<box size="1 1 1"/></geometry></visual>\r\n\t\t<!-- <collision> -->\r\n\t\t';
  const old = '<collision name="kept">\r\n\t\t\t<geometry><sphere radius="1"/></geometry>\r\n\t\t</collision>\r\n\t\t<collision><geometry><box size="2 2 2"/></geometry></collision>';
  const after = '\r\n\t\t<inertial/><gazebo a=">"/>\r\n\t</link>\r\n</robot>\r\n<!-- end -->';
  const plan = planOf(before + old + after, treeOf(['r/a.stl']));
  assert.equal(withHulls(plan, made(plan)).text, `${before}<collision name="kept">\r\n\t\t  <origin xyz="1 2 3"/>\r\n\t\t  <geometry>\r\n\t\t    ` +
      '<mesh filename="meshes/collision/a_hull.stl"/>\r\n\t\t  </geometry>\r\n\t\t</collision>\r\n\t\t<collision>\r\n\t\t  <geometry>\r\n\t\t\t<box size="1 1 1"/></geometry>\r\n\t\t</collision>' + after);
});

test('hulls of collision meshes take their places alone, and links without any keep what they have', () => {
  const collision = (form) => `<collision><geometry>${form}</geometry></collision>`, box = collision('<box size="1 1 1"/>');
  const links = (b, c) => `<link name="a">${visual(mesh('a.stl'))}</link><link name="b">${visual(mesh('a.stl'))}${box}${collision(b)}</link>` +
      `<link name="c">${collision(c)}</link><link name="d">${visual(mesh('a.stl'))}${box}</link>`;
  const plan = planOf(robot(links(mesh('b.stl', ' scale="2 2 2"'), mesh('b.stl'))), treeOf(['r/a.stl', 'r/b.stl']), 'collision');
  assert.deepEqual(plan.works.map(({link, path, scale}) => [link, path, scale[0]]), [['b', 'r/b.stl', 2], ['c', 'r/b.stl', 1]]);
  assert.deepEqual(plan.links.map(({why}) => why), ['its collision geometry has no mesh', null, null, 'its collision geometry has no mesh']);
  assert.equal(withHulls(plan, made(plan)).text, robot(links(mesh('meshes/collision/b_hull.stl'), mesh('meshes/collision/c_hull.stl'))));
});

test('without collision elements, hulls stand behind the visual ones; without visual ones, meshes of collision elements are replaced', () => {
  const first = planned(`<link name="a">${visual(mesh('a.stl'))}<x/></link>`);
  assert.equal(withHulls(first, made(first)).text,
    robot(`<link name="a">${visual(mesh('a.stl'))}<collision><geometry>${mesh('meshes/collision/a_hull.stl')}</geometry></collision><x/></link>`));
  const collision = (form) => `<collision><geometry>${form}</geometry><verbose/></collision>`, box = collision('<box size="1 1 1"/>');
  const second = planned(`<link name="a">${box}${collision(mesh('a.stl'))}</link>`);
  assert.equal(withHulls(second, made(second)).text, robot(`<link name="a">${box}${collision(mesh('meshes/collision/a_hull.stl'))}</link>`));
});

test('a link has all of its hulls or none, and says why', () => {
  const plan = planned(`<link name="a">${visual(mesh('a.stl'))}${visual(mesh('b.stl'))}</link><link name="b">${visual(mesh('b.stl'))}</link>` +
      `<link name="c">${visual(mesh('c.fbx'))}</link><link name="d">${visual(mesh('d.stl'))}</link><link name="e">${visual('<box size="1 1 1"/>')}</link>` +
      `<link name="f">${visual(mesh('a.stl', ' scale="1 0 1"'))}</link><link name="g">${visual(mesh('a.stl'))}<visual/></link>` +
      `<link name="h">${visual(mesh('a.stl'))}${visual('<torus/>')}</link><link name="i"/>`);
  const outcomes = made(plan);
  outcomes.set(plan.works[0], {why: 'it is empty'});
  assert.deepEqual(plan.links.map((link) => whyLeft(link, outcomes)), ['it is empty', null, 'c.fbx: files of this format are not read here',
    'd.stl: there is no file r/d.stl', 'its visual geometry has no mesh', 'the scale of a.stl is not three numbers other than 0', 'a <visual> has no geometry',
    'geometry of type torus is not read', 'its collision geometry has no mesh']);
  const {text, works} = withHulls(plan, outcomes);
  assert.deepEqual(works.map(({out}) => out), ['a_2_hull.stl']);
  assert.equal(text.split('<collision>').length, 2);
});

test('meshes that are the same share a hull, and other scales have their own', () => {
  const plan = planned(`<link name="a">${visual(mesh('a.stl'))}</link><link name="b">${visual(mesh('./a.stl', ' scale="1 1 1"'))}${visual(mesh('a.stl', ' scale="1 -1 1"'))}</link>`);
  assert.deepEqual(plan.works.map(({path, scale, out}) => [path, scale, out]), [['r/a.stl', [1, 1, 1], 'a_hull.stl'], ['r/a.stl', [1, -1, 1], 'b_hull.stl']]);
});

test('scales: three numbers or one, and a mirror image still looks outwards', () => {
  assert.deepEqual([scaleOf(), scaleOf(' 2 '), scaleOf('1e-3 -.5 +2.')], [[1, 1, 1], [2, 2, 2], [0.001, -0.5, 2]]);
  for (const text of ['', '1 2', '1 2 3 4', '0 1 1', '0x10', 'nan', '1,1,1', '1e200', 'Infinity']) assert.equal(scaleOf(text), null, text);
  const vertices = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), faces = Uint32Array.of(0, 1, 2);
  assert.deepEqual(scaled({vertices, faces}, [2, -3, 1]), {vertices: Float64Array.of(0, -0, 0, 2, -0, 0, 0, -3, 0), faces: Uint32Array.of(0, 2, 1)});
  assert.deepEqual([...scaled({vertices, faces}, [-2, -3, 1]).faces], [0, 1, 2]);
});

test('files are found as the folder has them', () => {
  const tree = treeOf(['w/arm/urdf/r.urdf', 'w/arm/meshes/a b.stl', 'w/arm/meshes/c.stl', 'w/old/arm/meshes/c.stl', 'w/tool-main/meshes/t.stl', 'w/x/one/m.stl', 'w/y/one/m.stl',
    'w/hand/grip.stl', 'loose/l.stl'], {'w/tool-main/': 'tool', 'w/hand/': 'hand'}, 'w/arm/urdf/r.urdf');
  for (const [uri, path] of [['../meshes/c.stl', 'w/arm/meshes/c.stl'], ['../meshes/a%20b.stl', 'w/arm/meshes/a b.stl'], ['package://arm/meshes/a%20b.stl', 'w/arm/meshes/a b.stl'],
    ['package://arm/meshes/c.stl', 'w/arm/meshes/c.stl'], ['package://tool/meshes/t.stl', 'w/tool-main/meshes/t.stl'], ['package://renamed/l.stl', 'loose/l.stl'], ['model://arm//meshes/c.stl', 'w/arm/meshes/c.stl']])
    assert.deepEqual(placeOf(uri, tree), {path}, uri);
  for (const [uri, why] of [['../../../../etc/passwd', /leads out/], ['/etc/passwd', /another machine/], ['file:///etc/passwd', /not read/], ['C:\\a.stl', /another machine/],
    ['https://a/b.stl', /https:\/\/ is not read/], ['package://arm', /expected/], ['package://arm/../../x', /expected/], ['package://one/m.stl', /there are 2 files/],
    ['package://foot/grip.stl', /there is no file/], ['%ff', /there is no file/], ['', /there is no file/]]) assert.match(placeOf(uri, tree).why ?? '', why, uri);
  assert.deepEqual(['a/./b//c', 'a/../b', '..', 'a/../../b'].map(tidied), ['a/b/c', 'b', null, null]);
});

test('hostile names of links become plain names of files, each once', () => {
  const name = fileNames(['A_hull.stl']), stl = '_hull.stl';
  assert.deepEqual(['a', '../../etc/x', '/abs', '<img src=x onerror=alert(1)>', '', '.hidden', 'CON"\n', 'é', 'É', 'x'.repeat(300)].map((wanted) => name(wanted, stl)),
    ['a_2_hull.stl', '_.._.._etc_x_hull.stl', '_abs_hull.stl', '_img_src_x_onerror_alert_1___hull.stl', '__hull.stl', '_.hidden_hull.stl', 'CON___hull.stl', '__2_hull.stl', '__3_hull.stl', `${'x'.repeat(100)}_hull.stl`]);
  const plan = planOf(robot(`<link name="a">${visual(mesh('a.stl'))}</link>`), treeOf(['r/a.stl', 'r/meshes/collision/A_hull.stl']));
  assert.equal(plan.works[0].out, 'a_2_hull.stl', 'a file of the robot is not overwritten');
});

test('what is no URDF is refused, with its line', () => {
  for (const [text, says] of [['', /0 root elements/], ['<robot>\n<link', /line 2: this is no XML/], ['<robot><link name="a"></robot>', /<\/robot> stands where <\/link> is expected/], ['<robot>', /<robot> is not closed/],
    ['</robot>', /nothing is open/], ['<sdf/>', /<sdf> is no URDF/], ['<robot/>', /no links/], ['<robot><link/></robot>', /a link has no name/],
    ['<robot><link name="a"/>\n<link name="&#97;"/></robot>', /line 2: there are two links called a/], ['<robot><link name="&x;"/></robot>', /&x; is not read/],
    ['<robot><link name="&#1114112;"/></robot>', /is not read/], ['<robot><link name="a" name="b"/></robot>', /stands there twice/],
    ['<!DOCTYPE r [<!ENTITY x "y">]><robot/>', /document types/], ['<robot><link name="a"/><xacro:include filename="x"/></robot>', /xacro is not read/]])
    assert.throws(() => planOf(text, treeOf([])), says, text);
  assert.throws(() => parseXml(`<a${' '.repeat(1e6)}`), /no XML/);
  assert.equal(parseXml(`${'<a>'.repeat(1e5)}${'</a>'.repeat(1e5)}`).name, 'a');
  assert.equal(parseXml('<a b="&lt;&amp;&#x41;"/>').attributes.get('b'), '<&A');
});

test('bounds stay bounds with four digits', () => {
  for (const digits of [1, 1.234, 9.999, 9.9995])
    for (const exponent of [-320, -12, 0, 3, 300])
      for (const x of [Number(`${digits}e${exponent}`), Number(`${digits}e${exponent}`) * (1 + 5e-13)]) {
        assert.ok(Number(atMost(x)) >= x && Number(atMost(x)) <= 1.0011 * x, `${x} is at most ${atMost(x)}`);
        assert.ok(Number(atLeast(x)) <= x && Number(atLeast(x)) >= 0.9989 * x, `${x} is at least ${atLeast(x)}`);
      }
  assert.deepEqual([atMost(0.3), atLeast(0.3), atLeast(9999.5), atMost(0), atLeast(0)], ['0.3', '0.3', '9999', '0', '0']);
});

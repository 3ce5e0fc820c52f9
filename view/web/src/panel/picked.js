// What the panel says of picked points.

import {counted, el, grouped, short} from './dom.js';

const PARTS = [[/sphere/, 'Sphere'], [/piece/, 'Piece'], [/./, 'Component']];

/** What its numbers count. */
function noteOf({face, body: {source, hasParts}}, {state: {explosion}, rays: {query}}) {
  if (face === null) return null;
  if (source?.levels && query) return 'Numbers count from 0, in the base mesh as the ray has split it.';
  if (!source || source.levels)
    return `${source ? `Of the level of ${grouped(source.levels.shownFaces)} faces. ` : ''}Numbers count from 0 in the order in which ` +
        'vertex splits make faces and vertices: files of levels have others.';
  if (source.kind === 'balls') return 'Spheres count from 0. They are drawn with flat faces.';
  const together = hasParts && explosion > 0 ? ' Positions are those of parts that are together.' : '';
  if (source.left_out > 0)
    return `Numbers count from 0, without ${counted(source.left_out, 'face that is', 'faces that are')} not finite.${together}`;
  const what = source.union ? 'pieces, one after the other,' : source.name ? 'file' : 'geometry of the link';
  return `Numbers count from 0, in the ${what} as prohull reads it${source.left_out_vertices > 0 ? ', without vertices that no face has' : ''}.${together}`;
}

/** The rows of a table: of a point and what lies around it. */
function rowsOf(pick, picks, {place, length}) {
  const {body, face, local} = pick, {source} = body, isFace = face !== null && source?.kind !== 'balls';
  const partner = picks.partnerOf(pick), corner = isFace && pick.nearestCorner;
  const near = isFace && pick.vertex(corner).applyMatrix4(body.moved.matrix);
  return [
    [face === null ? 'Section of' : 'On', body.label],
    face !== null && (body.hasParts || source?.kind === 'balls') && [PARTS.find(([what]) => what.test(source?.union ?? ' '))[1], grouped(pick.part)],
    isFace && ['Face', grouped(face)],
    ['Position', place(picks.pointOf(pick.place))],
    isFace && ['Nearest corner', `${grouped(corner)}, at ${place(picks.pointOf(near))}`],
    partner && [`To ${partner.label}`, length(partner.distanceTo(local) * picks.view.space.side)],
  ];
}

const HINT = 'A click picks a face. Shift and click measures the distance from there.';

export function pickedElements(picks, table) {
  const {view, points} = picks, {side} = view.space, {unit} = view.scene;
  const digits = Math.max(0, Math.min(20, 6 - Math.floor(Math.log10(side))));  // of what is drawn, 24 bits are known
  const rounded = (x) => String(Number(x.toFixed(digits)) + 0), length = (x) => `${short(Number(x.toFixed(digits)), 6)}${unit ? ` ${unit}` : ''}`;
  const words = {place: (point) => `(${point.map(rounded).join(', ')})`, length};
  if (points.length === 0) return [el('p', {class: 'soft'}, HINT)];
  const notes = new Set(points.map((pick) => noteOf(pick, view)).filter(Boolean));
  const told = [...points.flatMap((pick, i) => [
    el('h3', {}, el('span', {class: 'mark'}, 'AB'[i]), ` ${i === 0 ? 'First' : 'Second'} point`), table(rowsOf(pick, picks, words))]),
    ...[...notes].map((note) => el('p', {class: 'soft'}, note))];
  if (points.length === 1) return told;
  const [a, b] = points.map((pick) => picks.pointOf(pick.place)), way = b.map((x, k) => x - a[k]);
  return [el('p', {id: 'measured'}, 'From A to B: ', el('b', {id: 'measured-distance'}, length(Math.hypot(...way)))),
    table(way.map((x, k) => [`d${'xyz'[k]}`, length(x)])), ...told];
}

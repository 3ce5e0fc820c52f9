// Keys and the mouse. What turns, moves and zooms by the mouse is in picture/viewport.js.

import {byId} from '../panel/dom.js';

function actionOf(view, key, shift) {
  const {viewport, levels, section} = view;
  const arrow = (right, up) => () => shift ? viewport.shift(right * 0.03, up * 0.03) : viewport.turn(right * 6, up * 6);
  const toggle = (id) => () => byId(id)?.click();
  const cut = (axis) => () => section.toggle(axis);
  return {
    ArrowLeft: arrow(-1, 0), ArrowRight: arrow(1, 0), ArrowUp: arrow(0, 1), ArrowDown: arrow(0, -1),
    '+': () => viewport.zoom(1.15), '=': () => viewport.zoom(1.15), '-': () => viewport.zoom(1 / 1.15),
    0: () => viewport.home(), ',': () => levels.step(-0.02), '.': () => levels.step(0.02), ' ': () => levels.play(),
    e: toggle('edges'), h: toggle('heat'), p: toggle('png'), o: () => view.look.toggleOrthographic(), f: toggle('fly-far'), n: () => view.places.nextOutside(),
    q: () => view.rays.shootThroughMiddle(), c: () => view.picks.pickInMiddle(), m: () => view.picks.pickInMiddle(true),
    Escape: () => view.picks.points.length > 0 ? view.picks.end() : view.rays.end(),
    x: cut('x'), y: cut('y'), z: cut('z'),
    '[': () => section.move(-0.05), ']': () => section.move(0.05),
  }[key];
}

function press(view, e) {
  if (e.ctrlKey || e.metaKey || e.altKey || e.key !== 'Escape' && ['INPUT', 'SELECT', 'TEXTAREA'].includes(e.target.tagName)) return;
  if (e.key === ' ' && e.target.tagName !== 'CANVAS' && e.target !== document.body) return;
  const act = actionOf(view, e.key, e.shiftKey);
  if (!act) return;
  e.preventDefault();
  view.viewport.flight = null;
  act();
}

function clickAt(view, {clientX: x, clientY: y, shiftKey: shift}) {
  const mark = view.viewport.markAt(x, y);
  if (mark) view.places.flyTo(mark.userData.point);
  else if (view.picks.next === 'ray' && !shift) view.rays.shootAt(x, y);
  else view.picks.pickAt(x, y, shift || view.picks.next === 'second');
}

export function listen(view) {
  const canvas = byId('canvas'), {signal} = view.ended;
  let pressed = null;
  canvas.addEventListener('pointerdown', (e) => {
    view.viewport.flight = null;
    pressed = e.isPrimary && e.button === 0 ? [e.clientX, e.clientY] : null;
  });
  canvas.addEventListener('pointerup', (e) => {
    if (pressed && Math.hypot(e.clientX - pressed[0], e.clientY - pressed[1]) <= 4) clickAt(view, e);
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => view.look.setTheme(view.state.theme), {signal});
  addEventListener('keydown', (e) => press(view, e), {signal});
}

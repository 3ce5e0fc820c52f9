// What is shown, as the fragment of the page's address, so that a link leads to the same view.

const number = (text) => Number.isFinite(Number(text)) ? Number(text) : null;

/** The fragment as names and texts. */
export function readFragment() {
  return Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
}

export function writeFragment(values) {
  const text = Object.entries(values).filter(([, value]) => value !== null && value !== undefined && value !== '')
      .map(([name, value]) => `${name}=${encodeURIComponent(value).replaceAll('%2C', ',')}`).join('&');
  try {
    history.replaceState(null, '', `#${text}`);
  } catch {
    // A page within another one may have no address of its own.
  }
}

/** The numbers of "1,2.5,3", if there are `count` of them. */
function numbersOf(text, count) {
  const values = (text ?? '').split(',').map(number);
  return text && values.length === count && !values.includes(null) ? values : null;
}

/** A vector of length 1, or null. */
function unitVector(vector) {
  const length = vector ? Math.hypot(...vector) : 0;
  return length > 0 && length < Infinity ? vector.map((x) => x / length) : null;
}

const between = (text, least, most, otherwise) => {
  const value = text === undefined || text === '' ? null : number(text);
  return value === null ? otherwise : Math.min(most, Math.max(least, value));
};

/** What the texts of an address say, and what is shown first where it says nothing. */
export function readState({hulls, original}, text) {
  const robots = hulls.some((hull) => hull.robot);
  const alone = !original && !robots && !hulls.some((hull) => hull.levels);
  return {
    faces: between(text.l, 0, 1e12, null),
    opacity: between(text.o, 0.05, 1, alone ? 1 : 0.4),
    edges: text.e ? text.e === '1' : !alone && !robots,
    defects: text.w !== '0',
    heat: text.h === '1',
    beside: text.b === '1',
    parts: text.u !== '0',
    explosion: between(text.k, 0, 2, 0),
    cut: ['x', 'y', 'z', 'v'].includes(text.c) ? text.c : '',
    cutAt: between(text.a, -1, 1, 0),
    cutSign: text.s === '-1' ? -1 : 1,
    cutFacing: unitVector(numbersOf(text.d, 3)) ?? [0, -1, 0],
    hidden: (text.x ?? '').split(',').filter(Boolean).map(Number),
    active: between(text.n, 0, hulls.length - 1, 0),
    theme: ['dark', 'light'].includes(text.t) ? text.t : null,
    look: numbersOf(text.v, 6),
    orthographic: text.p === '1',
    time: text.m ? number(text.m) : null,
    joints: text.j ? text.j.split(',').map(Number) : null,
    ray: numbersOf(text.r, 6),
  };
}

/** What leads to the same view. */
export function remembered({state, space, viewport, active, hasParts, motion}) {
  const [azimuth, elevation, distance, target] = viewport.looking();
  const round = (x) => Number(x.toPrecision(5));
  return {
    v: [azimuth, elevation, distance / space.radius, ...target.map((x) => x / space.radius)]
        .map((x) => Math.abs(x) < 1e-6 ? 0 : round(x)).join(','),
    l: active.levels ? active.levels.shownFaces : null,
    o: state.opacity, e: state.edges ? 1 : 0, h: state.heat ? 1 : null, b: state.beside ? 1 : null,
    w: state.defects ? null : 0, u: hasParts && !state.parts ? 0 : null, k: hasParts && state.explosion || null,
    c: state.cut, a: state.cut ? state.cutAt : null, s: state.cut && state.cutSign < 0 ? -1 : null,
    d: state.cut === 'v' ? state.cutFacing.map(round).join(',') : null,
    r: state.ray?.join(','),
    j: active.robot?.free.map(({i}) => round(active.robot.positions[i])).join(','),
    m: motion.time, p: state.orthographic ? 1 : null,
    x: state.hidden.join(','), n: state.active || null, t: state.theme,
  };
}

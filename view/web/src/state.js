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
export function numbersOf(text, count) {
  const values = (text ?? '').split(',').map(number);
  return text && values.length === count && !values.includes(null) ? values : null;
}

/** A vector of length 1, or null. */
export function unitVector(vector) {
  const length = vector ? Math.hypot(...vector) : 0;
  return length > 0 && length < Infinity ? vector.map((x) => x / length) : null;
}

export const between = (text, least, most, otherwise) => {
  const value = text === undefined || text === '' ? null : number(text);
  return value === null ? otherwise : Math.min(most, Math.max(least, value));
};

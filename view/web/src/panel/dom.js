// Elements of the page. Whatever comes from a file becomes text here, never markup.

export function el(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

/** An element of a picture within the page. */
export function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

export const byId = (id) => document.getElementById(id);

/** 96966 as "96,966" */
export const grouped = (count) => String(count).replace(/\B(?=(\d{3})+$)/g, ',');
export const counted = (count, one, many) => `${grouped(count)} ${count === 1 ? one : many}`;

/** The number with four digits that count. */
export function short(number, digits = 4) {
  if (number === 0 || !Number.isFinite(number)) return String(number);
  const text = number.toPrecision(digits);
  return Math.abs(number) >= 1e-4 && Math.abs(number) < 1e7 ? String(Number(text)) : Number(text).toExponential();
}

/** Never less than it is: for bounds. */
export function atMost(number) {
  if (number === 0 || !Number.isFinite(number)) return String(number);
  const unit = 10 ** (Math.floor(Math.log10(number)) - 3);
  return short(Math.ceil(number / unit * (1 - 1e-12)) * unit);
}

/** Never more than it is: for bounds. */
export function atLeast(number) {
  if (!(number > 0) || !Number.isFinite(number)) return '0';
  const unit = 10 ** (Math.floor(Math.log10(number)) - 3);
  return short(Math.floor(number / unit * (1 - 1e-12)) * unit);
}

/** Less than a billionth of a per cent is the rounding of volumes. */
export const percent = (ratio) => `${Math.abs(ratio) < 1e-11 ? 0 : short(100 * ratio, 4)} %`;
export const place = (point) => `(${point.map((x) => short(x, 7)).join(', ')})`;

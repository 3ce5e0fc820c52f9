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

/** Offers a file of this name: bytes, or a blob. */
export function save(content, name) {
  const link = el('a', {href: URL.createObjectURL(new Blob([content])), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
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

/** With four digits that count, and not on the other side of the number. */
function rounded(number, sign) {
  const nearest = Number(number.toPrecision(4)), exponent = Number(number.toExponential().split('e')[1]);
  return short(sign * nearest >= sign * number ? nearest : nearest + sign * Number(`1e${exponent - 3}`));
}

/** Never less than it is: for bounds. */
export const atMost = (number) => number > 0 && Number.isFinite(number) ? rounded(number, 1) : String(number);

/** Never more than it is: for bounds. */
export const atLeast = (number) => number > 0 && Number.isFinite(number) ? rounded(number, -1) : '0';

/** Less than a billionth of a per cent is the rounding of volumes. */
export const percent = (ratio) => `${Math.abs(ratio) < 1e-11 ? 0 : short(100 * ratio, 4)} %`;
export const place = (point) => `(${point.map((x) => short(x, 7)).join(', ')})`;

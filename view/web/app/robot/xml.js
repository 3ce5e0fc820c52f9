// XML as elements with their places in the text, so that a change leaves all else as it is.

const TOKEN = new RegExp([
  String.raw`<!--[\s\S]*?-->|<!\[CDATA\[[\s\S]*?\]\]>|<\?[\s\S]*?\?>`,
  String.raw`<\/([^\s>]+)\s*>`,
  String.raw`<([^\s\/>!?"'=<]+)((?:\s+[^\s=\/>"'<]+\s*=\s*(?:"[^"<]*"|'[^'<]*'))*)\s*(\/?)>`,
  '<'].join('|'), 'g');
const ATTRIBUTE = /([^\s=]+)\s*=\s*(?:"([^"]*)"|'([^']*)')/g;
const ENTITIES = {lt: '<', gt: '>', amp: '&', quot: '"', apos: "'"};

/** What is wrong with a robot's file, and in which line. */
export class UrdfError extends Error {
  constructor(text, at, why) {
    super(`line ${text.slice(0, at).split('\n').length}: ${why}`);
  }
}

function attributesOf(text, at, source) {
  const attributes = new Map();
  for (const [, name, double, single] of source.matchAll(ATTRIBUTE)) {
    if (attributes.has(name)) throw new UrdfError(text, at, `the attribute ${name} stands there twice`);
    attributes.set(name, (double ?? single).replace(/&([^;]*);?/g, (whole, entity) => {
      const code = /^#(?:x([0-9a-f]{1,6})|([0-9]{1,7}))$/i.exec(entity);
      const number = code && (code[1] ? parseInt(code[1], 16) : Number(code[2]));
      const meant = code ? (number > 0 && number <= 0x10ffff ? String.fromCodePoint(number) : undefined)
          : Object.hasOwn(ENTITIES, entity) && whole.endsWith(';') ? ENTITIES[entity] : undefined;
      if (meant === undefined) throw new UrdfError(text, at, `${whole} is not read`);
      return meant;
    }));
  }
  return attributes;
}

/** The root: {name, attributes, children, begin, inner, end}, where its start tag ends at `inner`. */
export function parseXml(text) {
  const top = {children: []}, open = [top];
  for (const {0: token, 1: closed, 2: name, 3: attributes, 4: slash, index} of text.matchAll(TOKEN)) {
    const end = index + token.length;
    if (token === '<') throw new UrdfError(text, index, 'this is no XML that is read here; document types are not');
    if (closed !== undefined) {
      const element = open.pop();
      if (element.name !== closed)
        throw new UrdfError(text, index, `</${closed}> stands where ${element === top ? 'nothing is open' : `</${element.name}> is expected`}`);
      element.end = end;
    } else if (name !== undefined) {
      const element = {name, attributes: attributesOf(text, index, attributes), children: [], begin: index, inner: end, end};
      open[open.length - 1].children.push(element);
      if (!slash) open.push(element);
    }
  }
  if (open.length > 1) throw new UrdfError(text, open[open.length - 1].begin, `<${open[open.length - 1].name}> is not closed`);
  if (top.children.length !== 1) throw new UrdfError(text, text.length, `there are ${top.children.length} root elements, not one`);
  return top.children[0];
}

export const childrenCalled = (element, name) => element.children.filter((child) => child.name === name);

/** The text with each `[begin, end, replacement]` made; they do not overlap. */
export function edited(text, edits) {
  let result = '', at = 0;
  for (const [begin, end, replacement] of [...edits].sort((a, b) => a[0] - b[0])) {
    result += text.slice(at, begin) + replacement;
    at = end;
  }
  return result + text.slice(at);
}

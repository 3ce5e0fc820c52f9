// What all pages are made with: bundle.cjs makes that of prohull view, app.cjs those for the browser.
const fs = require('fs');
const path = require('path');
const crypto = require('crypto');
const esbuild = require('esbuild');

/** Text that may stand in an element of a page. */
exports.bundled = async (file, options = {}) => (await esbuild.build({
  entryPoints: [file],
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2020',
  charset: 'ascii',
  legalComments: 'inline',
  nodePaths: [process.env.NODE_PATH],
  write: false,
  ...options,
})).outputFiles[0].text.replaceAll('</', '<\\/');

const hash = (text) => `'sha256-${crypto.createHash('sha256').update(text).digest('base64')}'`;

/** Of a title, which is the first line of the source, and a body. The script and the style are named by their hashes in the page's policy,
 *  so that no other one can ever run. `texts` are for the script, by their ids. */
exports.pageOf = (source, {script, style, texts = {}, policy: {scripts = '', others = ''} = {}}) => {
  const [title, ...body] = source.split('\n');
  const rules = `default-src 'none'; script-src ${hash(script)}${scripts}; style-src ${hash(style)}; img-src data: blob:; ` +
      `${others}base-uri 'none'; form-action 'none'`;
  const more = Object.entries(texts).map(([id, text]) => `<script type="text/plain" id="${id}">${text}</script>\n`);
  return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="${rules}">
<meta name="color-scheme" content="light dark">
${title}
<style>${style}</style>
</head>
<body>
${body.join('\n')}${more.join('')}<script>${script}</script>
</body>
</html>
`;
};

const escaped = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;');

/** A function of a source, from the comment above it to its closing brace. `start` is how its line begins, with its indentation. */
function functionIn(source, start) {
  const lines = source.split('\n'), found = lines.flatMap((line, i) => line.startsWith(start) ? [i] : []);
  if (found.length !== 1) throw new Error(`${found.length} lines begin with "${start}", not one`);
  const indentation = /^ */.exec(start)[0];
  let first = found[0];
  while (/^ *(\/\/|template)/.test(lines[first - 1])) --first;
  const end = lines.indexOf(`${indentation}}`, found[0]);
  if (end < 0) throw new Error(`the function "${start}" has no end`);
  return lines.slice(first, end + 1).map((line) => line.slice(indentation.length)).join('\n');
}

/** Puts functions of the repository in the places of a page that name them: <!--code FILE | START-->. */
exports.withCode = (page, root) => page.replaceAll(/<!--code (\S+) \| (.*)-->/g, (_, file, start) =>
  `<details class="code"><summary>The code that runs: <code>${/[\w:]+(?=\()/.exec(start)[0]}</code> in <code>${file}</code></summary>` +
      `<pre tabindex="0"><code>${escaped(functionIn(fs.readFileSync(path.join(root, file), 'utf8'), start))}</code></pre></details>`);

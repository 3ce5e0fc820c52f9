// What both pages are made with: bundle.cjs makes that of prohull view, app.cjs that for the browser.
const fs = require('fs');
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

/** The script and the style are named by their hashes in the page's policy, so that no other one can ever run. */
exports.pageOf = (template, {script, style, policy = {}}, parts = {}) => {
  const {scripts = '', others = ''} = policy;
  const rules = `default-src 'none'; script-src ${hash(script)}${scripts}; style-src ${hash(style)}; img-src data: blob:; ` +
      `${others}base-uri 'none'; form-action 'none'`;
  const all = {'<!--policy-->': rules, '/*style*/': style, '/*script*/': script, ...parts};
  return Object.entries(all).reduce((page, [place, text]) => page.replace(place, () => text), fs.readFileSync(template, 'utf8'));
};

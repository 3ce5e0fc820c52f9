// Bundles the page and writes it as C++: node bundle.cjs SRC TEMPLATE.cpp
// The script and the style are named by their hashes in the page's policy, so that no other one can ever run.
const fs = require('fs');
const path = require('path');
const crypto = require('crypto');
const esbuild = require('esbuild');

const [src, out] = process.argv.slice(2);
const LONGEST = 8000;  // characters of a literal in C++

function bundled(entry) {
  const result = esbuild.buildSync({
    entryPoints: [path.join(src, entry)],
    bundle: true,
    minify: true,
    format: 'iife',
    target: 'es2020',
    charset: 'ascii',
    legalComments: 'inline',
    nodePaths: [process.env.NODE_PATH],
    write: false,
  });
  return result.outputFiles[0].text.replaceAll('</', '<\\/');
}

const hash = (text) => `'sha256-${crypto.createHash('sha256').update(text).digest('base64')}'`;

const script = bundled('main.js');
const style = bundled('style.css');
const policy = `default-src 'none'; script-src ${hash(script)}; style-src ${hash(style)}; img-src data: blob:; ` +
    "base-uri 'none'; form-action 'none'";
const page = fs.readFileSync(path.join(src, 'page.html'), 'utf8')
    .replace('<!--policy-->', () => policy)
    .replace('/*style*/', () => style)
    .replace('/*script*/', () => script);

const literals = [];
for (let at = 0; at < page.length;) {
  let end = Math.min(at + LONGEST, page.length);
  literals.push(`    R"PAGE(${page.slice(at, end)})PAGE"sv,\n`);
  at = end;
}
fs.writeFileSync(out, `#include <array>

#include "view/template.h"

namespace prohull::view {
namespace {

using namespace std::string_view_literals;

constexpr std::array<std::string_view, ${literals.length}> kParts{
${literals.join('')}};

}  // namespace

std::span<const std::string_view> page_template() { return kParts; }

}  // namespace prohull::view
`);

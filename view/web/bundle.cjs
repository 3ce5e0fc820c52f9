// Bundles the page and writes it as C++: node bundle.cjs SRC TEMPLATE.cpp
const fs = require('fs');
const path = require('path');
const {bundled, pageOf} = require('./pages.cjs');

const [src, out] = process.argv.slice(2);
const LONGEST = 8000;  // characters of a literal in C++

async function write() {
  const page = pageOf(fs.readFileSync(path.join(src, 'page.html'), 'utf8'),
      {script: await bundled(path.join(src, 'main.js')), style: await bundled(path.join(src, 'style.css'))});

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
}

write();

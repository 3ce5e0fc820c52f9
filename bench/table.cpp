#include "table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>

namespace prohull::bench {

void Table::add(std::vector<std::string> cells) {
  assert(cells.size() == columns_.size());
  rows_.push_back(std::move(cells));
}

std::string Table::markdown() const {
  std::string text = fmt::format("| {} |\n|---|", fmt::join(columns_, " | "));
  for (std::size_t i = 1; i < columns_.size(); ++i) text += "---:|";
  text += '\n';
  for (const auto& row : rows_) text += fmt::format("| {} |\n", fmt::join(row, " | "));
  return text;
}

std::string Table::csv() const {
  std::string text = fmt::format("{}\n", fmt::join(columns_, ","));
  for (const auto& row : rows_) text += fmt::format("{}\n", fmt::join(row, ","));
  return text;
}

}  // namespace prohull::bench

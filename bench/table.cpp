#include "table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace prohull::bench {

std::string number(double value, int digits, std::string_view unit) {
  return std::isfinite(value) ? fmt::format("{:.{}f}{}", value, digits, unit) : "";
}

std::string as_cell(std::string text) {
  for (char& c : text)
    if (c == ',' || c == '"' || c == '|' || c == '\n') c = ' ';
  return text;
}

std::string difference(double ours, double papers) {
  const double percent = 100 * (ours / papers - 1);
  return std::isfinite(percent) ? fmt::format("{:+.1f} %", std::round(10 * percent) / 10 + 0.0) : "";
}

double median(std::vector<double> numbers) {
  std::erase_if(numbers, [](double number) { return !std::isfinite(number); });
  if (numbers.empty()) return kUnknown;
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::ranges::nth_element(numbers, middle);
  return *middle;
}

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

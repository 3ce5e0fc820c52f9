#include "prohull/length.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace prohull {

Names<double> length_units() {
  static constexpr std::pair<std::string_view, double> kMetres[]{
      {"mm", 0.001}, {"cm", 0.01}, {"m", 1}, {"in", 0.0254}, {"ft", 0.3048}};
  return kMetres;
}

double Length::of(double diagonal) const {
  return unit == "%" ? number / 100 * diagonal : number * value_of(length_units(), unit).value_or(1);
}

std::optional<Length> length_of(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Length length;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), length.number);
  if (error != std::errc() || !(length.number >= 0) || !std::isfinite(length.number)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  if (text.empty()) return rest == text.data() ? std::optional(length) : std::nullopt;
  if (text == "%") length.unit = "%";
  for (const auto& [name, metres] : length_units())
    if (name == text) length.unit = name;
  return length.unit.empty() ? std::nullopt : std::optional(length);
}

}  // namespace prohull

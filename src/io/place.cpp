#include "io/place.h"

#include <fmt/format.h>

namespace prohull {

void fail(std::string_view file, Place place, std::string_view message, Defect defect) {
  const char* unit = place.unit == Place::Unit::Line ? "line" : "byte";
  throw InputError(defect, fmt::format("{}: {} {}: {}", file, unit, place.number, message));
}

std::string printable(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text;
  for (const char c : word.substr(0, kLongest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > kLongest ? "..." : "");
}

std::string quoted(std::string_view word) { return fmt::format("'{}'", printable(word)); }

}  // namespace prohull

#include "io/place.h"

#include <fmt/format.h>

namespace prohull {
namespace {

std::string text(Place place) {
  switch (place.unit) {
    case Place::Unit::Line:
      return fmt::format("line {}: ", place.number);
    case Place::Unit::Byte:
      return fmt::format("byte {}: ", place.number);
    case Place::Unit::Row:
      return fmt::format("row {} (from 0): ", place.number);
    case Place::Unit::None:
      break;
  }
  return {};
}

}  // namespace

void fail(std::string_view file, Place place, std::string_view message, Defect defect) {
  throw InputError(defect, fmt::format("{}: {}{}", file, text(place), message));
}

std::string printable(std::string_view word, std::size_t longest) {
  std::string text;
  for (const char c : word.substr(0, longest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > longest ? "..." : "");
}

std::string in_quotes(std::string_view word) { return fmt::format("'{}'", printable(word)); }

}  // namespace prohull

#include "io/place.h"

#include <fmt/format.h>

#include <algorithm>

#include "prohull/detail/text.h"

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

bool is_end_or_tab(char c) { return c == '\n' || c == '\r' || c == '\t'; }

}  // namespace

void fail(std::string_view file, Place place, std::string_view message, Defect defect) {
  throw InputError(defect, fmt::format("{}: {}{}", file, text(place), message));
}

std::string printable(std::string_view word, std::size_t longest) {
  std::string text;
  std::size_t at = 0;
  while (at < std::min(word.size(), longest)) {
    const std::size_t length = is_end_or_tab(word[at]) ? 0 : character_length(word.substr(at));
    text += length > 0 ? std::string(word.substr(at, length))
                       : fmt::format("\\x{:02x}", static_cast<unsigned char>(word[at]));
    at += std::max<std::size_t>(length, 1);
  }
  return text + (at < word.size() ? "..." : "");
}

std::string in_quotes(std::string_view word) { return fmt::format("'{}'", printable(word)); }

}  // namespace prohull

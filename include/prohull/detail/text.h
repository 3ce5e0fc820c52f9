#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace prohull {

/// A count as messages have it: 96966 -> "96,966".
inline std::string grouped(std::size_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

/// "1 face", "2,100 faces"; `many` if the plural is not made by an s.
inline std::string counted(std::size_t number, std::string_view one, std::string_view many = {}) {
  std::string text = grouped(number) + ' ';
  text += number == 1 || many.empty() ? one : many;
  return text + (number != 1 && many.empty() ? "s" : "");
}

/// The first names of several, and how many others there are: "a, b, and 12 more".
template <class Names>
std::string first_of(const Names& names, std::size_t most = 5) {
  std::string text;
  std::size_t told = 0;
  for (const std::string& name : names)
    if (told < most) text += (told++ > 0 ? ", " : "") + name;
  return names.size() > most ? text + ", and " + grouped(names.size() - most) + " more" : text;
}

/// How many bytes the UTF-8 character has that the text begins with; 0 if it is none that may be shown: a control
/// character other than tab and the ends of lines.
inline std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(0);
  if (first < 0x80) return (first >= 0x20 && first != 0x7f) || std::string_view("\t\n\r").find(text[0]) != text.npos;
  if (first < 0xc0 || first >= 0xf8) return 0;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  char32_t code = first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0u) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3fu);
  }
  constexpr char32_t kLeast[]{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000, control = code < 0xa0;
  const bool no_character = (code & 0xfffe) == 0xfffe || code > 0x10ffff;
  return code < kLeast[length] || surrogate || control || no_character ? 0 : length;
}

}  // namespace prohull

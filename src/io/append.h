#pragma once

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <string>

namespace prohull {

/// Little endian, whatever the machine.
template <class T>
void append_bytes(std::string& out, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw, raw + sizeof(T));
  out.append(raw, sizeof(T));
}

/// The shortest decimals that read back as the same number, whatever the locale.
template <class Number>
void append_number(std::string& out, Number value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  out.append(text, end);
}

}  // namespace prohull

#pragma once

#include <charconv>
#include <string>
#include <string_view>

namespace prohull {

/// A path as a URI has it, with "%20" and its like decoded; "%00" stays as it is, and so does what is no byte.
inline std::string without_percents(std::string_view uri) {
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char byte = 0;
    const std::string_view digits = uri[i] == '%' ? uri.substr(i + 1, 2) : std::string_view();
    const char* const end = digits.data() + digits.size();
    const bool is_byte = digits.size() == 2 && std::from_chars(digits.data(), end, byte, 16).ptr == end && byte != 0;
    path += is_byte ? static_cast<char>(byte) : uri[i];
    if (is_byte) i += 2;
  }
  return path;
}

}  // namespace prohull

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace prohull {

/// What precedes the numbers in an .npy file (versions 1 to 3 of the format).
struct NpyHeader {
  std::string type;  ///< "<f8": byte order, kind and bytes of a number
  bool fortran_order = false;
  std::vector<std::size_t> shape;
  std::size_t size = 0;  ///< of the header itself, in bytes
};

constexpr std::string_view kNpyMagic = "\x93NUMPY";

/// Throws InputError with the byte. Nothing is believed but that the header lies within the content.
NpyHeader read_npy_header(std::string_view content, const std::string& file);

/// As text: "(10, 6)".
std::string shape_text(const std::vector<std::size_t>& shape);

/// The header as numpy writes it: version 1, C order, numbers at a multiple of 64 bytes.
std::string npy_header(std::string_view type, const std::vector<std::size_t>& shape);

}  // namespace prohull

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/number_type.h"

namespace prohull {

struct PlyProperty {
  std::string name;
  NumberType type;
  std::optional<NumberType> count_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;  ///< as claimed
  std::size_t line = 0;
  std::vector<PlyProperty> properties;

  /// Its place among the properties.
  std::optional<std::size_t> find(std::string_view property) const;
  /// The fewest bytes that a record of it takes in a binary file.
  std::size_t min_record_size() const;
};

enum class PlyEncoding { Ascii, LittleEndian, BigEndian };

struct PlyHeader {
  PlyEncoding encoding;
  std::vector<PlyElement> elements;
  std::string_view body;  ///< all that follows
  std::size_t first_body_line;
};

/// Throws InputError with the line; `file` stands in messages.
PlyHeader read_ply_header(std::string_view content, const std::string& file);

}  // namespace prohull

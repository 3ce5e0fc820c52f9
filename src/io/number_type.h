#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "io/byte_cursor.h"

namespace prohull {

/// The types of numbers in binary files.
enum class NumberType : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };

/// In bytes.
constexpr std::size_t size_of(NumberType type) {
  constexpr std::array<std::size_t, 10> kSizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

constexpr bool is_integer(NumberType type) { return type < NumberType::Float32; }

/// Whether the value is in the range of the type; of floats every value is.
constexpr bool holds(NumberType type, double value) {
  if (!is_integer(type)) return true;
  const bool is_signed = static_cast<std::uint8_t>(type) % 2 == 0;
  double most = is_signed ? 0.5 : 1;
  for (std::size_t byte = 0; byte < size_of(type); ++byte) most *= 256;
  return (is_signed ? -most : 0) <= value && value < most;
}

/// Integers beyond 2^53 are rounded.
inline double read_number(ByteCursor& cursor, NumberType type) {
  switch (type) {
    case NumberType::Int8:
      return cursor.read<std::int8_t>();
    case NumberType::UInt8:
      return cursor.read<std::uint8_t>();
    case NumberType::Int16:
      return cursor.read<std::int16_t>();
    case NumberType::UInt16:
      return cursor.read<std::uint16_t>();
    case NumberType::Int32:
      return cursor.read<std::int32_t>();
    case NumberType::UInt32:
      return cursor.read<std::uint32_t>();
    case NumberType::Int64:
      return static_cast<double>(cursor.read<std::int64_t>());
    case NumberType::UInt64:
      return static_cast<double>(cursor.read<std::uint64_t>());
    case NumberType::Float32:
      return cursor.read<float>();
    case NumberType::Float64:
      break;
  }
  return cursor.read<double>();
}

}  // namespace prohull

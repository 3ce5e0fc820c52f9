#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>

#include "io/place.h"

namespace prohull {

/// Walks through binary content in memory. Whoever reads asks `has` first, and knows what the file ends within.
class ByteCursor {
 public:
  ByteCursor(std::string_view bytes, std::size_t position, std::endian order = std::endian::little)
      : bytes_(bytes), position_(position), swap_(order != std::endian::native) {}

  Place place() const { return {Place::Unit::Byte, position_}; }
  std::size_t remaining() const { return bytes_.size() - position_; }
  /// Whether `count` items of `size` bytes are left; no count can make it overflow.
  bool has(std::size_t count, std::size_t size) const { return size == 0 || count <= remaining() / size; }
  void skip(std::size_t size) { position_ += size; }

  template <class T>
  T read() {
    char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + position_, sizeof(T));
    if (swap_) std::reverse(raw, raw + sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    position_ += sizeof(T);
    return value;
  }

 private:
  std::string_view bytes_;
  std::size_t position_;
  bool swap_;
};

}  // namespace prohull

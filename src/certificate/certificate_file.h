#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "prohull/geometry.h"
#include "prohull/progressive_hull.h"

namespace prohull::certificate {

/// The kinds of sections (docs/certificate.md).
enum class Section : std::uint8_t { Tetrahedra = 1, Surfaces, Balls, Gap, Distance, Faces };

constexpr std::uint64_t kCovers = 1, kCoversAndEncloses = 3;

/// The bytes of a certificate, from the first one on.
class File {
 public:
  void number(std::uint64_t n) {
    for (; n >= 0x80; n >>= 7) bytes_.push_back(static_cast<char>(n | 0x80));
    bytes_.push_back(static_cast<char>(n));
  }
  void real(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    for (int shift = 0; shift < 64; shift += 8) bytes_.push_back(static_cast<char>(bits >> shift));
  }
  void point(const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) real(p[axis]);
  }
  void section(Section kind) { number(static_cast<std::uint64_t>(kind)); }
  void add(std::string_view bytes) { bytes_ += bytes; }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace prohull::certificate

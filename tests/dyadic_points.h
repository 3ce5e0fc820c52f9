#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "prohull/geometry.h"

namespace prohull {

/// Random points in [-1, 1]^3 with coordinates of so few bits that sums of them, and points of faces between them, are
/// exact.
class DyadicPoints {
 public:
  explicit DyadicPoints(unsigned seed) : random_(seed) {}

  Vec3 any() { return {coordinate(), coordinate(), coordinate()}; }

  /// A corner of the face, a point of one of its edges, or a point within it: as i % 3 is.
  Vec3 on(const Triangle& face, int i) {
    const int a = i % 3 == 0 ? 16 : uniform(1, i % 3 == 1 ? 15 : 14);
    const int b = i % 3 == 2 ? uniform(1, 15 - a) : 16 - a;
    return face.a * (a / 16.0) + face.b * (b / 16.0) + face.c * ((16 - a - b) / 16.0);
  }

 private:
  int uniform(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }
  double coordinate() {
    constexpr std::int64_t kOne = std::int64_t{1} << 40;
    return std::ldexp(static_cast<double>(std::uniform_int_distribution<std::int64_t>(-kOne, kOne)(random_)), -40);
  }

  std::mt19937 random_;
};

}  // namespace prohull

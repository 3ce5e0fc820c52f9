#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "prohull/geometry.h"

namespace prohull {

struct FloatBox {
  std::array<float, 3> min, max;

  void extend(const FloatBox& other) {
    for (int i = 0; i < 3; ++i) min[i] = std::min(min[i], other.min[i]), max[i] = std::max(max[i], other.max[i]);
  }
  bool overlaps(const FloatBox& other) const {
    // One branch for all: most boxes that are asked for overlap along some axes.
    return (int(min[0] <= other.max[0]) & int(other.min[0] <= max[0]) & int(min[1] <= other.max[1]) &
            int(other.min[1] <= max[1]) & int(min[2] <= other.max[2]) & int(other.min[2] <= max[2])) != 0;
  }
  bool holds(const FloatBox& other) const {
    return (int(min[0] <= other.min[0]) & int(other.max[0] <= max[0]) & int(min[1] <= other.min[1]) &
            int(other.max[1] <= max[1]) & int(min[2] <= other.min[2]) & int(other.max[2] <= max[2])) != 0;
  }
  bool has_inside(const std::array<float, 3>& p) const {
    return (int(min[0] < p[0]) & int(p[0] < max[0]) & int(min[1] < p[1]) & int(p[1] < max[1]) & int(min[2] < p[2]) &
            int(p[2] < max[2])) != 0;
  }
};

/// Coordinates in which a box lies in [-1, 1]^3. The way there is monotone along each axis, though many points may come
/// to one: boxes that overlap still do, and what is strictly inside of a box was so before.
class UnitCube {
 public:
  explicit UnitCube(const Box& box) : center_(box.center()) {
    const Vec3 half = box.max * 0.5 - box.min * 0.5;
    inverse_unit_ = 1 / std::max({half.x, half.y, half.z, std::numeric_limits<double>::min()});
  }

  std::array<float, 3> at(const Vec3& p) const { return {along(0, p.x), along(1, p.y), along(2, p.z)}; }
  /// A length becomes so many times itself.
  double scale() const { return inverse_unit_; }
  FloatBox at(const Box& box) const { return {at(box.min), at(box.max)}; }
  FloatBox at(const Triangle& t) const {
    FloatBox box;
    for (int i = 0; i < 3; ++i) {
      box.min[i] = along(i, std::min({t.a[i], t.b[i], t.c[i]}));
      box.max[i] = along(i, std::max({t.a[i], t.b[i], t.c[i]}));
    }
    return box;
  }

 private:
  float along(int axis, double x) const { return static_cast<float>((x - center_[axis]) * inverse_unit_); }

  Vec3 center_;
  double inverse_unit_;
};

}  // namespace prohull

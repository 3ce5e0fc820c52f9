#pragma once

#include <array>

#include "prohull/geometry.h"

namespace prohull {

/// All points within `radius` of the centre.
struct Ball {
  Vec3 center;
  double radius = 0;

  bool operator==(const Ball&) const = default;
};

/// All points within `radius` of the segment from `a` to `b`.
struct Capsule {
  Vec3 a, b;
  double radius = 0;
};

/// All points center + x axes[0] + y axes[1] + z axes[2] with |x| <= half_sizes.x and so on. The axes have length 1,
/// are at right angles to each other and right-handed, but for rounding.
struct OrientedBox {
  Vec3 center;
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  Vec3 half_sizes;
};

}  // namespace prohull

#pragma once

#include <optional>

#include "geometry/double_double.h"
#include "prohull/geometry.h"

namespace prohull {

/// A plane perpendicular to an axis. Mirrored points are exact, or there are none.
struct MirrorPlane {
  int axis;
  double sum;  ///< of a coordinate and its image: twice the plane's own

  double coordinate() const { return sum / 2; }

  /// The sign of the distance from the plane, exact.
  int side(const Vec3& p) const { return 2 * p[axis] < sum ? -1 : 2 * p[axis] > sum; }

  /// Nothing if no double is the image of the coordinate.
  std::optional<Vec3> image(Vec3 p) const {
    const DoubleDouble image = double_double::difference(sum, p[axis]);
    if (image.low != 0) return std::nullopt;
    p[axis] = image.high;
    return p;
  }
};

}  // namespace prohull

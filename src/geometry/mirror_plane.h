#pragma once

#include <optional>

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
    const double x = p[axis], image = sum - x;
    // Knuth's TwoSum: what rounding has lost of sum - x.
    const double minus_x = image - sum, rest = (sum - (image - minus_x)) + (-x - minus_x);
    if (rest != 0) return std::nullopt;
    p[axis] = image;
    return p;
  }
};

}  // namespace prohull

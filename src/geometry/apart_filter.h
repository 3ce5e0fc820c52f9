#pragma once

#include <array>

#include "geometry/simd.h"
#include "prohull/geometry.h"

namespace prohull {

/// Tells triangles that are certainly apart from one tetrahedron: by the separating axis theorem in floating point,
/// with a gap that is more than rounding. Far cheaper than the exact tests, and they are needed for what it leaves
/// only.
class ApartFilter {
 public:
  /// Coordinates of all corners may be wrong by 2^-51 of them.
  explicit ApartFilter(const std::array<Vec3, 4>& tetrahedron);

  using Corners = std::array<Vec3, 3>;
  /// Of two triangles at a time: bit 0 of the first, bit 1 of the second. A bit that is not set says nothing.
  unsigned certainly_apart(const Corners& first, const Corners& second) const;

 private:
  struct Axis {
    Vec3 direction;
    double low, high, largest;  ///< of the tetrahedron on it; of the direction's coordinates
  };

  std::array<Vec3, 4> corners_;
  double largest_;  ///< coordinate
  std::array<Axis, 4> normals_;
  std::array<Vec3, 6> edges_;
};

}  // namespace prohull

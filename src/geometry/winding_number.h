#pragma once

#include <optional>
#include <vector>

#include "geometry/bvh.h"
#include "prohull/geometry.h"

namespace prohull {

/// How often closed, outwards oriented surfaces wind around a point.
class WindingNumber {
 public:
  explicit WindingNumber(std::vector<Triangle> triangles);

  /// The signed number of triangles that a ray from p crosses. Exact; where it meets edges and corners it decides as if
  /// p were moved by an infinitesimal amount. Nothing if p may lie on the surface: in the plane of a triangle and in
  /// its box, or of a triangle that the moved ray meets.
  std::optional<int> at(const Vec3& p) const;

 private:
  std::vector<Triangle> triangles_;
  Bvh bvh_;
};

}  // namespace prohull

#pragma once

#include <array>

#include "prohull/geometry.h"
#include "prohull/triangle_mesh.h"

namespace prohull::cover {

/// An affine frame in which a polytope is about as long as wide and thick: 2, with its centroid at the origin. Ratios
/// of volumes are the same in every such frame, so needles and plates are as easy to approximate as balls.
class LocalFrame {
 public:
  /// `rounding`, greater than 0, is the least thickness that the polytope is taken to have.
  LocalFrame(const TriangleMesh& polytope, double rounding);

  Vec3 to_local(const Vec3& p) const {
    const Vec3 d = p - origin_;
    return {dot(d, axes_[0]) / sizes_.x, dot(d, axes_[1]) / sizes_.y, dot(d, axes_[2]) / sizes_.z};
  }
  Vec3 to_world(const Vec3& p) const {
    return origin_ + axes_[0] * (p.x * sizes_.x) + axes_[1] * (p.y * sizes_.y) + axes_[2] * (p.z * sizes_.z);
  }

  /// How far a cube of half-size 1 in the world, with sides along its axes, reaches along a local normal.
  double reach_of_unit_cube(const Vec3& normal) const {
    const Vec3 n =
        axes_[0] * (normal.x / sizes_.x) + axes_[1] * (normal.y / sizes_.y) + axes_[2] * (normal.z / sizes_.z);
    return std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  }

 private:
  Vec3 origin_;
  std::array<Vec3, 3> axes_;
  Vec3 sizes_;
};

}  // namespace prohull::cover

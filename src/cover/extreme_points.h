#pragma once

#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull::cover {

/// The vertices of a mesh that matter for what encloses it, and their convex hull in coordinates in which it is about 1
/// large and around the origin.
struct ExtremePoints {
  explicit ExtremePoints(const TriangleMesh& mesh);

  Vec3 to_world(const Vec3& p) const { return center + p * unit; }
  /// At least 1e-9 of the diagonal of the bounding box.
  double spare() const { return kSpare * unit; }
  /// The radius that encloses all around the segment from a to b, in the world, with something to spare.
  double radius_around(const Vec3& a, const Vec3& b) const;

  TriangleMesh hull;        ///< never flat: thickened by the spare if the mesh is
  std::vector<Vec3> world;  ///< as they are given
  Vec3 center;
  double unit;  ///< half of the longest side of the bounding box

 private:
  static constexpr double kSpare = 4e-9;
};

/// From p to the segment between the origin and `end`.
double distance_to_segment(const Vec3& p, const Vec3& end, double squared_length);

}  // namespace prohull::cover

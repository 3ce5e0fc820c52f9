#pragma once

#include <optional>
#include <vector>

#include "cover/local_frame.h"
#include "prohull/triangle_mesh.h"

namespace prohull::cover {

/// What a polytope of few vertices has to enclose: points in a local frame, each with a cube around it, of half-size
/// `rounding` in the world, so that the vertices may be rounded afterwards.
class Target {
 public:
  Target(const TriangleMesh& polytope, double rounding);

  const LocalFrame& frame() const { return frame_; }
  const std::vector<Vec3>& points() const { return points_; }
  /// What the cubes add to the products of points with a normal.
  double allowance(const Vec3& normal) const { return rounding_ * frame_.reach_of_unit_cube(normal); }
  /// The greatest product of a point with `normal`; all products in `products`.
  double greatest_product(const Vec3& normal, std::vector<double>& products) const;

 private:
  LocalFrame frame_;
  double rounding_;
  std::vector<Vec3> points_;
  std::vector<double> x_, y_, z_;
};

/// The convex polytope, scaled about the origin so that it just encloses the target; nothing if the origin is not
/// inside of it.
std::optional<TriangleMesh> scaled_around(TriangleMesh polytope, const Target& target);

/// Moves the vertices of a convex polytope so that it encloses the target with less volume. It has no more vertices
/// than before. It may miss the target by a little: scaled_around repairs that.
TriangleMesh tightened(TriangleMesh polytope, const Target& target);

}  // namespace prohull::cover

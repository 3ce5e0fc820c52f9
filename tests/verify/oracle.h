#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "prohull/detail/shapes.h"
#include "prohull/triangle_mesh.h"

namespace prohull::oracle {

// Decides by brute force, in exact numbers, and by other means than src/verify. Compiled once for all tests, as CGAL
// takes long.

struct Faces;

/// The triangles of a mesh, of which none is turned.
class Chain {
 public:
  explicit Chain(const TriangleMesh& mesh);

  /// The winding number of x: the signed count of the cones from an apex over all faces that hold it. None if x lies on
  /// the boundary of a cone.
  std::optional<int> winding(const Vec3& apex, const Vec3& x) const;

  /// Whether the closure of what the chain winds around at least once holds the triangle: that is cut by all planes
  /// around, and near one point of each piece every region is looked at that the planes leave.
  bool covers(const Triangle& t, std::mt19937& random) const;

  /// Whether `outer` winds around all of what this winds around. Solids are cut into tetrahedra by all planes around.
  bool is_enclosed_by(const Chain& outer, std::mt19937& random) const;

  /// The same, inside the given tetrahedra alone.
  bool is_enclosed_by(const Chain& outer, const std::vector<std::array<Vec3, 4>>& within, std::mt19937& random) const;

 private:
  std::shared_ptr<const Faces> faces_;
};

/// Whether the ball holds the sum of the corners times the weights.
bool contains(const Ball& ball, const Triangle& t, const std::array<double, 3>& weights);

bool has_area(const Triangle& t);

/// Whether no two points of the triangles are nearer than that. Both have area.
bool are_apart(const Triangle& s, const Triangle& t, double distance);

/// The pairs of faces that intersect, as CGAL counts them.
std::size_t self_intersections(const TriangleMesh& mesh);

/// The convex hull of all vertices, as CGAL makes it.
TriangleMesh convex_hull(const TriangleMesh& mesh);

}  // namespace prohull::oracle

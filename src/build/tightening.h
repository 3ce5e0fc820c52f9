#pragma once

#include <cstddef>

#include "geometry/bvh.h"
#include "geometry/winding_number.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/hull_builder.h"

namespace prohull {

/// What the vertices of a hull move towards.
class Original {
 public:
  /// For an inner hull turned inside out, as the hull is: then it too is outside of it.
  Original(TriangleMesh mesh, HullSide side);

  const Bvh& tree() const { return tree_; }  ///< over the boxes of faces
  Triangle triangle(std::uint32_t face) const { return mesh_.triangle(FaceId(face)); }
  const Box& bounds() const { return bounds_; }
  /// Whether the hull must enclose the point, or may have to: true where that is not certain. Exact otherwise.
  bool may_need_cover(const Vec3& p) const { return winding_.at(p).value_or(least_covered_) >= least_covered_; }

 private:
  TriangleMesh mesh_;
  Bvh tree_;
  WindingNumber winding_;
  int least_covered_;
  Box bounds_;
};

/// Moves the vertices of a hull towards the original mesh, one at a time, in rounds until hardly anything is gained.
/// Returns the number of moves. HullOptions gives the shape guards, float32_coordinates and progress.
///
/// Moving a vertex from P to Q replaces its star. Along each edge (a, b) of its link lies a tetrahedron (P, Q, a, b);
/// as chains, the new star is the old one plus those that are added outside minus those that are removed. So the hull
/// still encloses if no removed tetrahedron holds a point of the solid in its inside: no original triangle meets the
/// inside, and some point of it is outside of the original. Both are decided exactly, on stored coordinates. Nor is a
/// move made that adds a pair of intersecting faces.
std::size_t tighten(HalfEdgeMesh& hull, const Original& original, const HullOptions& options);

}  // namespace prohull

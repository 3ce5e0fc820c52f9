#pragma once

#include <cstddef>
#include <optional>

#include "geometry/bvh.h"
#include "geometry/tetrahedron_contact.h"
#include "geometry/winding_number.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/hull_builder.h"

namespace prohull {

/// What the vertices of a hull move towards: a closed mesh, or any triangles, of which the hull covers every one.
class Original {
 public:
  /// For an inner hull turned inside out, as the hull is: then it too is outside of it.
  static Original closed(TriangleMesh mesh, HullSide side);
  /// Hulls keep `clearance` from triangles, about, but never touch them.
  static Original triangles(TriangleMesh mesh, double clearance);

  const Bvh& tree() const { return tree_; }  ///< over the boxes of faces
  Triangle triangle(std::uint32_t face) const { return mesh_.triangle(FaceId(face)); }
  const Box& bounds() const { return bounds_; }
  double clearance() const { return clearance_; }  ///< 0: faces may touch

  /// Whether the hull may give up the tetrahedron. Exact; false where that is not certain.
  bool lies_outside_of(const Tetrahedron& removed) const;

 private:
  Original(TriangleMesh mesh, double clearance);

  TriangleMesh mesh_;
  Bvh tree_;
  Box bounds_;
  double clearance_;
  std::optional<WindingNumber> winding_;  ///< of a closed mesh
  int least_covered_ = 1;
};

/// Moves the vertices of a hull towards the original mesh, one at a time, in rounds until hardly anything is gained.
/// Returns the number of moves. HullOptions gives the shape guards, float32_coordinates and progress.
///
/// Moving a vertex from P to Q replaces its star. Along each edge (a, b) of its link lies a tetrahedron (P, Q, a, b);
/// as chains, the new star is the old one plus those that are added outside minus those that are removed. So the hull
/// still encloses a closed mesh if no removed tetrahedron holds a point of the solid in its inside: no original triangle
/// meets the inside, and some point of it is outside of the original. It still covers triangles of any kind if none
/// touches a removed tetrahedron: one between two of them would meet the inside of neither. All this is decided
/// exactly, on stored coordinates. Nor is a move made that adds a pair of intersecting faces.
std::size_t tighten(HalfEdgeMesh& hull, const Original& original, const HullOptions& options);

}  // namespace prohull

#pragma once

#include <optional>

#include "geometry/bvh.h"
#include "geometry/tetrahedron_contact.h"
#include "geometry/winding_number.h"
#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// What the vertices of a hull move towards: a closed mesh, or any triangles, of which the hull covers every one.
class Original {
 public:
  /// For an inner hull turned inside out, as the hull is: then it too is outside of it.
  static Original closed(TriangleMesh mesh, HullSide side);
  /// Hulls keep `clearance` from triangles, about, but never touch them.
  static Original triangles(TriangleMesh mesh, double clearance);
  /// New faces of hulls keep this distance from triangles.
  static Original padded_triangles(TriangleMesh mesh, double padding);

  const Bvh& tree() const { return tree_; }  ///< over the boxes of faces
  const TriangleMesh& mesh() const { return mesh_; }
  const Box& bounds() const { return bounds_; }
  double clearance() const { return clearance_; }  ///< 0: faces may touch

  /// Whether the hull may give up the tetrahedron. Exact; false where that is not certain.
  bool lies_outside_of(const Tetrahedron& removed) const;

  double padding() const { return padding_; }
  /// Whether a face of the hull keeps the padding. True without one.
  bool keeps_padding(const Triangle& face) const;

 private:
  Original(TriangleMesh mesh, double clearance);

  TriangleMesh mesh_;
  Bvh tree_;
  Box bounds_;
  double clearance_;
  double padding_ = 0;
  std::optional<WindingNumber> winding_;  ///< of a closed mesh
  int least_covered_ = 1;
};

}  // namespace prohull

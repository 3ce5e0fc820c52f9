#pragma once

#include <optional>
#include <vector>

#include "prohull/mesh_query.h"
#include "prohull/triangle_mesh.h"
#include "verify/surface.h"

namespace prohull::verify {

/// The convex hulls of pairs of faces that share an edge, as far as they are proven to lie in the solid that the faces
/// bound, or on its faces. The distance to such a hull, a tetrahedron, is a convex function. So it bounds the distance
/// from the solid for all points of a triangle that lies across an edge, where the distance to a single face would say
/// little.
class ConvexPairs {
 public:
  /// `mesh` is closed, and each of its parts is turned outwards, or it has no faces.
  explicit ConvexPairs(const TriangleMesh& mesh);

  /// A bound of how far points of the triangle are from the solid, by the hulls that `face` belongs to; infinite if it
  /// belongs to none.
  double distance_at_most(FaceId face, const Triangle& triangle);

 private:
  struct Pair {
    TriangleMesh hull;
    std::optional<bool> is_proven = std::nullopt;   // nullopt: nobody has asked
    std::optional<MeshQuery> query = std::nullopt;  // made when it is asked for
  };

  bool lies_in_solid(const TriangleMesh& hull) const;

  Surface surface_;
  std::vector<Pair> pairs_;
  PerFace<std::vector<std::size_t>> of_face_;  // in pairs_
};

}  // namespace prohull::verify

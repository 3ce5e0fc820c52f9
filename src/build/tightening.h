#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "build/self_intersection_guard.h"
#include "geometry/bvh.h"
#include "geometry/linear_program.h"
#include "geometry/winding_number.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/hull_builder.h"

namespace prohull {

/// Moves the vertices of an outer hull towards the original mesh, one at a time, as far as the enclosure allows.
///
/// Moving a vertex from P to Q replaces its star. Along each edge (a, b) of its link lies a tetrahedron (P, Q, a, b);
/// as chains, the new star is the old one plus those that are added outside minus those that are removed. So the hull
/// still encloses if no removed tetrahedron holds a point of the solid in its inside: no original triangle meets the
/// inside, and some point of it is outside of the original. Both are decided exactly, on stored coordinates.
class Tightening {
 public:
  /// `original` and `mesh` outlive this; `rounding` is the most by which storing moves a coordinate.
  Tightening(const TriangleMesh& original, HalfEdgeMesh& mesh, const HullOptions& options, double rounding);

  /// Rounds over the vertices until hardly anything is gained.
  void run();

 private:
  bool improve(VertexId v);
  void gather(VertexId v);
  std::optional<Vec3> propose(double margin);
  bool add_cuts(const Vec3& apex, double margin);
  std::optional<Vec3> deepest_point(const Vec3& apex, const Vec3& a, const Vec3& b);
  std::size_t after(std::size_t i) const { return i + 1 == link_.size() ? 0 : i + 1; }
  bool has_good_shape(const Vec3& apex) const;
  bool keeps_enclosing(const Vec3& from, const Vec3& to) const;

  const TriangleMesh& original_;
  HalfEdgeMesh& mesh_;
  const HullOptions& options_;
  const double rounding_;
  Bvh tree_;
  WindingNumber solid_;
  SelfIntersectionGuard guard_;

  // The vertex in hand; `local` is in a frame with the origin there, the farthest link vertex at distance 1.
  std::vector<VertexId> link_;
  std::vector<Vec3> local_;
  double scale_ = 1;
  std::vector<Triangle> candidates_;  ///< original faces nearby, local
  Vec3 objective_;
  std::vector<HalfSpace> constraints_;
  std::vector<Triangle> near_;
  std::vector<Vec3> polygon_, clipped_;
};

}  // namespace prohull

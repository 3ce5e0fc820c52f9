#pragma once

#include <array>
#include <optional>
#include <vector>

#include "construct/tight/original.h"
#include "geometry/linear_program.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/hull_builder.h"

namespace prohull {

/// Where a vertex of a hull may move so that the hull loses volume and still encloses the original: a linear program
/// with cutting planes proposes, exact predicates decide.
///
/// Moving a vertex from P to Q replaces its star. Along each edge (a, b) of its link lies a tetrahedron (P, Q, a, b);
/// as chains, the new star is the old one plus those that are added outside minus those that are removed. So the hull
/// still encloses a closed mesh if no removed tetrahedron holds a point of the solid in its inside: no original
/// triangle meets the inside, and some point of it is outside of the original. It still covers triangles of any kind if
/// none touches a removed tetrahedron: one between two of them would meet the inside of neither. All this is decided
/// exactly, on stored coordinates.
class TightPlacement {
 public:
  TightPlacement(const Original& original, bool float32_coordinates);

  /// The vertex, which need not be in the mesh, and its link in order around it.
  void set(const Vec3& from, const HalfEdgeMesh& mesh, const std::vector<VertexId>& link);

  /// The first of its proposals, as stored, that is_accepted(to) accepts and where the hull still encloses. Exact.
  template <class IsAccepted>
  std::optional<Vec3> first(IsAccepted&& is_accepted);

  /// A frame with the origin at the vertex and the farthest link vertex at distance 1.
  const std::vector<Vec3>& local_link() const { return local_; }
  Vec3 to_local(const Vec3& p) const { return (p - from_) / scale_; }
  std::size_t after(std::size_t i) const { return i + 1 == local_.size() ? 0 : i + 1; }

  /// Whether the vertex may move there: the hull still encloses, and keeps its padding. Exact.
  bool keeps_enclosing(const Vec3& to) const;

  Vec3 as_stored(const Vec3& p) const;
  double rounding() const { return rounding_; }

 private:
  std::optional<Vec3> propose(double margin);
  bool add_cuts(const Vec3& apex, double margin);
  std::optional<Vec3> deepest_point(const Vec3& apex, const Vec3& a, const Vec3& b);
  double allowed_depth() const;

  const Original& original_;
  const bool float32_coordinates_;
  const double rounding_;  ///< the most by which storing moves a coordinate, with some room

  Vec3 from_;
  double scale_ = 1;
  std::vector<Vec3> link_, local_;
  Vec3 objective_;
  std::vector<HalfSpace> constraints_;

  std::vector<Vec3> polygon_, clipped_;  ///< scratch
};

template <class IsAccepted>
std::optional<Vec3> TightPlacement::first(IsAccepted&& is_accepted) {
  // The second margin is for what rounding and the tolerances of the proposal have got wrong.
  constexpr double kLeastMargin = 1e-10, kWideMargin = 1e-7;
  const double clearance = original_.clearance() / scale_, rounding = rounding_ / scale_;
  for (const double margin : {clearance + kLeastMargin + 2 * rounding, clearance + kWideMargin + 8 * rounding}) {
    const auto apex = propose(margin);
    if (!apex) return std::nullopt;
    for (const double step : {1.0, 0.5, 0.25})
      if (const Vec3 to = as_stored(from_ + *apex * (step * scale_));
          is_finite(to) && is_accepted(to) && keeps_enclosing(to))
        return to;
  }
  return std::nullopt;
}

}  // namespace prohull

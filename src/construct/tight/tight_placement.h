#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "construct/tight/original.h"
#include "geometry/linear_program.h"
#include "geometry/simd.h"
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
///
/// What keeps a vertex are few points of the original, and mostly those that kept it, or its neighbours, before. So the
/// caller keeps these, and the original is searched only where the exact test says that others are in the way.
class TightPlacement {
 public:
  TightPlacement(const Original& original, bool float32_coordinates);

  /// The vertex, which need not be in the mesh, and its link in order around it.
  void set(const Vec3& from, const HalfEdgeMesh& mesh, const std::vector<VertexId>& link);
  /// Points of the original that cut before, near here.
  void know(const std::vector<Vec3>& points);
  /// The points that have cut since then.
  const std::vector<Vec3>& found() const { return found_; }
  /// How many triangles near the vertex were looked at, each time they were.
  std::size_t looks() const { return looks_; }

  /// The first of its proposals, as stored, that is_accepted(to) accepts and where the hull still encloses. Exact.
  template <class IsAccepted>
  std::optional<Vec3> first(IsAccepted&& is_accepted);

  /// Where the vertex would go if only the known points were in the way; as stored. What this finds out, `first` uses.
  std::optional<Vec3> guess();

  /// A frame with the origin at the vertex and the farthest link vertex at distance 1.
  const std::vector<Vec3>& local_link() const { return local_; }
  Vec3 to_local(const Vec3& p) const { return (p - from_) * inverse_scale_; }
  std::size_t after(std::size_t i) const { return i + 1 == local_.size() ? 0 : i + 1; }

  /// Whether the vertex may move there: the hull still encloses, and keeps its padding. Exact.
  bool keeps_enclosing(const Vec3& to);

  /// Whether new faces keep the padding of the original, if it has one. Exact.
  bool keeps_padding(const Vec3& to) const;

  Vec3 as_stored(const Vec3& p) const;
  double rounding() const { return rounding_; }

 private:
  double least_margin() const;
  double wide_margin() const;
  void begin(double margin);
  std::optional<Vec3> propose();
  std::optional<Vec3> propose_enclosing();
  void add_known(const Vec3& local);
  bool add_known_cuts(const Vec3& apex);
  bool add_cut(std::size_t i, const Vec3& point);
  class Deepest;
  std::array<Vec3, 3> local_corners(FaceId f) const;
  void find_near(const Tetrahedron& removed);
  void leave_out_apart(const Tetrahedron& removed);
  void find_reaching(const Deepest& deepest);
  void take_parts_of_reaching(Deepest& deepest);
  bool is_any_in_the_way(const Tetrahedron& removed);
  bool cut_where_met(const Vec3& apex, const Vec3& to);
  bool add_padding_cut(std::size_t i, const Vec3& apex, const Vec3& point);
  bool add_known_padding_cuts(const Vec3& apex);
  bool cut_where_near(const Vec3& apex, const Vec3& to);
  std::optional<Vec3> deepest_in(std::size_t i, const Vec3& apex, const Tetrahedron& removed);
  bool is_outside(const Vec3& to) const;
  double allowed_depth() const;

  const Original& original_;
  const bool float32_coordinates_;
  const double rounding_;  ///< the most by which storing moves a coordinate, with some room

  Vec3 from_;
  double scale_ = 1, inverse_scale_ = 1;
  std::vector<Vec3> link_, local_;
  Vec3 objective_;
  /// Points that may cut, local; their coordinates, four to a lane, once more in float32.
  struct Known {
    void clear();
    void add(const Vec3& p);
    std::vector<Vec3> points;
    std::vector<std::array<Float4, 3>> fours;
  };
  Known known_;
  std::vector<Vec3> found_;

  // Of the proposal in hand.
  double margin_ = 0;
  int programs_left_ = 0;
  bool is_begun_ = false;  ///< with the least margin, by a guess
  bool encloses_ = false;
  HalfSpaces constraints_;

  // Scratch.
  std::size_t looks_ = 0;
  std::vector<FaceId> near_;
  std::vector<std::array<Vec3, 3>> reaching_;  ///< local
  std::vector<Vec3> polygon_, clipped_;
};

template <class IsAccepted>
std::optional<Vec3> TightPlacement::first(IsAccepted&& is_accepted) {
  for (const double margin : {least_margin(), wide_margin()}) {
    if (!std::exchange(is_begun_, false)) begin(margin);
    const auto apex = propose_enclosing();
    if (!apex) return std::nullopt;
    const auto at = [&](double step) { return as_stored(from_ + *apex * (step * scale_)); };
    if (encloses_ && is_accepted(at(1))) return at(1);
    for (const double step : {0.5, 0.25})
      if (const Vec3 to = at(step); is_finite(to) && is_accepted(to) && keeps_enclosing(to)) return to;
    if (encloses_) return std::nullopt;  // a wider margin would change nothing
  }
  return std::nullopt;
}

}  // namespace prohull

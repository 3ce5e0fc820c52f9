#include "verify/original.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/no_index.h"
#include "geometry/predicates.h"
#include "geometry/triangle_key.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/enclosure.h"

namespace prohull {
namespace {

struct LinkEdge {
  VertexId from, to;
  std::uint32_t corner;  ///< of the face beside it, at the vertex whose link this is
};

/// The faces as they are now: a corner list, and for each vertex a chain of its corners.
class Replay {
 public:
  explicit Replay(const ProgressiveHull& hull)
      : hull_(hull),
        vertex_(hull.base_corners()),
        next_(vertex_.size(), kNone),
        first_(hull.positions().size(), kNone),
        wrong_side_(hull.side() == HullSide::Outer ? Side::Inside : Side::Outside) {
    for (std::uint32_t c = 0; c < vertex_.size(); ++c)
      if (vertex_[c] != ProgressiveHull::kAbsent) chain(c, vertex_[c]);
  }

  /// Undoes the collapse that made s; the reason if that proves nothing.
  std::optional<std::string> split(VertexId s, const VertexSplit& record) {
    if (!order_link(s, record.l)) return "the faces around its vertex are not one disk with l on its border";
    const auto r = std::ranges::find(link_, record.r, &LinkEdge::from);
    if (r == link_.end() || r == link_.begin()) return "r is not on the border of the star of its vertex, or is l";
    if (is_taken(record.o) || is_taken(record.d) || record.o == record.d) return "its new vertices exist";
    if (!has_room(record.od) || !has_room(record.do_) || record.od / 3 == record.do_ / 3)
      return "its new faces exist already";
    first_[s] = kNone;
    for (auto e = link_.begin(); e != link_.end(); ++e) chain(e->corner, e < r ? record.o : record.d);
    place(record.od, {record.o, record.d, record.l});
    place(record.do_, {record.d, record.o, record.r});

    const Vec3& apex = hull_.positions()[s];
    for (const LinkEdge& e : link_)
      if (is_on_wrong_side(e.corner / 3, apex)) return fmt::format("it sees face {} from the wrong side", e.corner / 3);
    for (const std::uint32_t face : {record.od / 3, record.do_ / 3})
      if (is_on_wrong_side(face, apex)) return fmt::format("it sees face {} from the wrong side", face);
    return std::nullopt;
  }

  std::size_t signs() const { return signs_; }

  const std::vector<VertexId>& corners() const { return vertex_; }

  /// Whether all faces have come back.
  bool is_complete() const { return std::ranges::count(vertex_, ProgressiveHull::kAbsent) == 0; }

  Triangle triangle(std::size_t face) const {
    const auto at = [&](std::size_t c) { return hull_.positions()[vertex_[3 * face + c]]; };
    return {at(0), at(1), at(2)};
  }

 private:
  void chain(std::uint32_t corner, VertexId v) {
    vertex_[corner] = v;
    next_[corner] = first_[v];
    first_[v] = corner;
  }

  static std::uint32_t following(std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }

  // The edges opposite to s, from l on, each starting where the one before ends; false if they are not one closed line.
  bool order_link(VertexId s, VertexId l) {
    by_start_.clear();
    for (std::uint32_t c = first_[s]; c != kNone; c = next_[c])
      by_start_.push_back({vertex_[following(c)], vertex_[following(following(c))], c});
    std::ranges::sort(by_start_, {}, &LinkEdge::from);
    link_.clear();
    for (VertexId v = l; link_.size() < by_start_.size();) {
      const auto e = std::ranges::lower_bound(by_start_, v, {}, &LinkEdge::from);
      if (e == by_start_.end() || e->from != v) return false;
      if (!link_.empty() && v == l) return false;
      link_.push_back(*e);
      v = e->to;
    }
    return !link_.empty() && link_.back().to == l;
  }

  bool is_taken(VertexId v) const { return index(v) >= first_.size() || first_[v] != kNone; }
  bool has_room(std::uint32_t corner) const {
    return corner < vertex_.size() && vertex_[corner] == ProgressiveHull::kAbsent;
  }

  void place(std::uint32_t corner, const std::array<VertexId, 3>& face) {
    for (const VertexId v : face) {
      chain(corner, v);
      corner = following(corner);
    }
  }

  bool is_on_wrong_side(std::uint32_t face, const Vec3& apex) {
    ++signs_;
    const Triangle t = triangle(face);
    return side(t.a, t.b, t.c, apex) == wrong_side_;
  }

  const ProgressiveHull& hull_;
  std::vector<VertexId> vertex_;     ///< of each corner
  std::vector<std::uint32_t> next_;  ///< corner of the same vertex
  PerVertex<std::uint32_t> first_;   ///< corner of each vertex
  const Side wrong_side_;
  std::vector<LinkEdge> by_start_, link_;
  std::size_t signs_ = 0;
};

// The chain of the faces. Triangles with two equal corners are no part of it.
template <class TriangleOf>
std::vector<TriangleKey> chain_of(std::size_t count, TriangleOf triangle) {
  std::vector<TriangleKey> all;
  for (std::size_t f = 0; f < count; ++f)
    if (const Triangle t = triangle(f); t.a != t.b && t.b != t.c && t.c != t.a) all.push_back(oriented_key(t));
  std::ranges::sort(all);
  return all;
}

// Mostly the faces have the same order. Otherwise both are sorted, which takes six times the memory of a mesh.
bool has_triangles_of(const Replay& replay, const TriangleMesh& original) {
  const auto ours = [&](std::size_t f) { return replay.triangle(f); };
  const auto theirs = [&](std::size_t f) { return original.triangle(FaceId(static_cast<std::uint32_t>(f))); };
  const std::size_t faces = replay.corners().size() / 3;
  bool are_same = faces == original.face_count();
  for (std::size_t f = 0; f < faces && are_same; ++f) are_same = ours(f) == theirs(f);
  return are_same || chain_of(faces, ours) == chain_of(original.face_count(), theirs);
}

bool is_well_formed(const ProgressiveHull& hull) {
  return hull.positions().size() == hull.original_vertex_count() + hull.splits().size() &&
         hull.base_corners().size() % 3 == 0 &&
         std::ranges::all_of(hull.positions(), [](const Vec3& p) { return is_finite(p); }) &&
         std::ranges::all_of(hull.base_corners(), [&](VertexId v) {
           return v == ProgressiveHull::kAbsent || index(v) < hull.positions().size();
         });
}

}  // namespace

ReplayReport verify::replay(const ProgressiveHull& hull, const TriangleMesh& outwards, const Progress& progress) {
  ProgressCounter counter(progress, "verify", hull.splits().size());
  ReplayReport report;
  if (!is_well_formed(hull)) {
    report.why_not = "it names vertices that do not exist, or that are not finite";
    return report;
  }
  Replay replay(hull);
  for (std::size_t i = hull.splits().size(); i-- > 0;) {
    if (const auto why = replay.split(hull.made_vertex(i), hull.splits()[i])) {
      report.why_not = fmt::format("split {}: {}", i, *why);
      return report;
    }
    report.signs = replay.signs();
    ++report.splits;
    counter.next();
  }
  report.holds = replay.is_complete() && has_triangles_of(replay, outwards);
  if (!report.holds)
    report.why_not = "the finest level does not have the triangles of the original mesh, turned outwards";
  return report;
}

ReplayReport verify_replay(const ProgressiveHull& hull, const TriangleMesh& original, const Progress& progress) {
  return verify::replay(hull, turned_outwards(original), progress);
}

}  // namespace prohull

#include "certificate/tetrahedra.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "certificate/certificate_file.h"
#include "geometry/no_index.h"
#include "mesh/closed.h"
#include "mesh/half_edge_mesh.h"
#include "verify/surface.h"

// An edge collapse is two fans of its new vertex s: one over all triangles around o, and one over those around d that
// do not touch o.

namespace prohull::certificate {
namespace {

/// A sum of oriented triangles, by the numbers of their corners.
class Chain {
 public:
  void add(std::array<std::uint32_t, 3> t, int times) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    if (t[1] > t[2]) std::swap(t[1], t[2]), times = -times;
    terms_.push_back({t, times});
  }

  bool is_zero() {
    std::ranges::sort(terms_, {}, &Term::corners);
    for (std::size_t i = 0; i < terms_.size();) {
      int sum = 0;
      const auto corners = terms_[i].corners;
      for (; i < terms_.size() && terms_[i].corners == corners; ++i) sum += terms_[i].times;
      if (sum != 0) return false;
    }
    return true;
  }

 private:
  struct Term {
    std::array<std::uint32_t, 3> corners;
    int times;
  };
  std::vector<Term> terms_;
};

/// Numbers for positions, equal for equal ones: first come the vertices of the original, then those of the levels, and
/// those of the hull.
class Points {
 public:
  Points(const ProgressiveHull& levels, const TriangleMesh& hull, const CertifiedOriginal& original)
      : level_begin_(original.mesh.vertex_count()), hull_begin_(level_begin_ + levels.positions().size()) {
    all_ = original.mesh.positions;
    for (const auto* positions : {&levels.positions(), &hull.positions})
      for (const Vec3& p : *positions) all_.push_back(p);
    number_ = numbered_by_position(all_);
    in_file_.assign(all_.size(), kNone);
    if (original.has_loose_corners) {
      for (const FaceId f : original.mesh.triangles.ids())
        for (std::uint32_t c = 0; c < 3; ++c)
          if (std::uint32_t& known = in_file_[index(original.mesh.triangles[f][c])]; known == kNone)
            known = 3 * index(f) + c;
      vertices_ = 3 * static_cast<std::uint32_t>(original.mesh.face_count());
    } else {
      for (; vertices_ < level_begin_; ++vertices_) in_file_[vertices_] = vertices_;
    }
  }

  std::uint32_t of_original(VertexId v) const { return number_[index(v)]; }
  std::uint32_t of_level(VertexId v) const { return number_[level_begin_ + index(v)]; }
  std::uint32_t of_hull(VertexId v) const { return number_[hull_begin_ + index(v)]; }

  /// The number that the certificate has for a vertex of the levels.
  std::uint64_t in_file(VertexId v) {
    const std::uint32_t i = of_level(v);
    if (in_file_[i] == kNone) {
      in_file_[i] = vertices_ + added_++;
      new_points_.point(all_[VertexId(i)]);
    }
    return in_file_[i];
  }

  std::uint32_t added() const { return added_; }
  const std::string& new_points() const { return new_points_.bytes(); }

 private:
  const std::size_t level_begin_, hull_begin_;
  PerVertex<Vec3> all_;
  std::vector<std::uint32_t> number_, in_file_;
  std::uint32_t vertices_ = 0, added_ = 0;
  File new_points_;
};

class Fans {
 public:
  explicit Fans(Points& points) : points_(points) {}

  /// Those of the collapse that made s, which is still there.
  void add(const HalfEdgeMesh& mesh, VertexId s, const VertexSplit& split) {
    HalfEdgeId to_l = mesh.out(s);
    while (mesh.tip(to_l) != split.l) to_l = mesh.rotated(to_l);
    around_o_.clear(), around_d_.clear();
    bool is_of_d = false;
    HalfEdgeId h = to_l;
    do {
      const VertexId x = mesh.tip(h);
      if (x == split.r) around_o_.push_back(x), is_of_d = true;
      (is_of_d ? around_d_ : around_o_).push_back(x);
      h = mesh.rotated(h);
    } while (h != to_l);
    for (const VertexId x : {split.d, split.l}) around_o_.push_back(x);
    around_d_.push_back(split.l);
    add(s, split.o, around_o_);
    add(s, split.d, around_d_);
  }

  std::size_t count() const { return count_; }
  const std::string& bytes() const { return bytes_.bytes(); }

 private:
  void add(VertexId apex, VertexId centre, const std::vector<VertexId>& border) {
    ++count_;
    bytes_.number(points_.in_file(apex));
    bytes_.number(points_.in_file(centre));
    bytes_.number(border.size() - 1);
    for (const VertexId v : border) bytes_.number(points_.in_file(v));
  }

  Points& points_;
  std::vector<VertexId> around_o_, around_d_;
  std::size_t count_ = 0;
  File bytes_;
};

template <class NumberOf>
void add(Chain& chain, const TriangleMesh& mesh, NumberOf number_of, int times) {
  for (const auto& [a, b, c] : mesh.triangles) chain.add({number_of(a), number_of(b), number_of(c)}, times);
}

void add(Chain& chain, const HalfEdgeMesh& level, const Points& points) {
  for (std::uint32_t f = 0; f < level.face_id_count(); ++f) {
    if (!level.has(FaceId(f))) continue;
    const auto [a, b, c] = level.corners(FaceId(f));
    chain.add({points.of_level(a), points.of_level(b), points.of_level(c)}, 1);
  }
}

}  // namespace

std::optional<std::string> tetrahedra(const ProgressiveHull& levels, const TriangleMesh& hull,
                                      const CertifiedOriginal& original, const TriangleMesh& turned) {
  Points points(levels, hull, original);
  HalfEdgeMesh level(levels.positions(), levels.base_corners());
  Chain coarsest;
  add(coarsest, level, points);
  add(
      coarsest, hull, [&](VertexId v) { return points.of_hull(v); }, -1);
  if (!coarsest.is_zero()) return std::nullopt;
  Fans fans(points);
  for (std::size_t i = levels.splits().size(); i-- > 0;) {
    fans.add(level, levels.made_vertex(i), levels.splits()[i]);
    level.split(levels.made_vertex(i), levels.splits()[i]);
  }
  Chain finest;
  add(finest, level, points);
  add(
      finest, turned, [&](VertexId v) { return points.of_original(v); }, -1);
  if (!finest.is_zero()) return std::nullopt;
  File section;
  section.number(points.added());
  section.add(points.new_points());
  section.number(fans.count());
  section.add(fans.bytes());
  return section.bytes();
}

}  // namespace prohull::certificate

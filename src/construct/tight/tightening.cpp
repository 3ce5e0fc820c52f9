#include "construct/tight/tightening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "construct/guard/self_intersection_guard.h"
#include "construct/tight/tight_placement.h"
#include "geometry/compactness.h"
#include "geometry/predicates.h"
#include "parallel/progress_meter.h"

namespace prohull {
namespace {

class Tightener {
 public:
  Tightener(HalfEdgeMesh& mesh, const Original& original, const MoveOptions& options)
      : mesh_(mesh),
        original_(original),
        options_(options),
        guard_(mesh, faces_along_curve(mesh)),
        placement_(original, options.float32_coordinates),
        waiting_(mesh.positions().size(), 1),
        changed_(waiting_),
        meter_(options.progress, "tighten") {}

  std::size_t run();

 private:
  void move_vertices(unsigned round);
  void flip_edges();
  bool move(VertexId v);
  bool flip(HalfEdgeId h);
  void mark_changed(VertexId v) { waiting_[v] = changed_[v] = 1; }
  std::array<VertexId, 4> corners_beside(HalfEdgeId h) const;
  bool has_good_shape(const Vec3& to) const;
  bool has_good_shape_without(const Tetrahedron& removed) const;

  HalfEdgeMesh& mesh_;
  const Original& original_;
  const MoveOptions& options_;
  SelfIntersectionGuard guard_;
  TightPlacement placement_;
  std::vector<VertexId> link_;  ///< of the vertex in hand
  PerVertex<char> waiting_;     ///< to be moved
  PerVertex<char> changed_;     ///< since edges were flipped last, or a neighbour has
  ProgressMeter meter_;
  std::size_t changes_ = 0, moves_ = 0;
};

std::size_t Tightener::run() {
  for (unsigned round = 0; round < options_.max_rounds; ++round) {
    const std::size_t before = changes_;
    move_vertices(round);
    flip_edges();
    if (changes_ == before) break;
  }
  return moves_;
}

void Tightener::move_vertices(unsigned round) {
  for (const VertexId v : mesh_.positions().ids()) {
    if (!mesh_.has(v) || !waiting_[v]) continue;
    meter_.at(round * mesh_.positions().size() + index(v), options_.max_rounds * mesh_.positions().size());
    waiting_[v] = 0;
    if (!move(v)) continue;
    ++changes_, ++moves_;
    mark_changed(v);
    for (const VertexId u : link_) mark_changed(u);
  }
}

void Tightener::flip_edges() {
  const PerVertex<char> before = std::exchange(changed_, PerVertex<char>(changed_.size(), 0));
  for (std::uint32_t e = 0; e < mesh_.edge_id_count(); ++e) {
    if (!mesh_.has(EdgeId{e})) continue;
    meter_.at(0);
    const HalfEdgeId h = mesh_.half_edge(EdgeId{e});
    const std::array corners = corners_beside(h);
    if (std::ranges::none_of(corners, [&](VertexId v) { return before[v] || changed_[v]; }) || !flip(h)) continue;
    ++changes_;
    for (const VertexId v : corners) mark_changed(v);
  }
}

bool Tightener::move(VertexId v) {
  link_.clear();
  for (const HalfEdgeId h : mesh_.around(v)) link_.push_back(mesh_.tip(h));
  placement_.set(mesh_.position(v), mesh_, link_);
  const auto to = placement_.first(
      [&](const Vec3& p) { return has_good_shape(p) && !guard_.would_add_intersections(mesh_, v, link_, p); });
  if (!to) return false;
  mesh_.move(v, *to);
  guard_.changed(mesh_, v);
  return true;
}

// The ends of the edge and the third corners of its faces: o, d, l, r.
std::array<VertexId, 4> Tightener::corners_beside(HalfEdgeId h) const {
  const HalfEdgeId g = mesh_.twin(h);
  return {mesh_.tail(h), mesh_.tail(g), mesh_.tail(mesh_.previous(h)), mesh_.tail(mesh_.previous(g))};
}

bool Tightener::flip(HalfEdgeId h) {
  const auto [o, d, l, r] = corners_beside(h);
  const Tetrahedron removed{mesh_.position(o), mesh_.position(d), mesh_.position(l), mesh_.position(r)};
  if (side(removed.a, removed.b, removed.c, removed.d) != Side::Inside || !mesh_.can_flip(h)) return false;
  if (std::max(mesh_.valence(l), mesh_.valence(r)) >= options_.guards.max_valence) return false;
  if (!has_good_shape_without(removed) || !original_.lies_outside_of(removed)) return false;
  if (!original_.keeps_padding({removed.d, removed.c, removed.a}) ||
      !original_.keeps_padding({removed.c, removed.d, removed.b}))
    return false;
  if (guard_.would_add_intersections(mesh_, h)) return false;
  mesh_.flip(h);
  guard_.changed(mesh_, l);
  return true;
}

bool Tightener::has_good_shape(const Vec3& to) const {
  const double least_cosine = std::cos(options_.guards.max_normal_deviation);
  const Vec3 apex = placement_.to_local(to);
  double least_before = 1, least_after = 1;
  for (std::size_t i = 0; i < link_.size(); ++i) {
    const Vec3 &a = placement_.local_link()[i], &b = placement_.local_link()[placement_.after(i)];
    const Vec3 n = cross(a, b), m = cross(a - apex, b - apex);
    if (dot(n, m) < least_cosine * norm(n) * norm(m)) return false;
    const double ab = squared_norm(b - a);
    least_before = std::min(least_before, compactness(norm(n), squared_norm(a) + squared_norm(b) + ab));
    least_after = std::min(least_after, compactness(norm(m), squared_norm(a - apex) + squared_norm(b - apex) + ab));
  }
  return least_after >
         std::min(options_.guards.min_compactness_ratio * least_before, options_.guards.sufficient_compactness);
}

// Faces (o, d, l), (d, o, r) before, (r, l, o), (l, r, d) after; in a frame with the origin at o.
bool Tightener::has_good_shape_without(const Tetrahedron& removed) const {
  const double scale =
      std::max({norm(removed.b - removed.a), norm(removed.c - removed.a), norm(removed.d - removed.a)});
  const Vec3 o, d = (removed.b - removed.a) / scale, l = (removed.c - removed.a) / scale,
                r = (removed.d - removed.a) / scale;
  const auto normal = [](const Vec3& a, const Vec3& b, const Vec3& c) { return cross(b - a, c - a); };
  const auto compactness_of = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    return compactness(norm(normal(a, b, c)), squared_edges(a, b, c));
  };
  const double least_cosine = std::cos(options_.guards.max_normal_deviation);
  const Vec3 before = normal(o, d, l) + normal(d, o, r);
  for (const Vec3& after : {normal(r, l, o), normal(l, r, d)})
    if (dot(before, after) < least_cosine * norm(before) * norm(after)) return false;
  const double least_before = std::min(compactness_of(o, d, l), compactness_of(d, o, r));
  const double least_after = std::min(compactness_of(r, l, o), compactness_of(l, r, d));
  return least_after >
         std::min(options_.guards.min_compactness_ratio * least_before, options_.guards.sufficient_compactness);
}

}  // namespace

std::size_t tighten(HalfEdgeMesh& hull, const Original& original, const MoveOptions& options) {
  return Tightener(hull, original, options).run();
}

}  // namespace prohull

#include "construct/tight/tightening.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "construct/guard/self_intersection_guard.h"
#include "construct/tight/tight_placement.h"
#include "geometry/compactness.h"
#include "geometry/predicates.h"
#include "parallel/arena.h"
#include "prohull/detail/progress_meter.h"

namespace prohull {
namespace {

/// Where a vertex goes, and what has kept it from going farther.
struct Move {
  VertexId vertex;
  std::optional<Vec3> to = {};
  std::vector<Vec3> found = {};
  std::size_t looks = 0;  ///< at triangles near it
};

// At triangles near a vertex: where thousands lie on each other, moving stops. Of robots, sheets and soups there were
// up to 2,100 looks for each vertex of the hull, or 4 for each face of the original; of 2,000 triangles in a plane,
// 77,000.
constexpr std::size_t kLooksPerVertex = 5000, kLooksPerFace = 100;

/// Finds where vertices may go; one for each thread.
class Placer {
 public:
  Placer(const HalfEdgeMesh& mesh, const Original& original, const MoveOptions& options, const MayReach& may_reach)
      : mesh_(mesh),
        options_(options),
        may_reach_(may_reach),
        allowed_(original.allowed(options.guards.max_overhang)),
        placement_(original, options.float32_coordinates) {}

  void place(Move& move, const Contacts& contacts, auto&& is_accepted) {
    link_.clear();
    for (const HalfEdgeId h : mesh_.around(move.vertex)) link_.push_back(mesh_.tip(h));
    placement_.set(mesh_.position(move.vertex), mesh_, link_);
    contacts.gather(move.vertex, link_, known_);
    placement_.know(known_);
    Box allowed = allowed_;
    allowed.extend(mesh_.position(move.vertex));
    move.to = placement_.first([&](const Vec3& to) {
      return allowed.contains(to) && has_good_shape(to) && grows_only_there(to) && is_accepted(to);
    });
    move.found = placement_.found();
    move.looks += placement_.looks();
  }
  const std::vector<VertexId>& link() const { return link_; }  ///< of the vertex placed last

 private:
  bool has_good_shape(const Vec3& to) const;
  bool grows_only_there(const Vec3& to) const;

  const HalfEdgeMesh& mesh_;
  const MoveOptions& options_;
  const MayReach& may_reach_;
  const Box allowed_;  ///< all vertices that do not hang over by more already
  TightPlacement placement_;
  std::vector<VertexId> link_;
  std::vector<Vec3> known_;
};

class Tightener {
 public:
  Tightener(HalfEdgeMesh& mesh, const Original& original, const MoveOptions& options, Contacts& contacts,
            PerVertex<char> waiting, const MayReach& may_reach = {})
      : mesh_(mesh),
        original_(original),
        options_(options),
        contacts_(contacts),
        guard_(mesh, faces_along_curve(mesh)),
        may_reach_(may_reach),
        placers_([this] { return Placer(mesh_, original_, options_, may_reach_); }),
        waiting_(std::move(waiting)),
        changed_(waiting_),
        batch_(mesh.positions().size(), 0),
        meter_(options.progress, "tighten"),
        most_looks_(kLooksPerVertex * mesh.positions().size() + kLooksPerFace * original.mesh().face_count()) {
    PerVertex<char> is_listed(mesh.positions().size(), 0);
    for (const FaceId f : faces_along_curve(mesh))
      for (const VertexId v : mesh.corners(f))
        if (!std::exchange(is_listed[v], 1)) order_.push_back(v);
  }

  std::size_t run();

 private:
  void move_vertices(unsigned round);
  std::vector<Move> take_independent(std::vector<VertexId>& vertices);
  bool apply(Move& move);
  void flip_edges();
  bool flip(HalfEdgeId h);
  void mark_changed(VertexId v) { waiting_[v] = changed_[v] = 1; }
  std::array<VertexId, 4> corners_beside(HalfEdgeId h) const;
  bool has_good_shape_without(const Tetrahedron& removed) const;

  HalfEdgeMesh& mesh_;
  const Original& original_;
  const MoveOptions& options_;
  Contacts& contacts_;
  SelfIntersectionGuard guard_;
  const MayReach may_reach_;
  oneapi::tbb::enumerable_thread_specific<Placer> placers_;
  std::vector<VertexId> link_;      ///< of the vertex in hand
  std::vector<VertexId> order_;     ///< what lies together in space does so in the list, mostly
  PerVertex<char> waiting_;         ///< to be moved
  PerVertex<char> changed_;         ///< since edges were flipped last, or a neighbour has
  PerVertex<std::uint32_t> batch_;  ///< the last one that it, or a neighbour, was in
  std::uint32_t batches_ = 0;
  ProgressMeter meter_;
  std::size_t changes_ = 0, moves_ = 0, looks_ = 0;
  const std::size_t most_looks_;
};

std::size_t Tightener::run() {
  for (unsigned round = 0; round < options_.max_rounds && looks_ < most_looks_; ++round) {
    const std::size_t before = changes_;
    move_vertices(round);
    flip_edges();
    if (changes_ == before) break;
  }
  return moves_;
}

// Vertices that are not neighbours are placed at the same time: what their stars lose and gain is apart. Only whether
// new faces meet others is asked of one after the other.
void Tightener::move_vertices(unsigned round) {
  std::vector<VertexId> vertices;
  for (const VertexId v : order_)
    if (waiting_[v]) vertices.push_back(v);
  const std::size_t all = vertices.size();
  while (!vertices.empty() && looks_ < most_looks_) {
    std::vector<Move> moves = take_independent(vertices);
    oneapi::tbb::parallel_for(std::size_t{0}, moves.size(), [&](std::size_t i) {
      meter_.at(round * all + (all - vertices.size()), options_.max_rounds * all);
      placers_.local().place(moves[i], contacts_, [](const Vec3&) { return true; });
    });
    for (Move& move : moves) {
      const bool is_moved = apply(move);
      looks_ += move.looks;
      if (!is_moved) continue;
      ++changes_, ++moves_;
      mark_changed(move.vertex);
      for (const VertexId u : link_) mark_changed(u);
    }
  }
}

// Takes vertices of which no two are neighbours, in their order.
std::vector<Move> Tightener::take_independent(std::vector<VertexId>& vertices) {
  ++batches_;
  std::vector<Move> moves;
  std::erase_if(vertices, [&](VertexId v) {
    if (batch_[v] == batches_) return false;
    for (const HalfEdgeId h : mesh_.around(v)) batch_[mesh_.tip(h)] = batches_;
    waiting_[v] = 0;
    moves.push_back({v});
    return true;
  });
  return moves;
}

bool Tightener::apply(Move& move) {
  const VertexId v = move.vertex;
  contacts_.keep(v, move.found);
  if (!move.to) return false;
  link_.clear();
  for (const HalfEdgeId h : mesh_.around(v)) link_.push_back(mesh_.tip(h));
  const auto is_free = [&](const Vec3& to) { return !guard_.would_add_intersections(mesh_, v, link_, to); };
  if (!is_free(*move.to)) placers_.local().place(move, contacts_, is_free);
  if (!move.to) return false;
  mesh_.move(v, *move.to);
  guard_.changed(mesh_, v);
  return true;
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

bool Placer::has_good_shape(const Vec3& to) const {
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

// Where the vertex goes to the inner side of a face, the hull shrinks there. New corners alone would not do: one that
// slides along the original spans faces over what is open.
bool Placer::grows_only_there(const Vec3& to) const {
  if (!may_reach_) return true;
  const Vec3 apex = placement_.to_local(to);
  for (std::size_t i = 0; i < link_.size(); ++i) {
    const std::size_t next = placement_.after(i);
    if (dot(apex, cross(placement_.local_link()[i], placement_.local_link()[next])) <= 0) continue;
    const Vec3 &a = mesh_.position(link_[i]), &b = mesh_.position(link_[next]);
    for (const Vec3& p : {to, (to + a + b) / 3, (to + a) / 2, (to + b) / 2})
      if (!may_reach_(p)) return false;
  }
  return true;
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

std::size_t tighten(HalfEdgeMesh& hull, const Original& original, const MoveOptions& options, Contacts& contacts,
                    const MayReach& may_reach) {
  return arena_of(options.threads).execute([&] {
    return Tightener(hull, original, options, contacts, PerVertex<char>(hull.positions().size(), 1), may_reach).run();
  });
}

std::size_t tighten_around(const std::vector<VertexId>& changed, HalfEdgeMesh& hull, const Original& original,
                           const MoveOptions& options, Contacts& contacts) {
  PerVertex<char> waiting(hull.positions().size(), 0);
  for (const VertexId v : changed) waiting[v] = 1;
  return arena_of(options.threads).execute([&] {
    return Tightener(hull, original, options, contacts, std::move(waiting)).run();
  });
}

std::size_t tighten(HalfEdgeMesh& hull, const Original& original, const MoveOptions& options,
                    const MayReach& may_reach) {
  Contacts contacts(hull.positions().size());
  return tighten(hull, original, options, contacts, may_reach);
}

}  // namespace prohull

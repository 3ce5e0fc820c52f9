#include "construct/tight/gap_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "construct/guard/self_intersection_guard.h"
#include "construct/tight/original.h"
#include "construct/tight/tightening.h"
#include "construct/turned.h"
#include "construct/unfolded_padding.h"
#include "geometry/bvh.h"
#include "geometry/closest_point.h"
#include "geometry/linear_program.h"
#include "mesh/half_edge_mesh.h"

namespace prohull {
namespace {

constexpr double kHairOfGap = 1 + 1e-6;  ///< on the padding, for rounding

/// How many faces the body has for each face of the hull: then it has 1 to 5 % more void than the offset surface.
constexpr std::size_t kFacesPerFace = 16;

TriangleMesh fine_hull(const TriangleMesh& mesh, HullOptions options) {
  options.target_faces *= kFacesPerFace;
  options.float32_coordinates = false;
  if (mesh.face_count() <= options.target_faces) return mesh;
  return build_hull(mesh, options).hull.base();
}

Triangle triangle_at(const HalfEdgeMesh& mesh, const std::array<VertexId, 3>& corners) {
  return {mesh.position(corners[0]), mesh.position(corners[1]), mesh.position(corners[2])};
}

/// Moves vertices outwards whose faces are too near.
class PushOut {
 public:
  PushOut(HalfEdgeMesh& mesh, const Original& original)
      : mesh_(mesh), original_(original), guard_(mesh, faces_along_curve(mesh)) {}

  void run() {
    constexpr int kPasses = 12;
    PerVertex<char> is_waiting(mesh_.positions().size(), 0);
    for (const FaceId f : faces_along_curve(mesh_))
      if (!original_.keeps_padding(triangle_at(mesh_, mesh_.corners(f))))
        for (const VertexId v : mesh_.corners(f)) is_waiting[v] = 1;
    std::vector<VertexId> waiting;
    for (const VertexId v : is_waiting.ids())
      if (is_waiting[v]) waiting.push_back(v);
    for (int pass = 0; pass < kPasses && !waiting.empty(); ++pass)
      std::erase_if(waiting, [&](VertexId v) { return !push(v); });
  }

 private:
  // By a little more than is missing: beyond the planes of its faces, or else away from what is near. False if nothing
  // is.
  bool push(VertexId v) {
    constexpr double kFarther = 1.05, kHardly = 1e-3, kFar = 4;
    look_at(v);
    if (missing_ == 0) return false;
    const double step = kFarther * missing_ + kHardly * original_.padding();
    const auto to = nearest_feasible_point({}, planes_);
    if (!(to && norm(*to) <= kFar && move(v, *to * step)) && norm(away_) > 0) move(v, away_ * (step / norm(away_)));
    return true;
  }

  void look_at(VertexId v) {
    missing_ = 0, away_ = {};
    link_.clear(), planes_.clear();
    for (const HalfEdgeId h : mesh_.around(v)) {
      const Triangle t = triangle_at(mesh_, {v, mesh_.tip(h), mesh_.tail(mesh_.previous(h))});
      link_.push_back(mesh_.tip(h));
      const Vec3 n = cross(t.b - t.a, t.c - t.a);
      if (const double size = norm(n); size > 0) planes_.push_back({n / size, 1});
      const auto near = original_.nearest_within_padding(t);
      if (!near || original_.padding() - near->distance <= missing_) continue;
      missing_ = original_.padding() - near->distance;
      away_ = near->away;
    }
  }

  bool move(VertexId v, const Vec3& step) {
    const Vec3 p = mesh_.position(v) + step;
    if (!is_finite(p) || guard_.would_add_intersections(mesh_, v, link_, p)) return false;
    mesh_.move(v, p);
    guard_.changed(mesh_, v);
    return true;
  }

  HalfEdgeMesh& mesh_;
  const Original& original_;
  SelfIntersectionGuard guard_;
  std::vector<VertexId> link_;
  HalfSpaces planes_;
  double missing_ = 0;
  Vec3 away_;  ///< from the nearest triangle
};

/// For a body turned inside out, if hulls are inner ones.
TriangleMesh finished(HalfEdgeMesh& body, const TriangleMesh& triangles, double padding, const HullOptions& options) {
  constexpr unsigned kRounds = 2;
  const Original original = Original::padded_triangles(triangles, padding, options.threads);
  PushOut(body, original).run();
  MoveOptions how;
  how.guards = options.guards, how.max_rounds = kRounds, how.threads = options.threads, how.progress = options.progress;
  tighten(body, original, how);
  return body.triangle_mesh();
}

class Nearest {
 public:
  explicit Nearest(const TriangleMesh& mesh) : mesh_(mesh), tree_(mesh) {}

  std::optional<Vec3> within(const Vec3& p, double distance) const {
    std::optional<Vec3> nearest;
    double least = distance * distance;
    tree_.least([&](const Box& box) { return squared_norm(closest_point(p, box) - p); },
                [&](std::uint32_t f) {
                  const Vec3 q = closest_point(p, mesh_.triangle(FaceId{f}));
                  const double d = squared_norm(q - p);
                  if (d < least) least = d, nearest = q;
                  return d;
                },
                least);
    return nearest;
  }

 private:
  const TriangleMesh& mesh_;
  const Bvh tree_;
};

/// Vertices move to where the padding ends, straight away from or towards what is nearest. They stay where the body
/// would intersect itself.
void move_to_padding(HalfEdgeMesh& body, const TriangleMesh& triangles, double padding) {
  constexpr double kFarthest = 8;  // paddings
  constexpr int kPasses = 2;
  const Nearest nearest(triangles);
  SelfIntersectionGuard guard(body, faces_along_curve(body));
  std::vector<VertexId> link;
  for (int pass = 0; pass < kPasses; ++pass)
    for (std::uint32_t i = 0; i < body.positions().size(); ++i) {
      const VertexId v{i};
      const Vec3 p = body.has(v) ? body.position(v) : Vec3{};
      const auto q = body.has(v) ? nearest.within(p, kFarthest * padding) : std::nullopt;
      if (!q || !(norm(p - *q) > 0)) continue;
      link.clear();
      for (const HalfEdgeId h : body.around(v)) link.push_back(body.tip(h));
      const Vec3 to = *q + (p - *q) * (kHairOfGap * padding / norm(p - *q));
      if (guard.would_add_intersections(body, v, link, to)) continue;
      body.move(v, to);
      guard.changed(body, v);
    }
}

}  // namespace

TriangleMesh gap_body(const TriangleMesh& mesh, const TriangleMesh& triangles, double padding,
                      const HullOptions& options) {
  const TriangleMesh fine = turned_if_inner(fine_hull(mesh, options), options.side);
  HalfEdgeMesh body(padded_without_folds(fine, kHairOfGap * padding));
  return turned_if_inner(finished(body, triangles, padding, options), options.side);
}

TriangleMesh gap_body_of_wrap(const TriangleMesh& wrap, const TriangleMesh& triangles, double padding,
                              const HullOptions& options) {
  const TriangleMesh fine = turned_if_inner(fine_hull(wrap, options), options.side);
  HalfEdgeMesh body(fine);
  move_to_padding(body, triangles, padding);
  return turned_if_inner(finished(body, triangles, padding, options), options.side);
}

}  // namespace prohull

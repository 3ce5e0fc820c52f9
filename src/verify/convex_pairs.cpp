#include "verify/convex_pairs.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "prohull/enclosure.h"

namespace prohull::verify {
namespace {

constexpr std::size_t kFacesOfHull = 4;

struct Edge {
  std::array<Vec3, 2> ends;  // in lexicographic order
  FaceId face;
  Vec3 opposite;

  auto key() const {
    const auto& [a, b] = ends;
    return std::tuple(a.x, a.y, a.z, b.x, b.y, b.z);
  }
};

bool is_before(const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

std::vector<Edge> sorted_edges(const TriangleMesh& mesh) {
  std::vector<Edge> edges;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    const std::array<Vec3, 3> corners{t.a, t.b, t.c};
    for (int i = 0; i < 3; ++i) {
      const Vec3 &a = corners[i], &b = corners[(i + 1) % 3];
      const bool in_order = is_before(a, b);
      edges.push_back({{in_order ? a : b, in_order ? b : a}, f, corners[(i + 2) % 3]});
    }
  }
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.key() < b.key(); });
  return edges;
}

/// Closed and outwards.
TriangleMesh tetrahedron(const Triangle& base, const Vec3& apex) {
  TriangleMesh mesh;
  for (const Vec3& p : {base.a, base.b, base.c, apex}) mesh.positions.push_back(p);
  constexpr std::uint32_t kFaces[kFacesOfHull][3]{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  for (const auto& [a, b, c] : kFaces) mesh.triangles.push_back({VertexId(a), VertexId(b), VertexId(c)});
  return mesh;
}

}  // namespace

ConvexPairs::ConvexPairs(const TriangleMesh& mesh, const Progress& progress) {
  for ([[maybe_unused]] const FaceId f : mesh.triangles.ids()) of_face_.push_back({});
  find_pairs(mesh);
  keep_proven(mesh, progress);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    of_face_[pairs_[i].f].push_back(i);
    of_face_[pairs_[i].g].push_back(i);
  }
}

/// Those whose edge is convex, or flat, as far as rounding tells.
void ConvexPairs::find_pairs(const TriangleMesh& mesh) {
  const std::vector<Edge> edges = sorted_edges(mesh);
  for (std::size_t i = 0, end; i < edges.size(); i = end) {
    for (end = i; end < edges.size() && edges[end].key() == edges[i].key();) ++end;
    if (end - i != 2) continue;
    TriangleMesh hull = tetrahedron(mesh.triangle(edges[i].face), edges[i + 1].opposite);
    if (signed_volume(hull) >= 0) pairs_.push_back({edges[i].face, edges[i + 1].face, std::move(hull)});
  }
}

/// Each face of a hull has to be covered. Then only a cavity could be left within it: verify_enclosure finds these.
void ConvexPairs::keep_proven(const TriangleMesh& mesh, const Progress& progress) {
  if (pairs_.empty()) return;
  TriangleMesh all;
  for (const Pair& pair : pairs_) append(all, pair.hull);
  std::vector<bool> is_out(pairs_.size());
  const EnclosureOptions options{.max_offenders = all.face_count(), .progress = progress};
  for (const Offender& offender : verify_cover(all, mesh, options).worst)
    is_out[index(offender.face) / kFacesOfHull] = true;
  std::vector<Pair> kept;
  TriangleMesh rest;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (is_out[i]) continue;
    append(rest, pairs_[i].hull);
    kept.push_back(std::move(pairs_[i]));
  }
  pairs_ = std::move(kept);
  if (!pairs_.empty() && !verify_enclosure(rest, mesh, {.progress = progress}).encloses) pairs_.clear();
}

double ConvexPairs::distance_at_most(FaceId face, const Triangle& triangle) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : of_face_[face]) {
    Pair& pair = pairs_[i];
    if (!pair.query) pair.query.emplace(QueryIndex(pair.hull));
    double farthest = 0;
    for (const Vec3& p : {triangle.a, triangle.b, triangle.c})
      farthest = std::max(farthest, pair.query->signed_distance(p).upper);
    least = std::min(least, farthest);
  }
  return least;
}

}  // namespace prohull::verify

#include "verify/convex_pairs.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "geometry/predicates.h"
#include "geometry/tetrahedron_contact.h"
#include "geometry/triangle_predicates.h"
#include "verify/winding.h"

namespace prohull::verify {
namespace {

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

/// Closed, and outwards if the apex is inside of the base.
TriangleMesh tetrahedron(const Triangle& base, const Vec3& apex) {
  TriangleMesh mesh;
  for (const Vec3& p : {base.a, base.b, base.c, apex}) mesh.positions.push_back(p);
  constexpr std::uint32_t kFaces[4][3]{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  for (const auto& [a, b, c] : kFaces) mesh.triangles.push_back({VertexId(a), VertexId(b), VertexId(c)});
  return mesh;
}

/// Whether a triangle (a, b, c) and one on its other side of the edge (a, b), with the corner d, both in one plane,
/// make up their convex hull.
bool is_convex_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto axis = projection_axis({a, b, c});
  if (!axis) return false;
  return turn(*axis, a, b, c) * turn(*axis, a, b, d) < 0 && turn(*axis, c, d, a) * turn(*axis, c, d, b) <= 0;
}

}  // namespace

ConvexPairs::ConvexPairs(const TriangleMesh& mesh) : of_face_(mesh.face_count()) {
  if (mesh.face_count() == 0) return;
  surface_ = Surface(mesh, "pieces", Turning::Never);
  const std::vector<Edge> edges = sorted_edges(mesh);
  for (std::size_t i = 0, end; i < edges.size(); i = end) {
    for (end = i; end < edges.size() && edges[end].key() == edges[i].key();) ++end;
    if (end - i != 2) continue;
    const FaceId f = edges[i].face, g = edges[i + 1].face;
    const Triangle base = mesh.triangle(f);
    const Vec3& apex = edges[i + 1].opposite;
    const Side where = side(base.a, base.b, base.c, apex);
    if (where == Side::Outside) continue;
    std::optional<bool> is_proven;
    if (where == Side::On) {  // then it consists of the faces
      is_proven = is_convex_quad(edges[i].ends[0], edges[i].ends[1], edges[i].opposite, apex);
      if (!*is_proven) continue;
    }
    of_face_[f].push_back(pairs_.size()), of_face_[g].push_back(pairs_.size());
    pairs_.push_back({tetrahedron(base, apex), is_proven});
  }
}

// Where no face reaches the interior, the winding number is the same all over it.
bool ConvexPairs::lies_in_solid(const TriangleMesh& hull) const {
  Vec3 middle;
  for (const Vec3& p : hull.positions) middle += p / 4;
  for (const FaceId f : hull.triangles.ids()) {
    const Triangle t = hull.triangle(f);
    if (side(t.a, t.b, t.c, middle) != Side::Inside) return false;  // it is rounded
  }
  const Vec3* const corner = hull.positions.data();
  const Tetrahedron inside{corner[0], corner[1], corner[2], corner[3]};
  const Box box = bounding_box(hull);
  bool is_empty = true;
  surface_.bvh.visit([&](const Box& other) { return is_empty && other.overlaps(box); },
                     [&](FaceIndex f) { is_empty = is_empty && !meets_interior(surface_.faces[f], inside); });
  return is_empty && winding_at(surface_, ExactPoint(middle)) >= 1;
}

double ConvexPairs::distance_at_most(FaceId face, const Triangle& triangle) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : of_face_[face]) {
    Pair& pair = pairs_[i];
    if (!pair.is_proven) pair.is_proven = lies_in_solid(pair.hull);
    if (!*pair.is_proven) continue;
    if (!pair.query) pair.query.emplace(QueryIndex(pair.hull));
    double farthest = 0;
    for (const Vec3& p : {triangle.a, triangle.b, triangle.c})
      farthest = std::max(farthest, pair.query->signed_distance(p).upper);
    least = std::min(least, farthest);
  }
  return least;
}

}  // namespace prohull::verify

#include "geometry/tetrahedron_contact.h"

#include <algorithm>
#include <array>

#include "geometry/predicates.h"

namespace prohull {
namespace {

using Corners = std::array<Vec3, 3>;

constexpr std::array<std::array<int, 4>, 6> kEdges{
    // of a tetrahedron, each with the two other corners
    {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};

std::array<Triangle, 4> faces_of(const Tetrahedron& t) {
  return {{{t.a, t.b, t.c}, {t.a, t.c, t.d}, {t.a, t.d, t.b}, {t.b, t.d, t.c}}};
}

/// Corners that are shared need no exact arithmetic: hulls have many points of the original.
Side side_of(const Triangle& t, const Vec3& p) {
  return p == t.a || p == t.b || p == t.c ? Side::On : side(t.a, t.b, t.c, p);
}

/// Whether all are on one side of the plane of t or on it.
template <std::size_t N>
bool on_one_side(const Triangle& t, const std::array<Vec3, N>& points, Side beside) {
  return std::ranges::all_of(points, [&](const Vec3& p) { return side_of(t, p) != opposite(beside); });
}

template <std::size_t N>
bool strictly_on_one_side(const Triangle& t, const std::array<Vec3, N>& points, Side beside) {
  return std::ranges::all_of(points, [&](const Vec3& p) { return side_of(t, p) == beside; });
}

/// Bit i is set if corner i is strictly inside of the plane of the face.
unsigned corners_inside(const Triangle& face, const Corners& corners) {
  unsigned inside = 0;
  for (std::size_t i = 0; i < 3; ++i) inside |= unsigned{side_of(face, corners[i]) == Side::Inside} << i;
  return inside;
}

/// Whether planes along the edges pq of the triangle, t its third corner, and rs of the tetrahedron, u and v the
/// others, have the triangle on one side and the tetrahedron on the other; `strictly`, with room between the two edges.
bool separated_along_edges(const Vec3& p, const Vec3& q, const Vec3& t, const Vec3& r, const Vec3& s, const Vec3& u,
                           const Vec3& v, bool strictly) {
  const bool share_an_end = p == r || p == s || q == r || q == s;
  if (share_an_end && strictly) return false;
  const int of_u = determinant_sign(p, q, r, s, r, u), of_v = determinant_sign(p, q, r, s, r, v);
  if (of_u == 0 && of_v == 0) return false;  // parallel edges: other planes separate, if any does
  if (of_u * of_v < 0) return false;
  const int away = of_u != 0 ? of_u : of_v;  // the side on which the tetrahedron is, seen from rs
  return determinant_sign(p, q, r, s, p, t) * away <= 0 &&
         (share_an_end || determinant_sign(p, q, r, s, p, r) * away >= (strictly ? 1 : 0));
}

bool separated_along_edges(const Corners& triangle, const std::array<Vec3, 4>& tetrahedron, bool strictly) {
  for (std::size_t i = 0; i < 3; ++i)
    for (const auto& [r, s, u, v] : kEdges)
      if (separated_along_edges(triangle[i], triangle[(i + 1) % 3], triangle[(i + 2) % 3], tetrahedron[r],
                                tetrahedron[s], tetrahedron[u], tetrahedron[v], strictly))
        return true;
  return false;
}

}  // namespace

// By the separating axis theorem: the difference of triangle and tetrahedron is a polytope with an inside, and its
// facets are parallel to a face of either or to an edge of each.
bool meets_interior(const Triangle& triangle, const Tetrahedron& tetrahedron) {
  const Corners corners{triangle.a, triangle.b, triangle.c};
  const auto& [a, b, c, d] = tetrahedron;
  unsigned inside = 0b111;  // corners that are strictly inside of all faces so far
  for (const Triangle& face : faces_of(tetrahedron)) {
    const unsigned now = corners_inside(face, corners);
    if (now == 0) return false;
    inside &= now;
  }
  if (inside != 0) return true;
  const std::array<Vec3, 4> v{a, b, c, d};
  if (on_one_side(triangle, v, Side::Outside) || on_one_side(triangle, v, Side::Inside)) {
    // A triangle without area has no plane: everything is on it.
    const bool has_plane =
        std::ranges::any_of(v, [&](const Vec3& p) { return side(triangle.a, triangle.b, triangle.c, p) != Side::On; });
    if (has_plane) return false;
  }
  return !separated_along_edges(corners, v, false);
}

bool may_touch(const Triangle& triangle, const Tetrahedron& tetrahedron) {
  const Corners corners{triangle.a, triangle.b, triangle.c};
  for (const Triangle& face : faces_of(tetrahedron))
    if (strictly_on_one_side(face, corners, Side::Outside)) return false;
  const std::array v{tetrahedron.a, tetrahedron.b, tetrahedron.c, tetrahedron.d};
  if (strictly_on_one_side(triangle, v, Side::Outside) || strictly_on_one_side(triangle, v, Side::Inside)) return false;
  return !separated_along_edges(corners, v, true);
}

}  // namespace prohull

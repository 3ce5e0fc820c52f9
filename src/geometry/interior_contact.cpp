#include "geometry/interior_contact.h"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/triangle_predicates.h"

namespace prohull {
namespace {

using Corners = std::array<Vec3, 3>;

/// The sides on which the corners of a triangle lie of the supporting plane of another.
struct Sides {
  std::array<Side, 3> of;
  int outside = 0, inside = 0;

  Sides(const Triangle& plane, const Corners& corners) {
    for (int i = 0; i < 3; ++i) {
      of[i] = side(plane, corners[i]);
      outside += of[i] == Side::Outside;
      inside += of[i] == Side::Inside;
    }
  }
  int on() const { return 3 - outside - inside; }
  bool is_crossed() const { return outside > 0 && inside > 0; }
  bool is_apart() const { return outside == 3 || inside == 3; }
  /// The plane holds more than a point of the triangle.
  bool has_segment() const { return is_crossed() || on() == 2; }
  /// For triangles with a segment: the corner alone on its side; the segment ends on the two edges that begin there.
  int lone() const {
    const Side side_of_one = outside == 1 ? Side::Outside : Side::Inside;
    return static_cast<int>(std::find(of.begin(), of.end(), side_of_one) - of.begin());
  }
};

Corners turned_to(const Corners& c, int first) { return {c[first], c[(first + 1) % 3], c[(first + 2) % 3]}; }

/// side(a, b, c, d), but quick if the lines ab and cd meet in a corner.
Side edges_side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return a == c || a == d || b == c || b == d ? Side::On : side(a, b, c, d);
}

/// Whether the segments in which two triangles meet each other's planes overlap in more than a point. As in Guigue and
/// Devillers, "Fast and robust triangle-triangle overlap test using orientation predicates" (2003): on the common line,
/// the order of two ends is the side on which the edge through one passes the edge through the other.
bool segments_overlap(const Corners& t, const Sides& t_sides, const Corners& h, const Sides& h_sides) {
  auto [p1, q1, r1] = turned_to(t, t_sides.lone());
  auto [p2, q2, r2] = turned_to(h, h_sides.lone());
  if (h_sides.of[h_sides.lone()] == Side::Inside) std::swap(q1, r1);
  if (t_sides.of[t_sides.lone()] == Side::Inside) std::swap(q2, r2);
  return edges_side(p1, q1, p2, q2) == Side::Inside && edges_side(p1, r1, r2, p2) == Side::Inside;
}

struct Turns {
  std::array<int, 3> of;
  Turns(int axis, const Vec3& a, const Vec3& b, const Corners& points)
      : of{turn_at_edge(axis, a, b, points[0]), turn_at_edge(axis, a, b, points[1]),
           turn_at_edge(axis, a, b, points[2])} {}
  bool none_is(int sign) const { return of[0] != sign && of[1] != sign && of[2] != sign; }
  int zeros() const { return int(std::count(of.begin(), of.end(), 0)); }
};

TriangleContact coplanar_contact(const Corners& t, int axis, const Corners& h) {
  const int t_turn = turn(axis, t[0], t[1], t[2]), h_turn = turn(axis, h[0], h[1], h[2]);
  if (std::is_permutation(t.begin(), t.end(), h.begin())) return {Contact::Same, 0};
  TriangleContact result;
  bool apart = false;
  for (int e = 0; e < 3; ++e) {
    const Turns beside_t(axis, t[e], t[(e + 1) % 3], h), beside_h(axis, h[e], h[(e + 1) % 3], t);
    apart |= beside_t.none_is(t_turn) || beside_h.none_is(h_turn);
    if (beside_t.zeros() >= 2) result.edges |= std::uint8_t(1 << e);
  }
  if (!apart) result.interior = Contact::Covering;
  return result;
}

}  // namespace

TriangleContact interior_contact(const Triangle& t, int axis, const Triangle& h) {
  const Corners t_corners{t.a, t.b, t.c}, h_corners{h.a, h.b, h.c};
  const Sides h_sides(t, h_corners);
  if (h_sides.is_apart()) return {};
  if (h_sides.on() == 3) return coplanar_contact(t_corners, axis, h_corners);
  if (!h_sides.has_segment()) return {};
  const Sides t_sides(h, t_corners);
  if (t_sides.on() == 2) {
    for (int e = 0; e < 3; ++e)
      if (t_sides.of[(e + 2) % 3] != Side::On) return {Contact::None, std::uint8_t(1 << e)};
  }
  if (!t_sides.is_crossed() || !segments_overlap(t_corners, t_sides, h_corners, h_sides)) return {};
  return {Contact::Crossing, 0};
}

}  // namespace prohull

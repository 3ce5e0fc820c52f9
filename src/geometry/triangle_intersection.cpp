#include "geometry/triangle_intersection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "geometry/rounded_turn.h"
#include "geometry/triangle_predicates.h"

namespace prohull {
namespace {

using Corners = std::array<Vec3, 3>;

bool same_strict_sign(int u, int v, int w) { return u != 0 && u == v && u == w; }

/// For p and q in the plane of t, which has an area along `axis`: disjoint convex polygons are separated strictly by
/// the line of an edge of one of them.
bool coplanar_segment_meets(const Corners& t, int axis, const Vec3& p, const Vec3& q) {
  const int orientation = turn(axis, t[0], t[1], t[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = t[i], &b = t[(i + 1) % 3];
    if (turn_at_edge(axis, a, b, p) == -orientation && turn_at_edge(axis, a, b, q) == -orientation) return false;
  }
  return !same_strict_sign(turn_at_edge(axis, p, q, t[0]), turn_at_edge(axis, p, q, t[1]),
                           turn_at_edge(axis, p, q, t[2]));
}

/// Whether the closed segment pq, or the point if they are one, meets the closed triangle t, which has an area along
/// `axis`. Exact.
bool segment_meets(const Corners& t, int axis, const Vec3& p, const Vec3& q) {
  const Side sp = side(t[0], t[1], t[2], p), sq = side(t[0], t[1], t[2], q);
  if (sp == Side::On && sq == Side::On) return coplanar_segment_meets(t, axis, p, q);
  if (sp == sq) return false;
  const int u = int(side(p, q, t[0], t[1])), v = int(side(p, q, t[1], t[2]));  // the line pq passes t[0]t[1] on side u
  if (u * v < 0) return false;
  const int w = int(side(p, q, t[2], t[0]));
  return u * w >= 0 && v * w >= 0;
}

/// Permutes both so that the shared corners come first, in the same order; returns their number.
int match_corners(Corners& s, Corners& t) {
  int shared = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = shared; j < 3; ++j)
      if (s[i] == t[j]) {
        std::swap(s[shared], s[i]);
        std::swap(t[shared], t[j]);
        ++shared;
        break;
      }
  return shared;
}

/// Whether the corners from `first` on lie strictly on one side of the supporting plane of t.
bool strictly_beside(const Corners& t, const Corners& corners, int first) {
  const Side s = side(t[0], t[1], t[2], corners[first]);
  if (s == Side::On) return false;
  for (int i = first + 1; i < 3; ++i)
    if (side(t[0], t[1], t[2], corners[i]) != s) return false;
  return true;
}

/// Whether an edge of s, from its corner `first` on, meets t. A common point of two triangles that share nothing can be
/// moved within both to an edge of one; with a shared corner, away from it to the edge opposite to it in one.
bool edges_meet(const Corners& s, int first, const Corners& t, int axis) {
  if (segment_meets(t, axis, s[1], s[2])) return true;
  return first == 0 && (segment_meets(t, axis, s[0], s[1]) || segment_meets(t, axis, s[0], s[2]));
}

/// Whether the line of an edge of t, seen along `axis`, has t on one side and all corners of s that t does not share
/// strictly on the other: then s and t have nothing in common but what they share. May say no for want of certainty.
bool projections_certainly_apart(const Corners& t, const Corners& s, int axis) {
  const auto orientation = certain_turn(axis, t[0], t[1], t[2]);
  if (!orientation) return false;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = t[i], &b = t[i == 2 ? 0 : i + 1];
    if (std::ranges::all_of(
            s, [&](const Vec3& p) { return p == a || p == b || certain_turn(axis, a, b, p) == -*orientation; }))
      return true;
  }
  return false;
}

}  // namespace

bool triangles_intersect(const Triangle& first, const Triangle& second) {
  const Corners one{first.a, first.b, first.c}, other{second.a, second.b, second.c};
  const int axis = dominant_axis(cross(first.b - first.a, first.c - first.a));
  if (projections_certainly_apart(one, other, axis) || projections_certainly_apart(other, one, axis)) return false;

  Corners s{first.a, first.b, first.c}, t{second.a, second.b, second.c};
  const int shared = match_corners(s, t);
  if (shared < 3 && (strictly_beside(s, t, shared) || strictly_beside(t, s, shared))) return false;

  const auto s_axis = projection_axis(first), t_axis = projection_axis(second);
  if (!s_axis || !t_axis) return false;
  if (shared == 3) return true;
  if (shared == 2) return turn(*s_axis, s[0], s[1], s[2]) == turn(*s_axis, s[0], s[1], t[2]);  // coplanar, overlapping
  return edges_meet(s, shared, t, *t_axis) || edges_meet(t, shared, s, *s_axis);
}

namespace {

/// Both as seen from a corner of one of them, so that little is lost by rounding.
class SeparatingAxis {
 public:
  SeparatingAxis(const Triangle& s, const Triangle& t) {
    const auto entry = [&](const Vec3& p) {
      const Vec3 q = p - s.a;
      largest_ = std::max({largest_, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
      return q;
    };
    s_ = {Vec3{}, entry(s.b), entry(s.c)};
    t_ = {entry(t.a), entry(t.b), entry(t.c)};
  }

  /// Along each coordinate, along both normals, and square to an edge of each.
  bool is_found() const {
    const Corners s_edges = edges(s_), t_edges = edges(t_);
    if (separates({1, 0, 0}) || separates({0, 1, 0}) || separates({0, 0, 1})) return true;
    if (separates(cross(s_edges[0], s_edges[1])) || separates(cross(t_edges[0], t_edges[1]))) return true;
    for (const Vec3& e : s_edges)
      for (const Vec3& f : t_edges)
        if (separates(cross(e, f))) return true;
    return false;
  }

 private:
  static Corners edges(const Corners& t) { return {t[1] - t[0], t[2] - t[1], t[0] - t[2]}; }

  /// Whatever the axis, of the values dot(axis, p - s.a) one triangle has smaller ones than the other. Each coordinate
  /// of p - s.a has a relative error of eps = 2^-53, the product another, and the two sums one each of the partial sum:
  /// at most 12 eps + O(eps^2) of the product of the largest entries, and 3 * 2^-1074 where products underflow. Twice
  /// that, for two values are compared, and more for rounding the bound itself.
  bool separates(const Vec3& axis) const {
    constexpr double kEpsilon = 0x1p-53;
    const double product = largest_ * std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
    if (!(product < 0x1p1000)) return false;
    const double error = 32 * kEpsilon * product + 0x1p-1060;
    const auto [s_min, s_max] = range(axis, s_);
    const auto [t_min, t_max] = range(axis, t_);
    return t_min - s_max > error || s_min - t_max > error;
  }
  static std::pair<double, double> range(const Vec3& axis, const Corners& t) {
    const double a = dot(axis, t[0]), b = dot(axis, t[1]), c = dot(axis, t[2]);
    return {std::min(std::min(a, b), c), std::max(std::max(a, b), c)};
  }

  Corners s_, t_;
  double largest_ = 0;
};

bool meets(const Triangle& t, int axis, const Vec3& p, const Vec3& q) {
  return segment_meets({t.a, t.b, t.c}, axis, p, q);
}

bool an_edge_meets(const Triangle& s, const Triangle& t, int axis) {
  return meets(t, axis, s.a, s.b) || meets(t, axis, s.b, s.c) || meets(t, axis, s.c, s.a);
}

bool before(const Vec3& p, const Vec3& q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); }

bool segments_touch(const Segment& s, const Segment& t) {
  if (side(s.a, s.b, t.a, t.b) != Side::On) return false;
  // Seen along an axis in which the plane of all four points keeps its area.
  for (const Triangle& corner : {Triangle{s.a, s.b, t.a}, {s.a, s.b, t.b}, {t.a, t.b, s.a}, {t.a, t.b, s.b}})
    if (const auto axis = projection_axis(corner))
      return turn(*axis, s.a, s.b, t.a) * turn(*axis, s.a, s.b, t.b) <= 0 &&
             turn(*axis, t.a, t.b, s.a) * turn(*axis, t.a, t.b, s.b) <= 0;
  // On one line, along which points are ordered by their coordinates.
  return !before(s.b, t.a) && !before(t.b, s.a);
}

}  // namespace

Segment segment_of(const Triangle& t) {
  const auto [least, greatest] = std::minmax({t.a, t.b, t.c}, before);
  return {least, greatest};
}

bool certainly_apart(const Triangle& s, const Triangle& t) { return SeparatingAxis(s, t).is_found(); }

bool triangles_touch(const Triangle& s, const Triangle& t) {
  if (certainly_apart(s, t)) return false;
  const auto s_axis = projection_axis(s), t_axis = projection_axis(t);
  if (s_axis && t_axis) return an_edge_meets(s, t, *t_axis) || an_edge_meets(t, s, *s_axis);
  if (!s_axis && !t_axis) return segments_touch(segment_of(s), segment_of(t));
  const Segment segment = segment_of(s_axis ? t : s);
  return s_axis ? meets(s, *s_axis, segment.a, segment.b) : meets(t, *t_axis, segment.a, segment.b);
}

}  // namespace prohull

#pragma once

#include <array>

#include "geometry/triangle_predicates.h"

namespace prohull {

inline bool same_strict_sign(int u, int v, int w) { return u != 0 && u == v && u == w; }

/// For p and q in the plane of t, which has an area along `axis`: disjoint convex polygons are separated strictly by
/// the line of an edge of one of them.
inline bool coplanar_segment_meets(const std::array<Vec3, 3>& t, int axis, const Vec3& p, const Vec3& q) {
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
inline bool segment_meets(const std::array<Vec3, 3>& t, int axis, const Vec3& p, const Vec3& q) {
  const Side sp = side(t[0], t[1], t[2], p), sq = side(t[0], t[1], t[2], q);
  if (sp == Side::On && sq == Side::On) return coplanar_segment_meets(t, axis, p, q);
  if (sp == sq) return false;
  const int u = int(side(p, q, t[0], t[1])), v = int(side(p, q, t[1], t[2]));  // the line pq passes t[0]t[1] on side u
  if (u * v < 0) return false;
  const int w = int(side(p, q, t[2], t[0]));
  return u * w >= 0 && v * w >= 0;
}

}  // namespace prohull

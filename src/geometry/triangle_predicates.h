#pragma once

#include <optional>

#include "geometry/predicates.h"
#include "geometry/rounded_turn.h"

namespace prohull {

inline bool is_corner(const Triangle& t, const Vec3& p) { return p == t.a || p == t.b || p == t.c; }

/// The side of the supporting plane of t on which p lies; fast where p is one of its corners.
inline Side side(const Triangle& t, const Vec3& p) { return is_corner(t, p) ? Side::On : side(t.a, t.b, t.c, p); }

/// Whether u lies in the supporting plane of t.
inline bool coplanar(const Triangle& t, const Triangle& u) {
  return side(t, u.a) == Side::On && side(t, u.b) == Side::On && side(t, u.c) == Side::On;
}

/// turn(axis, a, b, p), fast where p is a or b.
inline int turn_at_edge(int axis, const Vec3& a, const Vec3& b, const Vec3& p) {
  return p == a || p == b ? 0 : turn(axis, a, b, p);
}

/// The turn from a to b to a point of their line, seen along z, that was moved by (eps, eps^2), eps infinitely small: 0
/// only if a and b are one point seen like that.
inline int turn_of_moved(const Vec3& a, const Vec3& b) {
  if (a.y != b.y) return a.y < b.y ? -1 : 1;
  return a.x < b.x ? 1 : a.x > b.x ? -1 : 0;
}

/// How t turns around a ray from p towards +z, p moved by (eps, eps^2); 0 if the ray passes it by.
inline int turn_around_moved(const Triangle& t, const Vec3& p) {
  const auto turn_of = [&](const Vec3& a, const Vec3& b) {
    const int exact = turn(2, a, b, p);
    return exact != 0 ? exact : turn_of_moved(a, b);
  };
  const int turns = turn_of(t.a, t.b);
  return turns != 0 && turn_of(t.b, t.c) == turns && turn_of(t.c, t.a) == turns ? turns : 0;
}

/// An axis along which t projects to a triangle with an area, usually the one closest to its normal;
/// none if t has no area. Exact.
inline std::optional<int> projection_axis(const Triangle& t) {
  const Vec3 n = cross(t.b - t.a, t.c - t.a);
  const int guess = dominant_axis(n);
  for (const int axis : {guess, (guess + 1) % 3, (guess + 2) % 3})
    if (turn(axis, t.a, t.b, t.c) != 0) return axis;
  return std::nullopt;
}

}  // namespace prohull

#include "geometry/triangle_intersection.h"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/rounded_turn.h"
#include "geometry/segment_contact.h"
#include "geometry/triangle_predicates.h"

namespace prohull {
namespace {

using Corners = std::array<Vec3, 3>;

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

}  // namespace prohull

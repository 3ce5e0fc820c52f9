#include "geometry/winding_number.h"

#include <algorithm>

#include "geometry/predicates.h"

namespace prohull {
namespace {

// The ray goes towards +z. Seen along it, p is moved by (eps, eps^2): never onto the line of a and b.
int turn_of_moved(const Vec3& a, const Vec3& b, const Vec3& p) {
  if (const int exact = turn(2, a, b, p)) return exact;
  if (a.y != b.y) return a.y < b.y ? -1 : 1;
  return a.x < b.x ? 1 : a.x > b.x ? -1 : 0;
}

bool may_cross(const Triangle& t, const Vec3& p) {
  const auto [x0, x1] = std::minmax({t.a.x, t.b.x, t.c.x});
  const auto [y0, y1] = std::minmax({t.a.y, t.b.y, t.c.y});
  return x0 <= p.x && p.x <= x1 && y0 <= p.y && p.y <= y1 && std::max({t.a.z, t.b.z, t.c.z}) >= p.z;
}

}  // namespace

std::optional<int> winding_number(const Vec3& p, std::span<const Triangle> triangles) {
  int winding = 0;
  for (const Triangle& t : triangles) {
    if (!may_cross(t, p)) continue;
    const int turns = turn_of_moved(t.a, t.b, p);
    if (turns == 0 || turn_of_moved(t.b, t.c, p) != turns || turn_of_moved(t.c, t.a, p) != turns) continue;
    const Side s = side(t.a, t.b, t.c, p);
    if (s == Side::On) return std::nullopt;
    // The ray leaves through a triangle that it sees from inside: counter-clockwise seen from +z, p below.
    if (turns > 0 && s == Side::Inside) ++winding;
    if (turns < 0 && s == Side::Outside) --winding;
  }
  return winding;
}

}  // namespace prohull

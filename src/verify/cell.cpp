#include "verify/cell.h"

namespace prohull::verify {
namespace {

/// The exact difference of a coordinate.
Number along(const Vec3& from, const Vec3& to, int coordinate) {
  return Number(to[coordinate]) - Number(from[coordinate]);
}

}  // namespace

PlanePoint projected(int axis, const Vec3& p) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

Cell whole_cell(const Triangle& t, int axis) {
  return {projected(axis, t.a), projected(axis, t.b), projected(axis, t.c)};
}

std::array<Number, 3> lifted(const Triangle& t, int axis, const PlanePoint& p) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Number bu = along(t.a, t.b, u), bv = along(t.a, t.b, v), bw = along(t.a, t.b, axis);
  const Number cu = along(t.a, t.c, u), cv = along(t.a, t.c, v), cw = along(t.a, t.c, axis);
  const Number du = p.u - t.a[u], dv = p.v - t.a[v];
  std::array<Number, 3> point;
  point[u] = p.u;
  point[v] = p.v;
  point[axis] = t.a[axis] + (bw * (du * cv - dv * cu) + cw * (bu * dv - bv * du)) / (bu * cv - bv * cu);
  return point;
}

}  // namespace prohull::verify

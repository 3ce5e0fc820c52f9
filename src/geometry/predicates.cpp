#include "geometry/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>

#include "geometry/exact_number.h"

namespace prohull {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(const Vec3& v) { return {v.x, v.y, v.z}; }

Kernel::Point_2 projected(int axis, const Vec3& v) { return {v[(axis + 1) % 3], v[(axis + 2) % 3]}; }

}  // namespace

Side exact_side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  return Side(static_cast<int>(CGAL::orientation(point(a), point(b), point(c), point(p))));
}

int turn(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  return static_cast<int>(CGAL::orientation(projected(axis, a), projected(axis, b), projected(axis, c)));
}

int exact_determinant_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e, const Vec3& f) {
  const auto are_parallel = [](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
    return p == q || (p == r && q == s) || (p == s && q == r);
  };
  if (are_parallel(a, b, c, d) || are_parallel(c, d, e, f) || are_parallel(e, f, a, b)) return 0;  // often
  using Number = ExactNumber;
  const auto row = [](const Vec3& from, const Vec3& to) {
    return std::array{Number(to.x) - Number(from.x), Number(to.y) - Number(from.y), Number(to.z) - Number(from.z)};
  };
  const auto u = row(a, b), v = row(c, d), w = row(e, f);
  return int(CGAL::sign(u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                        u[2] * (v[0] * w[1] - v[1] * w[0])));
}

}  // namespace prohull

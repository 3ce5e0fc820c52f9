#include "geometry/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

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

}  // namespace prohull

#include "cover/polytope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "prohull/convex_hull.h"

namespace prohull::cover {

TriangleMesh fan_of(std::vector<Vec3> points) {
  TriangleMesh fan;
  fan.positions = PerVertex<Vec3>(std::move(points));
  for (std::uint32_t i = 2; i < fan.vertex_count(); ++i)
    fan.triangles.push_back({VertexId{0}, VertexId{i - 1}, VertexId{i}});
  return fan;
}

TriangleMesh convex_hull_of(std::vector<Vec3> points) { return convex_hull(fan_of(std::move(points))); }

Vec3 middle(const TriangleMesh& polytope) {
  Vec3 sum{};
  for (const Vec3& p : polytope.positions) sum += p / static_cast<double>(polytope.vertex_count());
  return sum;
}

double depth(const Vec3& p, const TriangleMesh& polytope) {
  double least = std::numeric_limits<double>::infinity();
  for (const FaceId f : polytope.triangles.ids()) {
    const auto [a, b, c] = polytope.triangle(f);
    const double unit = std::ldexp(1.0, -std::ilogb(norm(b - a)));  // the square of the normal shall not overflow
    const Vec3 normal = cross((b - a) * unit, (c - a) * unit);
    least = std::min(least, dot(a - p, normal) / norm(normal));
  }
  return least;
}

}  // namespace prohull::cover

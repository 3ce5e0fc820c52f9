#include "cover/piece_hull.h"

#include <algorithm>
#include <cmath>

#include "cover/few_vertices.h"
#include "cover/polytope.h"

namespace prohull::cover {
namespace {

/// Corners of the surface itself are exact; those on the planes are rounded.
bool is_on_a_plane(const Vec3& p, const Part& part, double near) {
  return std::any_of(part.cell.planes.begin(), part.cell.planes.end(),
                     [&](const Plane& plane) { return std::abs(plane.height(p)) <= near; });
}

/// The convex hull of octahedra around the points.
TriangleMesh thick_hull(const std::vector<Vec3>& points, double radius) {
  std::vector<Vec3> tips;
  for (const Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 step{};
      step[axis] = radius;
      tips.push_back(p + step);
      tips.push_back(p - step);
    }
  return convex_hull_of(std::move(tips));
}

/// Scaled so that every face moves outwards by at least `hair`; without faces if the polytope is too flat for that.
TriangleMesh grown(const TriangleMesh& polytope, double hair) {
  const Vec3 center = middle(polytope);
  const double inner_radius = depth(center, polytope);
  if (!(inner_radius > 1e3 * hair)) return {};
  std::vector<Vec3> points;
  for (const Vec3& p : polytope.positions) points.push_back(p + (p - center) * (hair / inner_radius));
  return convex_hull_of(std::move(points));
}

}  // namespace

TriangleMesh piece_hull(const Part& part, std::size_t max_vertices, bool float32_coordinates) {
  const std::vector<Vec3> points = hull_points(part);
  if (points.empty()) return {};
  Box box;
  for (const Vec3& p : points) box.extend(p);
  constexpr double kHair = 1e-9, kFar = 10;
  constexpr double kRounding = 1e-13;  // of coordinates far from the origin: some hundred times that of one
  const double diagonal = box.diagonal(), away = norm(box.center());
  const double hair = std::max(kHair * (std::min(away, kFar * diagonal) + diagonal), kRounding * away);
  TriangleMesh hull = convex_hull_of(points);
  const bool is_rounded = std::any_of(hull.positions.begin(), hull.positions.end(),
                                      [&](const Vec3& p) { return is_on_a_plane(p, part, hair); });
  if (is_rounded) hull = grown(hull, hair);
  if (hull.face_count() == 0) hull = thick_hull(points, std::max(1e-7 * box.diagonal(), 1e4 * hair));
  return with_few_vertices(hull, max_vertices, float32_coordinates);
}

}  // namespace prohull::cover

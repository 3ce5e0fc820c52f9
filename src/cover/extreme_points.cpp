#include "cover/extreme_points.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "prohull/convex_hull.h"
#include "prohull/detail/finite.h"

namespace prohull::cover {

double distance_to_segment(const Vec3& p, const Vec3& end, double squared_length) {
  const double t = squared_length > 0 ? std::clamp(dot(p, end) / squared_length, 0.0, 1.0) : 0;
  return norm(p - end * t);
}

ExtremePoints::ExtremePoints(const TriangleMesh& mesh) {
  TriangleMesh extreme = convex_hull(mesh);
  const Box box = bounding_box(mesh);
  center = box.center();
  const Vec3 half = box.max * 0.5 - box.min * 0.5;
  unit = std::max({half.x, half.y, half.z, std::numeric_limits<double>::min()});
  const bool is_flat = extreme.face_count() == 0;
  if (is_flat) extreme = mesh;
  extreme = without_unused_vertices(std::move(extreme));
  world.assign(extreme.positions.begin(), extreme.positions.end());
  for (Vec3& p : extreme.positions) p = (p - center) / unit;
  hull = is_flat ? TriangleMesh{} : convex_hull(extreme);
  if (hull.face_count() == 0) hull = padded_convex_hull(extreme, kSpare);
}

double ExtremePoints::radius_around(const Vec3& a, const Vec3& b) const {
  const Vec3 end = (b - a) / unit;  // in units, whose squares neither overflow nor vanish
  const double squared_length = squared_norm(end);
  double most = 0;
  for (const Vec3& p : world) most = std::max(most, distance_to_segment((p - a) / unit, end, squared_length));
  return most * unit + spare();
}

}  // namespace prohull::cover

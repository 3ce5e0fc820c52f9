#include "cover/depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/largest_coordinate.h"
#include "verify/solid_volume.h"

namespace prohull::cover {
namespace {

using Queries = oneapi::tbb::enumerable_thread_specific<MeshQuery>;

Queries queries_of(TriangleMesh mesh) {
  return Queries([index = QueryIndex(std::move(mesh))] { return MeshQuery(index); });
}

Vec3 of_length_1(const Vec3& v) {
  const double length = norm(v);
  return length > 0 ? v / length : Vec3{};
}

/// Of length 1, or 0. `unit` is near the size of the triangle.
Vec3 normal_of(const Triangle& t, double unit) { return of_length_1(cross((t.b - t.a) / unit, (t.c - t.a) / unit)); }

double unit_of(const TriangleMesh& mesh) {
  return std::ldexp(1.0, std::ilogb(std::max(bounding_box(mesh).diagonal(), 1e-300)));
}

/// What faces have within the solid, as where parts overlap, is no part of it.
TriangleMesh surface_of(const TriangleMesh& solid, ProgressMeter& meter) {
  const auto boundary = verify::solid_boundary(solid, meter);
  if (!boundary) return solid;
  TriangleMesh surface;
  for (const auto& [t, times] : *boundary) {
    if (times <= 0) continue;
    std::array<VertexId, 3> corners;
    std::ranges::transform(std::array{t.a, t.b, t.c}, corners.begin(),
                           [&](const Vec3& p) { return surface.positions.push_back(p); });
    surface.triangles.push_back(corners);
  }
  return surface.face_count() > 0 ? surface : solid;
}

}  // namespace

Depth::Depth(const TriangleMesh& solid, double slack, TriangleMesh sheets, ProgressMeter& meter)
    : faces_(surface_of(solid, meter)),
      slack_(slack),
      unit_(unit_of(solid)),
      inside_(queries_of(solid)),
      surface_(queries_of(faces_)) {
  // A foot is a corner plus a point of the face seen from there: each is rounded by a few 2^-53 of the coordinates.
  foot_error_ = 0x1p-46 * largest_coordinate(bounding_box(faces_)) + 0x1p-500;
  if (sheets.face_count() > 0) sheets_ = queries_of(std::move(sheets));
}

Place Depth::at(const Vec3& p) const { return place(p, *surface_.local().closest_point(p), is_inside(p)); }

Place Depth::place(const Vec3& p, const ClosestPoint& surface, bool is_inside) const {
  const Vec3 away = of_length_1(p - surface.position);
  Place found{p, (is_inside ? surface.lower : -surface.upper) - slack_, surface.position, is_inside ? away : -away};
  if (!sheets_ || found.depth >= 0) return found;
  const auto sheet = sheets_->local().closest_point(p, -found.depth);
  if (sheet) found.depth = std::max(found.depth, -sheet->upper);
  return found;
}

bool Depth::is_inside(const Vec3& p) const { return inside_.local().contains(p); }

double Depth::in_solid(const Vec3& p) const {
  const ClosestPoint surface = *surface_.local().closest_point(p);
  return is_inside(p) ? surface.lower : -surface.upper;
}

double Depth::most_at(const Vec3& p, std::span<const Vec3> feet) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& foot : feet) least = std::min(least, squared_norm(p - foot));
  const double most = std::sqrt(least) * (1 + 0x1p-46) + foot_error_ - slack_;
  return sheets_ ? std::max(most, 0.0) : most;
}

// The ball that touches the surface at one point shrinks until no other point of the surface is in it (Ma, Bae, Choi
// 2012, 3D medial axis point approximation).
std::optional<Place> Depth::medial_place(const Vec3& p, double tolerance) const {
  MeshQuery& query = surface_.local();
  const ClosestPoint foot = *query.closest_point(p);
  if (foot.lower > slack_ + tolerance && !is_inside(p)) return std::nullopt;
  const Vec3 normal = normal_of(faces_.triangle(foot.face), unit_), touched = foot.position;
  if (normal == Vec3{}) return std::nullopt;
  const auto across_solid = query.first_hit(Ray{touched - normal * (tolerance / 16), -normal * unit_});
  if (!across_solid || across_solid->entering) return std::nullopt;
  double radius = across_solid->t * unit_ / 2;
  constexpr int kMostRounds = 30;
  for (int round = 0; round < kMostRounds; ++round) {
    const Vec3 center = touched - normal * radius;
    const ClosestPoint found = *query.closest_point(center);
    const bool is_empty = found.upper > std::max(radius - tolerance, 0.0);
    if (is_empty) return is_inside(center) ? std::optional(place(center, found, true)) : std::nullopt;
    const Vec3 across = touched - found.position;
    const double rise = dot(normal, across);
    if (!(rise > 0)) return std::nullopt;
    const double next = squared_norm(across) / (2 * rise);
    if (!(next < radius)) return place(center, found, is_inside(center));
    radius = next;
  }
  return std::nullopt;
}

}  // namespace prohull::cover

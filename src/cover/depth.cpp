#include "cover/depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/largest_coordinate.h"

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

}  // namespace

Depth::Depth(TriangleMesh solid, double slack, TriangleMesh sheets)
    : solid_(std::move(solid)),
      slack_(slack),
      unit_(std::ldexp(1.0, std::ilogb(std::max(bounding_box(solid_).diagonal(), 1e-300)))),
      query_(queries_of(solid_)) {
  // A foot is a corner plus a point of the face seen from there: each is rounded by a few 2^-53 of the coordinates.
  foot_error_ = 0x1p-46 * largest_coordinate(bounding_box(solid_)) + 0x1p-500;
  if (sheets.face_count() > 0) sheets_ = queries_of(std::move(sheets));
}

Place Depth::at(const Vec3& p) const {
  MeshQuery& query = query_.local();
  return place(p, *query.closest_point(p), query.contains(p));
}

Place Depth::place(const Vec3& p, const ClosestPoint& surface, bool is_inside) const {
  const Vec3 away = of_length_1(p - surface.position);
  Place found{p, (is_inside ? surface.lower : -surface.upper) - slack_, surface.position, is_inside ? away : -away};
  if (!sheets_ || found.depth >= 0) return found;
  const auto sheet = sheets_->local().closest_point(p, -found.depth);
  if (sheet) found.depth = std::max(found.depth, -sheet->upper);
  return found;
}

double Depth::in_solid(const Vec3& p) const { return -query_.local().signed_distance(p).upper; }

double Depth::most_at(const Vec3& p, std::span<const Vec3> feet) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& foot : feet) least = std::min(least, squared_norm(p - foot));
  const double most = std::sqrt(least) * (1 + 0x1p-46) + foot_error_ - slack_;
  return sheets_ ? std::max(most, 0.0) : most;
}

Vec3 Depth::normal_of(FaceId face) const {
  const Triangle t = solid_.triangle(face);
  return of_length_1(cross((t.b - t.a) / unit_, (t.c - t.a) / unit_));
}

// The ball that touches the surface at one point shrinks until no other point of the surface is in it (Ma, Bae, Choi
// 2012, 3D medial axis point approximation).
std::optional<Place> Depth::medial_place(const Vec3& p, double tolerance) const {
  MeshQuery& query = query_.local();
  const ClosestPoint foot = *query.closest_point(p);
  const Vec3 normal = normal_of(foot.face), touched = foot.position;
  if (normal == Vec3{}) return std::nullopt;
  const auto across_solid = query.first_hit(Ray{touched - normal * (tolerance / 16), -normal * unit_});
  if (!across_solid || across_solid->entering) return std::nullopt;
  double radius = across_solid->t * unit_ / 2;
  constexpr int kMostRounds = 30;
  for (int round = 0; round < kMostRounds; ++round) {
    const Vec3 center = touched - normal * radius;
    const ClosestPoint found = *query.closest_point(center);
    const bool is_empty = found.upper > std::max(radius - tolerance, 0.0);
    if (is_empty) return query.contains(center) ? std::optional(place(center, found, true)) : std::nullopt;
    const Vec3 across = touched - found.position;
    const double rise = dot(normal, across);
    if (!(rise > 0)) return std::nullopt;
    const double next = squared_norm(across) / (2 * rise);
    if (!(next < radius)) return place(center, found, query.contains(center));
    radius = next;
  }
  return std::nullopt;
}

}  // namespace prohull::cover

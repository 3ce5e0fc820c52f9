#include "cover/depth.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
  if (sheets.face_count() > 0) sheets_ = queries_of(std::move(sheets));
}

double Depth::at(const Vec3& p) const {
  const double depth = in_solid(p) - slack_;
  if (!sheets_ || depth >= 0) return depth;
  const auto sheet = sheets_->local().closest_point(p, -depth);
  return sheet ? std::max(depth, -sheet->upper) : depth;
}

double Depth::in_solid(const Vec3& p) const { return -query_.local().signed_distance(p).upper; }

Vec3 Depth::normal_of(FaceId face) const {
  const Triangle t = solid_.triangle(face);
  return of_length_1(cross((t.b - t.a) / unit_, (t.c - t.a) / unit_));
}

// The ball that touches the surface at one point shrinks until no other point of the surface is in it (Ma, Bae, Choi
// 2012, 3D medial axis point approximation).
std::optional<Vec3> Depth::medial_point(const Vec3& p, double tolerance) const {
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
    const auto inside = query.closest_point(center, std::max(radius - tolerance, 0.0));
    if (!inside) return query.contains(center) ? std::optional(center) : std::nullopt;
    const Vec3 across = touched - inside->position;
    const double rise = dot(normal, across);
    if (!(rise > 0)) return std::nullopt;
    const double next = squared_norm(across) / (2 * rise);
    if (!(next < radius)) return center;
    radius = next;
  }
  return std::nullopt;
}

Vec3 Depth::inwards(const Vec3& p) const {
  const ClosestPoint found = query_.local().signed_distance(p);
  const Vec3 away = of_length_1(p - found.position);
  return found.distance < 0 ? away : -away;
}

}  // namespace prohull::cover

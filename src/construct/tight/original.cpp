#include "construct/tight/original.h"

#include <oneapi/tbb/parallel_invoke.h>
#include <cmath>

#include <algorithm>
#include <utility>

#include "geometry/predicates.h"
#include "geometry/triangle_distance.h"
#include "parallel/arena.h"

namespace prohull {
namespace {

std::vector<Triangle> triangles_of(const TriangleMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.face_count());
  for (const FaceId f : mesh.triangles.ids()) triangles.push_back(mesh.triangle(f));
  return triangles;
}

TriangleSieve sieve_of(const TriangleMesh& mesh, unsigned threads) {
  return arena_of(threads).execute([&] { return TriangleSieve(mesh); });
}

/// Whether they are so far apart for certain: one lies beyond the plane of the other. False for some that are.
bool is_certainly_beyond(const Triangle& plane, const Triangle& t, double distance) {
  constexpr double kLittleMore = 1 + 1e-9;
  const Vec3 n = cross(plane.b - plane.a, plane.c - plane.a);
  const double length = norm(n);
  if (!(length > 0)) return false;
  const double a = dot(n, t.a - plane.a), b = dot(n, t.b - plane.a), c = dot(n, t.c - plane.a);
  return std::max(std::min({a, b, c}), -std::max({a, b, c})) >= kLittleMore * distance * length;
}

/// The same, along an axis, from one to the other.
bool is_certainly_beyond(const Vec3& axis, const Triangle& s, const Triangle& t, double distance) {
  constexpr double kLittleMore = 1 + 1e-9;
  const auto along = [&](const Vec3& p) { return dot(axis, p - s.a); };
  return std::min({along(t.a), along(t.b), along(t.c)}) - std::max({0.0, along(s.b), along(s.c)}) >=
         kLittleMore * distance * norm(axis);
}

/// A point in the inside of the tetrahedron, if rounding leaves one there.
std::optional<Vec3> point_inside(const Tetrahedron& t) {
  const Vec3 center = t.a * 0.25 + t.b * 0.25 + t.c * 0.25 + t.d * 0.25;
  const bool is_inside = side(t.a, t.b, t.c, center) == Side::Inside && side(t.d, t.c, t.b, center) == Side::Inside &&
                         side(t.a, t.d, t.b, center) == Side::Inside && side(t.a, t.c, t.d, center) == Side::Inside;
  if (!is_inside) return std::nullopt;
  return center;
}

}  // namespace

Original::Original(TriangleSieve sieve, double clearance)
    : sieve_(std::move(sieve)), bounds_(bounding_box(sieve_.mesh())), clearance_(clearance) {}

Original Original::closed(const TriangleMesh& mesh, HullSide side, unsigned threads) {
  std::optional<WindingNumber> winding;
  std::optional<TriangleSieve> sieve;
  arena_of(threads).execute([&] {
    oneapi::tbb::parallel_invoke([&] { winding.emplace(triangles_of(mesh)); }, [&] { sieve.emplace(mesh); });
  });
  Original original(std::move(*sieve), 0);
  original.winding_ = std::move(winding);
  original.least_covered_ = side == HullSide::Outer ? 1 : 0;
  return original;
}

Original Original::triangles(const TriangleMesh& mesh, unsigned threads) {
  constexpr double kClearance = 1e-6;  // of the diagonal: more than a hull moves when it is rounded to float32
  return {sieve_of(mesh, threads), kClearance * bounding_box(mesh).diagonal()};
}

Original Original::padded_triangles(const TriangleMesh& mesh, double padding, unsigned threads) {
  constexpr double kLittleMore = 1 + 1e-9;  // for what proposals have rounded
  Original original(sieve_of(mesh, threads), kLittleMore * padding);
  original.padding_ = padding;
  return original;
}

// What lies side by side is beyond the same axis.
bool Original::keeps_padding(const Triangle& face) const {
  if (padding_ == 0) return true;
  bool keeps = true;
  Vec3 axis;
  sieve_.visit(sieve_.around(face, padding_), [&](FaceId f) {
    const Triangle t = mesh().triangle(f);
    if (is_certainly_beyond(face, t, padding_) || (axis != Vec3{} && is_certainly_beyond(axis, face, t, padding_)))
      return true;
    const TriangleDistance found = triangle_distance(face, t);
    axis = found.t - found.s;
    return keeps = found.lower >= padding_;
  });
  return keeps;
}

// Of those that are as near but for a thousandth of the padding, any.
std::optional<Original::Near> Original::nearest_within_padding(const Triangle& face) const {
  constexpr double kAsNear = 1e-6;
  std::optional<Near> nearest;
  double least = padding_;
  Vec3 axis;
  sieve_.visit(sieve_.around(face, padding_), [&](FaceId f) {
    const Triangle t = mesh().triangle(f);
    const double nearer = nearest ? least - kAsNear * padding_ : padding_;
    if (is_certainly_beyond(face, t, nearer) || (axis != Vec3{} && is_certainly_beyond(axis, face, t, nearer)))
      return true;
    const TriangleDistance found = triangle_distance(face, t);
    axis = found.t - found.s;
    if (found.lower < least) least = found.lower, nearest = Near{found.t, found.s - found.t, found.lower};
    return least > kAsNear * padding_;
  });
  return nearest;
}

void Original::find_near(const Tetrahedron& removed, std::vector<FaceId>& near) const {
  sieve_.visit(sieve_.around(removed, clearance_), [&](FaceId f) {
    near.push_back(f);
    return true;
  });
}

bool Original::is_in_the_way(FaceId f, const Tetrahedron& removed) const {
  const Triangle t = mesh().triangle(f);
  return winding_ ? meets_interior(t, removed) : may_touch(t, removed);
}

bool Original::is_outside_at(const Vec3& p) const {
  return !winding_ || winding_->at(p).value_or(least_covered_) < least_covered_;
}

bool Original::is_outside_inside_of(const Tetrahedron& removed) const {
  if (!winding_) return true;
  const auto inside = point_inside(removed);
  return inside && is_outside_at(*inside);
}

bool Original::lies_outside_of(const Tetrahedron& removed) const {
  bool met = false;
  sieve_.visit(sieve_.around(removed, 0), [&](FaceId f) { return !(met = is_in_the_way(f, removed)); });
  return !met && is_outside_inside_of(removed);
}

Box Original::allowed(double max_overhang) const {
  const double diagonal = std::isfinite(max_overhang) ? bounds_.diagonal() : 1;
  const double reach = max_overhang * diagonal + clearance_;
  const Vec3 all{reach, reach, reach};
  return {bounds_.min - all, bounds_.max + all};
}

}  // namespace prohull

#include "verify/offenders.h"

#include <algorithm>

namespace prohull::verify {
namespace {

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = squared_norm(ab);
  const double s = length2 > 0 ? std::clamp(dot(p - a, ab) / length2, 0.0, 1.0) : 0;
  return norm(p - (a + ab * s));
}

}  // namespace

double distance(const Vec3& p, const Triangle& t) {
  const Vec3 n = cross(t.b - t.a, t.c - t.a);
  const auto is_left_of = [&](const Vec3& a, const Vec3& b) { return dot(cross(b - a, p - a), n) >= 0; };
  // The normal of a thinner triangle is rounded by more than the triangle is wide.
  constexpr double kThin = 0x1p-52;
  if (squared_norm(n) > kThin * squared_norm(t.b - t.a) * squared_norm(t.c - t.a) && is_left_of(t.a, t.b) &&
      is_left_of(t.b, t.c) && is_left_of(t.c, t.a))
    return std::abs(dot(p - t.a, n)) / norm(n);
  return std::min(
      {distance_to_segment(p, t.a, t.b), distance_to_segment(p, t.b, t.c), distance_to_segment(p, t.c, t.a)});
}

double distance(const Vec3& p, const Box& box) {
  const auto beyond = [&](int i) { return std::max({box.min[i] - p[i], p[i] - box.max[i], 0.0}); };
  return norm(Vec3{beyond(0), beyond(1), beyond(2)});
}

Offender farthest(FaceId face, std::span<const Vec3> points, const Surface& surface) {
  Offender result{face, points[0], -1};
  for (const Vec3& p : points) {
    const double d = surface.bvh.least([&](const Box& box) { return distance(p, box); },
                                       [&](FaceIndex h) { return distance(p, surface.faces[h]); });
    if (d > result.distance) result.point = p, result.distance = d;
  }
  return result;
}

std::vector<Offender> worst_of(std::vector<Offender> offenders, std::size_t count) {
  count = std::min(count, offenders.size());
  std::partial_sort(offenders.begin(), offenders.begin() + std::ptrdiff_t(count), offenders.end(),
                    [](const Offender& a, const Offender& b) {
                      return a.distance != b.distance ? a.distance > b.distance : a.face < b.face;
                    });
  offenders.resize(count);
  return offenders;
}

}  // namespace prohull::verify

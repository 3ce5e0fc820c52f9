#include "verify/offenders.h"

#include <algorithm>

#include "verify/distance.h"

namespace prohull::verify {

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

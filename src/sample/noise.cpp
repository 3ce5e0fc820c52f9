#include "sample/noise.h"

#include <cmath>

namespace prohull {
namespace {

/// The scalar product of d with one of the twelve directions to the edges of a cube.
double gradient_along(std::uint64_t hash, const Vec3& d) {
  const int axis = int((hash >> 32) % 3);
  const double a = d[(axis + 1) % 3], b = d[(axis + 2) % 3];
  return ((hash & 1) ? a : -a) + ((hash & 2) ? b : -b);
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

}  // namespace

double gradient_noise(const Vec3& p, std::uint64_t seed) {
  const Vec3 cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const Vec3 d = p - cell;
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 offset{double(corner & 1), double(corner >> 1 & 1), double(corner >> 2)};
    const Vec3 q = cell + offset, to = d - offset;
    std::uint64_t hash = seed;
    for (int axis = 0; axis < 3; ++axis) hash = scramble(hash ^ std::uint64_t(std::int64_t(q[axis])));
    const double weight = fade(1 - std::abs(to.x)) * fade(1 - std::abs(to.y)) * fade(1 - std::abs(to.z));
    sum += weight * gradient_along(hash, to);
  }
  return sum;
}

}  // namespace prohull

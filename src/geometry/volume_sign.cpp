#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "geometry/exact_number.h"
#include "geometry/interval.h"
#include "geometry/orientation.h"
#include "geometry/vector_of.h"

namespace prohull {
namespace {

/// The sign of the volume, if rounding cannot change it. With eps = 2^-53, a determinant of rounded differences is off
/// by less than 8 eps times its permanent (as in predicates.h), and a sum of n by n eps times all of these; where the
/// differences are below 2^300, products that underflow move a determinant by less than 2^-770.
template <class TriangleOf>
std::optional<int> rounded_sign(std::size_t count, TriangleOf triangle) {
  double sum = 0, permanents = 0, reach = 0;
  const Vec3 o = triangle(0).a;
  for (std::size_t f = 0; f < count; ++f) {
    const Triangle t = triangle(f);
    const Vec3 u = t.a - o, v = t.b - o, w = t.c - o;
    const double vy_wz = v.y * w.z, vz_wy = v.z * w.y, vz_wx = v.z * w.x, vx_wz = v.x * w.z, vx_wy = v.x * w.y,
                 vy_wx = v.y * w.x;
    sum += u.x * (vy_wz - vz_wy) + u.y * (vz_wx - vx_wz) + u.z * (vx_wy - vy_wx);
    permanents += (std::abs(vy_wz) + std::abs(vz_wy)) * std::abs(u.x) +
                  (std::abs(vz_wx) + std::abs(vx_wz)) * std::abs(u.y) +
                  (std::abs(vx_wy) + std::abs(vy_wx)) * std::abs(u.z);
    for (const Vec3& d : {u, v, w}) reach = std::max({reach, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  }
  const double n = static_cast<double>(count), error = (n + 16) * 0x1p-52 * permanents + n * 0x1p-700;
  if (!(reach < 0x1p300 && std::abs(sum) > error)) return std::nullopt;
  return sum > 0 ? 1 : -1;
}

/// Six times the volume, seen from a corner of the mesh, so that a distant mesh loses no digits.
template <class Field, class TriangleOf>
Field sixfold_volume(std::size_t count, TriangleOf triangle) {
  Field sum(0);
  const Vec3 o = triangle(0).a;
  for (std::size_t f = 0; f < count; ++f) {
    const Triangle t = triangle(f);
    sum += dot(between<Field>(o, t.a), cross(between<Field>(o, t.b), between<Field>(o, t.c)));
  }
  return sum;
}

template <class TriangleOf>
int sign_of_volume(std::size_t count, TriangleOf triangle) {
  if (count == 0) return 0;
  if (const auto certain = rounded_sign(count, triangle)) return *certain;
  if (const auto certain = certain_sign(sixfold_volume<Interval>(count, triangle))) return *certain;
  return sign(sixfold_volume<ExactNumber>(count, triangle));
}

}  // namespace

int volume_sign(std::span<const Triangle> faces) {
  return sign_of_volume(faces.size(), [&](std::size_t f) { return faces[f]; });
}

int volume_sign(std::size_t count, const TriangleOfFace& triangle) {
  return sign_of_volume(count, std::cref(triangle));
}

}  // namespace prohull

#include "geometry/exact_number.h"
#include "geometry/interval.h"
#include "geometry/orientation.h"
#include "geometry/vector_of.h"

namespace prohull {
namespace {

/// Six times the volume, seen from a corner of the mesh, so that a distant mesh loses no digits.
template <class Field, class TriangleOf>
Field sixfold_volume(std::size_t count, TriangleOf triangle) {
  Field sum(0);
  if (count == 0) return sum;
  const Vec3 o = triangle(0).a;
  for (std::size_t f = 0; f < count; ++f) {
    const Triangle t = triangle(f);
    sum += dot(between<Field>(o, t.a), cross(between<Field>(o, t.b), between<Field>(o, t.c)));
  }
  return sum;
}

template <class TriangleOf>
int sign_of_volume(std::size_t count, TriangleOf triangle) {
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

#pragma once

#include <array>

#include "prohull/geometry.h"

namespace prohull {

/// Vectors of intervals, and of exact numbers.
template <class Field>
using VectorOf = std::array<Field, 3>;

template <class Field>
VectorOf<Field> between(const Vec3& from, const Vec3& to) {
  return {Field(to.x) - Field(from.x), Field(to.y) - Field(from.y), Field(to.z) - Field(from.z)};
}

template <class Field>
VectorOf<Field> operator-(const VectorOf<Field>& a, const VectorOf<Field>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class Field>
Field dot(const VectorOf<Field>& a, const VectorOf<Field>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Field>
VectorOf<Field> cross(const VectorOf<Field>& a, const VectorOf<Field>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace prohull

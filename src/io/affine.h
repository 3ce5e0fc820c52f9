#pragma once

#include "prohull/geometry.h"

namespace prohull {

/// p -> p.x * x + p.y * y + p.z * z + origin, in double precision; the identity leaves every bit as it is.
struct Affine {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin;

  bool operator==(const Affine&) const = default;
  Vec3 linear(const Vec3& p) const { return p.x * x + p.y * y + p.z * z; }
  Vec3 operator()(const Vec3& p) const { return *this == Affine{} ? p : linear(p) + origin; }
  /// First `inner`, then this.
  Affine operator*(const Affine& inner) const {
    return {linear(inner.x), linear(inner.y), linear(inner.z), (*this)(inner.origin)};
  }
  /// Whether it turns the outside of a mesh inwards, so that its faces have to be reversed.
  bool mirrors() const { return dot(cross(x, y), z) < 0; }
};

}  // namespace prohull

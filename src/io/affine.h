#pragma once

#include <algorithm>
#include <cmath>

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
  bool mirrors() const {
    const auto of_length_1 = [](const Vec3& v) {  // about, by a power of 2: products do not underflow
      int exponent = 0;
      std::frexp(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}), &exponent);
      return Vec3{std::ldexp(v.x, -exponent), std::ldexp(v.y, -exponent), std::ldexp(v.z, -exponent)};
    };
    return dot(cross(of_length_1(x), of_length_1(y)), of_length_1(z)) < 0;
  }
};

}  // namespace prohull

#pragma once

#include "prohull/geometry.h"

namespace prohull {

/// The float32 nearest to x, as a double. (g++ 12 may drop this rounding; see cmake/ProhullCompileOptions.cmake.)
inline double nearest_float32(double x) { return static_cast<float>(x); }

inline Vec3 nearest_float32(const Vec3& p) {
  return {nearest_float32(p.x), nearest_float32(p.y), nearest_float32(p.z)};
}

/// Whether a float32 keeps every bit.
inline bool is_float32(const Vec3& p) { return nearest_float32(p) == p; }

}  // namespace prohull

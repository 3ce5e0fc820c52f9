#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "prohull/geometry.h"

namespace prohull {

// Vectors as g++ and clang have them on every processor. Each lane rounds as a scalar does: the same bits everywhere.
using Double2 = double __attribute__((vector_size(16)));
using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using Short8 = std::uint16_t __attribute__((vector_size(16)));
using Truth2 = decltype(Double2{} < Double2{});  ///< of comparisons: -1 or 0
using Truth4 = decltype(Float4{} < Float4{});
using Truth8 = decltype(Float8{} < Float8{});

inline Double2 both(double x) { return Double2{x, x}; }

inline Double2 sqrt(Double2 x) {
#ifdef __SSE2__
  return _mm_sqrt_pd(x);
#else
  return Double2{std::sqrt(x[0]), std::sqrt(x[1])};
#endif
}

/// Of a lane in which one is NaN, that of b.
inline Float4 max(Float4 a, Float4 b) {
#ifdef __SSE2__
  return _mm_max_ps(a, b);
#else
  return a > b ? a : b;
#endif
}

/// Of a lane in which one is NaN, that of b; likewise of zeros.
inline Double2 min(Double2 a, Double2 b) {
#ifdef __SSE2__
  return _mm_min_pd(a, b);
#else
  return a < b ? a : b;
#endif
}
inline Double2 max(Double2 a, Double2 b) {
#ifdef __SSE2__
  return _mm_max_pd(a, b);
#else
  return a > b ? a : b;
#endif
}

/// a in the lanes where that is true, and b in the others.
inline Double2 select(Truth2 where, Double2 a, Double2 b) {
  return std::bit_cast<Double2>((std::bit_cast<Truth2>(a) & where) | (std::bit_cast<Truth2>(b) & ~where));
}

inline Double2 abs(Double2 x) {
  return std::bit_cast<Double2>(std::bit_cast<Truth2>(x) & std::numeric_limits<std::int64_t>::max());
}

/// Bit i is set where lane i is true.
inline unsigned mask(Truth2 lanes) {
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(lanes)));
#else
  return unsigned(lanes[0] != 0) | unsigned(lanes[1] != 0) << 1;
#endif
}
inline unsigned mask(Truth4 lanes) {
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(lanes)));
#else
  return unsigned(lanes[0] != 0) | unsigned(lanes[1] != 0) << 1 | unsigned(lanes[2] != 0) << 2 |
         unsigned(lanes[3] != 0) << 3;
#endif
}

/// Two points or directions, one in each lane.
struct Vec3Pair {
  Double2 x, y, z;

  Vec3 operator[](int lane) const { return {x[lane], y[lane], z[lane]}; }
};

inline Vec3Pair both(const Vec3& a, const Vec3& b) { return {Double2{a.x, b.x}, Double2{a.y, b.y}, Double2{a.z, b.z}}; }
inline Vec3Pair both(const Vec3& a) { return both(a, a); }

inline Vec3Pair operator-(const Vec3Pair& a, const Vec3Pair& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3Pair operator*(const Vec3Pair& a, Double2 s) { return {a.x * s, a.y * s, a.z * s}; }
inline Double2 dot(const Vec3Pair& a, const Vec3Pair& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3Pair cross(const Vec3Pair& a, const Vec3Pair& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace prohull

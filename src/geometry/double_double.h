#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "prohull/geometry.h"

namespace prohull {

/// An unevaluated sum of two doubles (Dekker, "A Floating-Point Technique for Extending the Available Precision",
/// 1971).
struct DoubleDouble {
  double high, low;
};

namespace double_double {

constexpr double kEpsilon = 0x1p-53;

/// a + b, exactly (Knuth's TwoSum).
[[gnu::always_inline]] inline DoubleDouble sum(double a, double b) {
  const double s = a + b, b_in_s = s - a;
  return {s, (a - (s - b_in_s)) + (b - b_in_s)};
}

/// a - b, exactly.
[[gnu::always_inline]] inline DoubleDouble difference(double a, double b) { return sum(a, -b); }

/// a b, exactly if nothing overflows or underflows (Dekker's product; a fused multiply-add is slow where the processor
/// may not have it).
[[gnu::always_inline]] inline DoubleDouble product(double a, double b) {
  const auto split = [](double x) {
    const double far = 0x1.0000002p27 * x, high = far - (far - x);
    return DoubleDouble{high, x - high};
  };
  const DoubleDouble x = split(a), y = split(b);
  const double p = a * b;
  return {p, x.low * y.low - (((p - x.high * y.high) - x.low * y.high) - x.high * y.low)};
}

}  // namespace double_double

// In what follows, each low part is bounded in eps of the largest product of the entries' high parts, D, P and Q of the
// three vectors; those of given numbers are at most eps of their high parts.

/// Rounded by 8 eps^2 P Q; the low part is at most 3 eps P Q.
[[gnu::always_inline]] inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble p = double_double::product(a.high, b.high);
  return {p.high, p.low + (a.high * b.low + a.low * b.high)};
}

/// Of two such products, rounded by 14 eps^2 P Q; the low part is at most 8 eps P Q.
[[gnu::always_inline]] inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble d = double_double::difference(a.high, b.high);
  return {d.high, d.low + (a.low - b.low)};
}

/// Differences of coordinates, exactly.
struct DoubleDoubleVector {
  DoubleDoubleVector(const Vec3& from, const Vec3& to)
      : x(double_double::difference(to.x, from.x)),
        y(double_double::difference(to.y, from.y)),
        z(double_double::difference(to.z, from.z)) {}

  double largest_entry() const { return std::max(std::max(std::abs(x.high), std::abs(y.high)), std::abs(z.high)); }

  DoubleDouble x, y, z;
};

namespace double_double {

constexpr double kUnderflow = 0x1p-1000;

/// dot(d, p cross q), with a low part of at most 46 eps D P Q. In doubt by 512 eps^2 D P Q: with the bounds above, a
/// coordinate of the cross product is rounded by 30 eps^2 P Q; its product with one of d by 8 + 8 + 2 + 10 + 12 more,
/// with a low part of at most 12 eps D P Q; the sums by 116 in all. Products that underflow are off by less than
/// 2^-1000, times D if that is above 1. Required: no product overflows.
[[gnu::always_inline]] inline DoubleDouble determinant(const DoubleDoubleVector& d, const DoubleDoubleVector& p,
                                                       const DoubleDoubleVector& q) {
  const DoubleDouble x = d.x * (p.y * q.z - p.z * q.y), y = d.y * (p.z * q.x - p.x * q.z),
                     z = d.z * (p.x * q.y - p.y * q.x);
  const DoubleDouble xy = sum(x.high, y.high), xyz = sum(xy.high, z.high);
  return {xyz.high, (xy.low + xyz.low) + ((x.low + y.low) + z.low)};
}

inline int sign_beyond(double error, const DoubleDouble& x) {
  const double value = x.high + x.low;
  return value > error ? 1 : value < -error ? -1 : 0;
}

}  // namespace double_double

/// The sign of dot(d, p cross q), or 0 if it is in doubt: if the value is less than about 2^-97 of what it may be.
inline int double_double_sign(const DoubleDoubleVector& d, const DoubleDoubleVector& p, const DoubleDoubleVector& q) {
  constexpr double kLargest = 0x1p300;
  const double largest_d = d.largest_entry(), largest_p = p.largest_entry(), largest_q = q.largest_entry();
  if (!(largest_d < kLargest && largest_p < kLargest && largest_q < kLargest)) return 0;
  const double error = 513 * double_double::kEpsilon * double_double::kEpsilon * largest_d * largest_p * largest_q +
                       double_double::kUnderflow * std::max(1.0, largest_d);
  return double_double::sign_beyond(error, double_double::determinant(d, p, q));
}

namespace double_double {

/// A sum of doubles, exactly (Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
/// Predicates", 1997, Grow-Expansion).
class ExactSum {
 public:
  void add(double x) {
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      const DoubleDouble s = sum(x, terms_[i]);
      x = s.high;
      if (s.low != 0) terms_[kept++] = s.low;
    }
    if (x != 0) terms_[kept++] = x;
    count_ = kept;
  }
  bool is_zero() const { return count_ == 0; }

 private:
  std::array<double, 16> terms_;
  int count_ = 0;
};

/// Whether it is certain that a b = c d.
inline bool certainly_equal(const DoubleDouble& a, const DoubleDouble& b, const DoubleDouble& c,
                            const DoubleDouble& d) {
  constexpr double kLeast = 0x1p-800;  // what rounding loses of such a product does not underflow
  const double ab = a.high * b.high, cd = c.high * d.high;
  if (std::abs(ab - cd) > 16 * kEpsilon * std::abs(ab)) return false;  // plainly: each is rounded by less than 4 eps
  ExactSum difference;
  const auto add = [&](const DoubleDouble& x, const DoubleDouble& y, double sign) {
    for (const double s : {x.high, x.low})
      for (const double t : {y.high, y.low}) {
        if (s == 0 || t == 0) continue;
        const DoubleDouble st = product(sign * s, t);
        if (!(std::abs(st.high) > kLeast)) return false;
        difference.add(st.high), difference.add(st.low);
      }
    return true;
  };
  return add(a, b, 1) && add(c, d, -1) && difference.is_zero();
}

}  // namespace double_double

/// Whether it is certain that one is a multiple of the other. No entry overflows when multiplied.
inline bool certainly_parallel(const DoubleDoubleVector& a, const DoubleDoubleVector& b) {
  using double_double::certainly_equal;
  return certainly_equal(a.x, b.y, a.y, b.x) && certainly_equal(a.y, b.z, a.z, b.y) &&
         certainly_equal(a.z, b.x, a.x, b.z);
}

}  // namespace prohull

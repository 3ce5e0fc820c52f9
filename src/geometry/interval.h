#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace prohull {

/// A closed interval that holds the exact value of what was computed with it. Its bounds are two finite doubles, or
/// it is the whole line. Operations round to nearest, and each result is moved outwards.
///
/// Let c be the rounded result of an operation. If c is finite, the exact one lies within half a unit in the last place
/// of c, or less than the least positive double from it if it underflows. The difference c - 2^-52 |c| is at least a
/// whole unit below c, and rounding keeps it at or below the next lower double. A sum whose unit is that of the
/// subnormal numbers is exact, so that only products and quotients underflow; those are moved by the least positive
/// double as well.
class Interval {
 public:
  Interval() = default;
  Interval(double x) : Interval(x, x) {}
  /// The whole line if the bounds are not finite, or if they are too far apart for their distance to be.
  Interval(double inf, double sup) : inf_(inf), sup_(sup) {
    if (!(sup - inf <= kLargest)) inf_ = -kInfinity, sup_ = kInfinity;
  }

  double inf() const { return inf_; }
  double sup() const { return sup_; }
  /// NaN for the whole line.
  double middle() const { return inf_ + (sup_ - inf_) * 0.5; }
  bool is_point() const { return inf_ == sup_; }

  Interval operator-() const { return {-sup_, -inf_}; }
  friend Interval operator+(const Interval& a, const Interval& b) { return of_sum(a.inf_ + b.inf_, a.sup_ + b.sup_); }
  friend Interval operator-(const Interval& a, const Interval& b) { return of_sum(a.inf_ - b.sup_, a.sup_ - b.inf_); }

  friend Interval operator*(const Interval& a, const Interval& b) {
    if (a.is_zero() || b.is_zero()) return {};
    if (a.is_whole_line() || b.is_whole_line()) return whole_line();
    return of_products(a.inf_ * b.inf_, a.inf_ * b.sup_, a.sup_ * b.inf_, a.sup_ * b.sup_);
  }

  friend Interval operator/(const Interval& a, const Interval& b) {
    if (a.is_whole_line() || b.is_whole_line() || (b.inf_ <= 0 && b.sup_ >= 0)) return whole_line();
    if (a.is_zero()) return {};
    return of_products(a.inf_ / b.inf_, a.inf_ / b.sup_, a.sup_ / b.inf_, a.sup_ / b.sup_);
  }

  Interval& operator+=(const Interval& x) { return *this = *this + x; }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kLargest = std::numeric_limits<double>::max();
  static constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  static constexpr double kUnit = 0x1p-52;

  static Interval whole_line() { return {-kInfinity, kInfinity}; }
  bool is_whole_line() const { return sup_ > kLargest; }
  bool is_zero() const { return inf_ == 0 && sup_ == 0; }

  static Interval of_sum(double low, double high) {
    return {low - kUnit * std::abs(low), high + kUnit * std::abs(high)};
  }

  static Interval of_products(double a, double b, double c, double d) {
    const double low = std::min(std::min(a, b), std::min(c, d)), high = std::max(std::max(a, b), std::max(c, d));
    return {low - (kUnit * std::abs(low) + kLeast), high + (kUnit * std::abs(high) + kLeast)};
  }

  double inf_ = 0, sup_ = 0;
};

/// Nothing if the interval holds numbers of different signs.
inline std::optional<int> certain_sign(const Interval& x) {
  if (x.inf() > 0) return 1;
  if (x.sup() < 0) return -1;
  if (x.is_point()) return 0;
  return std::nullopt;
}

}  // namespace prohull

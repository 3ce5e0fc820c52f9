#pragma once

#include <compare>
#include <memory>

#include "geometry/exact_number.h"
#include "geometry/interval.h"

namespace prohull {

/// A rational number that is an interval until its sign is in doubt. It knows how it was computed, and is computed
/// again exactly where the interval does not decide. Threads may share one.
class LazyNumber {
 public:
  LazyNumber(double x = 0) : approx_(x) {}  ///< finite
  explicit LazyNumber(Rational x);

  friend LazyNumber operator+(const LazyNumber& a, const LazyNumber& b);
  friend LazyNumber operator-(const LazyNumber& a, const LazyNumber& b);
  friend LazyNumber operator*(const LazyNumber& a, const LazyNumber& b);
  friend LazyNumber operator/(const LazyNumber& a, const LazyNumber& b);  ///< b is not 0
  LazyNumber& operator+=(const LazyNumber& x) { return *this = *this + x; }

  friend bool operator==(const LazyNumber& a, const LazyNumber& b) { return (a <=> b) == std::strong_ordering::equal; }
  friend std::strong_ordering operator<=>(const LazyNumber& a, const LazyNumber& b);
  friend int sign(const LazyNumber& x);

  const Interval& approx() const { return approx_; }
  Rational exact() const;
  /// The same number, with an interval of at most two units in the last place.
  LazyNumber narrowed() const { return approx_.is_point() ? *this : LazyNumber(exact()); }
  /// A double that is right to 2^-40 of its size, or the nearest one.
  double rounded() const;

 private:
  struct Node;
  enum class Operation : unsigned char { Given, Sum, Difference, Product, Quotient };
  LazyNumber(Operation operation, const Interval& approx, const LazyNumber& a, const LazyNumber& b);

  Interval approx_;
  std::shared_ptr<const Node> node_;  // none if the interval is a point, which is then the number
};

}  // namespace prohull

#include "geometry/lazy_number.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace prohull {

struct LazyNumber::Node {
  Node(Operation o, const LazyNumber& left, const LazyNumber& right) : operation(o), a(left), b(right) {}
  explicit Node(Rational x) : operation(Operation::Given), value(new Rational(std::move(x))) {}
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  ~Node() { delete value.load(std::memory_order_relaxed); }

  /// Two threads may compute it at once; both results are the same, and the first one is kept.
  const Rational& exact() const {
    if (const Rational* known = value.load(std::memory_order_acquire)) return *known;
    auto made = std::make_unique<const Rational>(computed());
    const Rational* known = nullptr;
    if (value.compare_exchange_strong(known, made.get(), std::memory_order_acq_rel)) return *made.release();
    return *known;
  }

  Rational computed() const {
    switch (operation) {
      case Operation::Sum:
        return a.exact() + b.exact();
      case Operation::Difference:
        return a.exact() - b.exact();
      case Operation::Product:
        return a.exact() * b.exact();
      default:
        return a.exact() / b.exact();
    }
  }

  const Operation operation;
  const LazyNumber a, b;
  mutable std::atomic<const Rational*> value = nullptr;
};

namespace {

/// Knuth's sum in two parts, of which the second one is 0; false if something overflows.
bool is_sum(double a, double b, double sum) {
  const double from_b = sum - a;
  return (a - (sum - from_b)) + (b - from_b) == 0;
}

}  // namespace

LazyNumber::LazyNumber(Rational x) : approx_(x.interval()) {
  if (!approx_.is_point()) node_ = std::make_shared<const Node>(std::move(x));
}

LazyNumber::LazyNumber(Operation operation, const Interval& approx, const LazyNumber& a, const LazyNumber& b)
    : approx_(approx) {
  if (!approx_.is_point()) node_ = std::make_shared<const Node>(operation, a, b);
}

LazyNumber operator+(const LazyNumber& a, const LazyNumber& b) {
  if (a.approx_.is_point() && b.approx_.is_point()) {
    const double x = a.approx_.inf(), y = b.approx_.inf();
    if (is_sum(x, y, x + y)) return x + y;
  }
  return {LazyNumber::Operation::Sum, a.approx_ + b.approx_, a, b};
}

LazyNumber operator-(const LazyNumber& a, const LazyNumber& b) {
  if (a.approx_.is_point() && b.approx_.is_point()) {
    const double x = a.approx_.inf(), y = b.approx_.inf();
    if (is_sum(x, -y, x - y)) return x - y;
  }
  return {LazyNumber::Operation::Difference, a.approx_ - b.approx_, a, b};
}

LazyNumber operator*(const LazyNumber& a, const LazyNumber& b) {
  return {LazyNumber::Operation::Product, a.approx_ * b.approx_, a, b};
}

LazyNumber operator/(const LazyNumber& a, const LazyNumber& b) {
  return {LazyNumber::Operation::Quotient, a.approx_ / b.approx_, a, b};
}

std::strong_ordering operator<=>(const LazyNumber& a, const LazyNumber& b) {
  if (a.approx_.sup() < b.approx_.inf()) return std::strong_ordering::less;
  if (a.approx_.inf() > b.approx_.sup()) return std::strong_ordering::greater;
  const bool are_points = a.approx_.is_point() && b.approx_.is_point();
  if (are_points || (a.node_ && a.node_ == b.node_)) return std::strong_ordering::equal;
  return a.exact() <=> b.exact();
}

int sign(const LazyNumber& x) {
  if (const auto certain = certain_sign(x.approx_)) return *certain;
  return x.approx_.is_point() ? 0 : sign(x.node_->exact());
}

Rational LazyNumber::exact() const { return node_ ? node_->exact() : Rational(approx_.inf()); }

double LazyNumber::rounded() const {
  if (approx_.is_point()) return approx_.inf();
  constexpr double kPrecise = 0x1p-40;
  const double size = std::min(std::abs(approx_.inf()), std::abs(approx_.sup()));
  if (approx_.sup() - approx_.inf() < kPrecise * size) return approx_.middle();
  return exact().rounded();
}

}  // namespace prohull

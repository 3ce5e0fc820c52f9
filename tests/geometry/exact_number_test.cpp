#include "geometry/exact_number.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "geometry/interval.h"
#include "geometry/lazy_number.h"
#include "random.h"

namespace prohull {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kLargest = std::numeric_limits<double>::max();
constexpr double kLeastDouble = std::numeric_limits<double>::denorm_min();

/// Any finite double, often an extreme one or a whole number, so that exact ties are frequent.
double any_double(std::mt19937_64& random) {
  static const std::vector<double> kExtreme{
      0,         -0.0,     1,     -1,       kLeastDouble, -kLeastDouble, 0x1p-1022, 0x1.fffffffffffffp-1023,
      0x1p-1021, 0x1p-970, 1e308, kLargest, 0x1p64,       -kLargest,     0x1p53,    0x1.fffffffffffffp63};
  switch (random() % 6) {
    case 0:
      return kExtreme[random() % kExtreme.size()];
    case 1:
      return static_cast<double>(static_cast<int>(random() % 17) - 8);
    case 2:
      return std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), -60);
    case 3:
      return std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())),
                        static_cast<int>(random() % 200) - 100);
    default:
      for (;;)
        if (const auto x = std::bit_cast<double>(static_cast<std::uint64_t>(random())); std::isfinite(x)) return x;
  }
}

/// The nearest double by halving of the distance, with no arithmetic but GMP's.
bool is_nearest(double x, const mpq_class& exact) {
  const auto beyond = [](double d) {  // the largest double's neighbour is 2^1024
    return std::isinf(d) ? mpq_class(std::copysign(0x1p1023, d)) * 2 : mpq_class(d);
  };
  const mpq_class here = beyond(x), error = abs(exact - here);
  const bool is_even = (std::bit_cast<std::uint64_t>(x) & 1) == 0 || std::isinf(x);
  if (std::isinf(x) && abs(exact) > abs(here)) return sgn(exact) == (x > 0 ? 1 : -1);
  for (const double to : {-kInfinity, kInfinity}) {
    const double next = std::nextafter(x, to);
    if (next == x) continue;
    const mpq_class other = abs(exact - beyond(next));
    if (other < error || (other == error && !is_even)) return false;
  }
  return true;
}

/// The same polynomial or quotient, computed twice.
struct Both {
  Rational ours;
  mpq_class theirs;
};

Both any_expression(std::mt19937_64& random, int depth) {
  if (depth == 0) {
    const double x = any_double(random);
    return {Rational(x), mpq_class(x)};
  }
  const Both a = any_expression(random, depth - 1),
             b = any_expression(random, static_cast<int>(random() % static_cast<unsigned>(depth)));
  switch (random() % 4) {
    case 0:
      return {a.ours + b.ours, a.theirs + b.theirs};
    case 1:
      return {a.ours - b.ours, a.theirs - b.theirs};
    case 2:
      return {a.ours * b.ours, a.theirs * b.theirs};
    default:
      return sgn(b.theirs) == 0 ? a : Both{a.ours / b.ours, a.theirs / b.theirs};
  }
}

TEST(ExactNumber, HasTheSignsOfGmp) {
  std::mt19937_64 random(test_seed());
  for (int i = 0; i < 20000; ++i) {
    ExactNumber sum;
    mpq_class theirs;
    for (int k = 0; k < 6; ++k) {
      const double a = any_double(random), b = any_double(random), c = any_double(random);
      const ExactNumber product = ExactNumber(a) * (ExactNumber(b) - ExactNumber(c));
      const mpq_class other = mpq_class(a) * (mpq_class(b) - mpq_class(c));
      ASSERT_EQ(sum <=> product, cmp(theirs, other) <=> 0);
      ASSERT_EQ(sum == product, theirs == other);
      sum = k % 2 == 0 ? sum + product : product - sum;
      theirs = k % 2 == 0 ? mpq_class(theirs + other) : mpq_class(other - theirs);
      ASSERT_EQ(sign(sum), sgn(theirs));
      ASSERT_EQ(sign(-sum), -sgn(theirs));
      ASSERT_EQ(sign(sum - sum), 0);
    }
  }
}

TEST(ExactNumber, CarriesThroughFullWords) {
  const ExactNumber one(1), full = ExactNumber(0x1p1000) - one;  // all bits are 1
  EXPECT_EQ(full + one, ExactNumber(0x1p1000));
  EXPECT_EQ(full * full, ExactNumber(0x1p1000) * ExactNumber(0x1p1000) - ExactNumber(0x1p1001) + one);
  EXPECT_EQ(full - full, ExactNumber(0));
  EXPECT_EQ(ExactNumber(0x1p-1074) + full - full, ExactNumber(0x1p-1074));
}

TEST(ExactNumber, KeepsItsValueWhenItIsCopiedAndMoved) {
  const ExactNumber small(3), large = ExactNumber(0x1p1000) + ExactNumber(0x1p-1000);
  for (const ExactNumber& x : {small, large, ExactNumber()})
    for (const ExactNumber& y : {small, large, ExactNumber()}) {
      ExactNumber copy = x, other = y;
      copy = other;
      EXPECT_EQ(copy, y);
      EXPECT_EQ(other, y);
      ExactNumber moved = std::move(other);
      EXPECT_EQ(moved, y);
      other = x;
      moved = std::move(other);
      EXPECT_EQ(moved, x);
    }
}

TEST(Rational, EqualsGmp) {
  std::mt19937_64 random(test_seed());
  for (int i = 0; i < 3000; ++i) {
    const Both a = any_expression(random, 4), b = any_expression(random, 3);
    ASSERT_EQ(sign(a.ours), sgn(a.theirs));
    ASSERT_EQ(a.ours <=> b.ours, cmp(a.theirs, b.theirs) <=> 0);
    ASSERT_EQ(a.ours, (a.ours + b.ours) - b.ours);
    const double rounded = a.ours.rounded();
    ASSERT_TRUE(is_nearest(rounded, a.theirs)) << rounded;
    const Interval interval = a.ours.interval();
    ASSERT_TRUE(std::isinf(interval.inf()) || mpq_class(interval.inf()) <= a.theirs);
    ASSERT_TRUE(std::isinf(interval.sup()) || mpq_class(interval.sup()) >= a.theirs);
    if (a.theirs != b.theirs) {
      const Rational quotient = zero_between(a.ours, b.ours);
      ASSERT_EQ(quotient, a.ours / (a.ours - b.ours));
    }
  }
}

TEST(Rational, IsRoundedToTheEvenOneOfTwoNearestDoubles) {
  const auto halves = [](double a, double b) { return ((Rational(a) + Rational(b)) / Rational(2)).rounded(); };
  const double next = std::nextafter(1.0, 2), second = std::nextafter(next, 2);
  EXPECT_EQ(halves(1, next), 1);
  EXPECT_EQ(halves(next, second), second);
  EXPECT_EQ(halves(0, kLeastDouble), 0);
  EXPECT_EQ(halves(kLeastDouble, 2 * kLeastDouble), 2 * kLeastDouble);
  EXPECT_EQ(halves(-kLeastDouble, -2 * kLeastDouble), -2 * kLeastDouble);
  EXPECT_EQ((Rational(kLargest) + Rational(0x1p970)).rounded(), kInfinity);
  EXPECT_EQ((Rational(kLargest) + Rational(0x1p969)).rounded(), kLargest);
  EXPECT_EQ((Rational(-kLargest) * Rational(kLargest)).rounded(), -kInfinity);
  EXPECT_EQ((Rational(1) / Rational(3)).rounded(), 1.0 / 3);
}

TEST(Interval, HoldsTheResults) {
  std::mt19937_64 random(test_seed());
  const auto holds = [](const Interval& x, const mpq_class& exact) {
    return (std::isinf(x.inf()) || mpq_class(x.inf()) <= exact) &&
           (std::isinf(x.sup()) || mpq_class(x.sup()) >= exact) && x.inf() <= x.sup() &&
           std::isinf(x.inf()) == std::isinf(x.sup());
  };
  for (int i = 0; i < 20000; ++i) {
    const double a = any_double(random), b = any_double(random), c = any_double(random), d = any_double(random);
    const Interval x(std::min(a, b), std::max(a, b)), y(std::min(c, d), std::max(c, d));
    for (const double p : {a, b})
      for (const double q : {c, d}) {
        const mpq_class u(p), v(q);
        ASSERT_TRUE(holds(x + y, u + v)) << p << ' ' << q;
        ASSERT_TRUE(holds(x - y, u - v)) << p << ' ' << q;
        ASSERT_TRUE(holds(x * y, u * v)) << p << ' ' << q;
        ASSERT_TRUE(holds(Interval(p) * Interval(q), u * v)) << p << ' ' << q;
        ASSERT_TRUE(holds(Interval(p) + Interval(q), u + v)) << p << ' ' << q;
        ASSERT_TRUE(holds(-(x * y) + x, u - u * v)) << p << ' ' << q;
        if (q == 0) continue;
        ASSERT_TRUE(holds(x / y, u / v)) << p << ' ' << q;
        ASSERT_TRUE(holds(Interval(p) / Interval(q), u / v)) << p << ' ' << q;
      }
  }
}

TEST(Interval, DecidesNothingWhereSomethingOverflowsOrIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Interval& x :
       {Interval(kInfinity), Interval(-kInfinity), Interval(nan), Interval(kLargest) + kLargest,
        Interval(-kLargest) * 2, Interval(1) / Interval(-1, 1), Interval(1) / 0, Interval(kLargest) / kLeastDouble})
    for (const Interval& y : {x, x + 1, -x, x - x, x * 2, x * x, x / 2, Interval(2) / x, x / x}) {
      EXPECT_FALSE(certain_sign(y));
      EXPECT_EQ(y.inf(), -kInfinity);
      EXPECT_EQ(y.sup(), kInfinity);
    }
  EXPECT_TRUE((Interval(kInfinity) * 0).is_point());
}

TEST(Interval, KeepsZerosAndIsNarrow) {
  EXPECT_EQ(certain_sign(Interval(3) - 3), 0);
  EXPECT_TRUE((Interval(0) * kLargest).is_point());
  const Interval third = Interval(1) / 3;
  EXPECT_LE(third.sup() - third.inf(), 0x1p-52);
  EXPECT_EQ(certain_sign(Interval(kLeastDouble)), 1);
  EXPECT_FALSE(certain_sign(Interval(kLeastDouble) * kLeastDouble));
}

TEST(LazyNumber, DecidesAsTheExactOne) {
  std::mt19937_64 random(test_seed());
  for (int i = 0; i < 5000; ++i) {
    std::vector<LazyNumber> ours;
    std::vector<mpq_class> theirs;
    for (int k = 0; k < 4; ++k) {
      const double x = any_double(random);
      ours.emplace_back(x);
      theirs.emplace_back(x);
    }
    for (int k = 0; k < 6; ++k) {
      const std::size_t a = random() % ours.size(), b = random() % ours.size(), operation = random() % 4;
      if (operation == 3 && sgn(theirs[b]) == 0) continue;
      const LazyNumber &x = ours[a], &y = ours[b];
      ours.push_back(operation == 0 ? x + y : operation == 1 ? x - y : operation == 2 ? x * y : x / y);
      const mpq_class &u = theirs[a], &v = theirs[b];
      theirs.push_back(operation == 0   ? mpq_class(u + v)
                       : operation == 1 ? mpq_class(u - v)
                       : operation == 2 ? mpq_class(u * v)
                                        : mpq_class(u / v));
    }
    for (std::size_t k = 0; k < ours.size(); ++k) {
      const std::size_t other = random() % ours.size();
      ASSERT_EQ(sign(ours[k]), sgn(theirs[k]));
      ASSERT_EQ(ours[k] <=> ours[other], cmp(theirs[k], theirs[other]) <=> 0);
      ASSERT_EQ(ours[k].narrowed(), ours[k]);
      const double rounded = ours[k].rounded();
      if (!std::isfinite(rounded)) continue;
      ASSERT_TRUE(abs(mpq_class(rounded) - theirs[k]) <= abs(theirs[k]) * mpq_class(0x1p-40) ||
                  is_nearest(rounded, theirs[k]));
    }
  }
}

}  // namespace
}  // namespace prohull

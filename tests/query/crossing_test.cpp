#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>

#include "dyadic_points.h"
#include "effort.h"
#include "geometry/double_double.h"
#include "query/exact_line.h"
#include "query/exact_points.h"
#include "query/line.h"
#include "random.h"

namespace prohull {
namespace {

Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point operator*(const Number& s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
bool is_negative(const Number& x) { return CGAL::sign(x) == CGAL::NEGATIVE; }

/// A move so small that on the grids below it acts as an infinitesimal one, (e, e^2, e^3).
Point tiny_move() {
  Number e = 1;
  for (int i = 0; i < 80; ++i) e = e / 2;
  return {e, e * e, e * e * e};
}

struct TrueCrossing {
  bool entering;
  Number t;
};

/// By constructing the point where the line meets the plane, after an actual move of the line.
std::optional<TrueCrossing> true_crossing(const Point& origin, const Point& direction, bool is_ray, const Triangle& f) {
  const Point o = origin + tiny_move(), a = exact(f.a), b = exact(f.b), c = exact(f.c);
  const Point n = cross(b - a, c - a);
  const Number speed = dot(n, direction);
  if (CGAL::is_zero(speed)) return std::nullopt;
  const Number t = dot(n, a - o) / speed;
  if (is_negative(t) || (!is_ray && is_negative(1 - t))) return std::nullopt;
  const Point p = o + t * direction;
  for (const auto& [u, v] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
    if (is_negative(dot(n, cross(v - u, p - u)))) return std::nullopt;
  return TrueCrossing{is_negative(speed), t};
}

class CrossingOnGrid : public testing::TestWithParam<bool> {
 protected:
  Vec3 corner() { return {0.1 * grid_(random_), 0.1 * grid_(random_), 0.1 * grid_(random_)}; }
  Triangle face() { return {corner(), corner(), corner()}; }

  std::mt19937 random_{test_seed()};
  std::uniform_int_distribution<int> grid_{-1, 1};
};

// Coordinates -0.1, 0, 0.1: lines run through corners, along edges and within planes more often than not.
TEST_P(CrossingOnGrid, IsThatOfALineActuallyMoved) {
  const bool is_ray = GetParam();
  int crossings = 0, orders = 0;
  for (int i = 0; i < rounds(20000); ++i) {
    const Vec3 a = corner(), b = corner();
    const DirectedLine line = is_ray ? DirectedLine(Ray{a, b}) : DirectedLine(Segment{a, b});
    const Point direction = is_ray ? exact(b) : exact(b) - exact(a);
    // Half of the faces share an edge, on which lines cross both at once.
    const Triangle first = face(), second = i % 2 == 0 ? face() : Triangle{first.b, first.a, corner()};
    const auto truth = true_crossing(exact(a), direction, is_ray, first);
    const auto expected = !truth ? Crossing::None : truth->entering ? Crossing::Entering : Crossing::Leaving;
    ASSERT_EQ(crossing(line, first), expected);
    ASSERT_EQ(crossing(line, {first.b, first.c, first.a}), expected);
    if (!truth) continue;
    ++crossings;
    const Parameter at = parameter(line, first);
    EXPECT_NEAR(at.t, CGAL::to_double(truth->t), 1e-9);

    const auto other = true_crossing(exact(a), direction, is_ray, second);
    if (!other) continue;
    ++orders;
    const Parameter at_other = parameter(line, second);
    const int order = truth->t < other->t ? -1 : other->t < truth->t ? 1 : 0, rounded = rounded_order(at, at_other);
    EXPECT_EQ(exact_order(line, first, second), order);
    EXPECT_EQ(exact_order(line, second, first), -order);
    EXPECT_EQ(prohull::order(line, first, second), order);
    EXPECT_TRUE(rounded == 0 || rounded == order);
  }
  EXPECT_GT(crossings, rounds(20000) / 100);
  EXPECT_GT(orders, rounds(20000) / 200);
}

INSTANTIATE_TEST_SUITE_P(Segments, CrossingOnGrid, testing::Values(false));
INSTANTIATE_TEST_SUITE_P(Rays, CrossingOnGrid, testing::Values(true));

TEST(Crossing, HasAnAnswerForTheGreatestAndTheLeastCoordinates) {
  for (const double size : {1e-300, 1e-160, 1.0, 1e160, 1.5e308}) {
    const Triangle face{{-size, -size, 0}, {size, -size, 0}, {0, size, 0}};
    const DirectedLine through(Segment{{0, 0, size}, {0, 0, -size}}),
        beside(Segment{{size, size, size}, {size, size, -size}});
    EXPECT_EQ(crossing(through, face), Crossing::Entering) << size;
    EXPECT_EQ(crossing(beside, face), Crossing::None) << size;
    EXPECT_DOUBLE_EQ(parameter(through, face).t, 0.5) << size;
  }
}

// The normal times the direction overflows, and neither does by itself.
TEST(Crossing, IsAtTheRightTWhereRoundedProductsOverflow) {
  const double size = 1e103;
  const Triangle face{{-size, -size, 0}, {size, -size, 0}, {0, size, 0}};
  const DirectedLine line(Segment{{0, 0, size}, {0, 0, -3 * size}});
  EXPECT_DOUBLE_EQ(parameter(line, face).t, 0.25);
  ASSERT_TRUE(parameter_if_within(line, face, -1));
  EXPECT_DOUBLE_EQ(parameter_if_within(line, face, -1)->t, 0.25);
}

// Lines of all sizes that all but meet an edge, against the exact sign; some of the products underflow.
TEST(Crossing, IsOnTheRightSideOfAnEdgeThatTheLineAllButMeets) {
  std::mt19937 random{test_seed()};
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> exponent(-560, 280);
  const auto point = [&](int power) {
    return Vec3{std::ldexp(unit(random), power), std::ldexp(unit(random), power), std::ldexp(unit(random), power)};
  };
  int decided = 0, count = 0;
  for (int i = 0; i < rounds(2000); ++i) {
    const int size = exponent(random), length = i % 2 == 0 ? 290 : size;  // of the line
    const Vec3 p = point(size), q = point(size), between = p + unit(random) * (q - p);
    const Vec3 direction = between * std::ldexp(1, length - size);
    const DirectedLine ray(Ray{Vec3{}, direction});
    const int sign = CGAL::sign(dot(exact(direction), cross(exact(p), exact(q))));
    const DoubleDoubleVector along(Vec3{}, direction), to_p(Vec3{}, p), to_q(Vec3{}, q);
    const int rounded = double_double_sign(along, to_p, to_q);
    EXPECT_TRUE(rounded == 0 || rounded == sign) << size << ' ' << length;
    if (sign == 0) continue;
    EXPECT_EQ(exact_edge_side(ray, p, q), sign) << size << ' ' << length;
    const FaceFromLine seen(ray, {p, q, Vec3{}});
    EXPECT_TRUE(std::abs(seen.ab) <= seen.error || (seen.ab > 0 ? 1 : -1) == sign) << size << ' ' << length;
    if (size > -200) ++count, decided += rounded != 0;
  }
  EXPECT_GT(decided, 0.99 * count);
}

TEST(Crossing, IsNotTakenForAMeetingWhereLowPartsUnderflow) {
  const DoubleDoubleVector one(Vec3{0x1p-600, 0, 0}, {1, 1, 0}), other(Vec3{-0x1p-600, 0, 0}, {1, 1, 0});
  EXPECT_FALSE(certainly_parallel(one, other));
  // (1 + t)(1 - t) is 1 but for t^2, which underflows.
  const DoubleDouble more{1, 0x1p-600}, less{1, -0x1p-600}, unit{1, 0};
  EXPECT_FALSE(double_double::certainly_equal(more, less, unit, unit));
  EXPECT_TRUE(double_double::certainly_equal({3, 0}, {5, 0}, {15, 0}, unit));
}

// Of two faces that share a corner, which the line all but meets.
TEST(Crossing, IsInTheRightOrderWhereTwoAreAllButOne) {
  std::mt19937 random{test_seed()};
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> exponent(-340, 100);
  for (int i = 0; i < rounds(2000); ++i) {
    const int power = exponent(random);
    const auto point = [&](double size) {
      return size *
             Vec3{std::ldexp(unit(random), power), std::ldexp(unit(random), power), std::ldexp(unit(random), power)};
    };
    const Vec3 from = point(100), corner = point(1);
    const DirectedLine line(Segment{from, from + 5 * (corner - from)});
    const Triangle first{corner, corner + point(0.1), corner + point(0.1)},
        second{corner, first.c, corner + point(0.1)};
    const auto t = [&](const Triangle& face) {
      const Point a = exact(face.a), o = exact(line.origin), n = cross(exact(face.b) - a, exact(face.c) - a);
      return dot(n, a - o) / dot(n, exact(line.end) - o);
    };
    const Number one = t(first), other = t(second);
    const int order = prohull::order(line, first, second);
    EXPECT_TRUE(one == other || order == (one < other ? -1 : 1)) << power;
  }
}

TEST(Crossing, IsAtAFiniteTWhereTheLineAllButRunsInTheFace) {
  // From a corner along an edge, so nearly that the rounded speed towards the plane is 0, and the exact one is not.
  const Vec3 start{-0.59999999999999998, 7.347880794884119e-17, 4.8985871965894131e-17};
  const Triangle face{{-0.56568542494923801, 0.56568542494923812, 0.34641016151377552},
                      start,
                      {-0.42426406871192845, 0.42426406871192851, 4.8985871965894131e-17}};
  const DirectedLine line(Ray{start, {0.17573593128807152, 0.42426406871192845, 0}});
  ASSERT_NE(crossing(line, face), Crossing::None);
  EXPECT_EQ(parameter(line, face).t, 0);
}

TEST(Crossing, HasNoNegativeZero) {
  const Triangle face{{0, 0, 1}, {0, 3, 1}, {3, 0, 1}};
  for (const double z : {-1.0, 1.0}) {
    const DirectedLine line(Ray{{1, 1, 1}, {0, 0, z}});
    EXPECT_EQ(parameter(line, face).t, 0);
    EXPECT_FALSE(std::signbit(parameter(line, face).t)) << z;
  }
}

}  // namespace
}  // namespace prohull

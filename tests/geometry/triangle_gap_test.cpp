#include "geometry/triangle_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "effort.h"
#include "geometry/exact_triangles.h"
#include "random.h"

namespace prohull {
namespace {

/// By CGAL, of triangles with an area.
Exact::FT squared_distance(const Triangle& s, const Triangle& t) {
  const Exact::Triangle_3 a(exact(s.a), exact(s.b), exact(s.c)), b(exact(t.a), exact(t.b), exact(t.c));
  return CGAL::squared_distance(a, b);
}

double above(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

TEST(AreApart, AgreesWithCgalOnGridsWhereManyDistancesAreWholeNumbers) {
  std::mt19937 random(test_seed());
  std::uniform_int_distribution<int> coordinate(-3, 3);
  const auto point = [&] {
    return Vec3{double(coordinate(random)), double(coordinate(random)), double(coordinate(random))};
  };
  int equal = 0;
  for (int i = 0; i < effort(6000, 600); ++i) {
    const Vec3 shift{0, 0, double(i % 7)};
    const Triangle s{point(), point(), point()}, t{point() + shift, point() + shift, point() + shift};
    if (!has_area(s) || !has_area(t)) continue;
    const Exact::FT squared = squared_distance(s, t);
    for (const double d : {1.0, 2.0, 0.5, std::sqrt(CGAL::to_double(squared))}) {
      if (d == 0) continue;
      ASSERT_EQ(are_apart(s, t, d), squared >= Exact::FT(d) * Exact::FT(d)) << "triangles " << i << ", distance " << d;
      ASSERT_EQ(are_apart(t, s, above(d)), squared >= Exact::FT(above(d)) * Exact::FT(above(d)));
      equal += squared == Exact::FT(d) * Exact::FT(d);
    }
  }
  EXPECT_GT(equal, effort(30, 3)) << "the test was to have equal distances";
}

TEST(AreApart, SeesOneUlp) {
  const Triangle floor{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const double height = 0.1;
  const Triangle corner{{1, 1, height}, {2, 1, 1}, {1, 2, 1}};
  EXPECT_TRUE(are_apart(floor, corner, height));
  EXPECT_FALSE(are_apart(floor, corner, above(height)));
  const Triangle edge{{-1, -1, height}, {5, 1, height}, {0, 0, 7}};
  EXPECT_TRUE(are_apart(floor, edge, height));
  EXPECT_FALSE(are_apart(floor, edge, above(height)));
}

TEST(AreApart, OfTrianglesThatMeetIsNeverSo) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  const Triangle floor{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  EXPECT_FALSE(are_apart(floor, {{1, 1, -5}, {1, 1, 5}, {2, 1, 5}}, kLeast)) << "pierces";
  EXPECT_FALSE(are_apart(floor, {{1, 1, 0}, {1, 1, 5}, {2, 1, 5}}, kLeast)) << "stands on it";
  EXPECT_FALSE(are_apart(floor, {{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}, kLeast)) << "lies in it";
  EXPECT_FALSE(are_apart(floor, {{-1, 1, 0}, {1, -1, 0}, {3, 3, 0}}, kLeast)) << "crosses it in its plane";
  EXPECT_FALSE(are_apart(floor, floor, kLeast));
  EXPECT_TRUE(are_apart(floor, floor, 0));
}

TEST(AreApart, TakesTrianglesWithoutArea) {
  const Triangle point{{1, 1, 3}, {1, 1, 3}, {1, 1, 3}}, segment{{-9, 1, 3}, {9, 1, 3}, {0, 1, 3}},
      floor{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  for (const Triangle& t : {point, segment}) {
    EXPECT_TRUE(are_apart(floor, t, 3));
    EXPECT_FALSE(are_apart(t, floor, above(3)));
  }
  EXPECT_FALSE(are_apart(point, segment, 1e-300));
}

}  // namespace
}  // namespace prohull

#include "geometry/triangle_intersection.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <variant>

#include "dyadic_points.h"
#include "effort.h"
#include "geometry/exact_triangles.h"
#include "geometry/predicates.h"
#include "random.h"

namespace prohull {
namespace {

using Shape = std::variant<Exact::Point_3, Exact::Segment_3, Exact::Triangle_3>;

Shape shape_of(const Triangle& t) {
  const Exact::Point_3 a = exact(t.a), b = exact(t.b), c = exact(t.c);
  if (!CGAL::collinear(a, b, c)) return Exact::Triangle_3(a, b, c);
  const auto [least, greatest] = std::minmax({a, b, c});
  if (least == greatest) return a;
  return Exact::Segment_3(least, greatest);
}

bool touch_by_cgal(const Triangle& s, const Triangle& t) {
  return std::visit([](const auto& one, const auto& other) { return CGAL::do_intersect(one, other); }, shape_of(s),
                    shape_of(t));
}

std::string print(const Triangle& t) {
  return testing::PrintToString(std::array{t.a.x, t.a.y, t.a.z, t.b.x, t.b.y, t.b.z, t.c.x, t.c.y, t.c.z});
}

TEST(TrianglesTouch, AgreesWithCgalOnSmallGridsWithAndWithoutArea) {
  // Corners on a grid of 3x3x3, 4x4 in a plane, or 6 on a line, make every kind of contact frequent.
  std::mt19937 random(test_seed());
  int touching[3][3] = {}, apart[3][3] = {};
  for (int i = 0; i < effort(60000, 20000); ++i) {
    const int dimension = 1 + i % 3;
    std::uniform_int_distribution<int> grid(0, dimension == 3 ? 2 : dimension == 2 ? 3 : 5);
    const auto corner = [&] {
      const double x = 0.1 * grid(random), y = 0.1 * grid(random), z = 0.1 * grid(random);
      return dimension == 3 ? Vec3{x, y, z} : dimension == 2 ? Vec3{x, y, 2 * x} : Vec3{x, 2 * x, 0.3};
    };
    // Few triangles on a grid have no area; half of them are made so.
    const auto triangle = [&] {
      Triangle t{corner(), corner(), corner()};
      if (random() % 2 == 0) t.c = t.a;
      if (random() % 4 == 0) t.b = t.c;
      return t;
    };
    const Triangle s = triangle(), t = triangle();
    const bool truth = touch_by_cgal(s, t);
    const Shape a = shape_of(s), b = shape_of(t);
    ++(truth ? touching : apart)[a.index()][b.index()];
    ASSERT_EQ(triangles_touch(s, t), truth) << print(s) << " and " << print(t);
    ASSERT_EQ(triangles_touch(t, s), truth) << print(s) << " and " << print(t);
    ASSERT_EQ(triangles_touch({s.c, s.b, s.a}, {t.b, t.c, t.a}), truth);
    ASSERT_FALSE(truth && certainly_apart(s, t));
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      EXPECT_GT(touching[i][j], 50) << i << j;
      EXPECT_GT(apart[i][j], 50) << i << j;
    }
}

Triangle scaled(const Triangle& t, double by) { return {t.a * by, t.b * by, t.c * by}; }

TEST(TrianglesTouch, TellsOneUlpApartAndHoldsForHugeAndTinyCoordinates) {
  for (const double scale : {0x1p-1060, 0x1p-500, 1.0, 0x1p500, 0x1p1020}) {
    const Triangle floor = scaled(kFloor, scale), over = scaled({{0.25, 0.25, 0}, {1, 1, 1}, {1, 1, 2}}, scale);
    EXPECT_TRUE(triangles_touch(floor, over));
    Triangle higher = over;
    higher.a.z = std::nextafter(0.0, 1.0);
    EXPECT_FALSE(triangles_touch(floor, higher));
    EXPECT_FALSE(certainly_apart(floor, over));
    EXPECT_FALSE(triangles_touch(floor, {higher.a, higher.a, higher.a}));
    EXPECT_TRUE(triangles_touch(floor, {over.a, over.a, over.a}));
  }
}

TEST(CertainlyApart, IsNeverTrueOfTrianglesThatTouchInAPoint) {
  DyadicPoints points(test_seed());
  int beside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Triangle s{points.any(), points.any(), points.any()};
    const Vec3 on = points.on(s, i);
    const Triangle t{on, points.any(), points.any()};
    if (side(s.a, s.b, s.c, t.b) != side(s.a, s.b, s.c, t.c)) continue;  // it crosses the plane
    ++beside;
    ASSERT_FALSE(certainly_apart(s, t)) << print(s) << " and " << print(t);
    ASSERT_FALSE(certainly_apart(t, s));
  }
  EXPECT_GT(beside, 5000);
}

TEST(CertainlyApart, IsSeldomInDoubt) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> unit(0, 1);
  const auto point = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
  for (int i = 0; i < 5000; ++i) {
    const Triangle s{point(), point(), point()}, t{point(), point(), point()};
    EXPECT_EQ(certainly_apart(s, t), !triangles_touch(s, t));
  }
}

}  // namespace
}  // namespace prohull

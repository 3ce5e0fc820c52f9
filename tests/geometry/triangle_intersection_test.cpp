#include "geometry/triangle_intersection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "effort.h"
#include "geometry/exact_triangles.h"
#include "random.h"

namespace prohull {
namespace {

/// The definition, by constructing the intersection: does it hold a point that is not on the shared corner or edge?
bool meet_beyond_shared(const Triangle& s, const Triangle& t) {
  std::vector<Exact::Point_3> shared;
  for (const Vec3& p : {s.a, s.b, s.c})
    for (const Vec3& q : {t.a, t.b, t.c})
      if (p == q) shared.push_back(exact(p));
  const auto is_shared = [&](const Exact::Point_3& p) {
    if (shared.size() == 1) return p == shared[0];
    return shared.size() == 2 && CGAL::collinear(shared[0], p, shared[1]) &&
           CGAL::collinear_are_ordered_along_line(shared[0], p, shared[1]);
  };
  const auto common = CGAL::intersection(Exact::Triangle_3(exact(s.a), exact(s.b), exact(s.c)),
                                         Exact::Triangle_3(exact(t.a), exact(t.b), exact(t.c)));
  if (!common) return false;
  std::vector<Exact::Point_3> corners;
  if (const auto* point = boost::get<Exact::Point_3>(&*common)) corners = {*point};
  if (const auto* segment = boost::get<Exact::Segment_3>(&*common)) corners = {segment->source(), segment->target()};
  if (const auto* area = boost::get<Exact::Triangle_3>(&*common))
    corners = {area->vertex(0), area->vertex(1), area->vertex(2)};
  if (const auto* polygon = boost::get<std::vector<Exact::Point_3>>(&*common)) corners = *polygon;
  return !std::all_of(corners.begin(), corners.end(), is_shared);
}

TEST(TrianglesIntersect, AgreesWithTheConstructedIntersectionOnSmallGrids) {
  // Corners on a grid of 3x3x3, or 4x4 in a plane, make every kind of contact frequent.
  std::mt19937 random(test_seed());
  int met = 0;
  for (int i = 0; i < effort(20000, 7000); ++i) {
    const bool flat = i % 2;
    std::uniform_int_distribution<int> grid(0, flat ? 3 : 2);
    const auto corner = [&] { return Vec3{0.1 * grid(random), 0.1 * grid(random), flat ? 0.3 : 0.1 * grid(random)}; };
    const Triangle s{corner(), corner(), corner()}, t{corner(), corner(), corner()};
    if (!has_area(s) || !has_area(t)) continue;
    const bool truth = meet_beyond_shared(s, t);
    met += truth;
    const auto print = [](const Vec3& v) { return testing::PrintToString(std::array{v.x, v.y, v.z}); };
    ASSERT_EQ(triangles_intersect(s, t), truth)
        << print(s.a) << print(s.b) << print(s.c) << " and " << print(t.a) << print(t.b) << print(t.c);
    ASSERT_EQ(triangles_intersect(t, s), truth);
    ASSERT_EQ(triangles_intersect({s.c, s.b, s.a}, {t.b, t.c, t.a}), truth);
  }
  EXPECT_GT(met, 1000);
}

TEST(TrianglesIntersect, NotWhereOnlyAnEdgeOrACornerIsShared) {
  EXPECT_FALSE(triangles_intersect(kFloor, {{1, 0, 0}, {0, 0, 0}, {0.3, 0.3, 1}}));
  EXPECT_FALSE(triangles_intersect(kFloor, {{1, 0, 0}, {0, 0, 0}, {0.3, -1, 0}}));
  EXPECT_FALSE(triangles_intersect(kFloor, {{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}}));
  EXPECT_FALSE(triangles_intersect(kFloor, {{-0.0, 0, -0.0}, {1, 1, 1}, {1, 1, 2}}));
}

TEST(TrianglesIntersect, WhereNeighboursFoldOntoEachOtherOrTouch) {
  EXPECT_TRUE(triangles_intersect(kFloor, {{1, 0, 0}, {0, 0, 0}, {0.3, 5, 0}}));
  EXPECT_TRUE(triangles_intersect(kFloor, {{0, 0, 0}, {1, 1, 0}, {1, 1, 2}}));
  EXPECT_TRUE(triangles_intersect(kFloor, {{0.25, 0.25, 0}, {1, 1, 1}, {1, 1, 2}}));
  EXPECT_TRUE(triangles_intersect(kFloor, kFloor));
}

TEST(TrianglesIntersect, TellsOneUlpApartAndHoldsForHugeCoordinates) {
  for (const double scale : {0x1p-1000, 1.0, 0x1p1000}) {
    const Triangle floor{kFloor.a * scale, kFloor.b * scale, kFloor.c * scale};
    const double above = std::nextafter(0.0, 1.0);
    EXPECT_TRUE(
        triangles_intersect(floor, {Vec3{0.25, 0.25, 0} * scale, Vec3{1, 1, 1} * scale, Vec3{1, 1, 2} * scale}));
    EXPECT_FALSE(triangles_intersect(
        floor, {{0.25 * scale, 0.25 * scale, above}, Vec3{1, 1, 1} * scale, Vec3{1, 1, 2} * scale}));
  }
}

TEST(TrianglesIntersect, NeverForATriangleWithoutArea) {
  EXPECT_FALSE(triangles_intersect(kFloor, {{0.2, 0.2, -1}, {0.2, 0.2, 1}, {0.2, 0.2, 1}}));
  EXPECT_FALSE(triangles_intersect({{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}}, kFloor));
}

}  // namespace
}  // namespace prohull

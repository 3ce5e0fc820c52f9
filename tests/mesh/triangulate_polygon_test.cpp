#include "mesh/triangulate_polygon.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "geometry/predicates.h"
#include "random.h"

namespace prohull {
namespace {

using Corners = std::array<VertexId, 3>;

std::vector<VertexId> in_order(std::size_t count) {
  std::vector<VertexId> ids;
  for (std::uint32_t i = 0; i < count; ++i) ids.push_back(VertexId(i));
  return ids;
}

/// In the xy plane: as many triangles as there must be, none turned over, their areas those of the polygon.
void expect_covered_once(const PerVertex<Vec3>& polygon) {
  const auto triangles = triangulate_polygon(in_order(polygon.size()), polygon);
  ASSERT_TRUE(triangles);
  EXPECT_EQ(triangles->size(), polygon.size() - 2);
  double polygon_area = 0, absolute_area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    polygon_area += cross(polygon.data()[i], polygon.data()[(i + 1) % polygon.size()]).z / 2;
  for (const auto& [a, b, c] : *triangles)
    absolute_area += std::abs(cross(polygon[b] - polygon[a], polygon[c] - polygon[a]).z) / 2;
  EXPECT_NEAR(absolute_area, std::abs(polygon_area), 1e-12 * absolute_area);
}

TEST(TriangulatePolygon, MakesAFanOfAConvexPolygon) {
  PerVertex<Vec3> circle;
  for (int i = 0; i < 20000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 20000;
    circle.push_back({std::cos(angle), std::sin(angle), 0});
  }
  expect_covered_once(circle);
  const PerVertex<Vec3> square = {{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}};
  EXPECT_EQ(PerFace<Corners>(*triangulate_polygon(in_order(4), square)),
            PerFace<Corners>({{VertexId(0), VertexId(1), VertexId(2)}, {VertexId(0), VertexId(2), VertexId(3)}}));
}

TEST(TriangulatePolygon, CoversNonConvexPolygonsOnce) {
  expect_covered_once({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.5, 0}});                      // a dart
  expect_covered_once({{1, 0.5, 0}, {2, 2, 0}, {2, 0, 0}, {0, 0, 0}});                      // from behind
  expect_covered_once({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});  // L
  expect_covered_once({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
}

TEST(TriangulatePolygon, CoversAPolygonWithASeamToAHole) {
  expect_covered_once(
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}});
}

TEST(TriangulatePolygon, CoversRandomStarShapedPolygonsOnce) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> radius(0.1, 1);
  for (int run = 0; run < 200; ++run) {
    PerVertex<Vec3> polygon;
    const int count = 4 + run;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count, r = radius(random);
      polygon.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    }
    expect_covered_once(polygon);
  }
}

TEST(TriangulatePolygon, KeepsTheBoundaryOfPolygonsThatAreNotSimple) {
  for (const PerVertex<Vec3>& polygon :
       {PerVertex<Vec3>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 3, 0}},
        PerVertex<Vec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}}, PerVertex<Vec3>(6, Vec3{1, 2, 3})}) {
    const auto triangles = triangulate_polygon(in_order(polygon.size()), polygon);
    ASSERT_TRUE(triangles);
    EXPECT_EQ(triangles->size(), polygon.size() - 2);
    // As a chain, the triangles' edges add up to the polygon's.
    std::vector<int> edges(polygon.size() * polygon.size());
    const auto edge = [&](VertexId a, VertexId b) -> int& { return edges[index(a) * polygon.size() + index(b)]; };
    for (const auto& t : *triangles)
      for (std::size_t i = 0; i < 3; ++i) ++edge(t[i], t[(i + 1) % 3]), --edge(t[(i + 1) % 3], t[i]);
    for (std::uint32_t i = 0; i < polygon.size(); ++i) {
      const VertexId a = VertexId(i), b = VertexId((i + 1) % static_cast<std::uint32_t>(polygon.size()));
      --edge(a, b), ++edge(b, a);
    }
    EXPECT_EQ(edges, std::vector<int>(edges.size()));
  }
}

}  // namespace
}  // namespace prohull

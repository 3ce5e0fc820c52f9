#include "construct/shape_guards.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "construct/placement.h"
#include "geometry/compactness.h"
#include "meshes.h"

namespace prohull {
namespace {

using namespace meshes;

/// The star of an edge of a mesh, measured.
Star star_of(const HalfEdgeMesh& mesh, std::uint32_t v, std::uint32_t w) {
  HalfEdgeId h = mesh.out(VertexId{v});
  while (mesh.tip(h) != VertexId{w}) h = mesh.rotated(h);
  Star star;
  gather_star(mesh, mesh.edge(h), star);
  measure_star(mesh, star);
  return star;
}

Vec3 to_local(const Star& star, const Vec3& p) { return (p - star.origin) / star.scale; }

TEST(Compactness, IsOneForAnEquilateralTriangle) {
  EXPECT_DOUBLE_EQ(compactness(std::sqrt(3.0) / 2, 3), 1);
  EXPECT_DOUBLE_EQ(compactness(100 * std::sqrt(3.0) / 2, 300), 1);
}

TEST(Compactness, OfKnownTriangles) {
  EXPECT_DOUBLE_EQ(compactness(1, 1 + 1 + 2), std::sqrt(3.0) / 2) << "half a square";
  EXPECT_EQ(compactness(0, 6), 0);
  EXPECT_EQ(compactness(0, 0), 0) << "all corners in one point";
  EXPECT_LT(compactness(1e-3, 2), 1e-2);
}

// The top of a bipyramid over a square, made of the edge 0-1: collapsing it to a point above the square.
TriangleMesh roof() {
  return make(
      {{-0.5, 0, 1}, {0.5, 0, 1}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0, 0, -1}},
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {1, 0, 4}, {1, 4, 5}, {1, 5, 2}, {3, 2, 6}, {4, 3, 6}, {5, 4, 6}, {2, 5, 6}});
}

TEST(ShapeGuards, LetAGoodApexPass) {
  const HalfEdgeMesh mesh(roof());
  const Star star = star_of(mesh, 0, 1);
  EXPECT_EQ(refused_shape(star, to_local(star, {0, 0, 1.1}), {}), std::nullopt);
}

TEST(ShapeGuards, RefuseAThinFace) {
  const HalfEdgeMesh mesh(roof());
  const Star star = star_of(mesh, 0, 1);
  const Vec3 apex = to_local(star, {0, 0, 30});
  HullOptions options{.guards = {.max_normal_deviation = std::numbers::pi / 2}};
  EXPECT_EQ(refused_shape(star, apex, options), Refusal::Compactness);
  options.guards.sufficient_compactness = 0.01;
  EXPECT_EQ(refused_shape(star, apex, options), std::nullopt) << "good enough whatever it was before";
  options.strategy = Strategy::Paper1;
  EXPECT_EQ(refused_shape(star, apex, options), Refusal::Compactness) << "the paper has no such floor";
  options.guards.min_compactness_ratio = 0;
  EXPECT_EQ(refused_shape(star, apex, options), std::nullopt);
}

TEST(ShapeGuards, NeverAllowAFaceWithoutArea) {
  const HalfEdgeMesh mesh(roof());
  const Star star = star_of(mesh, 0, 1);
  const HullOptions lax{.guards = {.min_compactness_ratio = 0,
                                   .sufficient_compactness = 0,
                                   .max_normal_deviation = std::numbers::pi / 2}};
  EXPECT_EQ(refused_shape(star, to_local(star, {0, 1, 0}), lax), Refusal::Compactness) << "in line with 2 and 3";
}

TEST(ShapeGuards, RefuseAFaceThatTurns) {
  const HalfEdgeMesh mesh(roof());
  const Star star = star_of(mesh, 0, 1);
  // Faces between the roof's long sides and a point at height h have the slope h: 45 degrees at the start.
  for (const double degrees : {5.0, 20.0}) {
    const double h = std::tan((45 + degrees) * std::numbers::pi / 180);
    const Vec3 apex = to_local(star, {0, 0, h});
    HullOptions options{
        .guards = {.min_compactness_ratio = 0, .max_normal_deviation = (degrees - 2) * std::numbers::pi / 180}};
    EXPECT_EQ(refused_shape(star, apex, options), Refusal::NormalDeviation);
    options.guards.max_normal_deviation = (degrees + 20) * std::numbers::pi / 180;
    EXPECT_EQ(refused_shape(star, apex, options), std::nullopt);
  }
}

TEST(ShapeGuards, RefuseAFaceThatFlipsHoweverLax) {
  const HalfEdgeMesh mesh(roof());
  const Star star = star_of(mesh, 0, 1);
  const HullOptions lax{.guards = {.min_compactness_ratio = 0, .max_normal_deviation = std::numbers::pi / 2}};
  EXPECT_EQ(refused_shape(star, to_local(star, {0, 0, -2}), lax), Refusal::NormalDeviation);
}

TEST(Placement, IsTheLowestPointOutsideOfTheRoof) {
  const HalfEdgeMesh mesh(roof());
  const Star star = star_of(mesh, 0, 1);
  const auto placement = place_outside(star, 0);
  ASSERT_TRUE(placement);
  // The two gables x = +-(0.5 + (1 - z) / 2) meet at z = 2, the long sides lie below.
  const Vec3 apex = star.to_input(placement->local);
  EXPECT_NEAR(apex.z, 2, 1e-9);
  EXPECT_NEAR(apex.x, 0, 1e-9);
  const double hull = 8 / 3.0, roof_volume = signed_volume(roof()) - 4 / 3.0;
  EXPECT_NEAR(placement->added_volume, hull - roof_volume, 1e-9);
  EXPECT_TRUE(is_outside(mesh, star, {apex.x, apex.y, apex.z + 1e-9}));
  EXPECT_FALSE(is_outside(mesh, star, {apex.x, apex.y, apex.z - 1e-9}));
}

TEST(Placement, OfAFlatStarIsNearTheEdgesMiddle) {
  const HalfEdgeMesh mesh(subdivided(subdivided(box({0, 0, 0}, {4, 4, 4}))));
  int flat = 0;
  for (std::uint32_t e = 0; e < mesh.edge_id_count(); ++e) {
    Star star;
    gather_star(mesh, EdgeId{e}, star);
    measure_star(mesh, star);
    bool is_flat = true;
    for (std::size_t i = 0; i < star.planes.size(); ++i) is_flat &= star.planes[i].normal == star.planes[0].normal;
    if (!is_flat) continue;
    ++flat;
    EXPECT_TRUE(lies_on_all_planes(mesh, star, mesh.position(star.o)) &&
                lies_on_all_planes(mesh, star, mesh.position(star.d)));
    const auto placement = place_outside(star, 0);
    ASSERT_TRUE(placement);
    EXPECT_LT(norm(placement->local), 1e-12);
    EXPECT_EQ(placement->added_volume, 0);
  }
  EXPECT_GT(flat, 50);
}

TEST(Placement, IsNotBoundByAFaceWithoutArea) {
  TriangleMesh with_needle = roof();
  with_needle.positions.push_back({-0.75, 0.5, 0.5});  // between 0 and 3
  with_needle.triangles[FaceId{2}] = {VertexId{0}, VertexId{3}, VertexId{7}};
  with_needle.triangles.push_back({VertexId{0}, VertexId{7}, VertexId{4}});
  with_needle.triangles.push_back({VertexId{7}, VertexId{3}, VertexId{4}});
  const HalfEdgeMesh mesh(with_needle);
  const Star star = star_of(mesh, 0, 1);
  ASSERT_EQ(star.planes.size(), 7u);
  ASSERT_EQ(std::ranges::count(star.double_areas, 0), 2) << "the needle, and what makes the number even";
  const auto placement = place_outside(star, 1e-3);
  ASSERT_TRUE(placement);
  EXPECT_TRUE(is_outside(mesh, star, star.to_input(placement->local)));
}

TEST(Placement, KnowsTheEndOfTheEdgeThatLiesOnAllPlanes) {
  // Edge from a corner of a box to the middle of the box's edge: only the corner lies on all planes.
  const TriangleMesh cube = subdivided(box({0, 0, 0}, {4, 4, 4}));
  const HalfEdgeMesh mesh(cube);
  std::uint32_t middle = 0;
  while (cube.positions[VertexId{middle}] != Vec3{2, 0, 0}) ++middle;
  const Star star = star_of(mesh, 0, middle);
  EXPECT_TRUE(lies_on_all_planes(mesh, star, {0, 0, 0}));
  EXPECT_FALSE(lies_on_all_planes(mesh, star, {2, 0, 0}));
  EXPECT_FALSE(lies_on_all_planes(mesh, star, {0, 0, std::numeric_limits<double>::denorm_min()}));
}

TEST(LinkCenterVolume, OfTheRoof) {
  const HalfEdgeMesh mesh(roof());
  // The link is the square, its centre the origin: the volume of the roof above it.
  EXPECT_NEAR(link_center_volume(star_of(mesh, 0, 1)), signed_volume(roof()) - 4 / 3.0, 1e-12);
}

}  // namespace
}  // namespace prohull

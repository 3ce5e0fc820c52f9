#include "prohull/cage.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "effort.h"
#include "meshes.h"
#include "prohull/collide.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/sample.h"
#include "prohull/verification.h"

namespace prohull {
namespace {

using namespace meshes;

TriangleMesh unit_box() { return box({0, 0, 0}, {1, 1, 1}); }

/// Triangles that touch another mesh, in any point. A face given twice leaves the mesh without an inside.
bool touch(TriangleMesh a, TriangleMesh b) {
  a.triangles.push_back(a.triangles[FaceId{0}]);
  b.triangles.push_back(b.triangles[FaceId{0}]);
  return collide(CollisionIndex(a), {}, CollisionIndex(b), {});
}

void expect_cage(const TriangleMesh& mesh, const Cage& cage) {
  const TriangleMesh& outer = cage.outer.hull().mesh;
  EXPECT_TRUE(cage.outer.hull().certified);
  EXPECT_TRUE(cage.outer.is_disjoint);
  EXPECT_GE(cage.outer.hull().padding, cage.gap);
  EXPECT_TRUE(verify_hull(outer, mesh).encloses);
  EXPECT_FALSE(touch(outer, mesh));
  EXPECT_EQ(count_self_intersections(outer), 0u);
  if (!cage.inner) return;
  const TriangleMesh& inner = cage.inner->hull().mesh;
  EXPECT_TRUE(cage.inner->hull().certified);
  EXPECT_TRUE(cage.inner->is_disjoint);
  EXPECT_TRUE(verify_hull(inner, mesh, HullSide::Inner).encloses);
  EXPECT_FALSE(touch(inner, mesh));
  EXPECT_FALSE(touch(inner, outer));
  EXPECT_EQ(count_self_intersections(inner), 0u);
}

TEST(Cage, HullsOfSamplesAreDisjointAndKeepTheGap) {
  const std::size_t faces = effort<std::size_t>(1200, 400);
  for (const char* which : {"box", "torus", "bracket"}) {
    const TriangleMesh mesh = make_sample(which, faces);
    const Cage cage = build_cage(mesh, {.outer_faces = 200, .inner_faces = 200});
    expect_cage(mesh, cage);
    EXPECT_TRUE(cage.inner->keeps_gap);
    EXPECT_LE(cage.outer.hull().mesh.face_count(), 200u);
  }
}

// The hulls of 200 faces and 100 touch themselves.
TEST(Cage, OfBoxesThatOverlapHasAnInnerHull) {
  TriangleMesh both = meshes::box({0, 0, 0}, {2, 2, 2});
  append(both, meshes::box({1, 1, 1}, {3, 3, 3}));
  const Cage cage = build_cage(both, {.outer_faces = 60, .inner_faces = 60, .gap = 0.1});
  ASSERT_TRUE(cage.inner);
  EXPECT_TRUE(cage.inner->hull().certified);
  EXPECT_TRUE(cage.inner->keeps_gap);
  EXPECT_TRUE(cage.inner->is_disjoint);
}

TEST(Cage, TakesFewerFacesWhereTheInnerHullNeedsThat) {
  TriangleMesh mesh = make_sample("sphere", 400);
  append(mesh, make_sample("torus", 600));
  const Cage cage = build_cage(mesh, {.outer_faces = 100, .inner_faces = 200, .gap = 0.01});
  EXPECT_TRUE(cage.inner->is_disjoint);
  EXPECT_LE(cage.inner->hull().mesh.face_count(), 200u);
}

TEST(Cage, InnerHullsAreNoWorseThanThoseOfTheSameGap) {
  const TriangleMesh bracket = make_sample("bracket", 500);
  const Cage cage = build_cage(bracket, {.outer_faces = 60, .inner_faces = 60, .gap = 0.2});
  expect_cage(bracket, cage);
  EXPECT_TRUE(cage.inner->keeps_gap);
  EXPECT_TRUE(cage.inner->hull().target_reached);
  EXPECT_LE(cage.inner->hull().mesh.face_count(), 60u);
}

// Hulls without a gap share the planes of a box.
TEST(Cage, OfABoxTouchesNothing) {
  const Cage cage = build_cage(unit_box(), {.outer_faces = 12, .inner_faces = 12, .gap = 0.25});
  expect_cage(unit_box(), cage);
  EXPECT_EQ(cage.gap, 0.25);
}

TEST(Cage, TrianglesAreEvenOnDemand) {
  for (const char* which : {"box", "asteroid"}) {
    const TriangleMesh mesh = make_sample(which, effort<std::size_t>(1200, 500));
    const CageOptions thin{.outer_faces = 200, .inner_faces = 200},
        even{.outer_faces = 200, .inner_faces = 200, .even = true};
    const Cage before = build_cage(mesh, thin), after = build_cage(mesh, even);
    expect_cage(mesh, after);
    EXPECT_GE(after.outer.quality.compactness.worst, kEvenCompactness);
    EXPECT_GE(after.inner->quality.compactness.worst, kEvenCompactness);
    EXPECT_LT(before.outer.quality.compactness.worst, kEvenCompactness);
    EXPECT_GT(after.outer.quality.smallest_angle, 17 * std::numbers::pi / 180);
    EXPECT_LT(after.outer.quality.worst_aspect_ratio, 4.7);
    EXPECT_LE(after.outer.hull().mesh.face_count(), 200u);
    EXPECT_GE(after.inner->hull().padding, after.gap);
  }
}

TEST(Cage, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = make_sample("torus", effort<std::size_t>(1200, 300));
  const auto outer = [&](unsigned threads) {
    return build_cage(mesh, {.outer_faces = 120, .even = true, .threads = threads}).outer.hull().mesh;
  };
  EXPECT_EQ(outer(1), outer(3));
}

TEST(Cage, KeepsFloat32Coordinates) {
  const TriangleMesh mesh = make_sample("asteroid", effort<std::size_t>(1200, 300));
  const Cage cage = build_cage(mesh, {.outer_faces = 200, .even = true, .float32_coordinates = true});
  expect_cage(mesh, cage);
  for (const Vec3& p : cage.outer.hull().mesh.positions) EXPECT_EQ(double(float(p.x)), p.x);
}

TEST(Cage, OfAnOpenMeshHasNoInnerHull) {
  TriangleMesh open{unit_box().positions, {}};
  for (std::uint32_t f = 0; f < 10; ++f) open.triangles.push_back(unit_box().triangles[FaceId{f}]);
  EXPECT_TRUE(build_cage(open, {.outer_faces = 20}).outer.is_disjoint);
}

TEST(Cage, RefusesWhatCannotBe) {
  const auto refusal = [](const TriangleMesh& mesh, const CageOptions& options) -> std::string {
    try {
      build_cage(mesh, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal(unit_box(), {.gap = -1}).find("gap"), std::string::npos);
  EXPECT_NE(refusal(unit_box(), {.outer_faces = 3}).find("4 faces"), std::string::npos);
  EXPECT_NE(refusal(TriangleMesh{}, {}).find("no faces"), std::string::npos);
  TriangleMesh sheet;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}) sheet.positions.push_back(p);
  sheet.triangles.push_back({VertexId{0}, VertexId{1}, VertexId{2}});
  EXPECT_NE(refusal(sheet, {.inner_faces = 10}), "");
}

}  // namespace
}  // namespace prohull

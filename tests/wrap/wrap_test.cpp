#include "prohull/wrap.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "effort.h"
#include "meshes.h"
#include "progress.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

/// What the header promises of every wrap, and what enclosing_hulls hopes for: that it covers all triangles.
void expect_sound(const TriangleMesh& triangles, const TriangleMesh& wrap, const std::string& what) {
  const MeshReport report = inspect(wrap);
  ASSERT_TRUE(report.is_closed_manifold()) << what << ": " << report.first_defect;
  EXPECT_GT(report.volume, 0) << what;
  EXPECT_EQ(count_self_intersections(wrap), 0u) << what;
  EXPECT_TRUE(verify_cover(triangles, wrap).encloses) << what;
}

/// The faces of which a corner is below this height.
TriangleMesh below(const TriangleMesh& mesh, double height) {
  TriangleMesh result{mesh.positions, {}};
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    if (std::min({t.a.z, t.b.z, t.c.z}) < height) result.triangles.push_back(mesh.triangles[f]);
  }
  return result;
}

TriangleMesh random_soup(std::mt19937& random, int triangles) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] { return Vec3{coordinate(random), coordinate(random), coordinate(random)}; };
  TriangleMesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const Vec3 a = point();
    mesh.triangles.push_back({mesh.positions.push_back(a), mesh.positions.push_back(a + point() * 0.5),
                              mesh.positions.push_back(a + point() * 0.5)});
  }
  return mesh;
}

TEST(Wrap, OfAClosedMeshFollowsItAtAThirdOfTheSpacing) {
  const TriangleMesh ball = sphere(4);
  const TriangleMesh wrapped = wrap(ball, {.spacing = 0.1}).mesh;
  expect_sound(ball, wrapped, "sphere");
  for (const Vec3& p : wrapped.positions) {
    EXPECT_GT(norm(p), 1);
    EXPECT_LT(norm(p), 1.05);
  }
}

TEST(Wrap, IsSoundForRandomSoups) {
  std::mt19937 random(test_seed());
  for (int round = 0; round < rounds(20); ++round) {
    const TriangleMesh soup = random_soup(random, std::uniform_int_distribution(1, 60)(random));
    const double spacing = std::uniform_real_distribution(0.04, 0.3)(random);
    expect_sound(soup, wrap(soup, {.spacing = spacing, .seal_rooms = round % 2 == 0}).mesh,
                 "round " + std::to_string(round));
  }
}

TEST(Wrap, OnLargerCellsIsSoundForRandomSoups) {
  std::mt19937 random(test_seed());
  for (int round = 0; round < rounds(20); ++round) {
    const TriangleMesh soup = random_soup(random, std::uniform_int_distribution(1, 20)(random));
    const double spacing = std::uniform_real_distribution(0.02, 0.1)(random);
    expect_sound(soup, wrap(soup, {.spacing = spacing, .flatness = 0.08}).mesh, "round " + std::to_string(round));
  }
}

TEST(Wrap, OnLargerCellsHasFewFacesWhereItIsFlat) {
  TriangleMesh slanted = box({0, 0, 0}, {3, 2, 1});
  for (Vec3& p : slanted.positions) p = {p.x - 0.3 * p.y, p.y + 0.3 * p.x, p.z + 0.2 * p.x};
  const auto faces = [&](double spacing, double flatness) {
    const TriangleMesh wrapped = wrap(slanted, {.spacing = spacing, .flatness = flatness}).mesh;
    expect_sound(slanted, wrapped, "box");
    return wrapped.face_count();
  };
  EXPECT_LT(3 * faces(0.04, 0.08), faces(0.04, 0));
  EXPECT_LT(faces(0.02, 0.08), 3 * faces(0.04, 0.08));  // there are more along edges only
}

TEST(Wrap, OfTwoBoxesThatCrossIsOneWithoutInnerFaces) {
  const TriangleMesh crossing = together(box({0, 0, 0}, {2, 1, 1}), box({1, 0.25, 0.25}, {3, 0.75, 0.75}));
  const TriangleMesh wrapped = wrap(crossing, {.spacing = 0.05}).mesh;
  expect_sound(crossing, wrapped, "boxes");
  EXPECT_EQ(inspect(wrapped).components, 1u);
  EXPECT_GT(signed_volume(wrapped), 2.25);
  EXPECT_LT(signed_volume(wrapped), 2.6) << "united: 2 + 0.25, and a third of the spacing around it";
}

TEST(Wrap, ClosesAHoleNarrowerThanTheSpacing) {
  const TriangleMesh holed = below(sphere(5), 0.995);  // the hole is some 0.2 across
  ASSERT_FALSE(inspect(holed).is_closed_manifold());
  const double ball = 4 * std::numbers::pi / 3;
  EXPECT_GT(signed_volume(wrap(holed, {.spacing = 0.21}).mesh), 0.95 * ball);
  EXPECT_LT(signed_volume(wrap(holed, {.spacing = 0.04}).mesh), 0.3 * ball) << "it goes in there";
  EXPECT_GT(signed_volume(wrap(holed, {.spacing = 0.04, .seal_holes = 0.3}).mesh), 0.95 * ball);
}

TEST(Wrap, ClosesTheDoorOfARoomIfAskedTo) {
  const TriangleMesh room = below(sphere(5), 0.95);  // the door is some 0.6 across
  const double ball = 4 * std::numbers::pi / 3;
  EXPECT_LT(signed_volume(wrap(room, {.spacing = 0.1}).mesh), 0.6 * ball);
  const Wrap sealed = wrap(room, {.spacing = 0.1, .seal_rooms = true});
  EXPECT_GT(signed_volume(sealed.mesh), 0.95 * ball);
  EXPECT_GT(sealed.doors.face_count(), 0u);
  EXPECT_NEAR(sealed.largest_door, 0.6, 0.25);
  expect_sound(room, sealed.mesh, "room");
  EXPECT_TRUE(verify_cover(sealed.doors, sealed.mesh).encloses) << "the wrap covers its doors too";
}

TEST(Wrap, OfABowlIsNoRoom) {
  const TriangleMesh bowl = below(sphere(4), 0);  // as wide at the rim as anywhere
  const double ball = 4 * std::numbers::pi / 3;
  EXPECT_LT(signed_volume(wrap(bowl, {.spacing = 0.05, .seal_rooms = true}).mesh), 0.2 * ball);
}

TEST(Wrap, FillsHollowsIfAskedTo) {
  // A groove 0.2 wide.
  const TriangleMesh grooved = together(box({0, 0, 0}, {1, 1, 1}), box({1.2, 0, 0}, {2.2, 1, 1}));
  EXPECT_EQ(inspect(wrap(grooved, {.spacing = 0.05}).mesh).components, 2u);
  const TriangleMesh filled = wrap(grooved, {.spacing = 0.05, .closing = 0.4}).mesh;
  EXPECT_EQ(inspect(filled).components, 1u);
  expect_sound(grooved, filled, "filled");
}

TEST(Wrap, OfWhatEnclosesNothingIsASheetAroundIt) {
  const TriangleMesh triangle = make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const TriangleMesh needle = make({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}});
  const TriangleMesh point = make({{1, 2, 3}}, {{0, 0, 0}});
  const TriangleMesh sheet = make({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0.3}}, {{0, 1, 2}, {0, 2, 3}});
  for (const auto& [name, mesh] :
       {std::pair{"triangle", triangle}, {"needle", needle}, {"point", point}, {"sheet", sheet}})
    expect_sound(mesh, wrap(mesh, {.spacing = 0.1, .seal_rooms = true}).mesh, name);
}

TEST(Wrap, OfLongNeedlesIsSound) {
  TriangleMesh needles;  // both sides at a corner are 180 spacings long
  for (double x = 0; x < 30; ++x) append(needles, make({{x, 0, 0}, {x + 60, 90, 60}, {x + 60.1, 90, 60}}, {{0, 1, 2}}));
  expect_sound(needles, wrap(needles, {.spacing = 0.7}).mesh, "needles");
}

TEST(Wrap, IsTheSameForTheSameInput) {
  std::mt19937 random(test_seed());
  const TriangleMesh soup = random_soup(random, 40);
  const WrapOptions options{.spacing = 0.08, .seal_rooms = true, .closing = 0.2};
  EXPECT_EQ(wrap(soup, options).mesh, wrap(soup, options).mesh);
}

TEST(Wrap, TellsTheVolumeInside) {
  const TriangleMesh ball = sphere(4);
  const double volume = signed_volume(ball);
  EXPECT_NEAR(wrap(ball, {.spacing = 0.05}).inside_volume / volume, 1, 0.02);
  EXPECT_NEAR(inside_volume(together(ball, ball), {.spacing = 0.05}) / volume, 1, 0.02) << "doubled";
  for (const double size : {1.0, 1.02, 1.033, 1.049})
    EXPECT_NEAR(inside_volume(box({0, 0, 0}, {size, size, size}), {.spacing = 0.05}) / std::pow(size, 3), 1, 0.01)
        << size;
  EXPECT_EQ(inside_volume(make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), {.spacing = 0.05}), 0);
}

TEST(InnerWrap, LiesInsideOfTheUnionOfParts) {
  const TriangleMesh crossing = together(box({0, 0, 0}, {1, 1, 1}), box({0.4, 0.4, -1}, {0.6, 0.6, 2}));
  const TriangleMesh inner = inner_wrap(crossing, {.spacing = 0.04});
  ASSERT_TRUE(inspect(inner).is_closed_manifold());
  EXPECT_EQ(count_self_intersections(inner), 0u);
  EXPECT_TRUE(verify_enclosure(inner, crossing).encloses);
  EXPECT_GT(signed_volume(inner), 0.85 * 1.08) << "the faces hidden inside do not cut into it";
}

TEST(InnerWrap, LeavesOutCavities) {
  const TriangleMesh hollow = together(box({0, 0, 0}, {1, 1, 1}), inside_out(box({0.3, 0.3, 0.3}, {0.7, 0.7, 0.7})));
  for (const TriangleMesh& mesh : {hollow, walls(0.3)}) {
    const TriangleMesh inner = inner_wrap(mesh, {.spacing = 0.04});
    EXPECT_TRUE(verify_enclosure(inner, mesh).encloses);
    EXPECT_GT(signed_volume(inner), 0.6);
  }
}

TEST(InnerWrap, OfWhatIsThinHasNoFaces) {
  EXPECT_EQ(inner_wrap(box({0, 0, 0}, {1, 1, 0.01}), {.spacing = 0.1}).face_count(), 0u);
}

TEST(Wrap, RefusesBadInput) {
  TriangleMesh not_finite = octahedron();
  not_finite.positions[VertexId(0)].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(wrap(not_finite, {.spacing = 0.1}), InputError);
  EXPECT_THROW(wrap({}, {.spacing = 0.1}), InputError);
  EXPECT_THROW(wrap(octahedron(), {.spacing = 0.1, .padding = 0.25}), InputError) << "2.7 spacings at most";
  EXPECT_THROW(wrap(octahedron(), {.spacing = 1e-6}), InputError) << "2^28 nodes at most";
  for (const double spacing : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(wrap(octahedron(), {.spacing = spacing}), InputError) << spacing;
}

// Its origin would be rounded by more than the margin, so that triangles lie beyond its nodes.
TEST(Wrap, RefusesAGridThatIsFinerThanCoordinates) {
  std::mt19937 random(test_seed());
  const TriangleMesh far = moved(scaled(random_soup(random, 6), 0x1p-23), {1e9, 1e9, 1e9});
  for (const bool seal_rooms : {false, true})
    EXPECT_THROW(wrap(far, {.spacing = 0x1p-27, .seal_rooms = seal_rooms}), InputError);
  EXPECT_THROW(inside_volume(far, {.spacing = 0x1p-27}), InputError);
}

TEST(Wrap, CanBeCancelled) {
  const UnthrottledProgress unthrottled;
  EXPECT_THROW(wrap(sphere(3), {.spacing = 0.05, .progress = [](std::string_view, double) { return false; }}),
               Cancelled);
}

}  // namespace
}  // namespace prohull

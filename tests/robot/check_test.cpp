#include "robot/check/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>

#include "effort.h"
#include "meshes.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "prohull/mesh_query.h"
#include "prohull/sample.h"
#include "random.h"
#include "robot/transform.h"
#include "verify/convex_pairs.h"

namespace prohull::robot {
namespace {

/// Mesh files of one test.
class Check : public testing::Test {
 protected:
  Check() { std::filesystem::create_directories(folder_); }
  ~Check() override { std::filesystem::remove_all(folder_); }

  Shape mesh(const TriangleMesh& triangles, const Pose& origin = {}) {
    const auto path = folder_ / (std::to_string(count_++) + ".ply");
    write_mesh(path, triangles);
    return {MeshFile{path.filename().string(), path, "", {1, 1, 1}}, origin, "", 0};
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      ("prohull-check-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
  int count_ = 0;
};

Shape shape(const Form& form, const Pose& origin = {}) { return {form, origin, "", 0}; }
Shape cube(double size, const Pose& origin = {}) { return shape(BoxForm{{size, size, size}}, origin); }

LinkCheck checked(std::vector<Shape> visual, std::vector<Shape> collision, const CheckOptions& options = {}) {
  Robot robot;
  robot.links.push_back({"link", std::move(visual), std::move(collision), 0});
  return check_links(robot, options).at(0);
}

double less(double x) { return std::nextafter(x, 0); }

TEST_F(Check, ABoxCoversItselfAndWhatIsWithin) {
  EXPECT_EQ(checked({cube(1)}, {cube(1)}).verdict, CheckVerdict::Covered);
  const LinkCheck check = checked({cube(1)}, {cube(2)});
  EXPECT_EQ(check.verdict, CheckVerdict::Covered);
  EXPECT_EQ(check.faces_outside, 0U);
  EXPECT_EQ(check.sticks_out_at_most, 0);
  EXPECT_EQ(check.visual_faces, 12U);
  EXPECT_EQ(check.collision_faces, 12U);
  EXPECT_EQ(check.pieces, 1U);
  EXPECT_DOUBLE_EQ(check.visual_volume, 1);
  EXPECT_DOUBLE_EQ(check.collision_volume, 8);
  EXPECT_DOUBLE_EQ(check.convex_volume, 1);
  EXPECT_NEAR(check.reach.lower, std::sqrt(0.75), 1e-12);
  EXPECT_GE(check.reach.upper, std::sqrt(0.75));
  EXPECT_GT(check.mean_distance, 0.5);
  EXPECT_LT(check.mean_distance, 0.75);
  EXPECT_TRUE(passes(check));
}

TEST_F(Check, TheVisualShapesThemselvesReachNowhere) {
  std::vector<Shape> arms;
  for (const double x : {0.0, 0.3, 0.6}) arms.push_back(shape(CapsuleForm{0.2, 1}, translation_by({x, 0, 0})));
  EXPECT_EQ(checked(arms, arms).reach.upper, 0);
  EXPECT_EQ(checked(arms, {arms[2], arms[0], arms[1]}).reach.upper, 0);
  EXPECT_GT(checked(arms, {arms[0], arms[1], shape(CapsuleForm{0.25, 1}, translation_by({0.6, 0, 0}))}).reach.lower, 0);
  arms.push_back(cube(0.5));
  EXPECT_EQ(checked(arms, arms).reach.upper, 0);
}

TEST_F(Check, OfNextToNoLeakTellsWhere) {
  TriangleMesh ball = make_sample("sphere", 500);
  for (Vec3& p : ball.positions) p = p / norm(p);
  const LinkCheck check = checked({mesh(ball)}, {shape(SphereForm{1})});
  ASSERT_EQ(check.verdict, CheckVerdict::Leaks);
  ASSERT_EQ(check.sticks_out_at_least, 0);
  EXPECT_GT(check.sticks_out_at_most, 0);
  EXPECT_GT(norm(check.worst_point), 0.9);
}

TEST_F(Check, WhatLiesInsideOfTheSolidDoesNotReachOutOfIt) {
  EXPECT_LT(checked({cube(1)}, {cube(1), cube(0.1)}).reach.upper, 1e-3);
  EXPECT_LT(checked({cube(1)}, {shape(SphereForm{0.8}), shape(SphereForm{0.9})}).reach.upper, 0.402);
}

// Volumes would overflow, or vanish. The verdict stands.
TEST_F(Check, WhatHasNoVolumeIsCheckedAllTheSame) {
  for (const double size : {1e170, 1e-170}) {
    const Shape huge = mesh(meshes::box({0, 0, 0}, {size, size, size}));
    const LinkCheck check = checked({huge}, {huge});
    EXPECT_EQ(check.verdict, CheckVerdict::Covered);
    EXPECT_EQ(check.notes.size(), 1U) << "no volume of the file that is both";
    EXPECT_EQ(check.visual_volume, 0);
  }
}

TEST_F(Check, APieceSmallerByOneUnitLeaks) {
  const LinkCheck check = checked({cube(1)}, {cube(less(1))});
  EXPECT_EQ(check.verdict, CheckVerdict::Leaks);
  EXPECT_EQ(check.faces_outside, 12U);
  EXPECT_GT(check.sticks_out_at_most, 0);
  EXPECT_LT(check.sticks_out_at_most, 1e-12);
  EXPECT_FALSE(passes(check));
  EXPECT_TRUE(passes(check, 1e-12));
}

/// Balls around the eight parts of the cube of size 1, of which each is larger by `factor` than it has to be.
std::vector<Shape> eight_balls(double factor) {
  std::vector<Shape> balls;
  for (const double x : {-0.25, 0.25})
    for (const double y : {-0.25, 0.25})
      for (const double z : {-0.25, 0.25})
        balls.push_back(shape(SphereForm{std::sqrt(0.1875) * factor}, translation_by({x, y, z})));
  return balls;
}

TEST_F(Check, BallsThatCoverABoxWithLittleToSpare) {
  const LinkCheck check = checked({cube(1)}, eight_balls(1 + 1e-6));
  EXPECT_EQ(check.verdict, CheckVerdict::Covered);
  EXPECT_EQ(check.pieces, 8U);
  EXPECT_GT(check.collision_volume, 1);
  EXPECT_LT(check.collision_volume, 8 * 4.19 * std::pow(std::sqrt(0.1875), 3));
}

TEST_F(Check, BallsThatLeaveTheCornersOfABox) {
  const LinkCheck check = checked({cube(1)}, eight_balls(1 - 1e-6));
  EXPECT_EQ(check.verdict, CheckVerdict::Leaks);
  EXPECT_NEAR(check.sticks_out_at_least, 1e-6 * std::sqrt(0.1875), 1e-9);
  EXPECT_LT(check.sticks_out_at_most, 1e-6);
}

TEST_F(Check, BallsThatCoverACylinder) {
  std::vector<Shape> balls;
  for (int i = -10; i <= 10; ++i) balls.push_back(shape(SphereForm{0.21}, translation_by({0, 0, 0.05 * i})));
  EXPECT_EQ(checked({shape(CylinderForm{0.2, 1})}, balls).verdict, CheckVerdict::Covered);
  balls.resize(balls.size() - 2);
  const LinkCheck check = checked({shape(CylinderForm{0.2, 1})}, balls);
  EXPECT_EQ(check.verdict, CheckVerdict::Leaks);
  EXPECT_NEAR(check.sticks_out_at_least, std::hypot(0.2, 0.1) - 0.21, 1e-3);
}

TEST_F(Check, ATurnedBallIsTheSameBall) {
  const Pose turned = pose_of_rpy({0.1, 0.2, 0.3}, {1, 2, 3});
  EXPECT_EQ(checked({shape(SphereForm{0.7}, translation_by({1, 2, 3}))}, {shape(SphereForm{0.7}, turned)}).verdict,
            CheckVerdict::Covered);
}

TEST_F(Check, ManyConvexPiecesThatShareWalls) {
  const Pose origin = pose_of_rpy({0.1, 0.2, 0.3}, {1, 2, 3});
  std::vector<Shape> pieces;
  for (int i = 0; i < 16; ++i) {
    const double x = i / 16.0;
    pieces.push_back(mesh(meshes::box({x, 0, 0}, {x + 0.0625, 1, 1}), origin));
  }
  const std::vector<Shape> whole{mesh(meshes::box({0, 0.1, 0.1}, {1, 0.9, 0.9}), origin)};
  EXPECT_EQ(checked(whole, pieces).verdict, CheckVerdict::Covered);
  pieces[5] = mesh(meshes::box({0.3125, 0, 0}, {less(0.375), 1, 1}), origin);
  EXPECT_EQ(checked(whole, pieces).verdict, CheckVerdict::Leaks);
}

TEST_F(Check, ToldHowFarAndWhere) {
  const LinkCheck check = checked({cube(1), shape(BoxForm{{0.1, 0.1, 0.1}}, translation_by({0, 0, 0.5}))}, {cube(1)});
  EXPECT_EQ(check.verdict, CheckVerdict::Leaks);
  EXPECT_NEAR(check.sticks_out_at_least, 0.05, 1e-12);
  EXPECT_GE(check.sticks_out_at_most, 0.05);
  EXPECT_LT(check.sticks_out_at_most, 0.0506);
  EXPECT_NEAR(check.worst_point.z, 0.55, 1e-12);
  EXPECT_EQ(check.faces_outside, 10U) << "the walls and the top; the bottom is inside";
  EXPECT_FALSE(passes(check, 0.04));
  EXPECT_TRUE(passes(check, 0.051));
}

// A long spike is deep inside over most of its length: only what is outside counts.
TEST_F(Check, PartsDeepInsideDoNotCount) {
  const Shape spike = mesh(meshes::tetrahedron({-0.4, 0, 0}, {-0.4, 0.1, 0}, {-0.4, 0, 0.1}, {0.51, 0, 0}));
  const LinkCheck check = checked({spike}, {cube(1)});
  EXPECT_EQ(check.verdict, CheckVerdict::Leaks);
  EXPECT_NEAR(check.sticks_out_at_least, 0.01, 1e-12);
  EXPECT_LT(check.sticks_out_at_most, 0.0103);
  EXPECT_EQ(check.worst_point, (Vec3{0.51, 0, 0}));
}

TEST_F(Check, TheWorstPointIsInTheFrameOfTheLink) {
  const Pose origin = pose_of_rpy({0, 0, std::acos(-1) / 2}, {1, 2, 3});
  const LinkCheck check =
      checked({mesh(meshes::box({0, 0, 0}, {2, 1, 1}), origin)}, {mesh(meshes::box({0, 0, 0}, {1.5, 1, 1}), origin)});
  EXPECT_NEAR(check.sticks_out_at_least, 0.5, 1e-12);
  EXPECT_NEAR(check.worst_point.y, 4, 1e-12) << "2 along x, turned to y";
  EXPECT_NEAR(bounding_box(check.visual).max.y, 4, 1e-12);
  EXPECT_NEAR(bounding_box(check.collision).max.y, 3.5, 1e-12);
}

TEST_F(Check, TwoBoxesThatShareAWallCoverWhatLiesAcross) {
  const Shape left = cube(1, translation_by({-0.5, 0, 0})), right = cube(1, translation_by({0.5, 0, 0}));
  EXPECT_EQ(checked({cube(1)}, {left, right}).verdict, CheckVerdict::Covered);
  EXPECT_EQ(checked({cube(1)}, {left}).verdict, CheckVerdict::Leaks);
}

TEST_F(Check, ASlitBetweenTwoBarsIsNotRoundedAway) {
  const BoxForm bar{{1, 0x1p-32, 0x1p-32}};
  const Shape left = shape(bar, translation_by({-0.5, 0, 0})),
              right = shape(bar, translation_by({0.5 + 0x1p-36, 0, 0}));
  const LinkCheck slit = checked({shape(bar)}, {left, right});
  EXPECT_EQ(slit.verdict, CheckVerdict::Leaks);
  EXPECT_GE(slit.sticks_out_at_most, 0x1p-37);
  EXPECT_LT(slit.sticks_out_at_most, 0x1p-35);
}

TEST_F(Check, WhatFramesRoundFarAwayCounts) {
  Shape far = cube(1);
  far.way = 2e11;  // there and back: its place is known to some 1e-5
  for (const double size : {1., 0.9999}) {
    const LinkCheck check = checked({far}, {cube(size)});
    EXPECT_EQ(check.verdict, CheckVerdict::Undecided);
    EXPECT_GT(check.sticks_out_at_most, 2e-5);
    EXPECT_FALSE(passes(check));
  }
  EXPECT_EQ(checked({far}, {cube(0.1)}).verdict, CheckVerdict::Leaks);
  far.way = 10;
  EXPECT_EQ(checked({far}, {cube(1)}).verdict, CheckVerdict::Covered);
  const LinkCheck check = checked({far}, {cube(1 - 4e-12)});
  EXPECT_EQ(check.verdict, CheckVerdict::Undecided) << "ten times as much as the link rounds";
}

TEST_F(Check, AFilledMeshIsItsConvexHull) {
  TriangleMesh both = meshes::box({-1, -1, -1}, {-0.9, 1, 1});
  append(both, meshes::box({0.9, -1, -1}, {1, 1, 1}));
  Shape piece = mesh(both);
  EXPECT_EQ(checked({cube(1)}, {piece}).verdict, CheckVerdict::Leaks);
  std::get<MeshFile>(piece.form).is_filled = true;
  EXPECT_EQ(checked({cube(1)}, {piece}).verdict, CheckVerdict::Covered);
}

TEST_F(Check, RoundingIsNoLeak) {
  const double quarter = std::acos(-1) / 2;
  const Shape box = shape(BoxForm{{1, 2, 3}}, pose_of_rpy({0, 0, 0.5}));
  const LinkCheck check = checked({box}, {shape(BoxForm{{2, 1, 3}}, pose_of_rpy({0, 0, 0.5 + quarter}))});
  EXPECT_NE(check.verdict, CheckVerdict::Leaks);
  EXPECT_EQ(check.sticks_out_at_least, 0);
  EXPECT_LE(check.sticks_out_at_most, check.rounding);
  EXPECT_LT(check.rounding, 1e-11);
  EXPECT_TRUE(passes(check));
  const LinkCheck less_wide = checked({box}, {shape(BoxForm{{2, 1 - 1e-10, 3}}, pose_of_rpy({0, 0, 0.5 + quarter}))});
  EXPECT_EQ(less_wide.verdict, CheckVerdict::Leaks);
  EXPECT_FALSE(passes(less_wide));
}

TEST_F(Check, TheSameSquareInOtherTrianglesIsNoLeak) {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
  const Shape four = mesh(meshes::make(corners, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}));
  const Shape two = mesh(meshes::make(corners, {{0, 1, 2}, {0, 2, 3}})),
              half = mesh(meshes::make(corners, {{0, 1, 2}}));
  const LinkCheck check = checked({four}, {two});
  EXPECT_EQ(check.verdict, CheckVerdict::Undecided);
  EXPECT_LE(check.sticks_out_at_most, check.rounding);
  EXPECT_TRUE(passes(check));
  EXPECT_EQ(checked({two}, {half}).verdict, CheckVerdict::Leaks);
}

TEST_F(Check, OverlappingAndNestedPiecesAreOneUnion) {
  const Shape left = cube(1, translation_by({-0.25, 0, 0})), right = cube(1, translation_by({0.25, 0, 0}));
  const LinkCheck check = checked({shape(BoxForm{{1.5, 1, 1}})}, {left, right, cube(0.1)});
  EXPECT_EQ(check.verdict, CheckVerdict::Covered);
  EXPECT_EQ(check.pieces, 3U);
  EXPECT_NEAR(check.collision_volume, 1.5, 0.05);
}

TEST_F(Check, ACavityIsAHoleUnlessAnotherPieceFillsIt) {
  const Shape hollow = mesh(meshes::together(meshes::box({-1, -1, -1}, {1, 1, 1}),
                                             meshes::inside_out(meshes::box({-.5, -.5, -.5}, {.5, .5, .5}))));
  const LinkCheck check = checked({cube(0.5)}, {hollow});
  EXPECT_EQ(check.verdict, CheckVerdict::Leaks);
  EXPECT_NEAR(check.sticks_out_at_least, 0.25, 1e-12) << "the way to the wall";
  EXPECT_EQ(checked({cube(0.5)}, {hollow, cube(1)}).verdict, CheckVerdict::Covered);
  EXPECT_EQ(checked({cube(0.5)}, {hollow, cube(0.6)}).verdict, CheckVerdict::Covered);
  EXPECT_EQ(checked({cube(0.5)}, {hollow, cube(0.4)}).verdict, CheckVerdict::Leaks);
}

// Their surfaces are covered; what pieces leave open in their midst was not looked at.
TEST_F(Check, ACavityIsAHoleInACurvedFormToo) {
  const Shape hollow = mesh(meshes::together(meshes::box({-2, -2, -2}, {2, 2, 2}),
                                             meshes::inside_out(meshes::box({-.3, -.3, -.3}, {.3, .3, .3}))));
  for (const Form& form : {Form(SphereForm{1}), Form(CylinderForm{1, 2}), Form(CapsuleForm{1, 1})}) {
    const LinkCheck check = checked({shape(form)}, {hollow});
    EXPECT_EQ(check.verdict, CheckVerdict::Leaks);
    EXPECT_NEAR(check.sticks_out_at_least, 0.3, 1e-12) << "from the middle to the wall";
    EXPECT_GE(check.sticks_out_at_most, 0.3);
    EXPECT_EQ(checked({shape(form)}, {hollow, shape(SphereForm{0.6})}).verdict, CheckVerdict::Covered);
    EXPECT_EQ(checked({shape(form)}, {hollow, shape(SphereForm{0.4})}).verdict, CheckVerdict::Leaks);
    EXPECT_EQ(checked({shape(form)}, {hollow, shape(SphereForm{1.9})}).verdict, CheckVerdict::Covered);
  }
}

TEST_F(Check, BallsAllOverASphereDoNotFillIt) {
  std::vector<Shape> balls;
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 16; ++j) {
      const double a = std::numbers::pi * i / 8, b = std::numbers::pi * j / 8;
      balls.push_back(
          shape(SphereForm{0.5}, translation_by({std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)})));
    }
  const LinkCheck check = checked({shape(SphereForm{1})}, balls);
  EXPECT_EQ(check.verdict, CheckVerdict::Leaks);
  EXPECT_NEAR(check.sticks_out_at_least, 0.5, 1e-9) << "from the middle to the nearest ball";
  balls.push_back(shape(SphereForm{0.7}));
  EXPECT_EQ(checked({shape(SphereForm{1})}, balls).verdict, CheckVerdict::Covered);
}

/// A prism, 0 <= z <= 1, over an outline that crosses itself: one lobe is inside out, as small as the other or smaller.
TriangleMesh bow() {
  TriangleMesh mesh =
      meshes::make({{0, 0, 0}, {1.5, 1.5, 0}, {1.5, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1.5, 1.5, 1}, {1.5, 0, 1}, {0, 1, 1}},
                   {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}});
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    mesh.triangles.push_back({VertexId(i), VertexId(j), VertexId(j + 4)});
    mesh.triangles.push_back({VertexId(i), VertexId(j + 4), VertexId(i + 4)});
  }
  return mesh;
}

// The balls meet at x = 1/3, where neither "covered" nor "outside" is proven: verify_union is undecided.
TEST_F(Check, BallsWithAPointInDoubtAreNotSaidToCover) {
  const double third = 1.0 / 3;
  const Shape segment = mesh(meshes::make({{-1, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}));
  const LinkCheck check = checked({segment}, {shape(SphereForm{2}, translation_by({third - 2, 0, 0})),
                                              shape(SphereForm{2}, translation_by({third + 2, 0, 0}))});
  EXPECT_EQ(check.verdict, CheckVerdict::Undecided);
}

TEST_F(Check, ALobeThatIsInsideOutTakesNothingFromAnotherPiece) {
  EXPECT_TRUE(is_tangled(bow()));
  EXPECT_TRUE(is_tangled(meshes::inside_out(bow())));
  EXPECT_FALSE(is_tangled(meshes::box({-1, -1, -1}, {1, 1, 1})));
  EXPECT_FALSE(is_tangled(meshes::box({-9e99, -9e99, -9e99}, {9e99, 9e99, 9e99})));
  EXPECT_FALSE(is_tangled(meshes::together(meshes::box({0, 0, 0}, {2, 2, 2}), meshes::box({1, 1, 1}, {3, 3, 3}))));
  int alone = 0;
  for (const Vec3& corner : {Vec3{0.1, 0.5, 0.5}, Vec3{1.3, 0.7, 0.5}}) {
    const Shape small = mesh(meshes::box(corner, corner + Vec3{0.05, 0.05, 0.05}));
    EXPECT_EQ(checked({small}, {mesh(bow()), cube(6)}).verdict, CheckVerdict::Covered);
    EXPECT_EQ(checked({small}, {mesh(bow()), shape(SphereForm{6})}).verdict, CheckVerdict::Covered);
    EXPECT_EQ(checked({small}, {mesh(bow()), cube(6), mesh(bow())}).verdict, CheckVerdict::Covered);
    alone += checked({small}, {mesh(bow()), cube(0.1)}).verdict == CheckVerdict::Covered;
  }
  EXPECT_EQ(alone, 1) << "the lobe that is not inside out";
}

TEST_F(Check, ATangledPieceAndAnotherOneShareTheWork) {
  const auto bar_to = [&](double x) { return mesh(meshes::box({1.3, 0.6, 0.4}, {x, 0.7, 0.5})); };
  const Shape beside = mesh(meshes::box({1.4, 0, 0}, {2, 1, 1}));
  const LinkCheck within = checked({bar_to(1.8)}, {mesh(bow()), beside});
  EXPECT_NE(within.verdict, CheckVerdict::Leaks);
  EXPECT_EQ(within.sticks_out_at_least, 0);
  EXPECT_LT(within.sticks_out_at_most, 0.01);
  const LinkCheck out = checked({bar_to(2.5)}, {mesh(bow()), beside});
  EXPECT_EQ(out.verdict, CheckVerdict::Leaks);
  EXPECT_NEAR(out.sticks_out_at_least, 0.5, 0.01);
}

TEST_F(Check, EachPieceIsTurnedByItself) {
  const TriangleMesh small = meshes::inside_out(meshes::box({2, 2, 2}, {3, 3, 3}));
  const TriangleMesh inner = meshes::box({2.25, 2.25, 2.25}, {2.75, 2.75, 2.75});
  EXPECT_EQ(checked({mesh(inner)}, {cube(2), mesh(small)}).verdict, CheckVerdict::Covered);
  EXPECT_EQ(checked({cube(1)}, {mesh(meshes::inside_out(meshes::box({-1, -1, -1}, {1, 1, 1})))}).verdict,
            CheckVerdict::Covered);
}

TEST_F(Check, ASphereThatJustCoversABox) {
  // The corners of the box are at (3, 4, 12) / 2, exactly 6.5 away.
  const Shape box = shape(BoxForm{{3, 4, 12}});
  EXPECT_EQ(checked({box}, {shape(SphereForm{6.5})}).verdict, CheckVerdict::Covered);
  const LinkCheck check = checked({box}, {shape(SphereForm{less(6.5)})});
  EXPECT_EQ(check.verdict, CheckVerdict::Leaks);
  EXPECT_LT(check.sticks_out_at_most, 6.5 * 2e-3);
  const LinkCheck far = checked({box}, {shape(SphereForm{6})});
  EXPECT_EQ(far.verdict, CheckVerdict::Leaks);
  EXPECT_NEAR(far.sticks_out_at_least, 0.5, 1e-9);
  EXPECT_GE(far.sticks_out_at_most, 0.5);
  EXPECT_LT(far.sticks_out_at_most, 0.51);
}

TEST_F(Check, CurvedPiecesAndMeshesShareTheWork) {
  const Shape bar = shape(BoxForm{{0.1, 0.1, 4}}), column = shape(CylinderForm{0.2, 2}, translation_by({0, 0, 1}));
  const Shape foot = cube(2, translation_by({0, 0, -1}));
  EXPECT_EQ(checked({bar}, {column, foot}).verdict, CheckVerdict::Covered);
  const LinkCheck check = checked({bar}, {column});
  EXPECT_EQ(check.verdict, CheckVerdict::Leaks);
  EXPECT_NEAR(check.sticks_out_at_least, 2, 1e-9);
  EXPECT_LT(check.sticks_out_at_most, 2.03);
}

// The corners are inside; the middle of an edge is outside by less than any mesh of the spheres tells.
TEST_F(Check, AnEdgeThatJustLeavesTwoSpheres) {
  // They meet in a circle of radius sqrt(0.75) about the x axis.
  const Shape left = shape(SphereForm{1}, translation_by({-0.5, 0, 0})),
              right = shape(SphereForm{1}, translation_by({0.5, 0, 0}));
  const auto below_edge_at = [&](double y) {
    return mesh(meshes::make({{-0.5, y, 0}, {0.5, y, 0}, {0, 0, 0}}, {{0, 2, 1}}));
  };
  EXPECT_EQ(checked({below_edge_at(0.86)}, {left, right}).verdict, CheckVerdict::Covered);
  const double y = std::sqrt(0.75) + 1e-5, out = std::hypot(0.5, y) - 1;
  const LinkCheck check = checked({below_edge_at(y)}, {left, right});
  EXPECT_EQ(check.verdict, CheckVerdict::Leaks);
  EXPECT_NEAR(check.sticks_out_at_least, out, 1e-11);
  EXPECT_LE(check.sticks_out_at_most, 1.02 * out);
  EXPECT_NEAR(check.worst_point.x, 0, 1e-12);
}

TEST_F(Check, EqualFormsCoverEachOther) {
  const Pose origin = pose_of_rpy({0.1, 0.2, 0.3}, {1, 2, 3});
  for (const Form& form : {Form(SphereForm{0.1}), Form(CylinderForm{0.1, 0.3}), Form(CapsuleForm{0.1, 0.3})})
    EXPECT_EQ(checked({shape(form, origin)}, {cube(0.1), shape(form, origin)}).verdict, CheckVerdict::Covered);
}

TEST_F(Check, CurvedFormsInEachOther) {
  const Shape capsule = shape(CapsuleForm{0.1, 0.3}), larger = shape(CapsuleForm{0.11, 0.3});
  EXPECT_EQ(checked({capsule}, {larger}).verdict, CheckVerdict::Covered);
  const LinkCheck check = checked({larger}, {capsule});
  EXPECT_EQ(check.verdict, CheckVerdict::Leaks);
  EXPECT_GT(check.sticks_out_at_least, 0.0095);
  EXPECT_LE(check.sticks_out_at_least, 0.01);
  EXPECT_GE(check.sticks_out_at_most, 0.01);
  EXPECT_LT(check.sticks_out_at_most, 0.0105);
  EXPECT_EQ(checked({shape(SphereForm{0.5})}, {cube(1.01)}).verdict, CheckVerdict::Covered);
  EXPECT_EQ(checked({shape(SphereForm{0.5})}, {cube(0.99)}).verdict, CheckVerdict::Leaks);
}

TEST_F(Check, IsUndecidedWhereASphereTouchesABox) {
  const LinkCheck check = checked({shape(CylinderForm{0.5, 1})}, {cube(1)});
  EXPECT_EQ(check.verdict, CheckVerdict::Undecided);
  EXPECT_EQ(check.sticks_out_at_least, 0);
  EXPECT_GT(check.sticks_out_at_most, 0);
  EXPECT_LT(check.sticks_out_at_most, 1e-3);
  EXPECT_FALSE(passes(check));
  EXPECT_TRUE(passes(check, 1e-3));
}

TEST_F(Check, AnOpenMeshIsClosedForTheCheck) {
  const TriangleMesh whole = meshes::box({-1, -1, -1}, {1, 1, 1});
  TriangleMesh open;
  open.positions = whole.positions;
  for (const FaceId f : whole.triangles.ids())
    if (index(f) > 1) open.triangles.push_back(whole.triangles[f]);
  const LinkCheck check = checked({cube(1)}, {mesh(open)});
  EXPECT_EQ(check.verdict, CheckVerdict::Covered);
  ASSERT_EQ(check.notes.size(), 1U);
  EXPECT_NE(check.notes[0].find("is open"), std::string::npos) << check.notes[0];
  EXPECT_NE(check.notes[0].find("1 opening was closed"), std::string::npos) << check.notes[0];
}

TEST_F(Check, AMeshThatCannotBeClosedCountsAsItsTriangles) {
  const TriangleMesh sheet = meshes::make({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}});
  EXPECT_EQ(checked({mesh(sheet)}, {mesh(sheet)}).verdict, CheckVerdict::Covered) << "by itself";
  const LinkCheck check = checked({mesh(meshes::moved(sheet, {0, 0, 0.25}))}, {mesh(sheet)});
  EXPECT_EQ(check.verdict, CheckVerdict::Leaks);
  EXPECT_NEAR(check.sticks_out_at_least, 0.25, 1e-12);
  EXPECT_LT(check.sticks_out_at_most, 0.2526);
  ASSERT_EQ(check.notes.size(), 1U);
  EXPECT_NE(check.notes[0].find("cannot be closed"), std::string::npos) << check.notes[0];
}

TEST_F(Check, AMissingFileIsAVerdictAndANote) {
  MeshFile lost{"package://a/b.stl", {}, "package://a/b.stl: no package a was found", {1, 1, 1}};
  const LinkCheck check = checked({cube(1)}, {shape(lost)});
  EXPECT_EQ(check.verdict, CheckVerdict::Missing);
  EXPECT_EQ(check.notes, (std::vector<std::string>{lost.why_not}));
  EXPECT_FALSE(passes(check, 1));
  EXPECT_EQ(checked({shape(lost)}, {shape(lost)}).notes, (std::vector<std::string>{lost.why_not})) << "once";
  lost.path = folder_ / "b.stl";
  EXPECT_EQ(checked({shape(lost)}, {cube(1)}).verdict, CheckVerdict::Missing);
}

TEST_F(Check, LinksWithoutGeometry) {
  EXPECT_EQ(checked({}, {}).verdict, CheckVerdict::NoVisual);
  EXPECT_EQ(checked({}, {cube(1)}).verdict, CheckVerdict::NoVisual);
  EXPECT_TRUE(passes(checked({}, {cube(1)})));
  EXPECT_EQ(checked({cube(1)}, {}).verdict, CheckVerdict::NoCollision);
  EXPECT_FALSE(passes(checked({cube(1)}, {}), 1));
}

TEST_F(Check, GeometryThatIsNotReadIsNotChecked) {
  const Shape other = shape(OtherForm{"ellipsoid"});
  const LinkCheck check = checked({other}, {cube(1)});
  EXPECT_EQ(check.verdict, CheckVerdict::Missing);
  EXPECT_FALSE(passes(check, 1));
  ASSERT_EQ(check.notes.size(), 1U);
  EXPECT_EQ(check.notes[0].find("ellipsoid: "), 0U) << check.notes[0];
  EXPECT_EQ(checked({other, cube(0.5)}, {cube(1)}).verdict, CheckVerdict::Missing);
  EXPECT_EQ(checked({cube(1)}, {other}).verdict, CheckVerdict::Missing) << "it may cover all";
  const LinkCheck rest = checked({cube(1)}, {other, cube(0.5)});
  EXPECT_EQ(rest.verdict, CheckVerdict::Missing) << "it may cover the rest";
  EXPECT_EQ(rest.sticks_out_at_least, 0);
  EXPECT_EQ(checked({cube(1)}, {other, cube(1)}).verdict, CheckVerdict::Covered);
}

TEST_F(Check, FacesOfWhichNoneIsFiniteAreNotChecked) {
  const auto path = folder_ / "broken.obj";
  std::ofstream(path) << "v 0 0 0\nv 0.1 0 0\nv nan 0 0\nf 1 2 3\n";
  const LinkCheck check = checked({shape(MeshFile{"broken.obj", path, "", {1, 1, 1}})}, {cube(1)});
  EXPECT_EQ(check.verdict, CheckVerdict::Missing);
  EXPECT_EQ(check.notes.size(), 2U);
}

TEST_F(Check, FacesThatAreNotFiniteAreLeftOut) {
  const auto path = folder_ / "broken.obj";
  std::ofstream(path) << "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\n";
  const LinkCheck check = checked({shape(MeshFile{"broken.obj", path, "", {1, 1, 1}})}, {cube(1)});
  EXPECT_EQ(check.verdict, CheckVerdict::Covered);
  EXPECT_EQ(check.visual_faces, 1U);
  EXPECT_EQ(check.notes.size(), 1U);
}

TEST_F(Check, HasNamesOfVerdicts) {
  EXPECT_EQ(name_of(CheckVerdict::Covered), "covered");
  EXPECT_EQ(name_of(CheckVerdict::NoCollision), "no-collision");
  EXPECT_EQ(name_of(CheckVerdict::Missing), "missing");
}

/// Of boxes and curved forms, by other code than that of the check.
class Union {
 public:
  explicit Union(const std::vector<Shape>& pieces) {
    for (const Shape& piece : pieces)
      if (const auto form = curved_form(piece.form, piece.origin))
        curved_.push_back(*form);
      else
        boxes_.emplace_back(QueryIndex(placed(piece.origin, form_mesh(piece.form, Curved::Around))));
  }
  double distance(const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const CurvedForm& form : curved_) least = std::min(least, form.distance(p).upper);
    for (MeshQuery& box : boxes_) least = std::min(least, std::max(0.0, box.signed_distance(p).distance));
    return least;
  }

 private:
  std::vector<CurvedForm> curved_;
  std::vector<MeshQuery> boxes_;
};

// Random triangles against unions of random pieces; what samples say, the bounds and the verdict must say, too.
TEST_F(Check, BoundsHoldWhereSamplesAre) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> any(-1, 1), size(0.3, 1.5), unit(0, 1);
  const auto point = [&] { return Vec3{any(random), any(random), any(random)}; };
  constexpr int kRounds = effort(12, 4);
  int leaking = 0;
  for (int i = 0; i < kRounds; ++i) {
    // The first triangle is in the ball of the first box, which is at least 0.3 wide.
    const double place = i == 0 ? 0 : 0.5, scale = i % 5 == 0 ? 0.08 : 1;
    std::vector<Shape> pieces;
    for (int k = 0; k <= i % 3; ++k) {
      const Pose pose = pose_of_rpy(point(), point() * place);
      pieces.push_back(shape(BoxForm{{size(random), size(random), size(random)}}, pose));
      if (i % 2 == 0)
        pieces.push_back(shape(CapsuleForm{size(random) / 2, size(random)}, pose_of_rpy(point(), point())));
      if (i % 4 == 1) pieces.push_back(shape(CylinderForm{size(random) / 2, size(random)}, pose_of_rpy(point(), {})));
    }
    const Triangle t{point() * scale, point() * scale, point() * scale};
    const LinkCheck check = checked({mesh(meshes::make({t.a, t.b, t.c}, {{0, 1, 2}}))}, pieces);
    Union all(pieces);
    double most = 0;
    for (int k = 0; k < 500; ++k) {
      double u = unit(random), v = unit(random);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      most = std::max(most, all.distance(t.a + u * (t.b - t.a) + v * (t.c - t.a)));
    }
    SCOPED_TRACE(i);
    for (const Vec3& corner : {t.a, t.b, t.c}) most = std::max(most, all.distance(corner));
    EXPECT_LE(most, check.sticks_out_at_most + 1e-12);
    EXPECT_LE(check.sticks_out_at_least, most + 0.1);
    EXPECT_LE(check.sticks_out_at_most, 1.02 * check.sticks_out_at_least + 2e-12);
    EXPECT_EQ(check.verdict, most > 1e-12 ? CheckVerdict::Leaks : CheckVerdict::Covered);
    if (check.sticks_out_at_least > 0) {
      EXPECT_NEAR(all.distance(check.worst_point), check.sticks_out_at_least, 1e-11);
    }
    leaking += most > 0;
  }
  EXPECT_GT(leaking, 0);
  EXPECT_LT(leaking, kRounds);
}

struct KnownReach {
  std::vector<Shape> visual, collision;
  double truth, room;  ///< of the bounds
};

TEST_F(Check, BoundsOfTheReachHoldForCurvedForms) {
  const Shape ball = shape(SphereForm{0.5}), other = shape(SphereForm{0.5}, translation_by({3, 0, 0})),
              cylinder = shape(CylinderForm{0.5, 1}), capsule = shape(CapsuleForm{0.1, 0.3}),
              above = shape(BoxForm{{2e-5, 2e-5, 1e-4}}, translation_by({0, 0, 0.50105})),
              prism = mesh(form_mesh(CylinderForm{0.5, 1}, Curved::Within, 200)),
              square = mesh(meshes::make({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}));
  const double corner = std::sqrt(0.75) - 0.5;
  const std::vector<KnownReach> known{
      {{ball}, {ball}, 0, 0},
      {{ball, other}, {other, ball}, 0, 2e-3},
      {{ball}, {shape(SphereForm{0.49})}, 0, 0},
      {{ball}, {shape(SphereForm{0.51})}, 0.01, 1e-3},
      {{ball}, {cube(1)}, corner, 1e-9},
      {{ball, other}, {cube(1)}, corner, 0.01},
      {{ball, other}, {above}, norm(Vec3{1e-5, 1e-5, 0.5011}) - 0.5, 2e-3},  // within a mesh around the ball
      {{capsule}, {shape(CylinderForm{0.1, 0.5})}, std::hypot(0.1, 0.1) - 0.1, 1e-3},
      {{cube(1)}, {shape(CylinderForm{0.75, 1})}, 0.25, 4e-3},
      {{prism}, {cylinder}, 0.5 * (1 - std::cos(std::numbers::pi / 200)), 4e-3},
      {{square}, {shape(CapsuleForm{0.25, 0.5})}, 0.5, 6e-3},
  };
  for (std::size_t i = 0; i < known.size(); ++i) {
    SCOPED_TRACE(i);
    const LinkCheck check = checked(known[i].visual, known[i].collision);
    EXPECT_LE(check.reach.lower, known[i].truth + 1e-12);
    EXPECT_GE(check.reach.upper, known[i].truth - 1e-12);
    EXPECT_LE(check.reach.upper - check.reach.lower, known[i].room);
    EXPECT_LE(check.mean_distance, check.reach.upper);
  }
}

// Random pieces against random pieces: the bounds hold at samples, and the farthest point is where it is said to be.
TEST_F(Check, BoundsOfTheReachHoldWhereSamplesAre) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> any(-1, 1), size(0.3, 1.5);
  const auto pose = [&] { return pose_of_rpy(Vec3{any(random), any(random), any(random)}, {any(random), 0, 0}); };
  const auto piece = [&](int kind) {
    if (kind % 4 == 0) return shape(BoxForm{{size(random), size(random), size(random)}}, pose());
    if (kind % 4 == 1) return shape(CapsuleForm{size(random) / 2, size(random)}, pose());
    if (kind % 4 == 2) return shape(CylinderForm{size(random) / 2, size(random)}, pose());
    return shape(SphereForm{size(random)}, pose());
  };
  for (int i = 0; i < effort(16, 4); ++i) {
    std::vector<Shape> visual{piece(i)}, collision{piece(i / 4)};
    if (i % 3 == 0) visual.push_back(piece(i + 1));
    if (i % 3 == 1) collision.push_back(piece(i + 1));
    const LinkCheck check = checked(visual, collision);
    Union all(visual), pieces(collision);
    double most = 0;
    for (const Shape& shape : collision)
      for (const Vec3& p : form_mesh(shape.form, Curved::Within, 32).positions)
        most = std::max(most, all.distance(placed(shape.origin, p)));
    SCOPED_TRACE(i);
    EXPECT_LE(most, check.reach.upper + 1e-12);
    EXPECT_LE(check.reach.lower, check.reach.upper);
    if (check.reach.lower > 0) {
      EXPECT_GE(all.distance(check.reach.farthest), check.reach.lower - 1e-12);
      EXPECT_LE(pieces.distance(check.reach.farthest), 1e-12);
    }
  }
}

TEST_F(Check, VolumesOfFormsAreExact) {
  const auto ball = [](double r) { return 4 * std::numbers::pi / 3 * r * r * r; };
  const double tube = std::numbers::pi * 0.75 * 0.75;
  const LinkCheck same = checked({shape(SphereForm{0.5})}, {shape(SphereForm{0.5})});
  EXPECT_EQ(same.visual_volume, same.collision_volume);
  EXPECT_NEAR(same.visual_volume, ball(0.5), 1e-9);
  EXPECT_NEAR(same.convex_volume, ball(0.5), 1e-9);
  const LinkCheck boxed = checked({shape(SphereForm{0.5})}, {cube(1.02)});
  EXPECT_NEAR(boxed.collision_volume / boxed.visual_volume, std::pow(1.02, 3) / ball(0.5), 1e-9);
  EXPECT_NEAR(checked({cube(1)}, {shape(CylinderForm{0.75, 1})}).collision_volume, tube, 1e-9);
  const Shape far = shape(CylinderForm{0.75, 1}, translation_by({5, 0, 0}));
  EXPECT_NEAR(checked({cube(1)}, {shape(CylinderForm{0.75, 1}), far}).collision_volume, 2 * tube, 1e-9);
}

TEST_F(Check, TheMeanDistanceIsThatOfTheReach) {
  const LinkCheck within = checked({cube(1)}, {cube(0.5)});
  EXPECT_EQ(within.mean_distance, 0);
  EXPECT_LT(within.reach.upper, 1e-3);
  // Of a slab of 2 x 2 x 0.5 around the middle, half of the surface or so is outside.
  const LinkCheck slab = checked({cube(1)}, {shape(BoxForm{{2, 2, 0.5}})});
  EXPECT_GT(slab.mean_distance, 0.1);
  EXPECT_LT(slab.mean_distance, slab.reach.upper);
}

// The numbers are those of docs; CGAL finds the same farthest points where it takes the collision mesh.
TEST_F(Check, FindsTheLeaksOfSharedRobots) {
  const std::filesystem::path motoman = std::filesystem::path(PROHULL_SHARED_ROBOTS) / "motoman";
  if (!std::filesystem::exists(motoman)) GTEST_SKIP() << "no robots in " << PROHULL_SHARED_ROBOTS;
  const auto of_file = [&](const std::string& name) { return shape(MeshFile{name, motoman / name, "", {1, 1, 1}}); };
  const LinkCheck open = checked({of_file("motoman_mh5_support/meshes/mh5/visual/MH5_T_AXIS.stl")},
                                 {of_file("motoman_mh5_support/meshes/mh5/collision/MH5_T_AXIS.stl")});
  EXPECT_EQ(open.verdict, CheckVerdict::Leaks);
  EXPECT_NEAR(open.sticks_out_at_least, 0.558e-3, 2e-6);
  EXPECT_LT(open.sticks_out_at_most, 0.565e-3);
  EXPECT_EQ(open.notes.size(), 1U) << "it is open";
  const LinkCheck equal = checked({of_file("motoman_sia20d_support/meshes/sia20d/visual/MOTOMAN_AXIS_T.stl")},
                                  {of_file("motoman_sia20d_support/meshes/sia20d/collision/MOTOMAN_AXIS_T.stl")});
  EXPECT_EQ(equal.verdict, CheckVerdict::Covered);
}

/// A prism over an arrowhead: tip, wing, notch, wing. The first two faces are its top.
TriangleMesh arrowhead() {
  TriangleMesh mesh =
      meshes::make({{0, 2, 0}, {-1, -1, 0}, {0, 0, 0}, {1, -1, 0}, {0, 2, -1}, {-1, -1, -1}, {0, 0, -1}, {1, -1, -1}},
                   {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}});
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    mesh.triangles.push_back({VertexId(i + 4), VertexId(j + 4), VertexId(j)});
    mesh.triangles.push_back({VertexId(i + 4), VertexId(j), VertexId(i)});
  }
  return mesh;
}

TEST(ConvexPairs, KeepsNoHullThatLeavesTheSolid) {
  const auto in_notch = [](double y) { return Triangle{{0, y, 0.01}, {0.01, y, 0.01}, {0, y, 0.02}}; };
  const TriangleMesh solid = arrowhead(), box = meshes::box({-1, -1, -1}, {1, 1, 0});
  verify::ConvexPairs pairs(solid), of_box(box);
  for (const FaceId f : solid.triangles.ids())
    EXPECT_GE(pairs.distance_at_most(f, in_notch(-0.5)), std::sqrt(0.125)) << "face " << index(f);
  double least = 1;
  for (std::uint32_t f = 0; f < 12; ++f) least = std::min(least, of_box.distance_at_most(FaceId(f), in_notch(-0.5)));
  EXPECT_NEAR(least, 0.02, 1e-12) << "two faces make up the top";
}

TEST(ConvexPairs, KeepsNoHullWithACavity) {
  const TriangleMesh hollow =
      meshes::together(meshes::tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}),
                       meshes::inside_out(meshes::tetrahedron({.1, .1, .1}, {.2, .1, .1}, {.1, .2, .1}, {.1, .1, .2})));
  verify::ConvexPairs pairs(hollow);
  for (const FaceId f : hollow.triangles.ids())
    EXPECT_GT(pairs.distance_at_most(f, {{.12, .12, .12}, {.13, .12, .12}, {.12, .13, .12}}), 0) << "face " << index(f);
}

Robot row_of_links(std::size_t count) {
  Robot robot;
  for (std::size_t i = 0; i < count; ++i)
    robot.links.push_back({"link" + std::to_string(i), {cube(1)}, {cube(0.9 + 0.02 * static_cast<double>(i))}, 0});
  return robot;
}

TEST_F(Check, TheResultDoesNotDependOnThreads) {
  const Robot robot = row_of_links(10);
  const auto one = check_links(robot, {.threads = 1}), many = check_links(robot, {.threads = 4});
  ASSERT_EQ(one.size(), 10U);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].link, i);
    EXPECT_EQ(one[i].verdict, i < 5 ? CheckVerdict::Leaks : CheckVerdict::Covered);
    EXPECT_EQ(many[i].verdict, one[i].verdict);
    EXPECT_EQ(many[i].sticks_out_at_most, one[i].sticks_out_at_most);
    EXPECT_EQ(many[i].worst_point, one[i].worst_point);
    EXPECT_EQ(many[i].mean_distance, one[i].mean_distance);
  }
}

TEST_F(Check, TellsLinksAndCanBeCancelled) {
  const Robot robot = row_of_links(3);
  double last = 0;
  check_links(robot, {.threads = 1, .progress = [&](std::string_view stage, double fraction) {
                        EXPECT_EQ(stage.substr(0, 4), "link");
                        EXPECT_GE(fraction, last);
                        last = fraction;
                        return true;
                      }});
  EXPECT_EQ(last, 1);
  EXPECT_THROW(check_links(robot, {.progress = [](std::string_view, double) { return false; }}), Cancelled);
}

}  // namespace
}  // namespace prohull::robot

#include "view/page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "meshes.h"
#include "prohull/enclosing_hull.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/sample.h"
#include "view/blocks.h"
#include "view/levels.h"
#include "view/robot.h"
#include "view/scene.h"
#include "view/shared_faces.h"

namespace prohull::view {
namespace {

ProgressiveHull small_hull() { return build_hull(make_sample("torus", 600), {.target_faces = 100}).hull; }

TEST(ViewBlocks, WritesBytesBySignificance) {
  Blocks blocks;
  const nlohmann::json first = blocks.plain(std::vector<std::uint32_t>{1, 0x203});
  const nlohmann::json second = blocks.plain(std::vector<std::uint32_t>{7});
  EXPECT_EQ(blocks.bytes(), std::string("\x01\x03\x00\x02\x07", 5));
  EXPECT_EQ(first["planes"], 2);
  EXPECT_EQ(second["at"], 4);
}

TEST(ViewBlocks, DifferencesOfBothSignsAreShort) {
  Blocks blocks;
  EXPECT_EQ(blocks.differences(std::vector<std::int32_t>{0, -1, 1, -2})["planes"], 1);
  EXPECT_EQ(blocks.bytes(), std::string("\x00\x01\x02\x03", 4));
  EXPECT_EQ(blocks.differences(std::vector<std::int32_t>{std::numeric_limits<std::int32_t>::min()})["planes"], 4);
}

TEST(ViewBlocks, RunningNumbersWrapAround) {
  Blocks blocks;
  blocks.running(std::vector<std::uint32_t>{0xffffffff, 0}, 1);
  EXPECT_EQ(blocks.bytes(), std::string("\x01\x02", 2));
}

TEST(ViewLevels, VolumesAreThoseOfTheLevels) {
  const ProgressiveHull hull = small_hull();
  const std::vector<double> volumes = volumes_of_levels(hull);
  ASSERT_EQ(volumes.size(), hull.splits().size() + 1);
  for (std::size_t k = 0; k < volumes.size(); k += 37) {
    const double volume = signed_volume(hull.level(hull.base_face_count() + 2 * k));
    EXPECT_NEAR(volumes[k], volume, 1e-9 * volume) << k;
  }
}

TEST(ViewLevels, FacesOfALevelAreThoseOfACoarserOneOrMadeSince) {
  const ProgressiveHull hull = small_hull();
  const auto points_of = [](const TriangleMesh& mesh) {
    std::set<std::array<double, 9>> faces;  // each face from its least corner on
    for (const FaceId f : mesh.triangles.ids()) {
      const Triangle t = mesh.triangle(f);
      std::array corners{std::array{t.a.x, t.a.y, t.a.z}, std::array{t.b.x, t.b.y, t.b.z},
                         std::array{t.c.x, t.c.y, t.c.z}};
      std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
      std::array<double, 9> all{};
      for (std::size_t i = 0; i < 9; ++i) all[i] = corners[i / 3][i % 3];
      faces.insert(all);
    }
    return faces;
  };
  MadeFaces made(hull);
  std::set<std::array<double, 9>> found = points_of(hull.base());
  for (const std::size_t splits : {std::size_t{7}, std::size_t{90}, hull.splits().size()}) {
    found.merge(points_of(made.until(splits)));
    for (const std::size_t level : {splits - 3, splits})
      EXPECT_TRUE(std::ranges::includes(found, points_of(hull.level(hull.base_face_count() + 2 * level)))) << level;
  }
  EXPECT_EQ(made.until(hull.splits().size()).face_count(), 0U);
}

TEST(ViewLevels, ABitForEachCornerThatASplitMeets) {
  const ProgressiveHull hull = small_hull();
  Blocks blocks;
  const PerVertex<double> distances(hull.positions().size(), 0);
  const nlohmann::json facts = levels_facts(hull, distances, Grid(bounding_box(hull.base())), blocks);
  EXPECT_EQ(facts["splits"], hull.splits().size());
  EXPECT_EQ(facts["triangles"]["count"], 3 * hull.base_face_count());
  EXPECT_GT(facts["split_bits"]["count"], 3 * hull.splits().size() / 8);
}

TEST(ViewSharedFaces, LeavesOutFacesWithTheSameCorners) {
  const TriangleMesh box = make_sample("box", 100);
  EXPECT_EQ(SharedFaces(box).left_out_of(box).face_count(), 0U);
  TriangleMesh moved = box;
  for (auto& face : moved.triangles) std::rotate(face.begin(), face.begin() + 1, face.end());
  moved.positions[moved.triangles[FaceId{5}][0]].x += 1e-9;
  EXPECT_GE(SharedFaces(box).left_out_of(moved).face_count(), 3U);
  EXPECT_LT(SharedFaces(box).left_out_of(moved).face_count(), box.face_count());
}

TEST(ViewGrid, KeepsCornersOfTheSceneAndHugeCoordinates) {
  const Grid grid(Box{{-1e308, 0, 0}, {1e308, 1, 1}});
  EXPECT_EQ(grid({-1e308, 0, 0})[0], 0);
  EXPECT_EQ(grid({1e308, 0, 0})[0], (1 << 30) - 1);
  EXPECT_EQ(Grid(Box{{5, 5, 5}, {5, 5, 5}})({5, 5, 5})[2], 0);
}

TEST(ViewRobot, SaysHowJointsMove) {
  robot::Robot robot{.name = "arm", .links = {{.name = "base"}, {.name = "hand"}}};
  robot.joints.push_back({.name = "wrist",
                          .type = robot::JointType::Revolute,
                          .parent = 0,
                          .child = 1,
                          .axis = {0, 0, 1},
                          .lower = 1,
                          .upper = 3});
  robot.joints.push_back({.name = "lift", .type = robot::JointType::Prismatic, .parent = 0, .child = 1});
  robot.joints[1].mimic = robot::Mimic{.joint = 0, .multiplier = 2, .offset = 0.5};
  const nlohmann::json joints = joint_facts(robot);
  EXPECT_EQ(joints[0]["motion"], "turn");
  EXPECT_EQ(joints[0]["lower"], 1);
  EXPECT_TRUE(joints[1]["upper"].is_null());
  EXPECT_EQ(joints[0]["rest"], 2);
  EXPECT_EQ(joints[1]["motion"], "slide");
  EXPECT_EQ(joints[1]["mimic"]["multiplier"], 2);
}

nlohmann::json verdict_of(Shown shown, const Original& original, const PageOptions& options = {}) {
  return scene_of({std::move(shown)}, original, options).facts["objects"][0]["verification"];
}

TEST(ViewScene, SaysNoMoreThanVerifyDoes) {
  const TriangleMesh box = make_sample("box", 100);
  Original finned{"finned.off", box};
  const VertexId a = finned.mesh.positions.push_back({0, 0, 0}), b = finned.mesh.positions.push_back({0.1, 0, 0}),
                 c = finned.mesh.positions.push_back({0, 0, 9});
  finned.mesh.triangles.push_back({a, b, c});
  finned.mesh.triangles.push_back({c, b, a});
  EXPECT_EQ(verdict_of({"hull.off", box}, finned)["told"], "hull.off does not enclose finned.off");
  const nlohmann::json solid = verdict_of({"hull.off", box}, finned, {.solid_only = true});
  EXPECT_EQ(solid["answer"], "yes");
  EXPECT_EQ(solid["told"], "hull.off encloses the solid of finned.off");

  const nlohmann::json levels = verdict_of({"h.phull", small_hull()}, {"torus", make_sample("torus", 600)});
  EXPECT_EQ(levels["told"], "every level of h.phull encloses torus");
  EXPECT_TRUE(levels.contains("self_intersections"));
  const nlohmann::json other = verdict_of({"h.phull", small_hull()}, {"box.off", box});
  EXPECT_EQ(other["answer"], "no");
  EXPECT_EQ(other["told"], "h.phull proves nothing about box.off");
  EXPECT_FALSE(other.contains("self_intersections")) << "nobody has counted them";
}

// Of a sphere whose top was pushed through its bottom, finer levels leave folds uncovered.
TEST(ViewScene, SaysOfWhichLevelsItIsKnown) {
  Original folded{"folded.obj", make_sample("sphere", 600)};
  *std::ranges::max_element(folded.mesh.positions, {}, &Vec3::z) = {0.03, 0.05, -1.001};
  const EnclosingHull hull = enclosing_hull(folded.mesh, 12, {.levels = true});
  const nlohmann::json found =
      verdict_of({"h.phull", hull.levels.value().with_finest_level(FinestLevel::Repaired)}, folded);
  EXPECT_EQ(found["answer"], "yes");
  EXPECT_EQ(found["told"], "the base mesh of h.phull encloses folded.obj, and every level its solid");
  EXPECT_EQ(found["every_level"], false);
}

// Three balls meet in one point of the triangle, with nothing to spare.
TEST(ViewScene, WhatIsUndecidedIsNotDenied) {
  Balls balls;
  for (const double turn : {1.0, 5.0, 9.0})
    balls.push_back({{std::cos(turn * std::numbers::pi / 6), std::sin(turn * std::numbers::pi / 6), 0}, 1});
  const TriangleMesh sheet{{{-0.5, -0.4, 0}, {0.5, -0.4, 0}, {0, 0.5, 0}}, {{VertexId{0}, VertexId{1}, VertexId{2}}}};
  const nlohmann::json found = verdict_of({"balls.yaml", balls}, {"sheet.off", sheet});
  EXPECT_EQ(found["answer"], "undecided");
  EXPECT_EQ(found["told"], "the union of 3 spheres may cover every triangle of sheet.off");
}

class ViewPage : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_page()) GTEST_SKIP() << "prohull was built without the page: node and npm are missing";
  }
};

TEST_F(ViewPage, HoldsNamesOnlyAsText) {
  const std::string name = "</script><script>alert(1)</script><!-- \xff.stl";
  const std::string text = page({{name, make_sample("box", 100)}}, std::nullopt, {});
  EXPECT_EQ(text.find("alert(1)</script>"), std::string::npos);
  EXPECT_EQ(text.find("<!-- "), std::string::npos);
  EXPECT_NE(text.find("\\u003c/script>\\u003cscript>alert(1)"), std::string::npos);
}

TEST_F(ViewPage, NamesNoOtherPlace) {
  const std::string text = page({{"hull.phull", small_hull()}}, std::nullopt, {.threads = 1});
  EXPECT_NE(text.find("default-src 'none'"), std::string::npos);
  for (const char* const element : {"src=\"http", "href=\"http", "@import", "<link"})
    EXPECT_EQ(text.find(element), std::string::npos) << element;
}

TEST_F(ViewPage, IsTheSameForAnyNumberOfThreads) {
  const Original original{"torus.ply", make_sample("torus", 600)};
  const std::vector<Shown> shown{{"hull.phull", small_hull()}, {"hull.stl", small_hull().base()}};
  EXPECT_EQ(page(shown, original, {.threads = 1}), page(shown, original, {.threads = 3}));
}

TEST_F(ViewPage, LeavesOutWhatIsNotFinite) {
  TriangleMesh mesh = make_sample("box", 100);
  const std::size_t faces = mesh.face_count();
  const VertexId v = mesh.positions.push_back({std::nan(""), 0, 0});
  mesh.triangles.push_back({v, v, v});
  const std::string text = page({{"broken.stl", mesh}}, std::nullopt, {});
  EXPECT_NE(text.find("\"left_out\":1"), std::string::npos);
  EXPECT_NE(text.find("\"faces\":" + std::to_string(faces)), std::string::npos);
  mesh.triangles = {{v, v, v}};
  EXPECT_THROW(page({{"nothing.stl", mesh}}, std::nullopt, {}), InputError);
}

TEST_F(ViewPage, TakesHugeCoordinates) {
  const TriangleMesh huge{{{1e300, 0, 0}, {0, 1e300, 0}, {0, 0, 1e300}}, {{VertexId{0}, VertexId{1}, VertexId{2}}}};
  EXPECT_NO_THROW(page({{"huge.stl", huge}}, std::nullopt, {}));
  EXPECT_NO_THROW(page({{"huge.stl", huge}}, Original{"box.stl", make_sample("box", 100)}, {}));
}

// Signed volumes would count the overlap twice, where `prohull verify` counts it once.
TEST_F(ViewPage, TellsVoidsOfLevelsWhereNothingOverlaps) {
  const TriangleMesh torus = make_sample("torus", 600);
  TriangleMesh crossed = torus;
  for (const Vec3& p : torus.positions) crossed.positions.push_back(p + Vec3{0.3, 0, 0});
  const auto offset = static_cast<std::uint32_t>(torus.vertex_count());
  for (const auto& [a, b, c] : torus.triangles)
    crossed.triangles.push_back(
        {VertexId(index(a) + offset), VertexId(index(b) + offset), VertexId(index(c) + offset)});
  const auto page_of = [](const TriangleMesh& mesh) {
    return page({{"hull.phull", build_hull(mesh, {.target_faces = 100}).hull}}, Original{"mesh.ply", mesh}, {});
  };
  EXPECT_NE(page_of(torus).find("\"void_ratios\":"), std::string::npos);
  EXPECT_EQ(page_of(crossed).find("\"void_ratios\":"), std::string::npos);
}

TEST_F(ViewPage, SaysWhyAHullCannotBeVerified) {
  TriangleMesh open = make_sample("box", 100);
  open.triangles.pop_back();
  const std::string text = page({{"open.stl", open}}, Original{"box.stl", make_sample("box", 100)}, {});
  EXPECT_NE(text.find("\"refused\":"), std::string::npos);
}

}  // namespace
}  // namespace prohull::view

#include "robot/hulls/link_hulls.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "effort.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "prohull/sample.h"
#include "prohull/union_verification.h"
#include "robot/hulls/cache.h"
#include "robot/motion/bodies.h"
#include "robot/transform.h"
#include "robot_folder.h"

namespace prohull::robot {
namespace {

/// A base with two meshes, an arm with one that is turned, a wheel that is a cylinder, and a frame.
class LinkHullsTest : public testing::Test {
 protected:
  LinkHullsTest() {
    folder_.add("torus.ply", make_sample("torus", 600));
    folder_.add("bracket.ply", make_sample("bracket", 600));
    robot_.name = "sample";
    robot_.links = {{.name = "base"}, {.name = "arm"}, {.name = "wheel"}, {.name = "tool0"}};
    robot_.links[0].visual = {mesh("torus.ply"), mesh("bracket.ply", translation_by({10, 0, 0}))};
    robot_.links[1].visual = {mesh("torus.ply", pose_of_rpy({0.1, 0.2, 0.3}, {1, 2, 3}))};
    robot_.links[2].visual = {{.form = CylinderForm{0.1, 0.05}}};
    options_.budget.faces = {200};
  }

  Shape mesh(const std::string& name, const Pose& origin = {}) const {
    return {.form = MeshFile{.uri = name, .path = folder_.path() / name}, .origin = origin};
  }

  /// The first links have a hull each.
  void expect_same_for_any_number_of_threads(std::size_t links) {
    options_.threads = 1;
    const std::vector<LinkHulls> one = link_hulls(robot_, options_);
    options_.threads = 3;
    const std::vector<LinkHulls> three = link_hulls(robot_, options_);
    for (std::size_t i = 0; i < links; ++i) EXPECT_EQ(one.at(i).hulls.at(0).mesh, three.at(i).hulls.at(0).mesh);
  }

  RobotFolder folder_;
  Robot robot_;
  LinkHullOptions options_;
};

TEST_F(LinkHullsTest, EncloseAllMeshesOfALink) {
  const std::vector<LinkHulls> made = link_hulls(robot_, options_);
  ASSERT_EQ(made.size(), 4U);
  EXPECT_EQ(made[0].status, LinkStatus::Hulled);
  EXPECT_FALSE(made[0].frame.same_origin_as);  // two origins: the frame of the link
  EXPECT_EQ(made[1].frame.same_origin_as, 0U);
  EXPECT_EQ(made[1].frame.in_link, robot_.links[1].visual[0].origin);
  for (const std::size_t link : {0U, 1U}) {
    ASSERT_EQ(made[link].hulls.size(), 1U);
    const LinkHull& hull = made[link].hulls[0];
    EXPECT_TRUE(hull.certified);
    EXPECT_LE(hull.mesh.face_count(), 200U);
    EXPECT_TRUE(verify_cover(made[link].triangles, hull.mesh).encloses);
    for (const Vec3& p : hull.mesh.positions) EXPECT_EQ(p.x, double(float(p.x)));  // as an STL file keeps it
    EXPECT_GT(hull.volume, made[link].sealed_volume);
    EXPECT_LT(hull.volume, made[link].convex_volume);
  }
  EXPECT_EQ(made[2].status, LinkStatus::Primitives);
  EXPECT_EQ(made[2].primitives, std::vector<std::size_t>{0});
  EXPECT_EQ(made[3].status, LinkStatus::Empty);
}

TEST_F(LinkHullsTest, AreTheSameForAnyNumberOfThreads) { expect_same_for_any_number_of_threads(2); }

TEST_F(LinkHullsTest, WithPaddingAreTheSameForAnyNumberOfThreads) {
  options_.budget.padding = 0.02;
  expect_same_for_any_number_of_threads(3);
}

TEST_F(LinkHullsTest, OfOtherBudgets) {
  options_.budgets["base"] = {.faces = {100}};
  options_.budgets["arm"] = {.faces = {200}, .skip = true};
  const std::vector<LinkHulls> made = link_hulls(robot_, options_);
  EXPECT_LE(made[0].hulls[0].mesh.face_count(), 100U);
  EXPECT_EQ(made[1].status, LinkStatus::Skipped);
  options_.budgets["elbow"] = {};
  EXPECT_THROW(link_hulls(robot_, options_), InputError);
}

TEST_F(LinkHullsTest, MayBeConvexPieces) {
  options_.budget.collision = Collision::Convex, options_.budget.pieces = effort(4, 2), options_.budget.vertices = 20;
  options_.cache = folder_.path() / "cache";
  const std::vector<LinkHulls> made = link_hulls(robot_, options_);
  EXPECT_EQ(made[1].frame.same_origin_as, 0U);
  for (const std::size_t link : {0U, 1U}) {
    ASSERT_EQ(made[link].hulls.size(), 1U);
    const LinkHull& cover = made[link].hulls[0];
    EXPECT_TRUE(cover.certified);
    EXPECT_EQ(cover.proof, "union");
    EXPECT_GE(cover.pieces.size(), 1U);
    EXPECT_LE(cover.pieces.size(), 4U);
    for (const TriangleMesh& piece : cover.pieces) {
      EXPECT_LE(piece.vertex_count(), 20U);
      for (const Vec3& p : piece.positions) EXPECT_EQ(p.x, double(float(p.x)));  // as an STL file keeps it
    }
    EXPECT_TRUE(verify_cover(made[link].triangles, cover.mesh).encloses);
    EXPECT_GT(cover.volume, 0.999 * made[link].sealed_volume);
  }
  EXPECT_EQ(made[2].status, LinkStatus::Primitives);

  const std::vector<LinkHulls> again = link_hulls(robot_, options_);
  EXPECT_TRUE(again[0].from_cache);
  EXPECT_EQ(again[0].hulls[0].pieces, made[0].hulls[0].pieces);
  EXPECT_EQ(again[0].hulls[0].mesh, made[0].hulls[0].mesh);
}

TEST_F(LinkHullsTest, MayBeSpheresInTheFrameOfTheLink) {
  robot_.links[2].visual.push_back({.form = SphereForm{0.2}});
  options_.budget.collision = Collision::Spheres, options_.budget.spheres = 10;
  options_.cache = folder_.path() / "cache";
  folder_.add("torus.ply", make_sample("torus", 200));
  folder_.add("bracket.ply", make_sample("bracket", 200));
  const std::vector<LinkHulls> made = link_hulls(robot_, options_);
  for (const std::size_t link : {0U, 1U, 2U}) {  // the cylinder of the wheel has spheres too
    ASSERT_EQ(made[link].hulls.size(), 1U);
    EXPECT_EQ(made[link].frame.in_link, Pose{});
    const LinkHull& cover = made[link].hulls[0];
    EXPECT_TRUE(cover.certified);
    EXPECT_EQ(cover.proof, "union");
    EXPECT_GE(cover.balls.size(), 1U);
    EXPECT_LE(cover.balls.size(), 10U);
    EXPECT_TRUE(verify_union(cover.balls, made[link].triangles, false).covers);
    ASSERT_TRUE(is_closed(cover.mesh));  // a mesh around each ball
    EXPECT_GT(signed_volume(cover.mesh), cover.volume);
  }
  EXPECT_EQ(made[2].primitives, std::vector<std::size_t>{1});  // a sphere is one already

  const std::vector<LinkHulls> again = link_hulls(robot_, options_);
  EXPECT_TRUE(again[0].from_cache);
  EXPECT_EQ(again[0].hulls[0].balls, made[0].hulls[0].balls);
  EXPECT_EQ(again[0].hulls[0].mesh, made[0].hulls[0].mesh);
}

TEST_F(LinkHullsTest, RefuseWhatOnlyHullsCanHave) {
  const auto refused = [&](const char* expected) {
    try {
      link_hulls(robot_, options_);
      ADD_FAILURE() << "not refused: " << expected;
    } catch (const InputError& error) {
      EXPECT_EQ(error.defect(), Defect::InvalidOption);
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  };
  options_.budgets["arm"] = {.collision = Collision::Convex, .padding = 0.001};
  refused("link arm: collision 'convex' takes no padding");
  options_.budgets["arm"] = {.collision = Collision::Spheres, .faces = {500, 100}};
  refused("link arm: collision 'spheres' comes in one set");
  options_.budgets.clear();
  options_.budget.collision = Collision::Spheres, options_.tight = true;
  refused("--tight is about hulls");
}

TEST_F(LinkHullsTest, SayWhichMeshesAreMissing) {
  robot_.links[1].visual[0].form = MeshFile{.uri = "package://p/arm.stl", .why_not = "package://p/arm.stl: not there"};
  try {
    link_hulls(robot_, options_);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.defect(), Defect::CannotRead);
    EXPECT_NE(std::string(error.what()).find("link arm: package://p/arm.stl: not there"), std::string::npos);
  }
  options_.skip_missing = true;
  const std::vector<LinkHulls> made = link_hulls(robot_, options_);
  EXPECT_EQ(made[1].status, LinkStatus::Skipped);
  EXPECT_EQ(made[1].why, "package://p/arm.stl: not there");
  EXPECT_TRUE(made[0].hulls[0].certified);
}

TEST_F(LinkHullsTest, NameTheLinkOfABadMesh) {
  std::ofstream(folder_.path() / "bad.stl") << "solid nothing";
  robot_.links[1].visual = {mesh("bad.stl")};
  try {
    link_hulls(robot_, options_);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("link arm: "), 0U) << error.what();
  }
}

TEST_F(LinkHullsTest, AreSharedByLinksWithTheSameGeometry) {
  robot_.links[1].visual = robot_.links[0].visual;
  const std::vector<LinkHulls> made = link_hulls(robot_, options_);
  EXPECT_GT(made[0].seconds, 0);
  EXPECT_EQ(made[1].seconds, 0);
  EXPECT_EQ(made[1].link, 1U);
  EXPECT_EQ(made[1].hulls[0].mesh, made[0].hulls[0].mesh);
  EXPECT_EQ(made[1].triangles, made[0].triangles);
  EXPECT_EQ(made[1].sealed_volume, made[0].sealed_volume);

  options_.budgets["arm"] = options_.budget;
  options_.budgets["arm"].faces = {60};
  EXPECT_EQ(link_hulls(robot_, options_)[1].hulls[0].target_faces, 60U);
}

TEST_F(LinkHullsTest, ComeFromTheCacheWhileNothingChanges) {
  options_.cache = folder_.path() / "cache";
  const std::vector<LinkHulls> first = link_hulls(robot_, options_), second = link_hulls(robot_, options_);
  EXPECT_FALSE(first[0].from_cache);
  EXPECT_TRUE(second[0].from_cache);
  EXPECT_EQ(second[0].hulls[0].mesh, first[0].hulls[0].mesh);
  EXPECT_EQ(second[0].hulls[0].distance.upper, first[0].hulls[0].distance.upper);
  EXPECT_EQ(second[0].sealed_volume, first[0].sealed_volume);
  EXPECT_EQ(second[0].triangles, first[0].triangles);

  folder_.add("bracket.ply", make_sample("bracket", 700));  // which the base has, and the arm has not
  const std::vector<LinkHulls> third = link_hulls(robot_, options_);
  EXPECT_FALSE(third[0].from_cache);
  EXPECT_TRUE(third[1].from_cache);
}

TEST_F(LinkHullsTest, HaveAKeyOfAllThatTheyAreMadeFrom) {
  Link& link = robot_.links[0];
  link.visual.push_back({.form = CylinderForm{0.1, 0.05}});
  const auto key = [&] { return key_of(link, options_.budget, options_); };
  const std::string before = key();
  const Link link_before = link;
  const LinkHullOptions options_before = options_;
  const auto change = [&](const char* what, const auto& by) {
    by();
    EXPECT_NE(key(), before) << what;
    link = link_before, options_ = options_before;
    EXPECT_EQ(key(), before) << what;
  };
  change("origin", [&] { link.visual[1].origin = translation_by({10, 0, 1e-9}); });
  change("scale", [&] { std::get<MeshFile>(link.visual[0].form).scale.y = 2; });
  change("size of a primitive", [&] { link.visual[2].form = CylinderForm{0.1, 0.06}; });
  change("faces", [&] { options_.budget.faces = {201}; });
  change("numbers of faces", [&] { options_.budget.faces = {200, 100}; });
  change("collision", [&] { options_.budget.collision = Collision::Convex; });
  change("pieces", [&] { options_.budget.pieces = 9; });
  change("vertices", [&] { options_.budget.vertices = 65; });
  change("spheres", [&] { options_.budget.spheres = 65; });
  change("max_distance", [&] { options_.budget.max_distance = 0.1; });
  change("padding", [&] { options_.budget.padding = 0.1; });
  change("format", [&] { options_.format = "obj"; });
  change("tight", [&] { options_.tight = true; });
  change("from", [&] { options_.from = Geometry::Collision; });
  options_.threads = 3;
  EXPECT_EQ(key(), before);
  folder_.add("bracket.ply", make_sample("bracket", 700));
  EXPECT_NE(key(), before);
}

TEST_F(LinkHullsTest, LeaveTheCacheWhenNobodyUsesThem) {
  using std::filesystem::file_time_type;
  const std::filesystem::path folder = folder_.path() / "cache";
  const HullCache cache(folder);
  const auto key = [](char digit) { return std::string(32, digit); };
  const auto age = [&](const std::string& name, std::chrono::hours time) {
    last_write_time(folder / name, file_time_type::clock::now() - time);
  };
  for (const char digit : {'1', '2', '3'}) cache.keep(key(digit), {});
  for (const char* name : {".1.0.unfinished", ".2.0.unfinished"}) std::ofstream(folder / (key('4') + name)) << "half";
  std::ofstream(folder / "mine.cbor") << "not of the cache";
  for (const char digit : {'1', '2'}) age(key(digit) + ".cbor", std::chrono::hours(24 * 91));
  age(key('3') + ".cbor", std::chrono::hours(24 * 89));
  age(key('4') + ".1.0.unfinished", std::chrono::hours(2));
  age("mine.cbor", std::chrono::hours(24 * 91));
  EXPECT_TRUE(cache.find(key('1')));  // which is a use
  cache.keep(key('5'), {});
  EXPECT_TRUE(cache.find(key('1')) && cache.find(key('3')) && cache.find(key('5')));
  EXPECT_FALSE(cache.find(key('2')));
  EXPECT_FALSE(exists(folder / (key('4') + ".1.0.unfinished")));
  EXPECT_TRUE(exists(folder / (key('4') + ".2.0.unfinished")));  // another run may be writing it
  EXPECT_TRUE(exists(folder / "mine.cbor"));
}

TEST_F(LinkHullsTest, DoNotComeFromADamagedCache) {
  options_.cache = folder_.path() / "cache";
  const std::vector<LinkHulls> first = link_hulls(robot_, options_);
  for (const auto& entry : std::filesystem::directory_iterator(options_.cache)) {
    std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-100, std::ios::end);
    file.put('x').put('y').put('z');
  }
  const std::vector<LinkHulls> second = link_hulls(robot_, options_);
  EXPECT_FALSE(second[0].from_cache);
  EXPECT_EQ(second[0].hulls[0].mesh, first[0].hulls[0].mesh);
}

TEST_F(LinkHullsTest, AreCancelled) {
  options_.progress = [](std::string_view, double) { return false; };
  robot_.links[0].visual = {mesh("torus.ply")};
  folder_.add("torus.ply", make_sample("torus", 100'000));
  EXPECT_THROW(link_hulls(robot_, options_), Cancelled);
}

TEST_F(LinkHullsTest, StandForTheBodiesOfTheRobot) {
  const std::vector<LinkHulls> made = link_hulls(robot_, options_);
  const Bodies bodies = bodies_of(robot_, made, Geometry::Visual);
  ASSERT_EQ(bodies.hull.size(), 4U);
  EXPECT_EQ(bodies.visual[0], made[0].triangles);
  EXPECT_EQ(bodies.visual[1], placed(made[1].frame.in_link, made[1].triangles));
  EXPECT_EQ(bodies.hull[2], bodies.visual[2]);
  EXPECT_EQ(bodies.hull[3].face_count(), 0U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(verify_cover(bodies.visual[i], bodies.convex[i]).encloses);
}

TEST_F(LinkHullsTest, ThatAreNotCertifiedAreNoBodies) {
  std::vector<LinkHulls> made = link_hulls(robot_, options_);
  made[0].hulls[0].certified = false;
  const Bodies bodies = bodies_of(robot_, made, Geometry::Visual);
  EXPECT_EQ(bodies.hull[0].face_count(), 0U);
  EXPECT_EQ(bodies.visual[0], made[0].triangles);
  EXPECT_GT(bodies.hull[1].face_count(), 0U);
}

TEST_F(LinkHullsTest, WithPaddingEncloseThePrimitivesToo) {
  options_.budget.padding = 0.02;
  const std::vector<LinkHulls> made = link_hulls(robot_, options_);
  EXPECT_EQ(made[2].status, LinkStatus::Hulled);
  EXPECT_TRUE(made[2].primitives.empty());
  for (const std::size_t link : {0U, 1U, 2U}) {
    EXPECT_TRUE(made[link].hulls[0].certified);
    EXPECT_GE(made[link].hulls[0].padding, 0.02);
  }
}

}  // namespace
}  // namespace prohull::robot

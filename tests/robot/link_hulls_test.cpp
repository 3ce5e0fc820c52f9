#include "robot/hulls/link_hulls.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>

#include "effort.h"
#include "input_error.h"
#include "io/compressing.h"
#include "meshes.h"
#include "prohull/convex_hull.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "prohull/sample.h"
#include "prohull/union_verification.h"
#include "random.h"
#include "robot/hulls/cache.h"
#include "robot/hulls/verdict.h"
#include "robot/motion/bodies.h"
#include "robot/robot_testing.h"
#include "robot/transform.h"
#include "robot_folder.h"
#include "robot_testing.h"

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
    EXPECT_TRUE(hull.certified());
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
    EXPECT_TRUE(cover.certified());
    EXPECT_EQ(cover.verdict.proof, "union");
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
    EXPECT_TRUE(cover.certified());
    EXPECT_EQ(cover.verdict.proof, "union");
    EXPECT_GE(cover.balls.size(), 1U);
    EXPECT_LE(cover.balls.size(), 10U);
    EXPECT_TRUE(verify_union(cover.balls, made[link].triangles, false).certified);
    ASSERT_TRUE(is_closed(cover.mesh));  // a mesh around each ball
    EXPECT_GT(signed_volume(cover.mesh), cover.volume);
  }
  EXPECT_EQ(made[2].primitives, std::vector<std::size_t>{1});  // a sphere is one already

  const std::vector<LinkHulls> again = link_hulls(robot_, options_);
  EXPECT_TRUE(again[0].from_cache);
  EXPECT_EQ(again[0].hulls[0].balls, made[0].hulls[0].balls);
  EXPECT_EQ(again[0].hulls[0].mesh, made[0].hulls[0].mesh);
}

TEST_F(LinkHullsTest, RefuseWhatTheirKindCannotHave) {
  const auto refused = [&](const char* expected) {
    const std::string refusal = refusal_of([&] { link_hulls(robot_, options_); }, Defect::InvalidOption);
    EXPECT_TRUE(has(refusal, expected)) << refusal << ", not " << expected;
  };
  options_.budgets["arm"] = {.collision = Collision::Convex, .padding = 0.001};
  refused("link arm: collision 'convex' takes no gap");
  options_.budgets["arm"] = {.collision = Collision::Spheres, .faces = {500, 100}};
  refused("link arm: collision 'spheres' comes in one set");
  options_.budgets["arm"] = {.collision = Collision::Spheres, .spheres = 100'001};
  refused("link arm: there are at most 100,000 spheres of a link, not 100001");
  options_.budgets.clear();
  options_.budget.collision = Collision::Spheres, options_.tight = true;
  refused("--tight is about hulls");
}

TEST_F(LinkHullsTest, TellTheLinkOfAnImpossibleBudgetOfItsOwn) {
  const auto refusal = [&] { return refusal_of([&] { link_hulls(robot_, options_); }, Defect::InvalidOption); };
  const std::string why = "a hull that keeps a gap of 0.005 is farther than 0.005 from its link";
  options_.budgets["arm"] = {.max_distance = 0.005, .padding = 0.005};
  EXPECT_EQ(refusal().rfind("link arm: " + why, 0), 0U) << refusal();
  options_.budget = options_.budgets["arm"];
  options_.budgets.clear();
  EXPECT_EQ(refusal().rfind(why, 0), 0U) << refusal();
}

TEST_F(LinkHullsTest, SayWhichMeshesAreMissing) {
  robot_.links[1].visual[0].form = MeshFile{.uri = "package://p/arm.stl", .why_not = "package://p/arm.stl: not there"};
  const std::string refusal = refusal_of([&] { link_hulls(robot_, options_); }, Defect::CannotRead);
  EXPECT_TRUE(has(refusal, "link arm: package://p/arm.stl: not there")) << refusal;
  options_.skip_missing = true;
  const std::vector<LinkHulls> made = link_hulls(robot_, options_);
  EXPECT_EQ(made[1].status, LinkStatus::Skipped);
  EXPECT_EQ(made[1].why, "package://p/arm.stl: not there");
  EXPECT_TRUE(made[0].hulls[0].certified());
}

TEST_F(LinkHullsTest, NameTheLinkOfABadMesh) {
  std::ofstream(folder_.path() / "bad.stl") << "solid nothing";
  robot_.links[1].visual = {mesh("bad.stl")};
  const std::string refusal = error_of([&] { link_hulls(robot_, options_); }).what();
  EXPECT_TRUE(refusal.starts_with("link arm: ")) << refusal;
}

TEST_F(LinkHullsTest, OfOpenMeshesAreMeasuredFromTheirTrianglesAloneToo) {
  TriangleMesh bucket = meshes::box({0, 0, 0}, {1, 1, 1});
  bucket.triangles.pop_back(), bucket.triangles.pop_back();
  folder_.add("bucket.ply", bucket);
  robot_.links[0].visual = {mesh("bucket.ply")};
  for (const Collision kind : {Collision::Hull, Collision::Convex, Collision::Spheres}) {
    options_.budget.collision = kind;
    const std::vector<LinkHulls> made = link_hulls(robot_, options_);
    const LinkHull &open = made[0].hulls[0], &closed = made[1].hulls[0];
    EXPECT_TRUE(open.has_openings() && open.certified());
    EXPECT_GE(open.verdict.distance_to_triangles->upper,
              kind == Collision::Spheres ? open.verdict.distance().upper : 0.49);
    EXPECT_LT(open.verdict.distance().upper, 0.4);
    EXPECT_FALSE(closed.has_openings());
    EXPECT_EQ(closed.verdict.distance_to_triangles->upper, closed.verdict.distance().upper);
    EXPECT_NEAR(made[0].sealed_volume, 1, 1e-12);
  }
}

TEST_F(LinkHullsTest, CountTrianglesThatAreLeftOut) {
  write_file(folder_.path() / "broken.obj",
             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv nan 0 0\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 1 2 5\n");
  robot_.links[0].visual = robot_.links[1].visual = {mesh("broken.obj")};
  const std::vector<LinkHulls> made = link_hulls(robot_, options_);
  EXPECT_EQ(made[0].non_finite_faces, 1U);
  EXPECT_EQ(made[1].non_finite_faces, 1U);
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
  EXPECT_EQ(second[0].hulls[0].verdict.distance().upper, first[0].hulls[0].verdict.distance().upper);
  EXPECT_EQ(second[0].sealed_volume, first[0].sealed_volume);
  EXPECT_EQ(second[0].triangles, first[0].triangles);

  folder_.add("bracket.ply", make_sample("bracket", 700));  // which the base has, and the arm has not
  const std::vector<LinkHulls> third = link_hulls(robot_, options_);
  EXPECT_FALSE(third[0].from_cache);
  EXPECT_TRUE(third[1].from_cache);
}

TEST_F(LinkHullsTest, HaveAKeyOfAllThatTheyAreMadeFrom) {
  TriangleMesh triangles = make_sample("torus", 600);
  const auto key = [&] { return key_of(triangles, options_.budget, options_); };
  const std::string before = key();
  const TriangleMesh triangles_before = triangles;
  const LinkHullOptions options_before = options_;
  const auto change = [&](const char* what, const auto& by) {
    by();
    EXPECT_NE(key(), before) << what;
    triangles = triangles_before, options_ = options_before;
    EXPECT_EQ(key(), before) << what;
  };
  change("a vertex", [&] { triangles.positions[VertexId{7}].x += 1e-9; });
  change("a face", [&] { std::swap(triangles.triangles[FaceId{7}][0], triangles.triangles[FaceId{7}][1]); });
  change("faces", [&] { options_.budget.faces = {201}; });
  change("numbers of faces", [&] { options_.budget.faces = {200, 100}; });
  change("collision", [&] { options_.budget.collision = Collision::Convex; });
  change("pieces", [&] { options_.budget.pieces = 9; });
  change("vertices", [&] { options_.budget.vertices = 65; });
  change("spheres", [&] { options_.budget.spheres = 65; });
  change("max_distance", [&] { options_.budget.max_distance = 0.1; });
  change("padding", [&] { options_.budget.padding = 0.1; });
  change("tight", [&] { options_.tight = true; });
  options_.threads = 3;
  EXPECT_EQ(key(), before);
}

/// A glTF file with its numbers in part.bin, gzipped, and in capitals.
TEST_F(LinkHullsTest, HaveAKeyOfWhatOtherFilesHold) {
  const auto positions = [](double size) {
    std::string bytes;
    for (const TriangleMesh box = make_sample("box", 12); const auto& corners : box.triangles)
      for (const VertexId v : corners)
        for (int axis = 0; axis < 3; ++axis) {
          const auto number = static_cast<float>(size * box.positions[v][axis]);
          bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
        }
    return bytes;
  };
  const std::string gltf =
      R"({"asset":{"version":"2.0"},"buffers":[{"uri":"part.bin","byteLength":432}],"bufferViews":[{"buffer":0,)"
      R"("byteLength":432}],"accessors":[{"bufferView":0,"componentType":5126,"count":36,"type":"VEC3"}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]})";
  for (const char* name : {"part.gltf", "part.GLTF", "part.gltf.gz"}) {
    write_file(folder_.path() / "part.bin", positions(1));
    write_file(folder_.path() / name, std::string_view(name).ends_with(".gz") ? gzipped(gltf) : gltf);
    options_.cache = folder_.path() / "cache", options_.budget.faces = {12};
    robot_.links = {{.name = "part", .visual = {mesh(name)}}};
    link_hulls(robot_, options_);
    write_file(folder_.path() / "part.bin", positions(2));
    const LinkHulls made = link_hulls(robot_, options_)[0];
    ASSERT_EQ(made.hulls.size(), 1U) << name;
    EXPECT_TRUE(made.hulls[0].certified());
    EXPECT_TRUE(verify_cover(read_mesh(folder_.path() / name), made.hulls[0].mesh).encloses) << name;
  }
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
  std::ofstream(folder / "mine.hulls") << "not of the cache";
  for (const char digit : {'1', '2'}) age(key(digit) + ".hulls", std::chrono::hours(24 * 91));
  age(key('3') + ".hulls", std::chrono::hours(24 * 89));
  age(key('4') + ".1.0.unfinished", std::chrono::hours(2));
  age("mine.hulls", std::chrono::hours(24 * 91));
  EXPECT_TRUE(cache.find(key('1')));  // which is a use
  cache.keep(key('5'), {});
  EXPECT_TRUE(cache.find(key('1')) && cache.find(key('3')) && cache.find(key('5')));
  EXPECT_FALSE(cache.find(key('2')));
  EXPECT_FALSE(exists(folder / (key('4') + ".1.0.unfinished")));
  EXPECT_TRUE(exists(folder / (key('4') + ".2.0.unfinished")));  // another run may be writing it
  EXPECT_TRUE(exists(folder / "mine.hulls"));
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

/// The hulls of the arm as a cache file may have them, with a right checksum.
class ForgedCacheTest : public LinkHullsTest {
 protected:
  ForgedCacheTest() {
    options_.cache = folder_.path() / "cache";
    robot_.links.erase(robot_.links.begin());
  }

  /// Whether `forge` makes the cache useless, and the hulls come out as they were without it.
  template <class Forge>
  void expect_made_anew(const char* what, Forge forge) {
    if (!made_) made_ = link_hulls(robot_, options_)[0];
    LinkHulls kept = *made_;
    forge(kept);
    HullCache(options_.cache).keep(key_of(made_->triangles, options_.budget, options_), kept.hulls);
    const LinkHulls again = link_hulls(robot_, options_)[0];
    EXPECT_FALSE(again.from_cache) << what;
    ASSERT_EQ(again.hulls.size(), made_->hulls.size()) << what;
    EXPECT_TRUE(again.hulls[0].certified()) << what;
    EXPECT_EQ(again.hulls[0].mesh, made_->hulls[0].mesh) << what;
    EXPECT_EQ(again.hulls[0].verdict.distance().upper, made_->hulls[0].verdict.distance().upper) << what;
    EXPECT_TRUE(link_hulls(robot_, options_)[0].from_cache) << what;
  }

  static TriangleMesh large_box() {
    TriangleMesh box = make_sample("box", 12);
    for (Vec3& p : box.positions)
      for (int axis = 0; axis < 3; ++axis) p[axis] = std::copysign(64, p[axis]);
    return box;
  }

  std::optional<LinkHulls> made_;
};

TEST_F(ForgedCacheTest, OfHulls) {
  const auto mesh_of_first = [](LinkHulls& kept) -> TriangleMesh& { return kept.hulls[0].mesh; };
  expect_made_anew("shrunk vertices", [&](LinkHulls& kept) {
    for (Vec3& p : mesh_of_first(kept).positions) p = p / 2;
  });
  expect_made_anew("a corner that does not exist",
                   [&](LinkHulls& kept) { mesh_of_first(kept).triangles[FaceId{0}][1] = VertexId{1U << 31U}; });
  expect_made_anew("a coordinate that is none",
                   [&](LinkHulls& kept) { mesh_of_first(kept).positions[VertexId{3}].y = std::nan(""); });
  expect_made_anew("a coordinate that no STL file keeps",
                   [&](LinkHulls& kept) { mesh_of_first(kept).positions[VertexId{3}].y += 1e-12; });
  expect_made_anew("huge coordinates", [&](LinkHulls& kept) {
    for (Vec3& p : mesh_of_first(kept).positions) p = 1e300 * p;
  });
  expect_made_anew("an open hull", [&](LinkHulls& kept) {
    mesh_of_first(kept).triangles[FaceId{0}] = kept.hulls[0].mesh.triangles[FaceId{1}];
  });
  expect_made_anew("a hull inside out", [&](LinkHulls& kept) {
    for (auto& corners : mesh_of_first(kept).triangles) std::swap(corners[0], corners[1]);
  });
  expect_made_anew("too many faces", [&](LinkHulls& kept) { append(mesh_of_first(kept), make_sample("torus", 600)); });
  expect_made_anew("no hull", [](LinkHulls& kept) { kept.hulls.clear(); });
  expect_made_anew("another number of faces", [](LinkHulls& kept) { kept.hulls[0].target_faces = 100; });
  expect_made_anew("another source", [](LinkHulls& kept) { kept.hulls[0].source = "a proof"; });
  expect_made_anew("pieces in place of a hull", [](LinkHulls& kept) { kept.hulls[0].pieces = {kept.hulls[0].mesh}; });
}

TEST_F(ForgedCacheTest, OfHullsThatKeepADistance) {
  options_.budget.max_distance = 0.2, options_.budget.faces = {20};
  expect_made_anew("a hull farther away", [](LinkHulls& kept) { kept.hulls[0].mesh = large_box(); });
}

TEST_F(ForgedCacheTest, OfPaddedHulls) {
  options_.budget.padding = 0.0625;
  expect_made_anew("less padding", [](LinkHulls& kept) { kept.hulls[0].padding = 0.03125; });
  expect_made_anew("more padding than there is", [](LinkHulls& kept) { kept.hulls[0].padding = 1; });
}

TEST_F(ForgedCacheTest, OfConvexPieces) {
  options_.budget.collision = Collision::Convex, options_.budget.pieces = 2, options_.budget.vertices = 20;
  expect_made_anew("a shrunk piece", [](LinkHulls& kept) {
    for (Vec3& p : kept.hulls[0].pieces[0].positions) p = p / 2;
  });
  expect_made_anew("a piece too many",
                   [](LinkHulls& kept) { kept.hulls[0].pieces.resize(3, kept.hulls[0].pieces[0]); });
  expect_made_anew("a piece that is not convex", [](LinkHulls& kept) {
    TriangleMesh piece = large_box();
    append(piece, placed(translation_by({256, 0, 0}), meshes::octahedron()));
    kept.hulls[0].pieces = {piece};
  });
  expect_made_anew("a piece inside out", [](LinkHulls& kept) {
    for (auto& corners : kept.hulls[0].pieces[0].triangles) std::swap(corners[0], corners[1]);
  });
}

TEST_F(ForgedCacheTest, OfSpheres) {
  options_.budget.collision = Collision::Spheres, options_.budget.spheres = 6;
  folder_.add("torus.ply", make_sample("torus", 200));
  expect_made_anew("a smaller sphere", [](LinkHulls& kept) { kept.hulls[0].balls[0].radius /= 2; });
  expect_made_anew("a sphere inside out", [](LinkHulls& kept) { kept.hulls[0].balls[0].radius *= -1; });
  expect_made_anew("too many spheres", [](LinkHulls& kept) { kept.hulls[0].balls.resize(7, kept.hulls[0].balls[0]); });
}

TEST_F(LinkHullsTest, HaveTheSameVolumeWithAndWithoutTheCache) {
  options_.cache = folder_.path() / "cache";
  TriangleMesh bucket = meshes::box({0, 0, 0}, {1, 1, 1});
  bucket.triangles.pop_back(), bucket.triangles.pop_back();
  const TriangleMesh cube = meshes::box({-1, -1, -1}, {1, 1, 1}), small = meshes::scaled(cube, 0.5);
  folder_.add("bucket.ply", bucket);
  folder_.add("hollow.ply", meshes::together(cube, meshes::inside_out(small)));
  folder_.add("overlapping.ply", meshes::together(cube, meshes::moved(small, {1, 0.1, 0.2})));
  folder_.add("fan.ply", meshes::together(cube, meshes::make({{0, 0, 0}, {2, 0, 0}, {0, 3, 0}}, {{0, 1, 2}})));
  const std::array names{"bucket.ply", "hollow.ply", "overlapping.ply", "fan.ply"};
  for (std::size_t i = 0; i < names.size(); ++i) robot_.links[i].visual = {mesh(names[i])};
  for (const Collision kind : {Collision::Hull, Collision::Convex, Collision::Spheres}) {
    options_.budget.collision = kind;
    const std::vector<LinkHulls> made = link_hulls(robot_, options_), again = link_hulls(robot_, options_);
    for (std::size_t i = 0; i < names.size(); ++i) {
      EXPECT_TRUE(again[i].from_cache) << names[i];
      EXPECT_EQ(again[i].sealed_volume, made[i].sealed_volume) << names[i];
    }
  }
}

TEST_F(ForgedCacheTest, TellsNothingThatAFileSays) {
  const LinkHulls made = link_hulls(robot_, options_)[0];
  LinkHulls kept = made;
  kept.sealed_volume = 0.001, kept.hulls[0].notes = {"no point is nearer than 5"};
  HullCache(options_.cache).keep(key_of(made.triangles, options_.budget, options_), kept.hulls);
  const LinkHulls again = link_hulls(robot_, options_)[0];
  EXPECT_TRUE(again.from_cache);
  EXPECT_EQ(again.sealed_volume, made.sealed_volume);
  EXPECT_EQ(
      again.hulls[0].notes,
      std::vector<std::string>{"it is from the cache: 1 note on its construction is told only when it is built anew"});
}

/// A file may say anything, with a right checksum.
TEST_F(ForgedCacheTest, OfOtherText) {
  const HullCache cache(options_.cache);
  std::filesystem::create_directories(options_.cache);
  const std::string key(32, '7');
  for (const std::string& text : {std::string(), std::string("null"), std::string("{}"), std::string(R"({"hulls":3})"),
                                  std::string(R"({"hulls":[3]})"), std::string(R"({"hulls":[{}]})"),
                                  std::string(1'000'000, '['), std::string("\xff\x00", 2)}) {
    Fingerprint checksum;
    checksum.add(text);
    write_file(options_.cache / (key + ".hulls"), checksum.text() + text);
    EXPECT_FALSE(cache.find(key)) << text.substr(0, 40);
  }
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

TEST_F(LinkHullsTest, AreFilledWhereTheRobotFillsMeshes) {
  robot_.links[0].visual = {mesh("torus.ply")};
  folder_.add("torus.ply", make_sample("torus", 1'000));
  const std::vector<LinkHulls> made = link_hulls(robot_, options_);
  const TriangleMesh hull = bodies_of(robot_, made, Geometry::Visual).hull[0];
  robot_.fills_collision_meshes = true;
  EXPECT_EQ(bodies_of(robot_, made, Geometry::Visual).hull[0], convex_hull(hull));
  EXPECT_GT(signed_volume(convex_hull(hull)), 1.1 * signed_volume(hull));
  const auto certified = certified_bodies(
      robot_, made, std::vector<HullFiles>{{.link = 0, .stem = "a", .meshes = {"a.stl"}}}, Geometry::Visual);
  EXPECT_EQ(certified[0]->stl, "") << "the file has the hull that is not filled";
}

TEST_F(LinkHullsTest, ThatAreNotCertifiedAreNoBodies) {
  std::vector<LinkHulls> made = link_hulls(robot_, options_);
  made[0].hulls[0].verdict.certified = false;
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
    EXPECT_TRUE(made[link].hulls[0].certified());
    EXPECT_GE(made[link].hulls[0].padding, 0.02);
  }
}

/// Links of curved forms. Corners of a hull are its farthest points from a convex form.
class CurvedLinksTest : public LinkHullsTest {
 protected:
  CurvedLinksTest() { options_.budget.padding = 0.002; }

  void make_links(const std::vector<std::vector<Shape>>& visual) {
    robot_.links.clear();
    for (std::size_t i = 0; i < visual.size(); ++i)
      robot_.links.push_back({.name = fmt::format("link{}", i), .visual = visual[i]});
  }

  /// The hulls of the first link, as they are built and as a second run has them.
  std::vector<LinkHulls> built_and_from_cache() {
    options_.cache = folder_.path() / "cache";
    std::vector<LinkHulls> runs;
    for (const bool from_cache : {false, true}) {
      runs.push_back(link_hulls(robot_, options_).at(0));
      EXPECT_EQ(runs.back().from_cache, from_cache);
    }
    return runs;
  }

  /// At corners of a hull, and at points of balls.
  double reach_at_points(const LinkHulls& made) const {
    TriangleMesh points = made.hulls.at(0).mesh;
    if (!made.hulls[0].balls.empty()) points = {};
    for (const Ball& ball : made.hulls[0].balls) append(points, CurvedForm::sphere(ball).mesh(Curved::Within, 32));
    double reach = 0;
    for (const Vec3& p : points.positions) {
      double distance = std::numeric_limits<double>::infinity();
      for (const Shape& shape : robot_.links[made.link].visual)
        distance = std::min(distance, curved_form(shape.form, pose_in(made.frame, shape))->distance(p).lower);
      reach = std::max(reach, distance);
    }
    return reach;
  }

  const Pose turned_ = pose_of_rpy({0.1, 0.2, 0.3}, {0.4, 0.5, 0.6});
  const Shape cylinder_{.form = CylinderForm{0.5, 1}}, capsule_{.form = CapsuleForm{0.25, 0.5}, .origin = turned_},
      ball_{.form = SphereForm{0.5}, .origin = translation_by({1, 2, 3})};
};

TEST_F(CurvedLinksTest, BoundsHoldForTheFormsThemselves) {
  make_links({{cylinder_}, {capsule_}, {ball_}, {cylinder_, ball_}});
  options_.budget.faces = {effort(4000, 2000)};
  for (const LinkHulls& made : link_hulls(robot_, options_)) {
    SCOPED_TRACE(made.link);
    const LinkHull& hull = made.hulls.at(0);
    EXPECT_TRUE(hull.certified());
    const double reach = reach_at_points(made);
    EXPECT_GE(hull.verdict.distance().upper, reach - 1e-12);
    EXPECT_GE(hull.verdict.distance_to_triangles->upper, reach - 1e-12);
    EXPECT_LE(hull.verdict.distance().lower, reach + 1e-12);
    EXPECT_LE(hull.verdict.distance().upper, reach + 0.002);
  }
}

TEST_F(CurvedLinksTest, KeepTheLargestDistanceFromTheFormsThemselves) {
  make_links({{cylinder_}});
  options_.budget.max_distance = 0.0035;
  for (const LinkHulls& made : built_and_from_cache()) {
    EXPECT_TRUE(made.hulls.at(0).within_bounds);
    EXPECT_LE(made.hulls[0].verdict.distance().upper, 0.0035);
    EXPECT_LE(reach_at_points(made), 0.0035);
  }
}

/// A mesh around the cylinder reaches out of it by 1.2 mm, and the hull keeps a gap of 2 mm from the mesh.
TEST_F(CurvedLinksTest, KeepNoDistanceThatIsLessThanThatOfTheMeshesAround) {
  make_links({{cylinder_}});
  options_.budget.max_distance = 0.003;
  for (const LinkHulls& made : built_and_from_cache()) {
    EXPECT_TRUE(made.hulls.at(0).certified());
    EXPECT_FALSE(made.hulls[0].within_bounds);
    ASSERT_FALSE(made.hulls[0].notes.empty());
    EXPECT_NE(made.hulls[0].notes.back().find("curved"), std::string::npos);
  }
}

TEST(DistanceLeft, KeepsTheLargestDistanceWithWhatMeshesReachOutOrIsNone) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> number(0, 1e-3);
  for (int i = 0; i < 1000; ++i) {
    const Budget budget{.max_distance = number(random), .padding = i % 2 * 1e-4};
    const double around = number(random);
    const auto left = distance_left(budget, around);
    EXPECT_EQ(left.has_value(), budget.max_distance - around > budget.padding) << budget.max_distance << ' ' << around;
    EXPECT_LE(left.value_or(0) + (left ? around : 0), budget.max_distance);
  }
}

TEST(Judge, TellsNoLessThanMeshesReachOutOfCurvedShapes) {
  const TriangleMesh triangles = form_mesh(SphereForm{0.5}, Curved::Around);
  const RepairedMesh input = prepared_for_hulls(triangles);
  const CurvedParts curved{.parts = {}, .around = 0.0012341};
  LinkHull hull{.mesh = meshes::box({-1, -1, -1}, {1, 1, 1})};
  judge(hull, {triangles, input, curved}, {.max_distance = 0.001}, {});
  ASSERT_EQ(hull.notes.size(), 1U);
  EXPECT_TRUE(has(hull.notes[0], "by up to 1.24 mm")) << hull.notes[0];
}

TEST_F(CurvedLinksTest, SpheresKeepTheLargestDistanceFromTheFormsThemselves) {
  make_links({{capsule_}});
  options_.budget = {.collision = Collision::Spheres, .spheres = 200, .max_distance = 0.03};
  const LinkHulls made = link_hulls(robot_, options_).at(0);
  const LinkHull& cover = made.hulls.at(0);
  EXPECT_TRUE(cover.certified() && cover.within_bounds);
  EXPECT_LE(cover.verdict.distance().upper, 0.03);
  EXPECT_GE(cover.verdict.distance().upper, reach_at_points(made) - 1e-12);
}

TEST_F(CurvedLinksTest, VolumesAreThoseOfTheForms) {
  make_links({{cylinder_}, {ball_}, {capsule_}, {ball_, {.form = BoxForm{{0.5, 0.5, 0.5}}}}});
  const double pi = std::numbers::pi, ball = 4 * pi / 3 * std::pow(0.5, 3);
  const std::array volumes{pi / 4, ball, 4 * pi / 3 * std::pow(0.25, 3) + pi / 32, ball + 0.125};
  options_.cache = folder_.path() / "cache";
  for (const bool from_cache : {false, true}) {
    const std::vector<LinkHulls> made = link_hulls(robot_, options_);
    for (std::size_t i = 0; i < volumes.size(); ++i) {
      SCOPED_TRACE(i);
      EXPECT_EQ(made[i].from_cache, from_cache);
      EXPECT_NEAR(made[i].sealed_volume, volumes[i], 1e-9);
      if (robot_.links[i].visual.size() > 1) continue;
      EXPECT_NEAR(made[i].convex_volume, volumes[i], 1e-9);
    }
  }
}

TEST_F(CurvedLinksTest, AreNotSharedWithMeshesOfTheSameTriangles) {
  folder_.add("prism.ply", link_triangles({&cylinder_, 1}, {}));
  make_links({{cylinder_}, {mesh("prism.ply")}});
  const std::vector<LinkHulls> made = link_hulls(robot_, options_);
  ASSERT_EQ(made[0].triangles, made[1].triangles);
  EXPECT_EQ(made[0].hulls.at(0).mesh, made[1].hulls.at(0).mesh);
  EXPECT_NEAR(made[0].hulls[0].verdict.distance().upper - made[1].hulls[0].verdict.distance().upper, 0.0012, 1e-4);
  EXPECT_EQ(made[0].hulls[0].verdict.distance().lower, made[1].hulls[0].verdict.distance().lower);
  EXPECT_NEAR(made[1].sealed_volume / made[0].sealed_volume, 1.0032, 1e-3);
}

TEST_F(CurvedLinksTest, MayBeFlat) {
  make_links({{{.form = CylinderForm{0.5, 0}}}, {{.form = CylinderForm{0, 1}}}});
  for (const LinkHulls& made : link_hulls(robot_, options_)) {
    EXPECT_TRUE(made.hulls.at(0).certified());
    EXPECT_LT(made.sealed_volume, 1e-9);
  }
}

}  // namespace
}  // namespace prohull::robot

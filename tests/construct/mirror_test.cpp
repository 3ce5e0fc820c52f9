#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "effort.h"
#include "geometry/float32.h"
#include "input_error.h"
#include "prohull/detail/replay.h"
#include "prohull/detail/symmetry.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/mesh_report.h"
#include "prohull/sample.h"
#include "random.h"
#include "symmetric_meshes.h"

namespace prohull {
namespace {

using namespace meshes;

constexpr int kLevels = effort(5, 3);

/// Void of a symmetric hull, relative to that of one that need not be: 1 on average, with few faces up to so much.
constexpr double kLittleMore = effort(1.1, 1.5);

/// Shares nothing with inspect_symmetry: the corners of all faces, sorted, are those of the mirrored faces.
bool is_mirrored(const TriangleMesh& mesh, int axis, double sum = 0) {
  using Face = std::array<std::array<double, 3>, 3>;
  std::vector<Face> faces, images;
  for (const FaceId f : mesh.triangles.ids()) {
    const auto key = [](Vec3 a, Vec3 b, Vec3 c) {
      Face face{{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}}};
      std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
      return face;
    };
    auto [a, b, c] = mesh.triangle(f);
    faces.push_back(key(a, b, c));
    for (Vec3* p : {&a, &b, &c}) (*p)[axis] = sum - (*p)[axis];
    images.push_back(key(a, c, b));
  }
  std::ranges::sort(faces), std::ranges::sort(images);
  return faces == images;
}

double void_ratio(const TriangleMesh& hull, const TriangleMesh& mesh) {
  return signed_volume(hull) / signed_volume(mesh) - 1;
}

/// A symmetric hull with all that is promised, and how much more void it has than one that need not be symmetric.
double compare(const TriangleMesh& mesh, Axis axis, std::size_t target, HullSide side = HullSide::Outer) {
  const int along = static_cast<int>(axis);
  EXPECT_TRUE(is_mirrored(mesh, along));
  const HullOptions any{.target_faces = target, .side = side, .relax_guards = true};
  HullOptions symmetric = any;
  symmetric.mirror = axis;
  const HullResult result = build_hull(mesh, symmetric);
  const TriangleMesh hull = result.hull.base();
  EXPECT_TRUE(is_mirrored(hull, along));
  EXPECT_LE(hull.face_count(), target) << describe_refusals(result.blocked);
  EXPECT_TRUE(side == HullSide::Outer ? verify_enclosure(mesh, hull).encloses : verify_enclosure(hull, mesh).encloses);
  const ReplayReport replay = verify_replay(result.hull, mesh);
  EXPECT_TRUE(replay.holds) << replay.why_not;
  EXPECT_EQ(count_self_intersections(hull), 0u);
  const double least = void_ratio(build_hull(mesh, any).hull.base(), mesh), is = void_ratio(hull, mesh);
  std::printf("%zu faces of %zu: void %.4f %%, without symmetry %.4f %%\n", hull.face_count(), mesh.face_count(),
              100 * is, 100 * least);
  return is / least;
}

TEST(Mirror, GivesHullsThatAreTheirOwnImageBitForBit) {
  const TriangleMesh mesh = bumpy_sphere(kLevels);
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
    for (const std::size_t target : {400, 100}) EXPECT_LT(compare(mesh, axis, target), kLittleMore);
}

TEST(Mirror, TakesFacesThatCrossThePlane) {
  for (const std::uint32_t every : {1u, 2u, 3u}) {
    const TriangleMesh mesh = with_edges_across(bumpy_sphere(kLevels), 0, every);
    for (const std::size_t target : {400, 100}) EXPECT_LT(compare(mesh, Axis::X, target), kLittleMore);
    compare(mesh, Axis::X, 20);
  }
}

TEST(Mirror, TakesSamplesOfWhichOneHalfIsMirrored) {
  for (const SampleInfo& sample : samples()) {
    // Cut in half, thin parts of few faces intersect themselves.
    const bool is_thin = sample.name == "knot" || sample.name == "bracket" || sample.name == "pony";
    if (sample.name == "gyroid" || (kTestsAreSlow && is_thin)) continue;
    const TriangleMesh whole = make_sample(sample.name, effort(20000, 2000));
    const Box box = bounding_box(whole);
    const TriangleMesh mesh = mirrored_half(whole, 1, box.center().y + 0.03 * box.diagonal());
    ASSERT_TRUE(inspect(mesh).is_closed_manifold()) << sample.name;
    std::printf("%s: ", std::string(sample.name).c_str());
    const double more = compare(mesh, Axis::Y, mesh.face_count() / 20);
    EXPECT_TRUE(sample.name == "box" || more < kLittleMore) << sample.name << ": " << more;
  }
}

TEST(Mirror, WorksForInnerHulls) {
  const TriangleMesh mesh = with_edges_across(bumpy_sphere(kLevels), 2);
  EXPECT_LT(compare(mesh, Axis::Z, 300, HullSide::Inner), kLittleMore);
}

TEST(Mirror, MakesOneOfTwoLevelsSymmetricAtLeast) {
  const TriangleMesh mesh = with_edges_across(bumpy_sphere(3), 0);
  const ProgressiveHull hull = build_hull(mesh, {.target_faces = 20, .relax_guards = true, .mirror = Axis::X}).hull;
  bool was_symmetric = true;
  std::size_t asymmetric = 0;
  for (std::size_t n = hull.base_face_count(); n <= hull.original_face_count(); n += 2) {
    const TriangleMesh level = hull.level(n);
    const bool is_symmetric = is_mirrored(level, 0);
    EXPECT_TRUE(is_symmetric || was_symmetric) << n;
    EXPECT_EQ(symmetric_faces(hull, Axis::X, n), is_symmetric ? n : n - 2);
    EXPECT_EQ(count_self_intersections(level), 0u) << n;
    asymmetric += !is_symmetric;
    was_symmetric = is_symmetric;
  }
  EXPECT_GT(asymmetric, 0u);
  EXPECT_EQ(symmetric_faces(hull, Axis::X, 0), hull.base_face_count());
  EXPECT_EQ(symmetric_faces(hull, Axis::X, 1'000'000), hull.original_face_count());
}

TEST(Mirror, RefusesASymmetricLevelOfAHullThatHasNone) {
  const ProgressiveHull hull = build_hull(bumpy_sphere(3), {.target_faces = 100}).hull;
  EXPECT_THROW(symmetric_faces(hull, Axis::X, 200), InputError);
}

TEST(Mirror, HoldsForAnyMeshAndAnyOptions) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> frequency(1, 9);
  for (int round = 0; round < rounds(60); ++round) {
    const int axis = static_cast<int>(random() % 3);
    TriangleMesh mesh = with_edges_across(bumpy_sphere(3, frequency(random)), axis, 1 + random() % 4);
    const bool stores_float32 = random() % 3 == 0;
    double sum = 0;
    if (random() % 2 == 0) {  // coordinates that a shift does not round
      for (Vec3& p : mesh.positions) p = {std::round(1024 * p.x), std::round(1024 * p.y), std::round(1024 * p.z)};
      Vec3 shift;
      shift[axis] = static_cast<double>(random() % 100000) * 0.5;
      mesh = moved(mesh, shift);
      sum = 2 * shift[axis];
    } else if (stores_float32) {
      for (Vec3& p : mesh.positions) p = nearest_float32(p);
    }
    const HullOptions options{.target_faces = 20 + random() % 200,
                              .side = random() % 3 == 0 ? HullSide::Inner : HullSide::Outer,
                              .strategy = static_cast<Strategy>(random() % 3),
                              .relax_guards = random() % 4 != 0,
                              .self_intersections = SelfIntersections::Refused,
                              .mirror = static_cast<Axis>(axis),
                              .float32_coordinates = stores_float32,
                              .queue = static_cast<QueueKind>(random() % 3),
                              .seed = random() % 2};
    SCOPED_TRACE(round);
    if (count_self_intersections(mesh) > 0) continue;  // rounded
    const HullResult result = build_hull(mesh, options);
    const TriangleMesh hull = result.hull.base();
    EXPECT_LT(hull.face_count(), mesh.face_count() / 2);
    EXPECT_TRUE(is_mirrored(hull, axis, sum));
    EXPECT_TRUE(inspect_symmetry(hull, static_cast<Axis>(axis)).is_symmetric());
    EXPECT_TRUE(verify_replay(result.hull, mesh).holds);
    EXPECT_EQ(count_self_intersections(hull), 0u);
    EXPECT_EQ(first_defect(result.hull), std::nullopt);
    EXPECT_TRUE(!stores_float32 || std::ranges::all_of(hull.positions, is_float32));
  }
}

TEST(Mirror, TakesPartsThatTouchThePlaneAndPartsBesideIt) {
  const TriangleMesh beside = moved(bumpy_sphere(2), {4, 0, 0});
  TriangleMesh image = inside_out(beside);
  for (Vec3& p : image.positions) p.x = -p.x;
  // Boxes that touch in a face of the plane, and parts that lie on each other.
  TriangleMesh mesh = together(beside, image);
  mesh = together(together(mesh, subdivided(box({-1, 6, 0}, {0, 7, 1}))), subdivided(box({0, 6, 0}, {1, 7, 1})));
  EXPECT_FALSE(is_mirrored(mesh, 0)) << "the two boxes have other diagonals";
  EXPECT_THROW(build_hull(mesh, {.mirror = Axis::X}), InputError);
  mesh = together(together(beside, image), together(bumpy_sphere(2), bumpy_sphere(2)));
  const HullResult result = build_hull(mesh, {.target_faces = 200, .relax_guards = true, .mirror = Axis::X});
  EXPECT_TRUE(is_mirrored(result.hull.base(), 0));
  EXPECT_LE(result.hull.base_face_count(), 200u);
  EXPECT_TRUE(verify_replay(result.hull, mesh).holds);
}

TEST(Mirror, KeepsFlatPartsFlat) {
  // Two pyramids on a square: sides cross the plane, others lie beside it.
  TriangleMesh mesh = make({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, -1}, {0, 0, 1}},
                           {{0, 1, 5}, {1, 2, 5}, {2, 3, 5}, {3, 0, 5}, {1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}});
  for (int i = 0; i < 3; ++i) mesh = subdivided(mesh);
  const HullResult result = build_hull(mesh, {.target_faces = 16, .relax_guards = true, .mirror = Axis::X});
  EXPECT_TRUE(is_mirrored(result.hull.base(), 0));
  EXPECT_LE(result.hull.base_face_count(), 16u);
  EXPECT_TRUE(verify_enclosure(result.hull.base(), mesh).encloses) << "it is the same solid";
}

TEST(Mirror, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = bumpy_sphere(effort(5, 3));
  HullOptions options{.target_faces = 100, .mirror = Axis::Y, .threads = 1};
  const HullResult one = build_hull(mesh, options);
  options.threads = 4;
  EXPECT_EQ(build_hull(mesh, options).hull, one.hull);
  EXPECT_TRUE(is_mirrored(one.hull.base(), 1));
}

std::string refusal_of(const TriangleMesh& mesh, const HullOptions& options) {
  return error_of([&] { build_hull(mesh, options); }).what();
}

TEST(Mirror, SaysWhereAMeshIsNotSymmetric) {
  TriangleMesh mesh = bumpy_sphere(2);
  VertexId v{0};
  while (!(mesh.positions[v].x > 0 && mesh.positions[v].y > 0)) v = VertexId{index(v) + 1};
  mesh.positions[v].z += 1e-12;
  const std::string why = refusal_of(mesh, {.mirror = Axis::X});
  for (const char* part : {"vertex ", " at (", "in the plane x = 0", "2 vertices have none", "Symmetrize"})
    EXPECT_NE(why.find(part), std::string::npos) << why;
  HalfEdgeMesh flipped(bumpy_sphere(2));
  HalfEdgeId h{0};
  while (flipped.position(flipped.tail(h)).x == 0 || !flipped.can_flip(h)) h = HalfEdgeId{index(h) + 1};
  flipped.flip(h);
  const std::string of_faces = refusal_of(flipped.triangle_mesh(), {.mirror = Axis::X});
  EXPECT_NE(of_faces.find("4 faces have none"), std::string::npos) << of_faces;
  EXPECT_NE(refusal_of(moved(bumpy_sphere(2), {0.1, 0, 0}), {.mirror = Axis::X}), "") << "the coordinates are rounded";
}

TEST(Mirror, RefusesTolerances) {
  const TriangleMesh mesh = bumpy_sphere(2);
  const std::string why = refusal_of(mesh, {.tolerances = PerFace<double>(mesh.face_count(), 1), .mirror = Axis::X});
  EXPECT_NE(why.find("tolerances"), std::string::npos) << why;
}

}  // namespace
}  // namespace prohull

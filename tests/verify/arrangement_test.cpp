// Hulls that intersect themselves often: verify_cover and verify_enclosure against brute force, and how much work it
// is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "effort.h"
#include "progress.h"
#include "prohull/enclosure.h"
#include "prohull/union_verification.h"
#include "random.h"
#include "verify/oracle.h"
#include "verify/random_chains.h"
#include "verify/solids.h"
#include "verify/winding.h"

namespace prohull {
namespace {

using namespace meshes;

/// Tetrahedra on a small grid, so that they share corners, edges and planes. Some of them may be inside out.
TriangleMesh tetrahedra_on_grid(int count, bool inside_out_too, RandomChains& chains) {
  TriangleMesh mesh;
  while (mesh.face_count() < 4 * std::size_t(count)) {
    TriangleMesh one;
    chains.add_tetrahedron(one);
    if (one.triangles.empty()) continue;
    const bool turned = inside_out_too && chains.uniform(0, 9) < 3;
    mesh = mesh.triangles.empty() ? one : together(mesh, turned ? inside_out(one) : one);
  }
  return mesh;
}

/// The same anywhere, in which nothing is special.
TriangleMesh scattered_tetrahedra(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(0, 1);
  const auto corner = [&] { return Vec3{within(random), within(random), within(random)}; };
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vec3 a = corner(), b = corner(), c = corner(), d = corner();
    const TriangleMesh t = tetrahedron(a, b, c, d);
    const TriangleMesh outwards = signed_volume(t) > 0 ? t : inside_out(t);
    mesh = mesh.triangles.empty() ? outwards : together(mesh, outwards);
  }
  return mesh;
}

/// With a hollow box far away: without its cavity, all faces would be known to bound the solid.
TriangleMesh tangled(int count) {
  return together(scattered_tetrahedra(count, 1),
                  together(box({20, 20, 20}, {24, 24, 24}), inside_out(box({21, 21, 21}, {22, 22, 22}))));
}

Triangle small_triangle(RandomChains& chains) {
  const Vec3 a = chains.corner() * 0.5 + Vec3{0.75, 0.75, 0.75};
  const auto near = [&] {
    return a + Vec3{0.25 * chains.uniform(-2, 2), 0.25 * chains.uniform(-2, 2), 0.25 * chains.uniform(-2, 2)};
  };
  return {chains.uniform(0, 1) ? a : near(), near(), near()};
}

TriangleMesh mesh_of(const Triangle& t) {
  TriangleMesh mesh;
  mesh.triangles.push_back(
      {mesh.positions.push_back(t.a), mesh.positions.push_back(t.b), mesh.positions.push_back(t.c)});
  return mesh;
}

TEST(HullsThatOverlapOften, CoverWhatBruteForceSaysTheyCover) {
  RandomChains chains(test_seed());
  std::mt19937 random(test_seed());
  int covered = 0, outside = 0;
  for (int round = 0; round < rounds(4); ++round) {
    const TriangleMesh hull = tetrahedra_on_grid(chains.uniform(20, 60), true, chains);
    if (signed_volume(hull) < 0.1) continue;  // would be turned
    const oracle::Chain oracle(hull);
    for (int i = 0; i < 10; ++i) {
      const Triangle t = small_triangle(chains);
      const bool truth = oracle.covers(t, random);
      ++(truth ? covered : outside);
      ASSERT_EQ(verify_cover(mesh_of(t), hull).encloses, truth) << "round " << round << ", triangle " << i;
    }
  }
  std::printf("%d covered, %d not\n", covered, outside);
  EXPECT_GT(covered, effort(5, 0));
  EXPECT_GT(outside, effort(5, 0));
}

/// Whether w_inner >= 1 and w_outer < 1 at one of many points.
bool sticks_out_at_a_sample(const TriangleMesh& inner, const TriangleMesh& outer, std::mt19937& random) {
  const oracle::Chain in(inner), out(outer);
  std::uniform_real_distribution<double> within(-0.1, 1.1);
  const double size = bounding_box(inner).diagonal();
  for (int i = 0; i < 300; ++i) {
    const Vec3 p{size * within(random), size * within(random), size * within(random)};
    const Vec3 apex{within(random), within(random), 1e4};
    const auto w_in = in.winding(apex, p), w_out = out.winding(apex, p);
    if (w_in && w_out && *w_in >= 1 && *w_out < 1) return true;
  }
  return false;
}

TEST(HullsThatOverlapOften, EncloseWhatTheyWereMadeOf) {
  RandomChains chains(test_seed());
  std::mt19937 random(test_seed());
  int sticks_out = 0;
  for (int round = 0; round < rounds(8); ++round) {
    const int count = chains.uniform(20, 60);
    const TriangleMesh inner = round % 2 == 0 ? scattered_tetrahedra(count, test_seed() + unsigned(round))
                                              : tetrahedra_on_grid(count / 2, false, chains);
    const TriangleMesh more = tetrahedra_on_grid(3, false, chains);
    for (const TriangleMesh& hull : {inner, together(inner, more)}) {
      const EnclosureReport report = verify_enclosure(inner, hull);
      EXPECT_TRUE(report.encloses) << "round " << round;
      EXPECT_EQ(report.faces_outside + report.cavities + report.faces_undecided, 0U);
      EXPECT_TRUE(verify_cover(inner, hull).encloses) << "round " << round;
    }
    const bool is_out = sticks_out_at_a_sample(together(inner, more), inner, random);
    sticks_out += is_out;
    if (is_out) {
      EXPECT_FALSE(verify_enclosure(together(inner, more), inner).encloses) << "round " << round;
    }
  }
  EXPECT_GT(sticks_out, 0);
}

/// A plate, and small boxes that cross it side by side.
TriangleMesh crossed_plate(int boxes) {
  TriangleMesh mesh = box({0, 0, 0}, {double(boxes), double(boxes), 1});
  for (int i = 0; i < boxes; ++i) {
    const double at = i + 0.25;
    mesh = together(mesh, box({at, 0.5 * at, -1}, {at + 0.5, 0.5 * at + 0.5, 2}));
  }
  return mesh;
}

// Whole lines would divide a face of the plate into hundreds of thousands of cells.
// How many steps a search takes depends on them.
TEST(RandomNumber, IsTheSameWithAnyStandardLibrary) {
  std::mt19937 random;
  for (const int number : {53441, 9100, 59387}) EXPECT_EQ(verify::random_number(random, 1 << 8, 1 << 16), number);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(verify::random_number(random, i, i), i);
}

TEST(HullsThatOverlapOften, TakeWorkThatGrowsAsContactsDo) {
  for (const int boxes : {10, 100, 400}) {
    const TriangleMesh mesh = crossed_plate(boxes);
    const EnclosureOptions options{.max_steps = 12'000 * std::size_t(boxes)};
    EXPECT_EQ(verify_enclosure(mesh, mesh, options).faces_undecided, 0U) << boxes;
    EXPECT_EQ(verify_cover(mesh, mesh, options).faces_undecided, 0U) << boxes;
  }
  for (const int tetrahedra : {20, 40, 60}) {
    const TriangleMesh mesh = scattered_tetrahedra(tetrahedra, 1);
    const std::size_t contacts = 2 * count_self_intersections(mesh), on_a_face = contacts / mesh.face_count();
    const EnclosureOptions options{.max_steps = 2 * contacts * on_a_face};
    EXPECT_EQ(verify_enclosure(mesh, mesh, options).faces_undecided, 0U) << tetrahedra;
  }
}

TEST(HullsThatOverlapOften, AreNotSaidToEncloseWhereFacesAreUndecided) {
  const TriangleMesh mesh = tangled(20);
  for (const std::size_t steps : {0U, 1000U, 10000U}) {
    const EnclosureReport solid = verify_enclosure(mesh, mesh, {.max_steps = steps});
    const EnclosureReport triangles = verify_cover(mesh, mesh, {.max_steps = steps});
    for (const EnclosureReport& report : {solid, triangles}) {
      EXPECT_FALSE(report.encloses) << steps;
      EXPECT_GT(report.faces_undecided, 0U) << steps;
      EXPECT_EQ(report.faces_outside, 0U) << steps;
    }
  }
  EXPECT_EQ(verify::undecided(2), "the search was ended before 2 faces were decided; allow more steps");
  const EnclosureReport clean = verify_enclosure(octahedron(), box({-1, -1, -1}, {1, 1, 1}), {.max_steps = 0});
  EXPECT_TRUE(clean.encloses) << "without contacts no step is taken";
}

TEST(HullsThatOverlapOften, AreUndecidedAfterAsManyStepsAsAreAllowed) {
  const TriangleMesh mesh = tangled(20), hull = together(mesh, box({30, 30, 30}, {31, 31, 31}));
  const Verification found = verify_hull(hull, mesh, HullSide::Outer, {.max_steps = 1000});
  EXPECT_FALSE(found.certified || found.is_any(Answer::No));
  EXPECT_EQ(found.encloses_solid, Answer::Undecided);
  EXPECT_GT(found.faces_undecided, 0U);
  EXPECT_TRUE(verify_hull(hull, mesh).certified);
}

TEST(PiecesThatOverlapOften, AreUndecidedAfterAsManyStepsAsAreAllowed) {
  const TriangleMesh many = tangled(20);
  for (const bool solid_only : {false, true}) {
    const UnionVerification found =
        verify_union(std::vector{many}, many, {.solid_only = solid_only, .max_steps = solid_only ? 1000U : 1U});
    EXPECT_FALSE(found.certified || found.is_any(Answer::No)) << solid_only;
    EXPECT_GT(found.faces_undecided, 0U) << solid_only;
    EXPECT_NE(found.why_not.find("ended before"), std::string::npos) << found.why_not;
  }
  EXPECT_TRUE(verify_union(std::vector{many}, many).certified);
}

// Walls that nothing meets are decided without steps, and what is in their midst is not.
TEST(PiecesThatOverlapOften, AreUndecidedInsideAfterAsManyStepsAsAreAllowed) {
  const TriangleMesh many = together(box({-9, -9, -9}, {9, 9, 9}), scattered_tetrahedra(20, 1));
  const TriangleMesh original = box({-5, -5, -5}, {5, 5, 5});
  const UnionVerification found = verify_union(std::vector{many}, original, {.max_steps = 1});
  EXPECT_FALSE(found.certified || found.is_any(Answer::No));
  EXPECT_EQ(found.faces_undecided, 0U);
  EXPECT_TRUE(found.inside_undecided);
  EXPECT_EQ(found.encloses_solid, Answer::Undecided);
  EXPECT_NE(found.why_not.find("ended before"), std::string::npos) << found.why_not;
  EXPECT_TRUE(verify_union(std::vector{many}, original).certified);
}

TEST(HullsThatOverlapOften, TellProgressWithinOneTriangle) {
  const TriangleMesh hull = scattered_tetrahedra(40, 1);
  const TriangleMesh triangle = mesh_of({{0, 0, 0.4}, {1, 0, 0.5}, {0.5, 1, 0.6}});
  expect_progress("verify", 20,
                  [&](const Progress& progress) { verify_cover(triangle, hull, {.progress = progress}); });
}

}  // namespace
}  // namespace prohull

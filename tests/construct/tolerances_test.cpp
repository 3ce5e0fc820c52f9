#include "prohull/tolerances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "effort.h"
#include "meshes.h"
#include "prohull/distance.h"
#include "prohull/enclosing_hull.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/sample.h"
#include "prohull/tight_hull.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

constexpr double kAny = std::numeric_limits<double>::infinity();

/// `tolerance` for faces of which all corners lie above `z`.
PerFace<double> above(const TriangleMesh& mesh, double z, double tolerance) {
  PerFace<double> tolerances(mesh.face_count(), kAny);
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    if (std::min({t.a.z, t.b.z, t.c.z}) >= z) tolerances[f] = tolerance;
  }
  return tolerances;
}

TriangleMesh faces_with(const TriangleMesh& mesh, const PerFace<double>& tolerances, double tolerance) {
  TriangleMesh part{mesh.positions, {}};
  for (const FaceId f : mesh.triangles.ids())
    if (tolerances[f] == tolerance) part.triangles.push_back(mesh.triangles[f]);
  return part;
}

double distance(const TriangleMesh& part, const TriangleMesh& hull) { return distance_bounds(part, hull).lower; }

constexpr int kLevels = effort(5, 3);

TEST(Tolerances, OfZeroKeepFacesBitForBit) {
  const TriangleMesh ball = sphere(kLevels);
  const PerFace<double> tolerances = above(ball, 0.6, 0);
  const std::size_t kept = faces_with(ball, tolerances, 0).face_count();
  for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
    const HullResult result = build_hull(ball, {.target_faces = kept + 60, .side = side, .tolerances = tolerances});
    const TriangleMesh hull = result.hull.base();
    EXPECT_LT(hull.face_count(), kept + ball.face_count() / 5);
    EXPECT_EQ(verify_tolerances(hull, ball, tolerances).missing_faces, 0u);
    EXPECT_TRUE(side == HullSide::Outer ? verify_enclosure(ball, hull).encloses
                                        : verify_enclosure(hull, ball).encloses);
    EXPECT_GT(verify_tolerances(build_hull(ball, {.target_faces = 200, .side = side}).hull.base(), ball, tolerances)
                  .missing_faces,
              0u);
  }
}

/// The same cube with the other diagonals, turned so that no face is quite in the plane of another.
TEST(Tolerances, AreDecidedInPlanesOfOtherFaces) {
  const TriangleMesh cube = box({-1, -1, -1}, {1, 1, 1});
  const auto turned = [](TriangleMesh mesh, double farther) {
    for (Vec3& p : mesh.positions) p = Vec3{p.x * 0.6 - p.y * 0.8, p.x * 0.8 + p.y * 0.6, p.z} * (1 + farther);
    return mesh;
  };
  TriangleMesh mirrored = cube;
  for (Vec3& p : mirrored.positions) p.x = -p.x;
  for (auto& t : mirrored.triangles) std::swap(t[1], t[2]);
  const PerFace<double> tolerances(cube.face_count(), 1e-9);
  EXPECT_TRUE(verify_tolerances(turned(cube, 0), turned(mirrored, 0), tolerances).holds);
  EXPECT_TRUE(verify_tolerances(turned(cube, 3e-10), turned(mirrored, 0), tolerances).holds);
  EXPECT_EQ(verify_tolerances(turned(cube, 1e-9), turned(mirrored, 0), tolerances).far_faces, cube.face_count());
}

TEST(Tolerances, BoundTheDistanceWhereTheyAreAndNowhereElse) {
  const TriangleMesh ball = sphere(5);  // faces far smaller than the tolerance allows
  constexpr double kTolerance = 0.02;
  const PerFace<double> tolerances = above(ball, 0, kTolerance);
  const TriangleMesh hull = build_hull(ball, {.target_faces = 4, .tolerances = tolerances}).hull.base();
  EXPECT_TRUE(verify_tolerances(hull, ball, tolerances).holds);
  EXPECT_GT(distance(faces_with(ball, tolerances, kTolerance), hull), 0.3 * kTolerance) << "most of it is made use of";
  EXPECT_GT(distance(faces_with(ball, tolerances, kAny), hull), 3 * kTolerance);
  EXPECT_LT(hull.face_count(), ball.face_count() / 5);
}

TEST(Tolerances, AreUsedUpByDeviations) {
  const TriangleMesh ball = sphere(kLevels);
  constexpr double kTolerance = 0.04, kUsed = 0.75 * kTolerance;
  HullOptions how{.target_faces = 4, .tolerances = PerFace<double>(ball.face_count(), kTolerance)};
  const TriangleMesh far = build_hull(ball, how).hull.base();
  how.deviations.assign(ball.positions.size(), kUsed);
  const TriangleMesh near = build_hull(ball, how).hull.base();
  EXPECT_LE(distance_bounds(near, ball).lower, kTolerance - kUsed);
  EXPECT_GT(distance_bounds(far, ball).lower, kTolerance - kUsed);
  EXPECT_GT(near.face_count(), far.face_count());
  for (const double wrong : {-kUsed, std::numeric_limits<double>::quiet_NaN()}) {
    how.deviations[VertexId{0}] = wrong;
    EXPECT_THROW(build_hull(ball, how), InputError);
  }
  how.deviations[VertexId{0}] = kUsed;
  how.deviations.pop_back();
  EXPECT_THROW(build_hull(ball, how), InputError);
}

TEST(Tolerances, HoldOnAllLevels) {
  const TriangleMesh ball = sphere(kLevels);
  const PerFace<double> tolerances = above(ball, 0.3, 0.05);
  const ProgressiveHull hull = build_hull(ball, {.target_faces = 60, .tolerances = tolerances}).hull;
  for (const std::size_t faces : {100, 200, 400})
    EXPECT_TRUE(verify_tolerances(hull.level(faces), ball, tolerances).holds) << faces;
}

// A thin plate: what is near its upper side must not count for its lower side.
TEST(Tolerances, AreNotKeptByTheOtherSideOfAThinPart) {
  TriangleMesh plate = sphere(kLevels);
  for (Vec3& p : plate.positions) p.z *= 0.02;
  const PerFace<double> tolerances = above(plate, 0, 0.005);
  const TriangleMesh hull = build_hull(plate, {.target_faces = 20, .tolerances = tolerances}).hull.base();
  EXPECT_TRUE(verify_tolerances(hull, plate, tolerances).holds);
}

TEST(Tolerances, HoldForAnyTolerancesOfAnyFaces) {
  std::mt19937_64 random(test_seed());
  std::uniform_real_distribution<double> exponent(-9, -1), choice(0, 1);
  for (int round = 0; round < effort(4, 1); ++round) {
    for (const char* name : {"asteroid", "bracket", "torus"}) {
      const TriangleMesh mesh = make_sample(name, effort(3000, 600));
      const double diagonal = bounding_box(mesh).diagonal();
      // Patches of faces with numbers near each other, mostly.
      PerFace<double> tolerances(mesh.face_count(), kAny);
      double now = kAny;
      for (double& tolerance : tolerances) {
        if (choice(random) < 0.02)
          now = choice(random) < 0.2 ? 0 : choice(random) < 0.4 ? kAny : diagonal * std::exp2(exponent(random));
        tolerance = now;
      }
      const auto kept = static_cast<std::size_t>(std::ranges::count(tolerances, 0.0));
      for (const Strategy strategy : {Strategy::Lazy, Strategy::Paper2}) {
        const HullOptions options{
            .target_faces = kept + 50, .strategy = strategy, .relax_guards = true, .tolerances = tolerances};
        const TriangleMesh hull = build_hull(mesh, options).hull.base();
        const ToleranceReport found = verify_tolerances(hull, mesh, tolerances);
        EXPECT_TRUE(found.holds) << name << ": " << found.missing_faces << " missing, " << found.far_faces << " far";
        EXPECT_TRUE(verify_enclosure(mesh, hull).encloses);
      }
    }
  }
}

TEST(Tolerances, GiveTheSameHullOnAnyNumberOfThreads) {
  const TriangleMesh mesh = make_sample("asteroid", 20000);
  PerFace<double> tolerances = above(mesh, 0.2, 0.03);
  const PerFace<double> keeps = above(mesh, 0.6, 0);
  for (const FaceId f : keeps.ids()) tolerances[f] = std::min(tolerances[f], keeps[f]);
  const auto kept = static_cast<std::size_t>(std::ranges::count(tolerances, 0.0));
  HullOptions options{.target_faces = kept + 500, .tolerances = tolerances, .threads = 1};
  const TriangleMesh one = build_hull(mesh, options).hull.base();
  options.threads = 4;
  EXPECT_EQ(build_hull(mesh, options).hull.base(), one);
  EXPECT_TRUE(verify_tolerances(one, mesh, tolerances).holds);
}

TEST(Tolerances, OfNoFaceChangeNothing) {
  const TriangleMesh mesh = make_sample("bracket", 1000);
  const PerFace<double> none(mesh.face_count(), kAny);
  EXPECT_EQ(build_hull(mesh, {.target_faces = 100, .tolerances = none}).hull.base(),
            build_hull(mesh, {.target_faces = 100}).hull.base());
}

TEST(Tolerances, ThatContradictOtherOptionsAreRefused) {
  const TriangleMesh ball = sphere(2);
  EXPECT_THROW(build_hull(ball, {.tolerances = PerFace<double>(3, 0)}), InputError);
  EXPECT_THROW(build_hull(ball, {.tolerances = PerFace<double>(ball.face_count(), -1)}), InputError);
  EXPECT_THROW(build_hull(ball, {.target_faces = 20, .tolerances = PerFace<double>(ball.face_count(), 0)}), InputError);
  EXPECT_THROW(build_tight_hull(ball, {.tolerances = PerFace<double>(ball.face_count(), 0.1)}), InputError);
  EnclosingOptions padded;
  padded.padding = 0.1;
  padded.hull.tolerances = PerFace<double>(ball.face_count(), 0.1);
  EXPECT_THROW(enclosing_hull(ball, 20, padded), InputError);
  EnclosingOptions tight;
  tight.tight = true;
  tight.hull.tolerances = PerFace<double>(ball.face_count(), 0.1);
  EXPECT_THROW(enclosing_hull(ball, 20, tight), InputError);
}

// Faces are found again by their corners, whatever the repair does to their numbers.
TEST(Tolerances, SurviveRepairs) {
  const TriangleMesh ball = sphere(3);
  TriangleMesh dirty = soup(ball);
  dirty.triangles.push_back(dirty.triangles[FaceId{0}]);
  std::ranges::reverse(dirty.triangles);
  std::swap(dirty.triangles[FaceId{7}][0], dirty.triangles[FaceId{7}][1]);
  EnclosingOptions options;
  options.hull.tolerances = above(dirty, 0.5, 0);
  const auto kept = static_cast<std::size_t>(std::ranges::count(options.hull.tolerances, 0.0));
  const EnclosingHull made = enclosing_hull(dirty, kept + 40, options);
  EXPECT_TRUE(made.certified);
  const PerFace<double> of_ball = above(ball, 0.5, 0);
  EXPECT_EQ(verify_tolerances(made.mesh, ball, of_ball).missing_faces, 0u);
}

TEST(Tolerances, NeedAMeshThatCanBeClosedAndKeepsItsParts) {
  TriangleMesh open = sphere(2);
  open.triangles.pop_back();
  EnclosingOptions options;
  options.open_shells = OpenShells::Keep;
  options.hull.tolerances = PerFace<double>(open.face_count(), 0.1);
  EXPECT_THROW(enclosing_hull(open, 100, options), InputError);

  const TriangleMesh nested = together(sphere(2), scaled(sphere(1), 0.5));
  options = {};
  options.hull.tolerances = PerFace<double>(nested.face_count(), 0.1);
  EXPECT_THROW(enclosing_hull(nested, 100, options), InputError);
  options.keep_cavities = true;
  EXPECT_TRUE(enclosing_hull(nested, 100, options).certified);
}

// STL cannot hold a third.
TEST(Tolerances, OfZeroAreRefusedWhereTheFileMovesVertices) {
  const TriangleMesh ball = scaled(sphere(3), 1.0 / 3);
  EnclosingOptions options;
  options.hull.tolerances = above(ball, 0.2, 0);
  options.hull.float32_coordinates = true;
  EXPECT_THROW(enclosing_hull(ball, 500, options), InputError);
  options.hull.float32_coordinates = false;
  EXPECT_TRUE(enclosing_hull(ball, 500, options).certified);
}

TEST(VerifyTolerances, FindsWhatIsMissingAndWhatIsFar) {
  const TriangleMesh ball = sphere(3);
  const TriangleMesh larger = scaled(ball, 1.1);
  const ToleranceReport kept = verify_tolerances(larger, ball, PerFace<double>(ball.face_count(), 0));
  EXPECT_EQ(kept.missing_faces, ball.face_count());
  EXPECT_FALSE(kept.holds);
  EXPECT_EQ(verify_tolerances(larger, ball, PerFace<double>(ball.face_count(), 0.09)).far_faces, ball.face_count());
  EXPECT_TRUE(verify_tolerances(larger, ball, PerFace<double>(ball.face_count(), 0.101)).holds);
  EXPECT_EQ(verify_tolerances(inside_out(ball), ball, PerFace<double>(ball.face_count(), 0)).missing_faces,
            ball.face_count())
      << "it looks the other way";
}

// A face whose corners are near, but whose middle is far.
// They counted as not asked for, so that anything held.
TEST(VerifyTolerances, RefusesThoseThatAreNoNumbersOfAtLeastZero) {
  const TriangleMesh near = box({0, 0, 0}, {1, 1, 1}), far = box({9, 9, 9}, {10, 10, 10});
  for (const double tolerance : {-1.0, std::nan("")})
    EXPECT_THROW(verify_tolerances(far, near, PerFace<double>(near.face_count(), tolerance)), InputError);
}

TEST(VerifyTolerances, LooksBetweenTheCorners) {
  const TriangleMesh flat = make({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}});
  const TriangleMesh tent = make({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.6, 0.6, 0.5}}, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  EXPECT_FALSE(verify_tolerances(tent, flat, PerFace<double>(1, 0.2)).holds);
  EXPECT_TRUE(verify_tolerances(tent, flat, PerFace<double>(1, 0.5)).holds);
}

}  // namespace
}  // namespace prohull

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "effort.h"
#include "meshes.h"
#include "progress.h"
#include "prohull/collide.h"
#include "prohull/enclosure.h"
#include "prohull/sample.h"
#include "random.h"
#include "verify/known_solid.h"
#include "verify/solid_volume.h"
#include "verify/solids.h"

namespace prohull::verify {
namespace {

using namespace meshes;

bool bounds_one(const TriangleMesh& mesh) {
  ProgressMeter silent({}, "verify");
  return KnownSolid(mesh, "given").bounds_one(silent);
}

TEST(OneSolid, IsBoundByClosedSurfacesInOnePiece) {
  for (const TriangleMesh& mesh : {sphere(2), torus(8, 6), box({0, 0, 0}, {1, 1, 1}), make_sample("bracket", 2000),
                                   make_sample("gyroid", 3000), soup(sphere(1))}) {
    EXPECT_TRUE(bounds_one(mesh));
    EXPECT_TRUE(faces_beside_the_solid(Surface(mesh, "given"), mesh, {}, {}).empty());
  }
}

TEST(OneSolid, HasOnePieceAndLooksOutwards) {
  const TriangleMesh ball = sphere(1);
  EXPECT_FALSE(bounds_one(inside_out(ball)));
  EXPECT_FALSE(bounds_one(together(ball, moved(ball, {5, 0, 0}))));
  EXPECT_FALSE(bounds_one(together(ball, inside_out(scaled(ball, 0.5)))));
  EXPECT_FALSE(bounds_one(together(ball, moved(ball, {0.5, 0, 0}))));
}

TEST(OneSolid, HasTwoFacesAlongEveryEdge) {
  const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
  EXPECT_FALSE(bounds_one(together(cube, moved(cube, {1, 1, 0}))));  // they share an edge
  TriangleMesh open = cube;
  open.triangles.pop_back();
  EXPECT_FALSE(bounds_one(open));
  TriangleMesh turned = cube;
  std::swap(turned.triangles[FaceId(3)][0], turned.triangles[FaceId(3)][1]);
  EXPECT_FALSE(bounds_one(turned));
}

TEST(OneSolid, HasFacesWithAnAreaThatDoNotMeet) {
  TriangleMesh pierced = sphere(2);
  pierced.positions[VertexId(0)] = -2 * pierced.positions[VertexId(0)];
  EXPECT_FALSE(bounds_one(pierced));
  TriangleMesh flat = make({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}},
                           {{0, 2, 1}, {0, 1, 4}, {0, 4, 3}, {4, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  EXPECT_FALSE(bounds_one(flat));
}

// A surface numbers its faces anew where it leaves some out.
TEST(KnownSolid, KnowsWhichFacesMeetBehindOnesWithoutArea) {
  const TriangleMesh corner = make({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}},
                                   {{0, 1, 4}, {0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  const TriangleMesh both = together(corner, moved(corner, {0.125, 0.125, 0.125}));
  ProgressMeter silent({}, "verify");
  KnownSolid known(both, "given");
  EXPECT_FALSE(known.bounds_one(silent));
  EXPECT_EQ(known.self_intersections(silent).size(), count_self_intersections(both));
  EXPECT_EQ(known.faces_beside({}), (std::vector{FaceId(0), FaceId(6)}));
  EXPECT_NEAR(known.volume(silent), 2 * 8.0 / 6 - 1.625 * 1.625 * 1.625 / 6, 1e-12);
}

// 200 random tetrahedra: 86,000 pairs of faces meet.
TEST(SolidVolume, IsGivenUpAtOnceWherePartsMeetTooOften) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> x(-1, 1);
  const auto point = [&] { return Vec3{x(random), x(random), x(random)}; };
  TriangleMesh mesh;
  for (int i = 0; i < 200; ++i) {
    TriangleMesh part = tetrahedron(point(), point(), point(), point());
    append(mesh, signed_volume(part) > 0 ? part : inside_out(part));
  }
  const UnthrottledProgress every_call;
  int steps = 0;
  ProgressMeter meter([&](std::string_view, double) { return ++steps > 0; }, "measure");
  EXPECT_TRUE(std::isnan(solid_volume(mesh, meter)));
  EXPECT_LT(steps, 5000) << "one for each cell of a face";
}

/// Turned by a random rotation, which rounds it.
TriangleMesh turned(TriangleMesh mesh, std::mt19937& random) {
  std::normal_distribution<double> x;
  const Pose pose = pose_of_quaternion(x(random), x(random), x(random), x(random));
  return placed(pose, std::move(mesh));
}

// Faces that lie in one plane but for rounding cross each other anywhere. A part that lies far away tells whether the
// boundary is closed.
TEST(SolidVolume, OfPartsThatTouchInNearlyOnePlaneCountsOverlapsOnce) {
  const TriangleMesh crate = box({0, 0, 0}, {4, 4, 4}), far = box({20, 7, 9}, {21, 9, 12});
  const TriangleMesh parts[]{box({1, 1, 0}, {2, 2, 1}),  box({1, 1, -1}, {2, 2, 0}), box({1, 1, 0}, {5, 3, 1}),
                             box({-1, 1, 0}, {5, 3, 4}), box({0, 0, 0}, {4, 4, 4}),  box({0, 0, 4}, {4, 4, 5})};
  const double volumes[]{64, 65, 66, 80, 64, 80};
  std::mt19937 random(test_seed());
  ProgressMeter silent({}, "measure");
  for (int round = 0; round < rounds(20); ++round)
    for (int i = 0; i < 6; ++i) {
      const TriangleMesh mesh = turned(together(together(crate, parts[i]), far), random);
      EXPECT_NEAR(solid_volume(mesh, silent), volumes[i] + 6, 1e-11) << i << ", round " << round;
    }
}

// Walls of the third box end on lines in which the first two meet: there they counted twice.
TEST(SolidVolume, OfBoxesThatShareCornersIsThatOfTheirUnion) {
  ProgressMeter silent({}, "verify");
  const TriangleMesh boxes =
      together(together(box({0, 0, 1}, {1, 1, 2}), box({0, 0, 1}, {1, 2, 2})), box({0, 0, 1}, {2, 1, 2}));
  EXPECT_NEAR(solid_volume(boxes, silent), 3, 1e-14);
}

TEST(SolidVolume, OfBoxesOnAGridIsThatOfTheCellsTheyWindAround) {
  constexpr int kSide = 3;
  ProgressMeter silent({}, "verify");
  std::mt19937 random(test_seed());
  const auto number = [&](int least, int most) { return std::uniform_int_distribution<int>(least, most)(random); };
  for (int round = 0; round < rounds(1000); ++round) {
    TriangleMesh boxes;
    std::vector<int> windings(kSide * kSide * kSide);
    for (int count = number(2, 5); count > 0; --count) {
      Vec3 min, max;
      for (int axis = 0; axis < 3; ++axis) {
        min[axis] = number(0, kSide - 1);
        max[axis] = number(static_cast<int>(min[axis]) + 1, kSide);
      }
      const bool is_hole = number(0, 4) == 0;
      boxes = together(boxes, is_hole ? inside_out(box(min, max)) : box(min, max));
      for (int i = 0; i < kSide * kSide * kSide; ++i) {
        const Vec3 middle{0.5 + i / (kSide * kSide), 0.5 + i / kSide % kSide, 0.5 + i % kSide};
        if (Box{min, max}.contains(middle)) windings[std::size_t(i)] += is_hole ? -1 : 1;
      }
    }
    if (signed_volume(boxes) <= 0) continue;  // it would count as turned
    const auto cells = std::ranges::count_if(windings, [](int winding) { return winding >= 1; });
    ASSERT_NEAR(solid_volume(boxes, silent), double(cells), 1e-12) << "round " << round;
  }
}

// Its corners are on one line but for rounding, which its normal is lost in.
TEST(SolidVolume, IsThatOfAPartThatANeedlePierces) {
  const double edge = 1.2379400392853803;
  const TriangleMesh needle =
      make({{-edge, edge, edge}, {0, -edge, edge / 2}, {-0.6565364447793076, 0.0751328502732348, 0.947238242032344}},
           {{0, 1, 2}, {0, 2, 1}});
  const TriangleMesh crate = box({-edge, -edge, -edge}, {edge, 1.125, edge});
  ProgressMeter silent({}, "measure");
  EXPECT_NEAR(solid_volume(together(crate, needle), silent) / signed_volume(crate), 1, 1e-12);
}

// The doubled area of its first face, -2^-60, is rounded to 0.
TEST(SolidVolume, IsKnownWhereANeedleCrossesAPart) {
  constexpr double kTiny = 0x1p-30;
  const TriangleMesh needle =
      make({{0, 0, 0}, {1 + kTiny, 1, 0}, {1, 1 - kTiny, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}});
  const TriangleMesh crate = box({0.25, -1, -1}, {2, 2, 2});
  ProgressMeter silent({}, "verify");
  EXPECT_NEAR(solid_volume(together(crate, needle), silent) / signed_volume(crate), 1, 1e-12);
}

}  // namespace
}  // namespace prohull::verify

#include "construct/lifting.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "effort.h"
#include "geometry/float32.h"
#include "meshes.h"
#include "prohull/enclosure.h"
#include "prohull/hull_builder.h"
#include "prohull/mesh_report.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

TEST(LiftedOver, CoversAPointThatSticksOutOfAFace) {
  const TriangleMesh cube = subdivided(box({0, 0, 0}, {1, 1, 1}));
  const std::vector<Protrusion> protrusions{{{0.4, 0.3, 1.05}, 0.05}};
  const TriangleMesh lifted = lifted_over(cube, protrusions, {});
  EXPECT_TRUE(verify_enclosure(cube, lifted).encloses);
  const TriangleMesh tip = make({{0.4, 0.3, 1.05}, {0.4, 0.31, 1}, {0.41, 0.3, 1}}, {{0, 1, 2}});
  EXPECT_FALSE(verify_cover(tip, cube).encloses);
  EXPECT_TRUE(verify_cover(tip, lifted).encloses);
  EXPECT_LT(signed_volume(lifted), 1.2);
}

TEST(LiftedOver, NothingIsTheHullItself) {
  const TriangleMesh rock = make_sample("asteroid", 200);
  EXPECT_EQ(lifted_over(rock, {}, {}), rock);
}

TEST(LiftedOver, RandomPointsEnclosesTheHull) {
  std::mt19937 random(test_seed());
  for (int round = 0; round < rounds(20); ++round) {
    const TriangleMesh hull = build_hull(make_sample("asteroid", 400), {.target_faces = 60}).hull.base();
    std::uniform_real_distribution<double> weight(0, 1), height(0.001, 0.2);
    std::vector<Protrusion> protrusions;
    for (int i = 0; i < 1 + round % 5; ++i) {
      const Triangle t = hull.triangle(FaceId(static_cast<std::uint32_t>(random() % hull.face_count())));
      const double u = weight(random), v = (1 - u) * weight(random);
      const Vec3 normal = cross(t.b - t.a, t.c - t.a);
      const double distance = height(random);
      protrusions.push_back({t.a + (t.b - t.a) * u + (t.c - t.a) * v + normal * (distance / norm(normal)), distance});
    }
    for (const bool float32 : {false, true}) {
      const TriangleMesh lifted = lifted_over(hull, protrusions, {.rings = 1, .float32_coordinates = float32});
      EXPECT_EQ(lifted.triangles, hull.triangles) << "only vertices move";
      EXPECT_TRUE(verify_enclosure(hull, lifted).encloses) << "round " << round;
      for (const VertexId v : lifted.positions.ids())
        EXPECT_TRUE(!float32 || lifted.positions[v] == hull.positions[v] || is_float32(lifted.positions[v]));
    }
  }
}

}  // namespace
}  // namespace prohull

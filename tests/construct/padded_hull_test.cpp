#include "prohull/padded_hull.h"

#include <gtest/gtest.h>

#include <limits>

#include "geometry/float32.h"
#include "meshes.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/sample.h"

namespace prohull {
namespace {

using namespace meshes;

/// The least height of a corner of a face above the plane of the same face before.
double least_height(const TriangleMesh& before, const TriangleMesh& after) {
  double least = std::numeric_limits<double>::infinity();
  for (const FaceId f : before.triangles.ids()) {
    const Triangle s = before.triangle(f), t = after.triangle(f);
    const Vec3 n = cross(s.b - s.a, s.c - s.a);
    for (const Vec3& p : {t.a, t.b, t.c}) least = std::min(least, dot(n, p - s.a) / norm(n));
  }
  return least;
}

TEST(PaddedHull, OfACubeIsALargerCube) {
  const PaddedHull padded = padded_hull(box({0, 0, 0}, {1, 2, 3}), 0.25);
  EXPECT_EQ(padded.cramped_vertices, 0u);
  const TriangleMesh expected = box({-0.25, -0.25, -0.25}, {1.25, 2.25, 3.25});
  EXPECT_EQ(padded.mesh.triangles, expected.triangles);
  for (const VertexId v : expected.positions.ids())
    EXPECT_LT(norm(padded.mesh.positions[v] - expected.positions[v]), 1e-8);
}

TEST(PaddedHull, FacesLieBeyondTheirPlanesMovedOutwards) {
  const TriangleMesh rock = build_hull(make_sample("asteroid", 2000), {.target_faces = 200}).hull.base();
  for (const TriangleMesh& hull : {sphere(3), torus(24, 12), rock})
    for (const Vec3& place : {Vec3{}, Vec3{3e3, -1e3, 5e3}})
      for (const bool float32 : {false, true})
        for (const double distance : {1e-3, 0.1}) {
          const TriangleMesh there = moved(hull, place);
          const PaddedHull padded = padded_hull(there, distance, float32);
          EXPECT_EQ(padded.cramped_vertices, 0u);
          EXPECT_EQ(padded.mesh.triangles, there.triangles);
          EXPECT_GE(least_height(there, padded.mesh), distance);
          if (distance < 0.01) {
            EXPECT_TRUE(verify_enclosure(there, padded.mesh).encloses);
          }
          if (float32) {
            EXPECT_TRUE(std::ranges::all_of(padded.mesh.positions, is_float32));
          }
        }
}

/// A cup whose rim goes up and down: its bottom sees steep faces from all sides.
TriangleMesh crown(std::uint32_t rim) {
  std::vector<Vec3> positions{{0, 0, 0}, {0, 0, -9}};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < rim; ++i) {
    const double angle = 2 * std::numbers::pi * i / rim;
    positions.push_back({std::cos(angle), std::sin(angle), i % 2 == 0 ? 8.0 : -8.0});
    const std::uint32_t a = 2 + i, b = 2 + (i + 1) % rim;
    triangles.push_back({0, a, b});
    triangles.push_back({1, b, a});
  }
  return make(positions, triangles);
}

TEST(PaddedHull, RemovesVerticesWithoutRoomOrTellsOfThem) {
  const PaddedHull removed = padded_hull(crown(6), 0.01);
  EXPECT_LT(removed.mesh.face_count(), crown(6).face_count());
  EXPECT_TRUE(verify_enclosure(crown(6), removed.mesh).encloses);
  EXPECT_GT(padded_hull(crown(8), 0.01).cramped_vertices, 0u) << "no collapse is outside of all faces";
}

TEST(PaddedHull, RefusesWhatCannotBeMovedOutwards) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double distance : {0.0, -1.0, kInfinity, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(padded_hull(octahedron(), distance), InputError);
  TriangleMesh open = octahedron();
  open.triangles.pop_back();
  EXPECT_THROW(padded_hull(open, 1), InputError);
}

}  // namespace
}  // namespace prohull

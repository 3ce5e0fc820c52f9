// verify_cover against brute force and against what is known of convex hulls.
#include <gtest/gtest.h>

#include <cstdio>

#include "prohull/enclosure.h"
#include "prohull/hull_builder.h"
#include "prohull/sample.h"
#include "verify/cover_oracle.h"
#include "verify/random_chains.h"

namespace prohull {
namespace {

using namespace meshes;

TriangleMesh soup_of(const std::vector<Triangle>& triangles) {
  TriangleMesh mesh;
  for (const Triangle& t : triangles)
    mesh.triangles.push_back(
        {mesh.positions.push_back(t.a), mesh.positions.push_back(t.b), mesh.positions.push_back(t.c)});
  return mesh;
}

/// Triangles near a surface: corners of it, points of its edges and faces, points of the grid, and an ulp beside each.
class RandomTriangles {
 public:
  RandomTriangles(const TriangleMesh& surface, RandomChains& chains) : surface_(surface), chains_(chains) {}

  Triangle next() {
    const Vec3 a = point(), b = point();
    switch (chains_.uniform(0, 7)) {
      case 0:
        return {a, a, a};
      case 1:
        return {a, b, chains_.uniform(0, 1) ? b : a * 0.5 + b * 0.5};
      case 2:
        return surface_.triangle(face());
      default:
        return {a, b, point()};
    }
  }

 private:
  FaceId face() { return FaceId(chains_.uniform(0, int(surface_.face_count()) - 1)); }

  Vec3 point() {
    const Triangle t = surface_.triangle(face());
    const double s = 0.25 * chains_.uniform(0, 4), r = 0.25 * chains_.uniform(0, 4);
    Vec3 p = chains_.uniform(0, 2) ? t.a + (t.b - t.a) * s : t.a + (t.b - t.a) * s * r + (t.c - t.a) * (1 - s) * r;
    if (chains_.uniform(0, 3) == 0) p = chains_.corner();
    if (chains_.uniform(0, 5) == 0) {
      double& x = p[chains_.uniform(0, 2)];
      x = std::nextafter(x, chains_.uniform(0, 1) ? 9 : -9);
    }
    return p;
  }

  const TriangleMesh& surface_;
  RandomChains& chains_;
};

TEST(Cover, AgreesWithBruteForceOnRandomChains) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  RandomChains chains(seed);
  std::mt19937 random(seed);
  int covered = 0, outside = 0;
  for (int chain = 0; chain < 60;) {
    TriangleMesh outer;
    for (int n = chains.uniform(1, 3); n > 0; --n) chains.add_tetrahedron(outer);
    if (outer.triangles.empty()) continue;
    for (int n = chains.uniform(0, 3); n > 0; --n) chains.split_face(outer, chains.uniform(0, 1));
    if (signed_volume(outer) < 0.1) continue;  // would be turned
    ++chain;
    const oracle::Cover oracle(outer, random);
    RandomTriangles triangles(outer, chains);
    std::vector<Triangle> all;
    std::size_t expected = 0;
    for (int i = 0; i < 12; ++i) {
      const Triangle& t = all.emplace_back(triangles.next());
      const bool truth = oracle.covers(t);
      ++(truth ? covered : outside);
      expected += !truth;
      ASSERT_EQ(verify_cover(soup_of({t}), outer).encloses, truth) << "chain " << chain << ", triangle " << i;
    }
    const EnclosureReport report = verify_cover(soup_of(all), outer);
    ASSERT_EQ(report.faces_outside, expected) << "chain " << chain;
    ASSERT_EQ(report.encloses, expected == 0);
  }
  std::printf("%d covered, %d not\n", covered, outside);
  EXPECT_GT(covered, 100);
  EXPECT_GT(outside, 100);
}

}  // namespace
}  // namespace prohull

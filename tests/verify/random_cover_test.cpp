// verify_cover against brute force and against what is known of convex hulls.
#include <gtest/gtest.h>

#include <cstdio>

#include "effort.h"
#include "prohull/enclosure.h"
#include "prohull/hull_builder.h"
#include "prohull/sample.h"
#include "random.h"
#include "verify/oracle.h"
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
  RandomChains chains(test_seed());
  std::mt19937 random(test_seed());
  int covered = 0, outside = 0;
  for (int chain = 0; chain < 60;) {
    TriangleMesh outer;
    for (int n = chains.uniform(1, 3); n > 0; --n) chains.add_tetrahedron(outer);
    if (outer.triangles.empty()) continue;
    for (int n = chains.uniform(0, 3); n > 0; --n) chains.split_face(outer, chains.uniform(0, 1));
    if (signed_volume(outer) < 0.1) continue;  // would be turned
    ++chain;
    const oracle::Chain oracle(outer);
    RandomTriangles triangles(outer, chains);
    std::vector<Triangle> all;
    std::size_t expected = 0;
    for (int i = 0; i < 12; ++i) {
      const Triangle& t = all.emplace_back(triangles.next());
      const bool truth = oracle.covers(t, random);
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

/// Convex bodies that keep small integer coordinates, or an ulp off them, with flat parts that are divided.
std::vector<TriangleMesh> convex_bodies() {
  return {box({0, 0, 0}, {4, 4, 4}),
          subdivided(box({0, 0, 0}, {4, 4, 4})),
          moved(scaled(subdivided(octahedron()), 2), {2, 2, 2}),
          tetrahedron({0, 0, 4}, {4, 0, 0}, {0, 4, 0}, {4, 4, 4}),
          tetrahedron({0, 1, 0}, {4, 0, 1}, {1, 4, 2}, {2, 1, 4}),
          scaled(subdivided(subdivided(tetrahedron())), 4)};
}

bool holds(const TriangleMesh& convex, const Triangle& t) {
  for (const FaceId f : convex.triangles.ids())
    for (const Vec3& p : {t.a, t.b, t.c})
      if (side(convex.triangle(f), p) == Side::Outside) return false;
  return true;
}

TEST(Cover, OfAConvexHullIsWhatAllItsPlanesLeaveInside) {
  RandomChains chains(test_seed());
  int covered = 0, outside = 0;
  for (TriangleMesh body : convex_bodies()) {
    if (signed_volume(body) < 0) body = inside_out(body);
    RandomTriangles near(body, chains);
    for (int round = 0; round < 40; ++round) {
      std::vector<Triangle> soup;
      std::size_t expected = 0;
      while (soup.size() < 25) {
        const Triangle t = near.next();
        const bool is_held = holds(body, t);
        if (round % 2 == 0 && !is_held) continue;
        for (int times = chains.uniform(1, 2); times > 0; --times) {
          soup.push_back(t);
          expected += !is_held;
        }
      }
      const EnclosureReport report = verify_cover(soup_of(soup), body);
      ASSERT_EQ(report.faces_outside, expected) << "round " << round;
      ++(report.encloses ? covered : outside);
    }
  }
  std::printf("%d soups covered, %d not\n", covered, outside);
  EXPECT_GT(covered, 100);
  EXPECT_GT(outside, 50);
}

/// On a grid, so that the rational numbers stay short.
TriangleMesh snapped_torus() {
  TriangleMesh mesh = torus(6, 4);
  for (Vec3& p : mesh.positions) p = {std::round(p.x * 4) / 4, std::round(p.y * 4) / 4, std::round(p.z * 4) / 4};
  return mesh;
}

/// A hull moved about in many ways, from not at all to beyond recognition.
TriangleMesh mutant_of(TriangleMesh hull, RandomChains& chains) {
  const auto vertex = [&] { return VertexId(chains.uniform(0, int(hull.vertex_count()) - 1)); };
  Vec3& p = hull.positions[vertex()];
  double& x = p[chains.uniform(0, 2)];
  switch (chains.uniform(0, 4)) {
    case 0:
      x = std::nextafter(x, chains.uniform(0, 1) ? 9 : -9);
      break;
    case 1:
      x += std::pow(10.0, -chains.uniform(1, 16)) * (chains.uniform(0, 1) ? 1 : -1);
      break;
    case 2:  // along an edge, or a flat part
      p = p * 0.5 + hull.positions[vertex()] * 0.5;
      break;
    case 3:  // as in an edge collapse
      p = hull.positions[vertex()];
      break;
    default:
      hull = moved(hull, chains.corner() * std::pow(10.0, -chains.uniform(0, 16)));
  }
  return hull;
}

TEST(Cover, AcceptsNoMutantThatBruteForceRejects) {
  RandomChains chains(test_seed());
  std::mt19937 random(test_seed());
  int accepted = 0, rejected = 0;
  for (const TriangleMesh& hull :
       {box({0, 0, 0}, {3, 3, 3}), subdivided(scaled(octahedron(), 2)), scaled(octahedron(), 3),
        together(box({0, 0, 0}, {2, 3, 3}), inside_out(box({1, 1, 1}, {1.5, 2, 2}))),
        together(box({0, 0, 0}, {2, 3, 3}), box({1, 0, 0}, {3, 3, 3})), snapped_torus()}) {
    RandomTriangles near(hull, chains);
    for (int soups = 0; soups < effort(3, 1); ++soups) {
      std::vector<Triangle> soup;
      while (soup.size() < 8)
        if (const Triangle t = near.next(); verify_cover(soup_of({t}), hull).encloses) soup.push_back(t);
      for (int i = 0; i < 10; ++i) {
        const TriangleMesh mutant = mutant_of(hull, chains);
        if (signed_volume(mutant) < 0.1) continue;
        const oracle::Chain oracle(mutant);
        const auto outside =
            std::count_if(soup.begin(), soup.end(), [&](const Triangle& t) { return !oracle.covers(t, random); });
        ASSERT_EQ(verify_cover(soup_of(soup), mutant).faces_outside, std::size_t(outside)) << "mutant " << i;
        ++(outside == 0 ? accepted : rejected);
      }
    }
  }
  std::printf("mutants: %d cover, %d do not\n", accepted, rejected);
  EXPECT_GT(accepted, effort(10, 3));
  EXPECT_GT(rejected, effort(25, 8));
}

TEST(Cover, AgreesWithEnclosureWhereMeshesAreSolids) {
  RandomChains chains(test_seed());
  int accepted = 0, rejected = 0;
  for (const char* name : {"asteroid", "bracket", "box", "pony"}) {
    const TriangleMesh original = make_sample(name, 500);
    const TriangleMesh hull = build_hull(original, {.target_faces = 150}).hull.base();
    const double ulp = bounding_box(original).diagonal() * 0x1p-52;
    for (int i = 0; i < 12; ++i) {
      TriangleMesh mutant = hull;
      Vec3& p = mutant.positions[VertexId(chains.uniform(0, int(hull.vertex_count()) - 1))];
      if (i > 0) p += (chains.corner() + Vec3{-1.5, -1.5, -1.5}) * ulp * std::pow(4.0, chains.uniform(0, 25));
      if (count_self_intersections(mutant) > 0) continue;
      const bool encloses = verify_enclosure(original, mutant).encloses;
      ASSERT_EQ(verify_cover(original, mutant).encloses, encloses) << name << ", mutant " << i;
      ASSERT_EQ(verify_cover(soup(original), mutant).encloses, encloses) << name << ", mutant " << i;
      ++(encloses ? accepted : rejected);
    }
  }
  std::printf("%d enclose, %d do not\n", accepted, rejected);
  EXPECT_GT(accepted, 4);
  EXPECT_GT(rejected, 5);
}

}  // namespace
}  // namespace prohull

#include <gtest/gtest.h>

#include <cstdio>

#include "effort.h"
#include "geometry/triangle_predicates.h"
#include "meshes.h"
#include "prohull/enclosure.h"
#include "random.h"
#include "verify/oracle.h"

namespace prohull {
namespace {

using namespace meshes;

/// On a grid, which keeps the oracle's rational numbers short.
Vec3 snapped(const Vec3& p) {
  return {std::round(p.x * 256) / 256, std::round(p.y * 256) / 256, std::round(p.z * 256) / 256};
}

TriangleMesh snapped(TriangleMesh mesh) {
  for (Vec3& p : mesh.positions) p = snapped(p);
  return mesh;
}

/// An enclosing hull of a mesh, made by moving vertices so that no face of the star sees the new position inside: the
/// tetrahedra between old and new faces are all outside or flat, so that the hull only ever grows.
class GrowingHull {
 public:
  GrowingHull(const TriangleMesh& original, unsigned seed)
      : hull_(original), stars_(original.vertex_count()), random_(seed) {
    for (const FaceId f : original.triangles.ids())
      for (const VertexId v : original.triangles[f]) stars_[v].push_back(f);
  }

  const TriangleMesh& mesh() const { return hull_; }
  VertexId random_vertex() { return VertexId(uniform(0, int(hull_.vertex_count()) - 1)); }
  int uniform(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }

  bool grow() {
    const VertexId v = random_vertex();
    if (uniform(0, 3)) return move_if_it_grows(v, snapped(hull_.positions[v] + outwards(v) * (0.01 * uniform(1, 30))));
    // Onto a neighbour, as in an edge collapse; leaves faces without area.
    return move_if_it_grows(v, hull_.positions[hull_.triangles[stars_[v][0]][uniform(0, 2)]]);
  }

  /// A move of v inwards: by an ulp or so, by a small or large step, or to a random place nearby.
  Vec3 mutated(VertexId v) {
    Vec3 p = hull_.positions[v];
    switch (uniform(0, 3)) {
      case 0: {
        const Vec3 n = outwards(v);
        for (int i = 0; i < 3; ++i)
          if (uniform(0, 1) && n[i] != 0) p[i] = std::nextafter(p[i], n[i] > 0 ? -1e9 : 1e9);
        return p;
      }
      case 1:
        return p - outwards(v) * std::pow(10.0, -uniform(1, 16));
      case 2:
        return p + outwards(v) * std::pow(10.0, -uniform(1, 16));
      default:
        return p + Vec3{0.01 * uniform(-9, 9), 0.01 * uniform(-9, 9), 0.01 * uniform(-9, 9)};
    }
  }

  TriangleMesh with(VertexId v, const Vec3& p) const {
    TriangleMesh mesh = hull_;
    mesh.positions[v] = p;
    return mesh;
  }

  /// What the hull loses if v moves to p.
  std::vector<std::array<Vec3, 4>> loss(VertexId v, const Vec3& p) const {
    std::vector<std::array<Vec3, 4>> result;
    for (const FaceId f : stars_[v]) {
      const Triangle t = hull_.triangle(f);
      if (side(t, p) == Side::Inside) result.push_back({t.a, t.b, t.c, p});
    }
    return result;
  }

 private:
  /// The sum of the normals, as long as the mean edge.
  Vec3 outwards(VertexId v) const {
    Vec3 n;
    double length = 0;
    for (const FaceId f : stars_[v]) {
      const Triangle t = hull_.triangle(f);
      n += cross(t.b - t.a, t.c - t.a);
      length += norm(t.b - t.a) / double(stars_[v].size());
    }
    return norm(n) > 0 ? n * (length / norm(n)) : n;
  }

  bool move_if_it_grows(VertexId v, const Vec3& p) {
    for (const FaceId f : stars_[v])
      if (side(hull_.triangle(f), p) == Side::Inside) return false;
    hull_.positions[v] = p;
    return true;
  }

  TriangleMesh hull_;
  PerVertex<std::vector<FaceId>> stars_;
  std::mt19937 random_;
};

TriangleMesh with_noise(TriangleMesh mesh, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> factor(1 - noise, 1 + noise);
  for (Vec3& p : mesh.positions) p = p * factor(random);
  return mesh;
}

std::vector<TriangleMesh> originals(unsigned seed) {
  return {octahedron(),
          subdivided(box({0, 0, 0}, {1, 1, 1})),
          subdivided(subdivided(octahedron())),
          snapped(sphere(2)),
          snapped(with_noise(sphere(2), 0.2, seed)),
          snapped(torus(10, 6)),
          snapped(with_noise(torus(9, 6), 0.1, seed)),
          moved(snapped(torus(8, 5)), {1000, 1000, 1000})};
}

TEST(Enclosure, RejectsMutantsExactlyWhereTheyLoseAPartOfTheOriginal) {
  std::mt19937 random(test_seed());
  int accepted = 0, rejected = 0, hulls = 0;
  for (const TriangleMesh& original : originals(test_seed())) {
    const oracle::Chain original_chain(original);
    GrowingHull hull(original, test_seed());
    for (int generation = 0; generation < effort(5, 3); ++generation, ++hulls) {
      ASSERT_TRUE(verify_enclosure(original, hull.mesh()).encloses) << "hull " << hulls;
      for (int i = 0; i < effort(3, 1); ++i) {
        const VertexId v = hull.random_vertex();
        const Vec3 p = hull.mutated(v);
        const TriangleMesh mutant = hull.with(v, p);
        const bool truth = original_chain.is_enclosed_by(oracle::Chain(mutant), hull.loss(v, p), random);
        ASSERT_EQ(verify_enclosure(original, mutant).encloses, truth) << "hull " << hulls << ", mutant " << i;
        ++(truth ? accepted : rejected);
      }
      for (std::size_t i = 0; i < original.vertex_count() / 4; ++i) hull.grow();
    }
  }
  std::printf("%d hulls; mutants: %d enclose, %d do not\n", hulls, accepted, rejected);
  EXPECT_GT(accepted, effort(20, 1));
  EXPECT_GT(rejected, effort(20, 1));
}

TEST(Enclosure, HoldsAlongThousandsOfOutwardMoves) {
  for (const TriangleMesh& original : {sphere(4), with_noise(sphere(4), 0.05, test_seed()), torus(40, 20)}) {
    GrowingHull hull(original, test_seed());
    for (int level = 0; level < effort(5, 2); ++level) {
      const TriangleMesh finer = hull.mesh();
      for (int i = 0; i < 1000; ++i) hull.grow();
      EXPECT_TRUE(verify_enclosure(original, hull.mesh()).encloses);
      EXPECT_TRUE(verify_enclosure(finer, hull.mesh()).encloses);
      EXPECT_FALSE(verify_enclosure(hull.mesh(), original).encloses);
    }
  }
}

}  // namespace
}  // namespace prohull

#include "construct/tight/triangle_sieve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "effort.h"
#include "geometry/predicates.h"
#include "geometry/tetrahedron_contact.h"
#include "geometry/triangle_distance.h"
#include "meshes.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

PerFace<char> found(const TriangleSieve& sieve, const TriangleSieve::Region& region) {
  PerFace<char> is_found(sieve.mesh().face_count(), 0);
  sieve.visit(region, [&](FaceId f) {
    EXPECT_EQ(std::exchange(is_found[f], 1), 0) << "once each";
    return true;
  });
  return is_found;
}

std::size_t count(const PerFace<char>& faces) { return static_cast<std::size_t>(std::ranges::count(faces, 1)); }

Vec3 random_point(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> along(-size, size);
  const double x = along(random), y = along(random);
  return {x, y, along(random)};
}

class TriangleSieves : public testing::TestWithParam<double> {};

TEST_P(TriangleSieves, FindWhateverIsNearATetrahedronOrTriangle) {
  const double far_away = GetParam();
  TriangleMesh mesh = meshes::moved(make_sample("pony", 1000), {far_away, -far_away, far_away});
  const TriangleSieve sieve(mesh);
  ASSERT_EQ(sieve.mesh().face_count(), mesh.face_count());
  const Box bounds = bounding_box(mesh);
  const double size = bounds.diagonal();
  std::mt19937 random(test_seed());
  std::size_t all = 0;
  for (int round = 0; round < rounds(300); ++round) {
    const double reach = round % 2 == 0 ? 0 : 0.01 * size;
    const Vec3 at = mesh.positions[VertexId{static_cast<std::uint32_t>(random() % mesh.vertex_count())}];
    const auto corner = [&] { return at + random_point(random, 0.1 * size); };
    Tetrahedron t{corner(), corner(), corner(), corner()};
    if (side(t.a, t.b, t.c, t.d) != Side::Inside) std::swap(t.a, t.b);
    const Triangle face{t.a, t.b, t.c};
    const auto near_tetrahedron = found(sieve, sieve.around(t, reach)),
               near_face = found(sieve, sieve.around(face, reach));
    all += count(near_tetrahedron);
    for (const FaceId f : sieve.mesh().triangles.ids()) {
      const Triangle other = sieve.mesh().triangle(f);
      EXPECT_TRUE(near_tetrahedron[f] || !may_touch(other, t)) << index(f);
      EXPECT_TRUE(near_face[f] || triangle_distance(face, other).upper > reach) << index(f);
    }
  }
  EXPECT_LT(all, static_cast<std::size_t>(rounds(300)) * mesh.face_count() / 4) << "leaves out most";
}

INSTANTIATE_TEST_SUITE_P(Places, TriangleSieves, testing::Values(0.0, 1e3, 1e9));

TEST(TriangleSieve, OfNothingFindsNothing) {
  const TriangleSieve sieve{TriangleMesh{}};
  EXPECT_EQ(count(found(sieve, sieve.around(Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 1.0))), 0u);
}

TEST(TriangleSieve, StopsWhenItIsToldTo) {
  const TriangleSieve sieve(make_sample("asteroid", 500));
  int visits = 0;
  sieve.visit(sieve.around(Tetrahedron{{-9, -9, -9}, {9, -9, -9}, {0, 9, -9}, {0, 0, 9}}, 0),
              [&](FaceId) { return ++visits < 3; });
  EXPECT_EQ(visits, 3);
}

}  // namespace
}  // namespace prohull

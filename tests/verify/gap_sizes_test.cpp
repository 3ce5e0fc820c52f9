// Gaps between triangles of all sizes, against exact numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "effort.h"
#include "geometry/triangle_distance.h"
#include "meshes.h"
#include "random.h"
#include "verify/gap.h"
#include "verify/oracle.h"

namespace prohull {
namespace {

TriangleMesh mesh_of(const Triangle& t) { return meshes::make({t.a, t.b, t.c}, {{0, 1, 2}}); }

// Sizes, places and the distance of a pair are each of a size of their own.
TEST(VerifyGap, AgreesWithExactNumbersAtAllSizes) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> exponent(-498, 330), digits(0, 60);
  const auto point = [&](double size) { return Vec3{size * unit(random), size * unit(random), size * unit(random)}; };
  int kept = 0, checked = 0;
  for (int i = 0; i < rounds(8000); ++i) {
    const double size = std::ldexp(1.0, exponent(random));
    const auto triangle = [&](const Vec3& at) {
      const double own = std::ldexp(size, -digits(random));
      return Triangle{at + point(own), at + point(own), at + point(own)};
    };
    const Vec3 at = point(size);
    const Triangle s = triangle(at), t = triangle(at + point(std::ldexp(size, -digits(random))));
    if (!oracle::has_area(s) || !oracle::has_area(t)) continue;
    double gap = triangle_distance(s, t).upper;
    if (i % 3 == 0) gap *= 1 + 1e-3 * unit(random);
    if (i % 3 == 1) gap = std::ldexp(size, -digits(random));
    const bool keeps = oracle::are_apart(s, t, gap);
    const verify::GapReport found = verify::verify_gap(mesh_of(s), mesh_of(t), gap, {});
    ASSERT_EQ(found.faces_too_near == 0, keeps) << "pair " << i;
    ASSERT_TRUE(oracle::are_apart(s, t, found.proven_distance)) << "pair " << i;
    kept += keeps, ++checked;
  }
  EXPECT_GT(kept, checked / 4);
  EXPECT_LT(kept, checked * 3 / 4);
}

}  // namespace
}  // namespace prohull

#include "geometry/cones.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/triangle_intersection.h"
#include "random.h"

namespace prohull {
namespace {

Cone cone_of(const Triangle& t) {
  Cone cone{t.a, {}};
  cone.extend(t);
  return cone;
}

TEST(Cones, AreApartOnlyIfNoTrianglesMeet) {
  std::mt19937 random(test_seed());
  std::uniform_int_distribution<int> grid(-3, 3);
  int apart = 0, common_apex = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto point = [&] { return Vec3{0.1 * grid(random), 0.1 * grid(random), 0.1 * grid(random)}; };
    const Vec3 apex = point();
    const Triangle s{apex, point(), point()}, t{i % 2 ? apex : point(), point(), point()};
    for (const double scale : {1.0, 0x1p-300, 0x1p300, 0x1p1020}) {
      const auto scaled = [&](const Triangle& u) { return Triangle{u.a * scale, u.b * scale, u.c * scale}; };
      const bool are = are_apart(cone_of(scaled(s)), cone_of(scaled(t)));
      if (!are && !are_apart(scaled(s), cone_of(scaled(t)))) continue;
      ASSERT_FALSE(triangles_intersect(s, t)) << i;
      ++apart;
      common_apex += s.a == t.a;
    }
  }
  EXPECT_GT(apart, 30000);
  EXPECT_GT(common_apex, 15000);
}

TEST(Cones, OnBothSidesOfARimAreApart) {
  const Cone above{{0, 0, 1}, {{1, 0, 0}, {1, 0.1, 0}}}, below{{0, 0, -1}, {{0.9, 0.3, 0}, {1, 0.4, 0}}};
  EXPECT_TRUE(are_apart(above, below));
  EXPECT_TRUE(are_apart(below, above));
  EXPECT_TRUE(are_apart(above, {{0, 0, 1}, below.rim}));
  EXPECT_FALSE(are_apart(above, {{0, 0, -1}, above.rim}));
  EXPECT_FALSE(are_apart(above, above));
}

TEST(Cones, FollowFacesThatChange) {
  std::vector<Triangle> fan;
  for (int i = 0; i < 64; ++i) fan.push_back({{0, 0, 1}, {double(i), 1, 0}, {double(i + 1), 1, 0}});
  Cones cones(64, [&](std::uint32_t slot) { return fan[slot]; });
  ASSERT_TRUE(cones.find(2, 0));
  EXPECT_EQ(cones.find(2, 0)->rim.max.x, 64);
  EXPECT_EQ(cones.find(0, 3)->rim.max.x, 16);
  cones.place(13, {{0, 0, 1}, {13, 1, 0}, {99, 1, 0}});
  EXPECT_EQ(cones.find(2, 0)->rim.max.x, 99);
  EXPECT_EQ(cones.find(0, 3)->rim.max.x, 99);
  cones.place(13, {{0, 0, 2}, {13, 1, 0}, {99, 1, 0}});
  for (const std::size_t level : {0, 1, 2}) EXPECT_FALSE(cones.find(level, level == 0 ? 3 : 0));
  EXPECT_TRUE(cones.find(0, 2));
  const auto without_common_corner = [](std::uint32_t i) {
    return Triangle{{double(i), 0, 0}, {0, 1, double(i)}, {0, 0, 1 + double(i)}};
  };
  EXPECT_TRUE(Cones(64, without_common_corner).empty());
}

}  // namespace
}  // namespace prohull

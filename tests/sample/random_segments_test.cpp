#include "prohull/detail/random_segments.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "prohull/error.h"

namespace prohull {
namespace {

const Box kBox{{-1, 2, 3}, {1, 6, 11}};
const Box kTwice{{-2, 0, -1}, {2, 8, 15}};  // the same centre

/// The side of kTwice on which a point lies, 0 to 5: that of least and of greatest x, then y, z.
int side_of(const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] == kTwice.min[axis]) return 2 * axis;
    if (p[axis] == kTwice.max[axis]) return 2 * axis + 1;
  }
  return -1;
}

TEST(RandomSegments, GoFromOneSideOfTheDoubledBoxToAnother) {
  std::array<std::array<int, 6>, 6> count{};
  for (const Segment& s : random_segments(kBox, 30000, 1)) {
    const int from = side_of(s.a), to = side_of(s.b);
    ASSERT_GE(from, 0);
    ASSERT_GE(to, 0);
    ++count[from][to];
    for (const Vec3& p : {s.a, s.b}) ASSERT_TRUE(kTwice.overlaps(Box{p, p}));
  }
  for (int from = 0; from < 6; ++from)
    for (int to = 0; to < 6; ++to) {
      const int expected = from == to ? 0 : 1000;
      EXPECT_NEAR(count[from][to], expected, 5 * std::sqrt(expected)) << from << " to " << to;
    }
}

TEST(RandomSegments, SpreadOverEachSide) {
  std::array<int, 4> quarter{};  // of the points on the side of least x
  for (const Segment& s : random_segments(kBox, 24000, 2))
    if (s.a.x == kTwice.min.x) ++quarter[(s.a.y > 4) + 2 * (s.a.z > 7)];
  for (const int count : quarter) EXPECT_NEAR(count, 1000, 5 * std::sqrt(1000));
}

// Computed by another implementation of the engine, std::mt19937_64.
TEST(RandomSegments, HaveTheSameBitsEverywhere) {
  const auto segments = random_segments({{0, 0, 0}, {1, 1, 1}}, 1, 0);
  EXPECT_EQ(segments[0].a, (Vec3{-0x1.0p-1, 0x1.63d5a40f3b8fep-1, 0x1.2b4cc04cec1c8p-1}));
  EXPECT_EQ(segments[0].b, (Vec3{-0x1.8aefcea81500cp-2, 0x1.8p+0, 0x1.6378f22a2c120p-2}));
}

TEST(RandomSegments, DependOnTheSeedAndNotOnTheCount) {
  const auto many = random_segments(kBox, 100, 5), few = random_segments(kBox, 10, 5),
             other = random_segments(kBox, 10, 6);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].a, many[i].a);
    EXPECT_EQ(few[i].b, many[i].b);
    EXPECT_NE(few[i].a, other[i].a);
  }
  EXPECT_TRUE(random_segments(kBox, 0, 5).empty());
}

TEST(RandomPoints, FillTheBoxEvenly) {
  const std::vector<Vec3> points = random_points(kBox, 24000, 3);
  Box around;
  for (const Vec3& p : points) around.extend(p);
  for (int axis = 0; axis < 3; ++axis) {
    const double size = kBox.max[axis] - kBox.min[axis];
    EXPECT_GE(around.min[axis], kBox.min[axis]);
    EXPECT_LE(around.max[axis], kBox.max[axis]);
    EXPECT_GT(around.max[axis] - around.min[axis], 0.99 * size);
    const auto low = std::ranges::count_if(points, [&](const Vec3& p) { return p[axis] < kBox.min[axis] + size / 4; });
    EXPECT_NEAR(static_cast<double>(low), 6000, 300);
  }
  EXPECT_EQ(random_points(kBox, 10, 3)[9], points[9]);
  EXPECT_THROW(random_points(Box{}, 1, 1), InputError);
}

TEST(RandomSegments, NeedABox) {
  EXPECT_THROW(random_segments(Box{}, 1, 1), InputError);
  EXPECT_THROW(random_segments({{0, 0, 0}, {1e308, 1, 1}}, 1, 1), InputError);
}

}  // namespace
}  // namespace prohull

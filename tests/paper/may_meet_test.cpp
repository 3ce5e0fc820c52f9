#include <gtest/gtest.h>

#include <random>

#include "dyadic_points.h"
#include "effort.h"
#include "paper/box_line.h"
#include "random.h"

namespace prohull {
namespace {

TEST(MayMeet, IsNeverFalseWhereALineTouches) {
  // Lines from, to and through a corner of the face, a point of an edge and a point within: only the filters round.
  DyadicPoints points(test_seed());
  for (int i = 0; i < rounds(20000); ++i) {
    const Triangle face{points.any(), points.any(), points.any()};
    const Vec3 on = points.on(face, i);
    const Vec3 away = points.any();
    EXPECT_TRUE(may_meet(DirectedLine(Segment{away, 2 * on - away}), face));
    EXPECT_TRUE(may_meet(DirectedLine(Segment{away, on}), face));
    EXPECT_TRUE(may_meet(DirectedLine(Segment{on, away}), face));
    EXPECT_TRUE(may_meet(DirectedLine(Ray{on, away}), face));
    Box box;
    box.extend(face.a), box.extend(face.b), box.extend(face.c);
    EXPECT_TRUE(may_meet(BoxLine(DirectedLine(Segment{away, on})), box, 1));
    EXPECT_TRUE(may_meet(BoxLine(DirectedLine(Segment{away, 2 * on - away})), box, 1));
    EXPECT_TRUE(may_meet(BoxLine(DirectedLine(Ray{on, away})), box, std::numeric_limits<double>::infinity()));
  }
}

TEST(MayMeet, IsFalseForMostLinesThatPassBy) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] { return Vec3{coordinate(random), coordinate(random), coordinate(random)}; };
  for (int i = 0; i < 5000; ++i) {
    const Triangle face{point(), point(), point()};
    for (const DirectedLine& line : {DirectedLine(Segment{point(), point()}), DirectedLine(Ray{point(), point()})})
      EXPECT_EQ(may_meet(line, face), crossing(line, face) != Crossing::None);
  }
}

TEST(MayMeet, HoldsForTheGreatestAndTheLeastCoordinates) {
  for (const double size : {1e-300, 1e-160, 1.0, 1e160, 1.5e308}) {
    const Triangle face{{-size, -size, 0}, {size, -size, 0}, {0, size, 0}};
    const DirectedLine through(Segment{{0, 0, size}, {0, 0, -size}});
    EXPECT_TRUE(may_meet(through, face)) << size;
    Box box;
    box.extend(face.a), box.extend(face.b), box.extend(face.c);
    EXPECT_TRUE(may_meet(BoxLine(through), box, 1)) << size;
  }
}

TEST(MayMeet, OfABoxKnowsAxisParallelLines) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  const double far = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(may_meet(BoxLine(DirectedLine(Ray{{0, 0.5, -1}, {0, 0, 1}})), box, far)) << "within a face";
  EXPECT_TRUE(may_meet(BoxLine(DirectedLine(Ray{{0, 0, -1}, {0, -0.0, 1}})), box, far)) << "along an edge";
  EXPECT_FALSE(may_meet(BoxLine(DirectedLine(Ray{{-0.1, 0.5, -1}, {0, 0, 1}})), box, far));
  EXPECT_FALSE(may_meet(BoxLine(DirectedLine(Ray{{0.5, 0.5, -1}, {0, 0, -1}})), box, far)) << "behind";
  EXPECT_FALSE(may_meet(BoxLine(DirectedLine(Segment{{0.5, 0.5, -2}, {0.5, 0.5, -1}})), box, 1)) << "beyond the end";
}

}  // namespace
}  // namespace prohull

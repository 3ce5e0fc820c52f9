#include "geometry/predicates.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "geometry/orientation.h"
#include "geometry/rounded_turn.h"
#include "random.h"

namespace prohull {
namespace {

const Vec3 kA{0, 0, 0}, kB{1, 0, 0}, kC{0, 1, 0};

TEST(Side, OutsideSeesTheTriangleCounterClockwise) {
  EXPECT_EQ(side(kA, kB, kC, {0.3, 0.3, 1}), Side::Outside);
  EXPECT_EQ(side(kA, kB, kC, {0.3, 0.3, -1}), Side::Inside);
  EXPECT_EQ(side(kA, kB, kC, {17, -4, 0}), Side::On);
}

TEST(Side, TellsOneUlpApart) {
  const double third = 1.0 / 3;
  const Vec3 a{third, third, third}, b{1, third, third}, c{third, 1, third};
  EXPECT_EQ(side(a, b, c, {0.7, 0.1, third}), Side::On);
  EXPECT_EQ(side(a, b, c, {0.7, 0.1, std::nextafter(third, 1)}), Side::Outside);
  EXPECT_EQ(side(a, b, c, {0.7, 0.1, std::nextafter(third, 0)}), Side::Inside);
}

TEST(Side, HoldsForTinyAndHugeCoordinates) {
  for (const double scale : {0x1p-1074, 0x1p-500, 1.0, 0x1p500, 0x1p1000}) {
    const Vec3 a = kA * scale, b = kB * scale, c = kC * scale;
    EXPECT_EQ(side(a, b, c, {0, 0, scale}), Side::Outside) << scale;
    EXPECT_EQ(side(a, b, c, {0, 0, -scale}), Side::Inside) << scale;
    EXPECT_EQ(side(a, b, c, {scale, scale, 0}), Side::On) << scale;
  }
}

TEST(Side, HoldsWhereProductsUnderflowUnderAHugeHeight) {
  const double small = 0x1p-530, smaller = 0x1p-545, height = 0x1p200;  // small * smaller rounds to zero
  const Vec3 a{0, 0, height}, b{small, smaller, 0}, c{0, 0, -height}, p{smaller, small, 1};
  EXPECT_EQ(side(a, b, c, p), exact_side(a, b, c, p));
  const Vec3 q{small, 0, 0}, r{0, smaller, 0}, s{small, smaller * 0.5, height};
  EXPECT_EQ(side(q, r, s, {0, 0, 0}), exact_side(q, r, s, {0, 0, 0}));
}

TEST(Side, IsCyclicAndAntisymmetricOnNearlyCoplanarPoints) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a{unit(random), unit(random), unit(random)}, b{unit(random), unit(random), unit(random)},
        c{unit(random), unit(random), unit(random)};
    const Vec3 p = a * 0.25 + b * 0.25 + c * 0.5;
    const Side s = side(a, b, c, p);
    ASSERT_EQ(s, exact_side(a, b, c, p));
    ASSERT_EQ(side(b, c, a, p), s);
    ASSERT_EQ(side(b, a, c, p), opposite(s));
  }
}

// A tetrahedron has six times the volume that the determinant of side() is, also where it is nearly flat.
TEST(VolumeSign, OfATetrahedronIsTheSideOfItsTip) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const double scale : {0x1p-400, 0x1p-100, 1.0, 0x1p100, 0x1p320})
    for (const double far : {0.0, 1e6})
      for (int i = 0; i < 2000; ++i) {
        std::array<Vec3, 3> t;
        for (Vec3& p : t) p = Vec3{unit(random) + far, unit(random), unit(random)} * scale;
        const auto& [a, b, c] = t;
        const Vec3 tip = i % 2 == 0 ? a * 0.25 + b * 0.25 + c * 0.5 : Vec3{unit(random), unit(random), far} * scale;
        const std::array faces{Triangle{a, c, b}, Triangle{a, b, tip}, Triangle{b, c, tip}, Triangle{c, a, tip}};
        ASSERT_EQ(volume_sign(faces), static_cast<int>(exact_side(a, b, c, tip))) << scale;
      }
}

// Of points that are nearly on a line, next to each other and of any size.
TEST(CertainTurn, IsTheTurnOrNothing) {
  std::mt19937 random(test_seed());
  std::uniform_int_distribution<int> steps(-20, 20);
  int certain = 0, uncertain = 0;
  for (int i = 0; i < 3000; ++i) {
    const double size = std::ldexp(1.0, steps(random) * 45);
    const auto point = [&](double at) {
      return Vec3{at, at, at} * size + Vec3{double(steps(random)), double(steps(random)), 0} * (0x1p-53 * size);
    };
    const Vec3 a = point(0.5), b = point(0.75), c = point(1.25);
    for (const int axis : {0, 1, 2}) {
      const auto found = certain_turn(axis, a, b, c);
      ++(found ? certain : uncertain);
      const int exact = turn(axis, a, b, c);
      EXPECT_EQ(found.value_or(exact), exact);
      EXPECT_EQ(certain_turn(axis, a, b, b).value_or(0), 0);
    }
  }
  EXPECT_GT(certain, 0);
  EXPECT_GT(uncertain, 0);
}

TEST(Turn, IsCounterClockwiseSeenFromTheAxis) {
  EXPECT_EQ(turn(2, kA, kB, kC), 1);
  EXPECT_EQ(turn(2, kA, kC, kB), -1);
  EXPECT_EQ(turn(0, kA, kB, kC), 0);
  EXPECT_EQ(turn(0, kA, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(turn(1, kA, {0, 0, 1}, {1, 0, 0}), 1);
}

}  // namespace
}  // namespace prohull

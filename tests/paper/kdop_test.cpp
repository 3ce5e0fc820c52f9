#include "paper/kdop.h"

#include <gtest/gtest.h>

#include <random>

#include "effort.h"
#include "random.h"

namespace prohull {
namespace {

template <class Directions>
class KDopOf : public testing::Test {
 protected:
  static constexpr int kK = Directions::value;

  Vec3 point() { return {coordinate_(random_), coordinate_(random_), coordinate_(random_)}; }

  std::mt19937 random_{test_seed()};
  std::uniform_real_distribution<double> coordinate_{-1, 1};
};

using AllK = testing::Types<std::integral_constant<int, 6>, std::integral_constant<int, 14>,
                            std::integral_constant<int, 18>, std::integral_constant<int, 26>>;
TYPED_TEST_SUITE(KDopOf, AllK);

TYPED_TEST(KDopOf, ATriangleIsMetByEveryLineThatTouchesACorner) {
  constexpr int K = TestFixture::kK;
  for (int i = 0; i < rounds(20000); ++i) {
    // Of any size, near the origin or far away in terms of its size.
    const double size = std::ldexp(1, i % 7 == 0 ? -1000 : i % 7 == 1 ? 900 : i % 40 - 20);
    const Vec3 place = i % 2 == 0 ? Vec3{} : 1e9 * size * this->point();
    const auto point = [&] { return place + size * this->point(); };
    const Triangle triangle{point(), point(), point()};
    Box around;
    for (const Vec3& p : {triangle.a, triangle.b, triangle.c, point(), point()}) around.extend(p);
    const KDopFrame frame(around);
    const KDop<K> kdop = kdop_of<K>(frame, triangle);

    const Vec3 away = i % 5 == 0 ? place + 1e6 * size * this->point() : point();
    const Vec3 direction = triangle.a - away;
    // On a ray the corner is where rounding the direction has left it: at the start, or nearly.
    for (const DirectedLine& line :
         {DirectedLine(Segment{away, triangle.a}), DirectedLine(Segment{triangle.a, away}),
          DirectedLine(Ray{triangle.a, direction}), DirectedLine(Ray{triangle.a, -direction})}) {
      const LineProjections<K> seen(frame, line, std::min(line.t_end, 10.0));
      EXPECT_FALSE(KDopLine<K>(seen).through(kdop, line.t_end).is_empty());
      EXPECT_TRUE(kdop_of(seen).overlaps(kdop));
    }
  }
}

TYPED_TEST(KDopOf, ATriangleIsMissedByMostLinesThatMissIt) {
  constexpr int K = TestFixture::kK;
  const KDopFrame frame(Box{{-1, -1, -1}, {1, 1, 1}});
  int missed = 0, clipped = 0, apart = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 corner = this->point();
    const Triangle triangle{corner, corner + 0.1 * this->point(), corner + 0.1 * this->point()};
    const DirectedLine line(Segment{this->point(), this->point()});
    if (crossing(line, triangle) != Crossing::None) continue;
    ++missed;
    const LineProjections<K> seen(frame, line, line.t_end);
    clipped += KDopLine<K>(seen).through(kdop_of<K>(frame, triangle), 1).is_empty();
    apart += !kdop_of(seen).overlaps(kdop_of<K>(frame, triangle));
  }
  EXPECT_GT(clipped, missed * 0.97);
  EXPECT_GT(apart, missed * (K == 6 ? 0.7 : 0.85));
  EXPECT_GE(clipped, apart);
}

}  // namespace
}  // namespace prohull

#include "geometry/tetrahedron_contact.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "effort.h"
#include "geometry/apart_filter.h"
#include "geometry/exact_triangles.h"
#include "geometry/predicates.h"
#include "random.h"

namespace prohull {
namespace {

struct Meeting {
  bool touches, meets_interior;
};

/// The definition, by construction: the triangle is clipped by the four planes; what is left touches, and meets the
/// inside if its centre, a point of the relative inside, lies strictly inside of all planes.
Meeting true_meeting(const Triangle& t, const Tetrahedron& v) {
  std::vector<Exact::Point_3> polygon{exact(t.a), exact(t.b), exact(t.c)};
  const Exact::Point_3 a = exact(v.a), b = exact(v.b), c = exact(v.c), d = exact(v.d);
  const std::pair<Exact::Point_3, Exact::Vector_3> planes[] = {{a, CGAL::cross_product(b - a, c - a)},
                                                               {a, CGAL::cross_product(c - a, d - a)},
                                                               {a, CGAL::cross_product(d - a, b - a)},
                                                               {b, CGAL::cross_product(d - b, c - b)}};
  for (const auto& [point, n] : planes) {
    std::vector<Exact::Point_3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const auto &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const Exact::FT sp = n * (p - point), sq = n * (q - point);
      if (sp <= 0) kept.push_back(p);
      if (sp * sq < 0) kept.push_back(p + sp / (sp - sq) * (q - p));
    }
    polygon = std::move(kept);
    if (polygon.empty()) return {false, false};
  }
  Exact::Vector_3 sum(0, 0, 0);
  for (const auto& p : polygon) sum = sum + (p - CGAL::ORIGIN);
  const Exact::Point_3 center = CGAL::ORIGIN + sum / Exact::FT(static_cast<int>(polygon.size()));
  for (const auto& [point, n] : planes)
    if (n * (center - point) >= 0) return {true, false};
  return {true, true};
}

TEST(TetrahedronContact, AgreesWithTheClippedTriangleOnASmallGrid) {
  std::mt19937 random(test_seed());
  std::uniform_int_distribution<int> grid(0, 3);
  const auto corner = [&] { return Vec3{0.1 * grid(random), 0.1 * grid(random), 0.1 * grid(random)}; };
  int met = 0, touched = 0, apart = 0, found_apart = 0;
  for (int i = 0; i < rounds(20000); ++i) {
    Tetrahedron v{corner(), corner(), corner(), corner()};
    const Side s = side(v.a, v.b, v.c, v.d);
    if (s == Side::On) continue;
    if (s == Side::Outside) std::swap(v.b, v.c);
    const Triangle t{corner(), corner(), corner()};  // often without area
    const Meeting truth = true_meeting(t, v);
    (truth.meets_interior ? met : truth.touches ? touched : apart) += 1;
    ASSERT_EQ(meets_interior(t, v), truth.meets_interior);
    ASSERT_EQ(meets_interior({t.c, t.a, t.b}, {v.b, v.c, v.a, v.d}), truth.meets_interior);
    if (truth.touches) {
      ASSERT_TRUE(may_touch(t, v));
      ASSERT_TRUE(may_touch({t.c, t.a, t.b}, {v.b, v.c, v.a, v.d}));
    } else {
      found_apart += !may_touch(t, v);
    }
  }
  EXPECT_GT(met, rounds(20000) / 10);
  EXPECT_GT(touched, rounds(20000) / 10);
  EXPECT_GT(apart, rounds(20000) / 10);
  EXPECT_GT(found_apart, 0.98 * apart) << "parallel edges only are left";
}

/// In a frame with the origin at a corner, as placements have it; the corners are on a grid, or nearly, near the origin
/// and far away from it.
TEST(ApartFilter, NeverTellsApartWhatTouches) {
  std::mt19937 random(test_seed());
  std::uniform_int_distribution<int> grid(0, 3), exponent(-17, -6), one_in_two(0, 1);
  std::uniform_real_distribution<double> unit(-1, 1);
  int apart = 0, found = 0;
  for (int i = 0; i < rounds(20000); ++i) {
    const double far = one_in_two(random) ? 0 : 1e4, noise = one_in_two(random) ? 0 : std::pow(10, exponent(random));
    const auto corner = [&] {
      const auto coordinate = [&] { return far + 0.1 * grid(random) + noise * unit(random); };
      return Vec3{coordinate(), coordinate(), coordinate()};
    };
    Tetrahedron v{corner(), corner(), corner(), corner()};
    const Side s = side(v.a, v.b, v.c, v.d);
    if (s == Side::On) continue;
    if (s == Side::Outside) std::swap(v.b, v.c);
    const double inverse_scale = 1 / norm(v.a - v.d);
    const auto local = [&](const Vec3& p) { return (p - v.d) * inverse_scale; };
    const auto corners_of = [&](const Triangle& t) { return std::array{local(t.a), local(t.b), local(t.c)}; };
    const std::array triangles{Triangle{corner(), corner(), corner()}, Triangle{corner(), corner(), corner()}};
    const ApartFilter filter({local(v.a), local(v.b), local(v.c), Vec3{}});
    const unsigned told = filter.certainly_apart(corners_of(triangles[0]), corners_of(triangles[1]));
    for (std::size_t k = 0; k < 2; ++k) {
      const bool is_told = (told >> k & 1) != 0, touches = true_meeting(triangles[k], v).touches;
      ASSERT_FALSE(is_told && touches);
      apart += !touches, found += is_told;
    }
  }
  EXPECT_GT(apart, rounds(20000) / 4);
  EXPECT_GT(found, 0.9 * apart);
}

/// Axes of such sides underflow, and projections on those of huge ones overflow.
TEST(ApartFilter, NeverTellsApartTinyAndHugeTrianglesThatTouch) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto point = [&](double size) { return Vec3{size * unit(random), size * unit(random), size * unit(random)}; };
  for (int i = 0; i < rounds(20000); ++i) {
    const ApartFilter filter({point(1), point(1), point(1), Vec3{}});
    const std::array tiny{Vec3{}, point(1e-155), point(1e-160)}, huge{Vec3{}, point(1e154), point(1e150)};
    ASSERT_EQ(filter.certainly_apart(tiny, huge), 0U);
  }
}

TEST(MeetsInterior, IsFalseForTheFacesOfTheTetrahedron) {
  const Tetrahedron v{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0.1, 0.2, 0.7}};
  ASSERT_EQ(side(v.a, v.b, v.c, v.d), Side::Inside);
  EXPECT_FALSE(meets_interior({v.a, v.b, v.c}, v));
  EXPECT_FALSE(meets_interior({v.a, v.b, v.d}, v));
  EXPECT_TRUE(meets_interior({v.a, v.b, (v.c + v.d) * 0.5}, v)) << "through the middle";
}

TEST(DeterminantSign, IsZeroForEdgesInOnePlaneAndTurnsWithTheOrder) {
  const Vec3 a{0.1, 0.2, 0.3}, b{0.7, 0.1, 0.3}, c{0.4, 0.9, 0.3}, d{0.2, 0.2, 0.3}, e{0.1, 0.1, 0.3}, f{0.5, 0.6, 0.3};
  EXPECT_EQ(determinant_sign(a, b, c, d, e, f), 0);
  const Vec3 up{0.5, 0.6, 0.30000000000000004};
  const int sign = determinant_sign(a, b, c, d, e, up);
  EXPECT_NE(sign, 0);
  EXPECT_EQ(determinant_sign(c, d, a, b, e, up), -sign);
  EXPECT_EQ(determinant_sign(b, a, c, d, e, up), -sign);
}

}  // namespace
}  // namespace prohull

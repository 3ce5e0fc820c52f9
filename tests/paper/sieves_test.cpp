#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "dyadic_points.h"
#include "effort.h"
#include "geometry/bvh.h"
#include "geometry/triangle_intersection.h"
#include "paper/balls.h"
#include "paper/line_sieve.h"
#include "random.h"

namespace prohull {
namespace {

Vec3 scaled(const Vec3& p, double by) { return p * by; }

/// A frame with triangles in it, and segments near them, of all kinds: on small grids, where they touch; far outside;
/// tiny; through the middles of their edges, as nearly as doubles can.
struct Scene {
  Scene(std::mt19937& random, double scale) {
    const bool grid = random() % 2;
    const auto coordinate = [&] {
      return grid ? 0.1 * std::uniform_int_distribution<int>(-9, 9)(random)
                  : std::uniform_real_distribution<double>(-1, 1)(random);
    };
    const auto point = [&] { return Vec3{coordinate(), coordinate(), coordinate()}; };
    const Vec3 moved = random() % 4 == 0 ? point() * 1e6 : Vec3{};
    const auto place = [&](const Vec3& p) { return scaled(p + moved, scale); };
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = point(), q = random() % 2 ? point() : p * 0.9;
      const Vec3 r = random() % 2 ? point() : p * 0.95;
      triangles.push_back({place(p), place(q), place(r)});
      frame.extend(box_of(triangles.back()));
    }
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = point(), q = point();
      const double far = std::array{1.0, 1.0, 3.0, 1e-3, 1e5}[random() % 5];
      segments.push_back({place(p), place(p + (q - p) * far)});
      segments.push_back({place(p - (q - p) * far), place(p + (q - p) * far)});
      const Triangle& t = triangles[random() % 20];
      const Vec3 start = place(p), middle = t.a * 0.5 + t.b * 0.5;
      segments.push_back({start, middle});
      segments.push_back({start, middle + (middle - start)});
    }
  }
  Box frame;
  std::vector<Triangle> triangles;
  std::vector<Segment> segments;
};

bool touch(const Segment& s, const Triangle& t) { return triangles_touch({s.a, s.b, s.b}, t); }

/// Far enough along the ray to be beyond the frame.
Segment piece(const Ray& ray, const Box& frame) {
  const double length = 8 * (frame.diagonal() + norm(ray.origin - frame.center()));
  return {ray.origin, ray.origin + ray.direction * std::exp2(std::ceil(std::log2(length / norm(ray.direction))))};
}

constexpr double kScales[] = {1, 1e-30, 1e30, 0x1p-200, 0x1p200};

TEST(Balls, NeverLetAQueryMissWhatItMeets) {
  std::mt19937 random(test_seed());
  std::size_t met = 0, missed = 0, marked = 0;
  for (int round = 0; round < rounds(300); ++round) {
    const Scene scene(random, kScales[round % 5]);
    Balls balls(scene.frame);
    for (const Triangle& t : scene.triangles) balls.add(std::array{t.a, t.b, t.c});
    std::vector<std::uint8_t> marks(balls.size());
    for (const Segment& s : scene.segments) {
      const Ray ray{s.a, s.b - s.a};
      for (const bool as_ray : {false, true}) {
        balls.mark(as_ray ? DirectedLine(ray) : DirectedLine(s), marks);
        if (as_ray && ray.direction == Vec3{}) continue;
        for (std::size_t i = 0; i < marks.size(); ++i) {
          const bool truth = touch(as_ray ? piece(ray, scene.frame) : s, scene.triangles[i]);
          ASSERT_TRUE(marks[i] || !truth);
          ++(truth ? met : missed);
          marked += marks[i] && !truth;
        }
      }
      Box box;
      box.extend(s.a), box.extend(s.b);
      balls.mark(box, marks);
      for (std::size_t i = 0; i < marks.size(); ++i) ASSERT_TRUE(marks[i] || !box.overlaps(box_of(scene.triangles[i])));
    }
  }
  EXPECT_GT(met, missed / 100);
  EXPECT_LT(marked, missed * 6 / 10);
}

// Of the least radius that there is: what remains is rounding.
TEST(Balls, OfAPointAreMarkedByEveryLineThroughIt) {
  DyadicPoints points(test_seed());
  for (int i = 0; i < rounds(20000); ++i) {
    const Vec3 p = points.any(), away = points.any();
    Balls balls(Box{{-1, -1, -1}, {1, 1, 1}});
    balls.add(std::array{p});
    for (const DirectedLine& line : {DirectedLine(Segment{away, p}), DirectedLine(Segment{away, 2 * p - away}),
                                     DirectedLine(Ray{p, away}), DirectedLine(Ray{away, p - away})}) {
      std::vector<std::uint8_t> marks(1);
      balls.mark(line, marks);
      ASSERT_TRUE(marks[0]);
    }
  }
}

TEST(LineSieve, NeverPassesAFaceThatTheLineMeets) {
  std::mt19937 random(test_seed());
  std::size_t met = 0, missed = 0, passed = 0;
  for (int round = 0; round < rounds(300); ++round) {
    const Scene scene(random, kScales[round % 5]);
    for (const Segment& s : scene.segments) {
      const DirectedLine line(s);
      const LineSieve sieve(line, scene.frame);
      for (const Triangle& t : scene.triangles) {
        const bool truth = touch(s, t);
        ASSERT_FALSE(truth && sieve.passes(t));
        ++(truth ? met : missed);
        passed += sieve.passes(t);
      }
    }
  }
  EXPECT_GT(met, missed / 100);
  EXPECT_GT(passed, missed / 2);
}

}  // namespace
}  // namespace prohull

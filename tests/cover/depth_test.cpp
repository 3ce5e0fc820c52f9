#include "cover/depth.h"

#include <gtest/gtest.h>

#include <list>
#include <random>
#include <vector>

#include "meshes.h"
#include "random.h"

namespace prohull::cover {
namespace {

using namespace meshes;

constexpr double kSlack = 0.01;

TriangleMesh sheet() { return make({{1, 1, 0}, {3, 1, 0}, {1, 3, 1}}, {{0, 1, 2}}); }

ProgressMeter& no_meter() {
  static ProgressMeter meter({}, "test");
  return meter;
}

/// Of a solid with a hole, alone, in place of other triangles, and with a sheet beside it.
std::list<Depth> depths(const TriangleMesh& solid) {
  std::list<Depth> made;
  made.emplace_back(solid, 0, TriangleMesh{}, no_meter());
  made.emplace_back(solid, kSlack, TriangleMesh{}, no_meter());
  made.emplace_back(solid, kSlack, sheet(), no_meter());
  return made;
}

std::vector<Vec3> points_around(const TriangleMesh& solid, int count) {
  std::mt19937 random(test_seed());
  const Box box = bounding_box(solid);
  std::uniform_real_distribution<double> fraction(-0.2, 1.2);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const double t = fraction(random);
      p[axis] = box.min[axis] * (1 - t) + box.max[axis] * t;
    }
    points.push_back(p);
  }
  return points;
}

TEST(Depth, IsNoGreaterThanItsBoundByTheFeetOfOtherPlaces) {
  for (const double size : {1.0, 1e-150, 1e100})
    for (const Vec3& from : {Vec3{}, Vec3{1e6, -1e6, 1e5}}) {
      const TriangleMesh solid = scaled(moved(torus(24, 12), from), size);
      for (const Depth& depth : depths(solid)) {
        std::vector<Vec3> feet;
        for (const Vec3& p : points_around(solid, 200)) {
          const Place place = depth.at(p);
          EXPECT_LE(place.depth, depth.most_at(p, feet));
          feet.push_back(place.foot);
          EXPECT_LE(place.depth, depth.most_at(p, feet));
        }
      }
    }
}

// A place near another is ruled out by that one's foot, without a search.
TEST(Depth, IsBoundedClosely) {
  const TriangleMesh solid = sphere(3);
  const Depth depth(solid, kSlack, {}, no_meter());
  for (const Vec3& p : points_around(solid, 100)) {
    const Place place = depth.at(p);
    if (place.depth <= 0) continue;
    EXPECT_NEAR(depth.most_at(p, std::vector{place.foot}), place.depth, 1e-12);
    const double step = place.depth / 2;
    EXPECT_NEAR(depth.most_at(p - place.inwards * step, std::vector{place.foot}), place.depth - step, 1e-12);
  }
}

TEST(Depth, OfAMedialPlaceIsThatOfItsCenter) {
  const TriangleMesh solid = torus(24, 12);
  for (const Depth& depth : depths(solid)) {
    int found = 0;
    for (const FaceId f : solid.triangles.ids()) {
      const auto medial = depth.medial_place(solid.triangle(f).a, 1e-3);
      if (!medial) continue;
      ++found;
      const Place place = depth.at(medial->center);
      EXPECT_EQ(medial->depth, place.depth);
      EXPECT_EQ(medial->foot, place.foot);
      EXPECT_EQ(medial->inwards, place.inwards);
      EXPECT_GT(depth.in_solid(medial->center), 0);
    }
    EXPECT_GT(found, int(solid.face_count()) / 2);
  }
}

TEST(Depth, SeesNoFacesWithinTheSolid) {
  const TriangleMesh crossing = together(box({0, 0, 0}, {4, 2, 2}), box({3, 0, 0}, {8, 2, 2}));
  const Depth depth(crossing, 0, {}, no_meter());
  for (const double x : {2.0, 3.0, 3.5, 4.0, 6.0}) EXPECT_NEAR(depth.at({x, 1, 1}).depth, 1, 1e-12) << x;
}

}  // namespace
}  // namespace prohull::cover

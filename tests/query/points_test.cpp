#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "effort.h"
#include "geometry/closest_point.h"
#include "geometry/winding_number.h"
#include "meshes.h"
#include "prohull/error.h"
#include "prohull/mesh_query.h"
#include "query/brute_force.h"
#include "query/exact_points.h"
#include "random.h"
#include "verify/offenders.h"

namespace prohull {
namespace {

using namespace meshes;

/// Points at random around a mesh, and points that share coordinates with its corners, edges and faces or lie on them.
std::vector<Vec3> awkward_points(const TriangleMesh& mesh, std::size_t count) {
  std::vector<Vec3> points;
  for (const Segment& s : awkward_segments(mesh, count, test_seed())) {
    points.push_back(s.b);
    points.push_back(s.a * 0.5 + s.b * 0.5);
    points.push_back({s.b.x, s.a.y, s.b.z});
    points.push_back({s.b.x + 1e-3, s.b.y, s.b.z});
  }
  return points;
}

struct NamedMesh {
  const char* name;
  TriangleMesh mesh;
};

/// A sphere of which one vertex is pulled through the other side.
TriangleMesh pierced_sphere() {
  TriangleMesh mesh = sphere(2);
  mesh.positions[VertexId{0}] = mesh.positions[VertexId{0}] * -1.5;
  return mesh;
}

std::vector<NamedMesh> closed_meshes() {
  const TriangleMesh inner = moved(scaled(sphere(2), 0.5), {0.1, 0, 0}), outer = sphere(2);
  return {{"a sphere", outer},
          {"a sphere inside out", inside_out(outer)},
          {"nested spheres", together(outer, inner)},
          {"a cavity", together(outer, inside_out(inner))},
          {"an island in a cavity", together(together(outer, inside_out(inner)), scaled(sphere(1), 0.2))},
          {"overlapping parts", two_spheres_and_a_box()},
          {"a part inside out beside another", together(outer, moved(inside_out(outer), {3, 0, 0}))},
          {"a part inside out across another", together(outer, moved(inside_out(outer), {0.5, 0, 0}))},
          {"a torus of loose faces", soup(torus(8, 6))},
          {"a sphere that intersects itself", pierced_sphere()},
          {"a box", box({0, 0, 0}, {1, 1, 1})}};
}

TEST(Contains, IsAWindingNumberAboveZero) {
  for (const auto& [name, mesh] : closed_meshes()) {
    std::vector<Triangle> triangles;
    for (const FaceId f : mesh.triangles.ids()) triangles.push_back(mesh.triangle(f));
    const WindingNumber reference(std::move(triangles));
    MeshQuery query{QueryIndex(mesh)};
    std::size_t decided = 0;
    for (const Vec3& p : awkward_points(mesh, static_cast<std::size_t>(rounds(500))))
      if (const auto winding = reference.at(p)) {
        ASSERT_EQ(query.contains(p), *winding > 0) << name << ": " << p.x << ' ' << p.y << ' ' << p.z;
        ++decided;
      }
    EXPECT_GT(decided, 50u) << name;
  }
}

TEST(Contains, InABoxAsWideAsNumbersGo) {
  MeshQuery query{QueryIndex(scaled(box({-1, -1, -1}, {1, 1, 1}), 1.7e308))};
  EXPECT_TRUE(query.contains({1e308, 1e300, -1}));
  EXPECT_FALSE(query.contains({1.75e308, 0, 0}));
}

TEST(Contains, IsSaidByEveryEngineAlsoOnTheSurface) {
  for (const auto& [name, mesh] : closed_meshes()) {
    MeshQuery query{QueryIndex(mesh)}, brute{QueryIndex(mesh, Engine::Brute)};
    for (const Vec3& p : awkward_points(mesh, static_cast<std::size_t>(rounds(100))))
      ASSERT_EQ(query.contains(p), brute.contains(p)) << name;
  }
}

Number squared_distance(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a, away = p - a;
  const Number length = dot(along, along), part = dot(along, away);
  if (part <= 0) return dot(away, away);
  if (part >= length) return dot(p - b, p - b);
  return dot(away, away) - part * part / length;
}

/// Exact, and unlike the library: the plane's distance if the point lies above the face, else that of an edge.
Number squared_distance(const Vec3& point, const Triangle& t) {
  const Point p = exact(point), a = exact(t.a), b = exact(t.b), c = exact(t.c), n = cross(b - a, c - a);
  const auto lies_above = [&] {
    if (dot(n, n) == 0) return false;
    for (const auto& [u, v] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      if (dot(n, cross(v - u, p - u)) < 0) return false;
    return true;
  };
  if (lies_above()) return dot(n, p - a) * dot(n, p - a) / dot(n, n);
  return std::min({squared_distance(p, a, b), squared_distance(p, b, c), squared_distance(p, c, a)});
}

Number squared_distance(const Vec3& point, const TriangleMesh& mesh) {
  Number least = squared_distance(point, mesh.triangle(FaceId{0}));
  for (const FaceId f : mesh.triangles.ids()) least = std::min(least, squared_distance(point, mesh.triangle(f)));
  return least;
}

/// Largest allowed upper - lower, in lengths of the distance and the size of the mesh.
constexpr double kTight = 1e-13, kLoose = 2;

void expect_bounds(const TriangleMesh& mesh, const std::vector<Vec3>& points, double allowed = kTight) {
  const Box box = bounding_box(mesh);
  const double size = std::max({box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z});
  MeshQuery query{QueryIndex(mesh)}, brute{QueryIndex(mesh, Engine::Brute)};
  for (const Vec3& p : points) {
    const auto closest = query.closest_point(p);
    ASSERT_TRUE(closest);
    const Number truth = squared_distance(p, mesh), lower = closest->lower, upper = closest->upper;
    ASSERT_GE(closest->lower, 0);
    ASSERT_LE(lower * lower, truth) << p.x << ' ' << p.y << ' ' << p.z;
    ASSERT_GE(upper * upper, truth) << p.x << ' ' << p.y << ' ' << p.z;
    ASSERT_LE(closest->lower, closest->distance);
    ASSERT_GE(closest->upper, closest->distance);
    ASSERT_LE(closest->upper - closest->lower, allowed * (closest->distance + size)) << p.x << ' ' << p.y << ' ' << p.z;
    const auto scanned = brute.closest_point(p);
    ASSERT_EQ(closest->face, scanned->face);
    ASSERT_EQ(closest->position, scanned->position);
    ASSERT_EQ(closest->upper, scanned->upper);
  }
}

std::vector<Vec3> some_points(const TriangleMesh& mesh) {
  return awkward_points(mesh, static_cast<std::size_t>(effort(15, 4)));
}

TEST(ClosestPoint, IsWithinItsBoundsExactly) {
  for (const TriangleMesh& mesh : {octahedron(), soup(torus(8, 6)), box({0, 0, 0}, {1, 2, 3}), sphere(1)}) {
    std::vector<Vec3> points = some_points(mesh);
    for (std::size_t i = points.size(); i-- > 0;) {  // very close to the surface
      const Vec3 foot = MeshQuery{QueryIndex(mesh)}.closest_point(points[i])->position;
      points.push_back(foot + (points[i] - foot) * 1e-9);
    }
    expect_bounds(mesh, points);
  }
}

TEST(ClosestPoint, IsWithinItsBoundsWhateverTheSizeOfCoordinates) {
  const TriangleMesh mesh = octahedron();
  for (const double size : {1e-310, 1e-290, 1e-150, 1e-62, 1e62, 1e150, 1e300, 1e307}) {
    const TriangleMesh resized = scaled(mesh, size);
    std::vector<Vec3> points = some_points(mesh);
    for (Vec3& p : points) p = p * size;
    expect_bounds(resized, points, size < 1e-300 ? kLoose : kTight);  // subnormals have few digits
  }
  expect_bounds(scaled(mesh, 1e-100), some_points(mesh));
  const TriangleMesh far_away = moved(mesh, {1e6, -3e5, 0.1});
  expect_bounds(far_away, some_points(far_away));
}

TEST(ClosestPoint, OfAPointJustBesideACornerOfAHugeFaceIsWithinItsBounds) {
  for (const double size : {1e100, 1e250, 1e305})
    for (const double away : {1e-300, 1e-240, 1e-80})
      expect_bounds(make({{size, 0, 0}, {0, size, 0}, {0, 0, size}}, {{0, 1, 2}}), {{size, -away, 0}, {size, 0, away}});
  expect_bounds(make({{1e308, 0, 0}, {1e308, 1e61, 0}, {1e308, 0, 1e61}}, {{0, 1, 2}}), {{1e308, -1e61, 1e60}});
}

TEST(ClosestPoint, OfAPointFarAwayIsWithinItsBounds) {
  const TriangleMesh mesh = sphere(1);
  for (const double far : {1e3, 1e6, 1e18, 1e305}) {
    std::vector<Vec3> points = some_points(mesh);
    for (Vec3& p : points) p = p * far;
    expect_bounds(mesh, points);
  }
}

TEST(ClosestPoint, OfNeedlesAndFacesWithoutAreaIsWithinItsBounds) {
  const auto mesh = make({{0, 0, 0},
                          {1, 0, 0},
                          {0.5, 1e-9, 0},
                          {0.3, 1e-17, 1},
                          {2, 0.1, 0.7},
                          {3, 0.1, 0.7},
                          {4, 0.1, 0.7},
                          {-1, -1, -1},
                          {-1, -1, -1 + 1e-12}},
                         {{0, 1, 2}, {0, 1, 3}, {4, 5, 6}, {4, 4, 5}, {7, 7, 7}, {7, 8, 0}, {6, 5, 4}});
  expect_bounds(mesh, some_points(mesh), 1e-6);
}

// Corners that coincide, and third corners that are rounded to a point of an edge.
TEST(ClosestPoint, OfAFaceThatIsASegmentIsThatOfTheSegment) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto any = [&] { return Vec3{coordinate(random), coordinate(random), coordinate(random)}; };
  for (const double size : {1e-90, 1.0, 1e30, 1e99})
    for (int round = 0; round < rounds(100); ++round) {
      const Vec3 a = any() * size, b = any() * size, on_edge = a + (b - a) * std::abs(coordinate(random));
      const Vec3 p = any() * (round % 2 == 0 ? 2 * size : 1e3 * size);
      for (const Triangle& t : {Triangle{a, a, b}, Triangle{a, b, a}, Triangle{b, a, a}, Triangle{a, a, a},
                                Triangle{on_edge, a, b}, Triangle{a, on_edge, b}, Triangle{a, b, on_edge}}) {
        expect_bounds(make({t.a, t.b, t.c}, {{0, 1, 2}}), {p});
        const double truth = std::sqrt(CGAL::to_double(squared_distance(p, t))), allowed = 1e-14 * norm(p);
        ASSERT_NEAR(norm(p - closest_point(p, t)), truth, allowed);
        ASSERT_NEAR(verify::distance(p, t), truth, allowed);
      }
    }
}

TEST(ClosestPoint, OfAPointOnAFeatureIsAtDistanceZero) {
  const TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  MeshQuery query{QueryIndex(mesh)};
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    const auto corner = query.closest_point(t.b);
    EXPECT_EQ(corner->position, t.b);
    EXPECT_EQ(corner->upper, 0);
    for (const Vec3& p : {t.b, (t.a + t.b) * 0.5, t.a * 0.5 + t.b * 0.25 + t.c * 0.25}) {
      EXPECT_EQ(query.closest_point(p)->distance, 0);
      EXPECT_EQ(query.closest_point(p)->lower, 0);
      EXPECT_LT(query.closest_point(p)->upper, 1e-14);
    }
  }
}

TEST(ClosestPoint, OfSeveralFacesIsThatWithTheLowestNumber) {
  const TriangleMesh mesh = box({-1, -1, -1}, {1, 1, 1});
  EXPECT_EQ(MeshQuery{QueryIndex(mesh)}.closest_point({0, 0, 0})->face, FaceId{0});
  EXPECT_EQ(MeshQuery{QueryIndex(together(mesh, mesh))}.closest_point({3, 0.2, 0.1})->face,
            MeshQuery{QueryIndex(mesh)}.closest_point({3, 0.2, 0.1})->face);
}

TEST(ClosestPoint, IsCertainlyWithinTheMaximum) {
  MeshQuery query{QueryIndex(box({0, 0, 0}, {1, 1, 1}))};
  const Vec3 p{0.4, 0.3, 2};
  EXPECT_FALSE(query.closest_point(p, 0.99));
  const auto closest = query.closest_point(p, 1.01);
  ASSERT_TRUE(closest);
  EXPECT_EQ(closest->distance, query.closest_point(p)->distance);
  EXPECT_TRUE(query.closest_point(p, closest->upper));
  EXPECT_FALSE(query.closest_point(p, std::nextafter(closest->upper, 0)));
  EXPECT_TRUE(query.closest_point({1, 0, 1}, 0));
  EXPECT_THROW(query.closest_point(p, -1), InputError);
  EXPECT_THROW(query.closest_point(p, std::nan("")), InputError);
}

TEST(ClosestPoint, OfAnEmptyMeshIsNone) {
  const QueryIndex nothing{TriangleMesh{}};
  EXPECT_FALSE(MeshQuery{nothing}.closest_point({0, 0, 0}));
  EXPECT_THROW(MeshQuery{nothing}.signed_distance({0, 0, 0}), InputError);
}

TEST(SignedDistance, IsNegativeInside) {
  const TriangleMesh shell = together(box({0, 0, 0}, {4, 4, 4}), inside_out(box({1, 1, 1}, {3, 3, 3})));
  MeshQuery query{QueryIndex(shell)};
  for (const auto& [p, distance] : {std::pair(Vec3{2, 2, 2}, 1.0), std::pair(Vec3{2.1, 1.9, 0.25}, -0.25),
                                    std::pair(Vec3{2.1, 1.9, -0.25}, 0.25), std::pair(Vec3{7, 8, 4}, 5.0)}) {
    const ClosestPoint found = query.signed_distance(p);
    EXPECT_DOUBLE_EQ(found.distance, distance);
    EXPECT_LE(found.lower, distance);
    EXPECT_GE(found.upper, distance);
    EXPECT_EQ(found.face, query.closest_point(p)->face);
  }
  TriangleMesh open = octahedron();
  open.triangles.pop_back();
  EXPECT_THROW(MeshQuery{QueryIndex(open)}.signed_distance({0, 0, 0}), InputError);
}

TEST(Distances, OfABatchAreThoseOfEachPoint) {
  const QueryIndex index(two_spheres_and_a_box());
  MeshQuery query(index);
  std::vector<Vec3> points = awkward_points(two_spheres_and_a_box(), static_cast<std::size_t>(rounds(500)));
  for (const unsigned threads : {0u, 1u}) {
    const auto closest = closest_points(index, points, 0.5, {.threads = threads});
    const auto distances = signed_distances(index, points, {.threads = threads});
    ASSERT_EQ(closest.size(), points.size());
    ASSERT_EQ(distances.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(closest[i], query.closest_point(points[i], 0.5));
      ASSERT_EQ(distances[i], query.signed_distance(points[i]));
    }
  }
  const BatchOptions stopped{.progress = [](std::string_view, double) { return false; }};
  EXPECT_THROW(closest_points(index, points, 1, stopped), Cancelled);
  EXPECT_THROW(signed_distances(index, points, stopped), Cancelled);
  EXPECT_THROW(closest_points(index, points, -1), InputError);
  points[34].z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(closest_points(index, points), InputError);
  EXPECT_THROW(signed_distances(index, points), InputError);
}

TEST(Batches, RefuseWhatIsNotFiniteInOnePlace) {
  const QueryIndex index(meshes::octahedron());
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Ray> rays_from_nowhere{{{kNan, 0, 0}, {1, 0, 0}}}, rays_to_nowhere{{{0, 0, 0}, {1, kNan, 0}}};
  const std::vector<Segment> from_nowhere{{{kNan, 0, 0}, {1, 0, 0}}}, to_nowhere{{{0, 0, 0}, {1, kNan, 0}}};
  EXPECT_THROW(crosses(index, rays_from_nowhere), InputError);
  EXPECT_THROW(crosses(index, rays_to_nowhere), InputError);
  EXPECT_THROW(crosses(index, from_nowhere), InputError);
  EXPECT_THROW(crosses(index, to_nowhere), InputError);
}

}  // namespace
}  // namespace prohull

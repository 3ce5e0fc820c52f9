#include "prohull/convex_hull.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>
#include <tuple>

#include "effort.h"
#include "geometry/predicates.h"
#include "meshes.h"
#include "prohull/enclosure.h"
#include "prohull/mesh_report.h"
#include "prohull/sample.h"
#include "random.h"
#include "verify/oracle.h"

namespace prohull {
namespace {

using namespace meshes;

/// A mesh whose triangles use these points, whatever they look like.
TriangleMesh through(const std::vector<Vec3>& points) {
  TriangleMesh mesh;
  for (const Vec3& p : points) {
    const VertexId v = mesh.positions.push_back(p);
    mesh.triangles.push_back({v, VertexId(0), v});
  }
  return mesh;
}

/// What the header guarantees: it is closed, and no vertex of the mesh is outside of a face's plane.
void expect_convex_hull(const TriangleMesh& mesh, const TriangleMesh& hull) {
  ASSERT_TRUE(inspect(hull).is_closed_manifold()) << inspect(hull).first_defect;
  for (const FaceId f : hull.triangles.ids()) {
    const Triangle t = hull.triangle(f);
    for (const Vec3& p : mesh.positions) ASSERT_NE(side(t.a, t.b, t.c, p), Side::Outside) << "face " << index(f);
  }
  std::set<std::tuple<double, double, double>> given;
  for (const Vec3& p : mesh.positions) given.insert({p.x, p.y, p.z});
  for (const Vec3& p : hull.positions) ASSERT_TRUE(given.contains({p.x, p.y, p.z}));
  const double expected = signed_volume(oracle::convex_hull(mesh));
  EXPECT_NEAR(signed_volume(hull), expected, 1e-9 * expected);
}

TEST(ConvexHull, OfAConvexMeshIsTheMeshItself) {
  for (const TriangleMesh& mesh : {tetrahedron(), octahedron(), sphere(2), box({-1, 2, 0}, {3, 4, 0.5})}) {
    const TriangleMesh hull = convex_hull(mesh);
    EXPECT_EQ(hull.face_count(), mesh.face_count());
    expect_convex_hull(mesh, hull);
  }
}

TEST(ConvexHull, EnclosesSamples) {
  for (const char* const name : {"torus", "knot", "asteroid", "bracket"}) {
    const TriangleMesh mesh = make_sample(name, 1000);
    const TriangleMesh hull = convex_hull(mesh);
    expect_convex_hull(mesh, hull);
    EXPECT_TRUE(verify_cover(mesh, hull).encloses) << name;
  }
}

TEST(ConvexHull, LeavesOutVerticesWithinFacesAndEdges) {
  const TriangleMesh fine = subdivided(subdivided(box({0, 0, 0}, {1, 1, 1})));
  const TriangleMesh hull = convex_hull(fine);
  EXPECT_EQ(hull.face_count(), 12u);
  EXPECT_EQ(hull.vertex_count(), 8u);
  expect_convex_hull(fine, hull);
}

TEST(ConvexHull, HasNoFacesIfAllPointsLieInAPlane) {
  for (const TriangleMesh& flat :
       {through({{0, 0, 0}}), through({{0, 0, 0}, {1, 2, 3}}), through({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {-1, -2, -3}}),
        through({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {0.3, 0.2, 1}}), through({{1, 1, 1}, {1, 1, 1}}),
        TriangleMesh{}})
    EXPECT_EQ(convex_hull(flat).face_count(), 0u);
}

TEST(ConvexHull, DistinguishesAlmostFlatFromFlat) {
  const TriangleMesh thin = through({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.5, 0x1p-60}});
  const TriangleMesh hull = convex_hull(thin);
  EXPECT_EQ(hull.face_count(), 6u);
  expect_convex_hull(thin, hull);
}

TEST(ConvexHull, HasAllFacesWhereSquaresUnderflowOrOverflow) {
  for (const double size : {1e-150, 1e-90, 1e90}) {
    const TriangleMesh cube = box({0, 0, 0}, {size, size, size});
    const TriangleMesh hull = convex_hull(cube);
    EXPECT_EQ(hull.face_count(), 12u) << size;
    expect_convex_hull(cube, hull);
  }
}

// The areas of their triangles may be less than rounding.
TEST(ConvexHull, DistinguishesAlmostStraightFromStraight) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> coordinate(1, 2);
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 end{coordinate(random), coordinate(random), coordinate(random)}, p = end * 0.3, q = end * 0.7;
    const bool is_flat = side({0, 0, 0}, p, q, end) == Side::On;
    ASSERT_EQ(convex_hull(through({{0, 0, 0}, p, q, end})).face_count(), is_flat ? 0u : 4u) << i;
  }
}

TEST(ConvexHull, TakesOnlyVerticesThatTrianglesUse) {
  TriangleMesh mesh = octahedron();
  mesh.positions.push_back({9, 9, 9});
  EXPECT_DOUBLE_EQ(signed_volume(convex_hull(mesh)), signed_volume(octahedron()));
}

// Points of a small lattice: most are coplanar, collinear or equal to others.
TEST(ConvexHull, OfRandomLatticePointsIsExact) {
  std::mt19937 random(test_seed());
  for (int round = 0; round < rounds(300); ++round) {
    std::uniform_int_distribution<int> coordinate(0, 1 + round % 6);
    std::vector<Vec3> points;
    const auto count = std::uniform_int_distribution<int>(4, 60)(random);
    for (int i = 0; i < count; ++i)
      points.push_back({double(coordinate(random)), double(coordinate(random)), double(coordinate(random))});
    const TriangleMesh mesh = through(points), hull = convex_hull(mesh);
    bool is_flat = true;
    for (std::size_t i = 0; is_flat && i < points.size(); ++i)
      for (std::size_t j = 0; is_flat && j < i; ++j)
        for (std::size_t k = 0; is_flat && k < j; ++k)
          is_flat = side(points[0], points[i], points[j], points[k]) == Side::On;
    EXPECT_EQ(hull.face_count() == 0, is_flat) << "round " << round;
    if (!is_flat) expect_convex_hull(mesh, hull);
  }
}

TEST(ConvexHull, SlabsReachOutAlongAllAxes) {
  const TriangleMesh triangle = meshes::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const TriangleMesh slab = slab_around(triangle, 0.25);
  EXPECT_TRUE(inspect(slab).is_closed_manifold());
  EXPECT_EQ(bounding_box(slab).min, (Vec3{-0.25, -0.25, -0.25}));
  EXPECT_EQ(bounding_box(slab).max, (Vec3{1.25, 1.25, 0.25}));
  EXPECT_TRUE(verify_cover(triangle, slab).encloses);
}

TEST(ConvexHull, WithPaddingKeepsTheDistance) {
  const TriangleMesh flat = make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  for (const TriangleMesh& mesh : {flat, octahedron(), sphere(2)})
    for (const double distance : {0.01, 3.0}) {
      const TriangleMesh hull = padded_convex_hull(mesh, distance);
      ASSERT_GT(hull.face_count(), 0u);
      for (const FaceId f : hull.triangles.ids()) {
        const Triangle t = hull.triangle(f);
        const Vec3 n = cross(t.b - t.a, t.c - t.a);
        double nearest = std::numeric_limits<double>::infinity();
        for (const Vec3& p : mesh.positions) nearest = std::min(nearest, dot(n, t.a - p) / norm(n));
        EXPECT_GE(nearest, distance * (1 - 1e-9));
        EXPECT_LE(nearest, 1.06 * distance);
      }
    }
  EXPECT_EQ(padded_convex_hull({}, 1).face_count(), 0u);
}

}  // namespace
}  // namespace prohull

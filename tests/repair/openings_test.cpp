#include "prohull/detail/openings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include "meshes.h"
#include "prohull/mesh_report.h"
#include "prohull/repair.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

template <class Goes>
TriangleMesh without(TriangleMesh mesh, Goes goes) {
  PerFace<std::array<VertexId, 3>> kept;
  for (const FaceId f : mesh.triangles.ids())
    if (!goes(mesh.triangle(f))) kept.push_back(mesh.triangles[f]);
  mesh.triangles = std::move(kept);
  return mesh;
}

std::vector<std::size_t> lengths(const std::vector<Opening>& openings) {
  std::vector<std::size_t> result;
  for (const Opening& opening : openings) result.push_back(opening.loop.size());
  return result;
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    sum += norm(cross(t.b - t.a, t.c - t.a)) / 2;
  }
  return sum;
}

/// The mesh with a cap on every opening, which must close it.
MeshReport closed_by_caps(const TriangleMesh& mesh) {
  const TriangleMesh capped = with_caps(mesh, find_openings(mesh));
  EXPECT_TRUE(find_openings(capped).empty());
  const RepairedMesh repaired = repaired_mesh(capped);
  EXPECT_TRUE(repaired.closed) << repaired.obstacle;
  EXPECT_EQ(repaired.repairs.turned_single_faces, 0u) << "caps face the side that the faces beside them face";
  return repaired.closed ? repaired.closed->report : MeshReport{};
}

/// A closed line with a tube below it: quads from the line straight down to z = -1.
TriangleMesh skirt(const std::vector<Vec3>& line) {
  const auto n = static_cast<std::uint32_t>(line.size());
  std::vector<Vec3> positions = line;
  for (const Vec3& p : line) positions.push_back({p.x, p.y, -1});
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    triangles.push_back({i, n + i, n + j});
    triangles.push_back({i, n + j, j});
  }
  return make(positions, triangles);
}

std::vector<Vec3> circle(std::uint32_t corners, double radius = 1) {
  std::vector<Vec3> line;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    line.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return line;
}

/// A strip of quads whose ends are joined after a half turn, or after none.
TriangleMesh band(std::uint32_t quads, bool is_turned) {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < quads; ++i) {
    const double u = 2 * std::numbers::pi * i / quads, v = is_turned ? u / 2 : 0;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::sin(v);
      positions.push_back({r * std::cos(u), r * std::sin(u), side * std::cos(v)});
    }
    const bool flips = is_turned && i + 1 == quads;
    const std::uint32_t a = 2 * i, b = a + 1, next = 2 * ((i + 1) % quads), c = next + !flips, d = next + flips;
    triangles.push_back({a, d, c});
    triangles.push_back({a, c, b});
  }
  return make(positions, triangles);
}

TEST(Openings, AreNotFoundInClosedMeshes) {
  for (const TriangleMesh& mesh : {octahedron(), torus(9, 5), soup(sphere(2))}) {
    EXPECT_TRUE(find_openings(mesh).empty());
    EXPECT_EQ(with_caps(mesh, {}), mesh);
  }
  EXPECT_TRUE(find_openings({}).empty());
}

TEST(Openings, OfACubeWithoutASideIsThatSide) {
  const TriangleMesh cube =
      without(box({0, 0, 0}, {4, 4, 4}), [](const Triangle& t) { return t.a.z == 4 && t.b.z == 4 && t.c.z == 4; });
  for (const TriangleMesh& mesh : {cube, soup(cube), inside_out(cube)}) {
    const std::vector<Opening> openings = find_openings(mesh);
    ASSERT_EQ(lengths(openings), std::vector<std::size_t>{4});
    EXPECT_DOUBLE_EQ(openings[0].diameter, std::sqrt(32));
    EXPECT_EQ(closed_by_caps(mesh).volume, 64);
  }
}

TEST(Openings, OfACylinderWithoutLidsAreItsRims) {
  const TriangleMesh tube = skirt(circle(32));
  const std::vector<Opening> openings = find_openings(tube);
  EXPECT_EQ(lengths(openings), (std::vector<std::size_t>{32, 32}));
  EXPECT_NEAR(openings[0].diameter, 2, 1e-12);
  const MeshReport closed = closed_by_caps(tube);
  EXPECT_NEAR(closed.volume, 16 * std::sin(2 * std::numbers::pi / 32), 1e-12);
  EXPECT_EQ(closed.faces, 64u + 2 * 30);
}

TEST(Openings, ComeLargestFirst) {
  const TriangleMesh ball = sphere(4);
  const TriangleMesh holed =
      without(ball, [](const Triangle& t) { return t.a.z > 0.7 || t.a.x > 0.9 || t.a.y < -0.98; });
  const std::vector<Opening> openings = find_openings(holed);
  ASSERT_EQ(openings.size(), 3u);
  EXPECT_TRUE(std::ranges::is_sorted(openings, std::greater(), &Opening::diameter));
  EXPECT_NEAR(openings[0].diameter, 2 * std::sqrt(1 - 0.7 * 0.7), 0.2);
  const MeshReport closed = closed_by_caps(holed);
  EXPECT_EQ(closed.euler_characteristic, 2);
  EXPECT_LT(closed.volume, signed_volume(ball));
  EXPECT_GT(closed.volume, 0.7 * signed_volume(ball));
}

TEST(Openings, ThatMeetInAVertexAreTwo) {
  // Faces around two vertices of a sphere whose links share one vertex: the boundary is a figure of eight.
  const TriangleMesh ball = sphere(2);
  const auto link_of = [&](VertexId v) {
    std::set<VertexId> link;
    for (const auto& t : ball.triangles)
      if (std::ranges::count(t, v)) link.insert(t.begin(), t.end());
    link.erase(v);
    return link;
  };
  const std::set<VertexId> link = link_of(VertexId(0));
  VertexId other{};
  for (const VertexId v : ball.positions.ids()) {
    const std::set<VertexId> theirs = link_of(v);
    const auto shared = std::ranges::count_if(theirs, [&](VertexId w) { return link.contains(w); });
    if (shared == 1 && !link.contains(v) && index(v) != 0) other = v;
  }
  ASSERT_NE(index(other), 0u);
  const Vec3 a = ball.positions[VertexId(0)], b = ball.positions[other];
  const TriangleMesh holed = without(
      ball, [&](const Triangle& t) { return t.a == a || t.b == a || t.c == a || t.a == b || t.b == b || t.c == b; });
  EXPECT_EQ(inspect(holed).non_manifold_vertices, 1u);
  const std::vector<std::size_t> found = lengths(find_openings(holed));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0] + found[1], link.size() + link_of(other).size());
  EXPECT_EQ(closed_by_caps(holed).components, 1u);
}

TEST(Openings, OfSheetsThatMeetInAVertexStayApart) {
  const auto cup = without(tetrahedron(), [](const Triangle& t) { return t.a.z == 0 && t.b.z == 0 && t.c.z == 0; });
  const TriangleMesh cups = together(cup, moved(cup, {1, 0, 0}));
  EXPECT_EQ(lengths(find_openings(cups)), (std::vector<std::size_t>{3, 3}));
  EXPECT_EQ(closed_by_caps(cups).components, 2u);
}

TEST(Openings, OfASheetIsItsRim) {
  const TriangleMesh sheet = make({{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const std::vector<Opening> openings = find_openings(sheet);
  ASSERT_EQ(lengths(openings), std::vector<std::size_t>{4});
  EXPECT_EQ(openings[0].diameter, 5);
  const TriangleMesh capped = with_caps(sheet, openings);
  EXPECT_EQ(area(capped), 24);
  EXPECT_TRUE(inspect(capped).is_watertight());
}

TEST(Openings, OfAMoebiusBandIsOneLoop) {
  EXPECT_EQ(lengths(find_openings(band(20, false))), (std::vector<std::size_t>{20, 20}));
  const TriangleMesh moebius = band(20, true);
  const std::vector<Opening> openings = find_openings(moebius);
  EXPECT_EQ(lengths(openings), std::vector<std::size_t>{40});
  EXPECT_EQ(inspect(with_caps(moebius, openings)).open_edges, 0u);
}

TEST(Openings, AlongTJunctionsGetCapsWithoutArea) {
  // The top of a box is split at the middle of an edge that the side does not split, twice.
  TriangleMesh cracked =
      without(box({0, 0, 0}, {4, 4, 4}), [](const Triangle& t) { return t.a.z == 4 && t.b.z == 4 && t.c.z == 4; });
  const VertexId a{4}, b{5}, c{7}, d{6}, near = cracked.positions.push_back({1, 0, 4}),
                                         middle = cracked.positions.push_back({2, 0, 4});
  for (const auto& t : {std::array{a, near, d}, {near, middle, d}, {middle, c, d}, {middle, b, c}})
    cracked.triangles.push_back(t);
  const std::vector<Opening> openings = find_openings(cracked);
  EXPECT_EQ(lengths(openings), std::vector<std::size_t>{4});
  const MeshReport closed = closed_by_caps(cracked);
  EXPECT_EQ(closed.volume, 64);
  EXPECT_EQ(area(with_caps(cracked, openings)), 96);
}

TEST(Openings, ContinueAlongAFin) {
  // A fin stands on the rim of a cube without a side: the surface goes on there.
  TriangleMesh cube =
      without(box({0, 0, 0}, {4, 4, 4}), [](const Triangle& t) { return t.a.z == 4 && t.b.z == 4 && t.c.z == 4; });
  cube.triangles.push_back({VertexId(4), VertexId(5), cube.positions.push_back({2, 2, 6})});
  EXPECT_EQ(lengths(find_openings(cube)), std::vector<std::size_t>{5});
  EXPECT_EQ(inspect(with_caps(cube, find_openings(cube))).open_edges, 0u);
}

TEST(Openings, RunAlongEdgesOfThreeFaces) {
  // Three triangles on one edge: the rims of two are a loop, that of the third closes along the edge.
  const TriangleMesh book =
      make({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  std::vector<std::size_t> found = lengths(find_openings(book));
  std::ranges::sort(found);
  EXPECT_EQ(found, (std::vector<std::size_t>{3, 4}));
  // A wall stands on two opposite edges of a cube without a side, which is open on both sides of it.
  TriangleMesh cube =
      without(box({0, 0, 0}, {4, 4, 4}), [](const Triangle& t) { return t.a.z == 4 && t.b.z == 4 && t.c.z == 4; });
  cube.triangles.push_back({VertexId(4), VertexId(0), VertexId(7)});
  cube.triangles.push_back({VertexId(0), VertexId(3), VertexId(7)});
  EXPECT_EQ(inspect(cube).non_manifold_edges, 3u);
  EXPECT_EQ(inspect(with_caps(cube, find_openings(cube))).open_edges, 0u);
}

TEST(Openings, AreNoWallsInsideOfSolids) {
  TriangleMesh cube = box({0, 0, 0}, {4, 4, 4});
  cube.triangles.push_back({VertexId(0), VertexId(3), VertexId(4)});
  cube.triangles.push_back({VertexId(3), VertexId(7), VertexId(4)});
  EXPECT_EQ(inspect(cube).non_manifold_edges, 4u);
  EXPECT_TRUE(find_openings(cube).empty());
}

TEST(Openings, IgnoreWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TriangleMesh ball = sphere(2);
  for (int i = 0; i < 100; ++i) ball.positions.push_back({nan, i % 2 ? nan : i, 0});
  const VertexId lost = ball.positions.push_back({nan, 0, 0});
  ball.triangles.push_back({VertexId(0), VertexId(1), lost});
  EXPECT_TRUE(find_openings(ball).empty());
  ball.triangles[FaceId(5)][0] = lost;
  EXPECT_EQ(lengths(find_openings(ball)), std::vector<std::size_t>{3});
}

TEST(Caps, AreWhereTheyWereBesideAnUnusedVertexThatIsNotFinite) {
  const TriangleMesh skirt_of_a_box = skirt({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}});
  TriangleMesh mesh;
  mesh.positions.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  append(mesh, skirt_of_a_box);
  EXPECT_DOUBLE_EQ(closed_by_caps(mesh).volume, closed_by_caps(skirt_of_a_box).volume);
}

TEST(Caps, HaveTheLeastArea) {
  // A U, whose convex hull is larger, and a saddle, of which two triangulations are possible.
  const TriangleMesh u =
      skirt({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
  EXPECT_DOUBLE_EQ(closed_by_caps(u).volume, 7);
  const TriangleMesh saddle = skirt({{2, 0, 0}, {0, 1, 1}, {-2, 0, 0}, {0, -1, 1}});
  EXPECT_DOUBLE_EQ(area(with_caps(saddle, find_openings(saddle))) - area(saddle), 2 * std::sqrt(5.0) + 4)
      << "the fold runs between the ends that are nearer to each other";
}

TEST(Caps, AvoidEdgesThatTheMeshHas) {
  // A tetrahedron stands on the shorter diagonal of the hole.
  TriangleMesh mesh = skirt({{0, -1, 0}, {3, 0, 0}, {0, 1, 0}, {-3, 0, 0}});
  const VertexId tip = mesh.positions.push_back({1, 1, 5}), side = mesh.positions.push_back({2, 1, 5});
  for (const auto& t : {std::array{VertexId(0), VertexId(2), tip},
                        {VertexId(2), VertexId(0), side},
                        {VertexId(0), tip, side},
                        {tip, VertexId(2), side}})
    mesh.triangles.push_back(t);
  EXPECT_EQ(inspect(with_caps(mesh, find_openings(mesh))).non_manifold_edges, 0u);
}

TEST(Caps, OfLongPlanarLoopsAreFlat) {
  std::vector<Vec3> star = circle(3000);
  for (std::size_t i = 0; i < star.size(); i += 2) star[i] = star[i] * 0.3;
  const TriangleMesh tube = skirt(star);
  const MeshReport closed = closed_by_caps(tube);
  EXPECT_EQ(closed.vertices, tube.vertex_count());
  EXPECT_NEAR(closed.volume, 3000 * 0.3 * std::sin(2 * std::numbers::pi / 3000) / 2, 1e-9);
}

TEST(Caps, OfLongWindingLoopsAreFans) {
  // Three turns around the axis, up and down: from no side a simple polygon.
  std::vector<Vec3> line;
  for (int i = 0; i < 600; ++i) {
    const double angle = 2 * std::numbers::pi * i / 600;
    line.push_back({std::cos(angle) + 2 * std::cos(2 * angle), std::sin(angle) - 2 * std::sin(2 * angle),
                    2 * std::sin(3 * angle)});
  }
  const TriangleMesh tube = skirt(line);
  EXPECT_TRUE(inspect(with_caps(tube, find_openings(tube))).is_closed_manifold());
}

TEST(Caps, OfManyLongLoopsTakeLittleMemoryAndEnd) {
  TriangleMesh mesh;
  const TriangleMesh tube = skirt(circle(100));
  for (int i = 0; i < 400; ++i) mesh = together(std::move(mesh), moved(tube, {3.0 * i, 0, 0}));
  const MeshReport closed = inspect(with_caps(mesh, find_openings(mesh)));
  EXPECT_TRUE(closed.is_closed_manifold());
  EXPECT_NEAR(closed.volume, 400 * 50 * std::sin(2 * std::numbers::pi / 100), 1e-6);
}

TEST(Caps, CloseSpheresWithRandomHoles) {
  std::mt19937 random(test_seed());
  for (int round = 0; round < 40; ++round) {
    const std::uint32_t share = std::uniform_int_distribution(2u, 40u)(random);
    const TriangleMesh holed = without(sphere(3), [&](const Triangle&) { return random() % share == 0; });
    const std::vector<Opening> openings = find_openings(holed);
    std::size_t edges = 0;
    for (const Opening& opening : openings) {
      edges += opening.loop.size();
      EXPECT_EQ(std::set(opening.loop.begin(), opening.loop.end()).size(), opening.loop.size());
    }
    EXPECT_EQ(edges, inspect(holed).open_edges);
    const TriangleMesh capped = with_caps(soup(holed), find_openings(soup(holed)));
    const RepairedMesh repaired = repaired_mesh(capped, {.keep_cavities = true, .open_shells = OpenShells::Keep});
    EXPECT_TRUE(repaired.closed || repaired.obstacle.find("no volume") != std::string::npos) << repaired.obstacle;
  }
}

}  // namespace
}  // namespace prohull

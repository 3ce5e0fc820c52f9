#include "prohull/sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "effort.h"
#include "input_error.h"
#include "prohull/error.h"
#include "verify/oracle.h"

namespace prohull {
namespace {

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

/// Every directed edge has one face and an opposite, and the faces around every vertex are one cycle.
std::optional<std::string> manifold_defect(const TriangleMesh& mesh) {
  std::vector<DirectedEdge> edges;
  std::vector<std::vector<DirectedEdge>> links(mesh.vertex_count());
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = index(t[k]), b = index(t[(k + 1) % 3]), c = index(t[(k + 2) % 3]);
      edges.push_back({a, b});
      links[a].push_back({b, c});
    }
  std::sort(edges.begin(), edges.end());
  const auto name = [](const DirectedEdge& e) { return std::to_string(e.first) + "-" + std::to_string(e.second); };
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    if (edges[i] == edges[i + 1]) return "two faces on edge " + name(edges[i]);
  for (const auto& [a, b] : edges)
    if (!std::binary_search(edges.begin(), edges.end(), DirectedEdge{b, a})) return "no twin of edge " + name({a, b});
  for (std::size_t v = 0; v < links.size(); ++v) {
    if (links[v].empty()) return "no face on vertex " + std::to_string(v);
    std::size_t steps = 0;
    std::uint32_t at = links[v][0].first;
    do {
      at = std::find_if(links[v].begin(), links[v].end(), [&](const DirectedEdge& e) { return e.first == at; })->second;
      ++steps;
    } while (at != links[v][0].first);
    if (steps != links[v].size()) return "two stars on vertex " + std::to_string(v);
  }
  return std::nullopt;
}

long euler_characteristic(const TriangleMesh& mesh) { return long(mesh.vertex_count()) - long(mesh.face_count()) / 2; }

bool has_equal_positions(const TriangleMesh& mesh) {
  std::vector<std::array<double, 3>> sorted;
  for (const Vec3& p : mesh.positions) sorted.push_back({p.x, p.y, p.z});
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

double compactness(const Triangle& t) {
  const double area = norm(cross(t.b - t.a, t.c - t.a)) / 2;
  return 4 * std::numbers::sqrt3 * area / (squared_norm(t.b - t.a) + squared_norm(t.c - t.b) + squared_norm(t.a - t.c));
}

double least_compactness(const TriangleMesh& mesh) {
  double least = 1;
  for (const FaceId f : mesh.triangles.ids()) least = std::min(least, compactness(mesh.triangle(f)));
  return least;
}

/// FNV-1a of all bits.
std::uint64_t hash(const TriangleMesh& mesh) {
  std::uint64_t h = 0xcbf29ce484222325;
  const auto add = [&](const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) h = (h ^ bytes[i]) * 0x100000001b3;
  };
  add(mesh.positions.data(), mesh.vertex_count() * sizeof(Vec3));
  add(mesh.triangles.data(), mesh.face_count() * 3 * sizeof(VertexId));
  return h;
}

std::size_t fewest_faces(std::string_view name) { return make_sample(name, 4).face_count(); }

void expect_closed_and_as_described(const TriangleMesh& mesh, const SampleInfo& info) {
  EXPECT_EQ(manifold_defect(mesh), std::nullopt);
  EXPECT_EQ(euler_characteristic(mesh), 2 - 2 * info.genus);
  EXPECT_FALSE(has_equal_positions(mesh));
  EXPECT_GT(signed_volume(mesh), 0);
  EXPECT_GT(least_compactness(mesh), 0.15);
}

class EverySample : public testing::TestWithParam<SampleInfo> {};

TEST_P(EverySample, IsClosedManifoldAndOutwardAtEveryFaceCount) {
  const std::size_t fewest = fewest_faces(GetParam().name);
  for (const std::size_t faces : {std::size_t(4), std::size_t(1000), fewest + fewest / 3, std::size_t(20000)}) {
    SCOPED_TRACE(std::string(GetParam().name) + " of " + std::to_string(faces) + " faces");
    expect_closed_and_as_described(make_sample(GetParam().name, faces), GetParam());
  }
}

TEST_P(EverySample, IsClosedManifoldAndOutwardAsABigMesh) {
  expect_closed_and_as_described(make_sample(GetParam().name, 200'000), GetParam());
}

TEST_P(EverySample, HasTheFacesAskedFor) {
  const std::size_t fewest = fewest_faces(GetParam().name);
  for (double faces = double(fewest); faces < 100'000; faces *= 1.07) {
    const double ratio = double(make_sample(GetParam().name, std::size_t(faces)).face_count()) / faces;
    EXPECT_TRUE(0.8 <= ratio && ratio <= 1.2) << GetParam().name << " of " << faces << " faces: " << ratio;
  }
}

TEST_P(EverySample, IsFreeOfSelfIntersection) {
  for (double faces = double(fewest_faces(GetParam().name)); faces < effort(30'000, 3'000); faces *= 1.3)
    EXPECT_EQ(oracle::self_intersections(make_sample(GetParam().name, std::size_t(faces))), 0u)
        << GetParam().name << " of " << faces;
}

TEST_P(EverySample, IsTheSameEveryTime) {
  EXPECT_EQ(hash(make_sample(GetParam().name, 20000)), hash(make_sample(GetParam().name, 20000)));
}

INSTANTIATE_TEST_SUITE_P(Samples, EverySample, testing::ValuesIn(samples().begin(), samples().end()),
                         [](const auto& sample) { return std::string(sample.param.name); });

/// The coordinate that a triangle's corners share, if they lie in an axis-parallel plane.
std::optional<std::pair<int, double>> axis_plane(const Triangle& t) {
  for (int axis = 0; axis < 3; ++axis)
    if (t.a[axis] == t.b[axis] && t.b[axis] == t.c[axis]) return std::pair(axis, t.a[axis]);
  return std::nullopt;
}

TEST(Box, HasOnlyAxisParallelFacesInItsTenPlanesAtEveryFaceCount) {
  for (const std::size_t faces : {std::size_t(32), std::size_t(1000), std::size_t(20000)}) {
    const TriangleMesh box = make_sample("box", faces);
    std::set<std::pair<int, double>> planes;
    for (const FaceId f : box.triangles.ids()) {
      const auto plane = axis_plane(box.triangle(f));
      ASSERT_TRUE(plane) << "face " << index(f);
      planes.insert(*plane);
    }
    EXPECT_EQ(planes.size(), 10u);
  }
}

TEST(Bracket, KeepsItsPlanesAndSharpEdgesExactly) {
  for (const std::size_t faces : {std::size_t(4), std::size_t(20000)}) {
    const TriangleMesh bracket = make_sample("bracket", faces);
    // Faces that are not axis-parallel belong to the walls of holes, which are parallel to x or z.
    std::map<std::pair<int, double>, double> area;
    double planar = 0, wall = 0;
    for (const FaceId f : bracket.triangles.ids()) {
      const Triangle t = bracket.triangle(f);
      const Vec3 normal = cross(t.b - t.a, t.c - t.a);
      if (const auto plane = axis_plane(t)) {
        planar += norm(normal) / 2;
        area[*plane] += norm(normal) / 2;
      } else {
        wall += norm(normal) / 2;
        EXPECT_TRUE(normal.x == 0 || normal.z == 0) << "face " << index(f);
      }
    }
    EXPECT_GT(planar, 5 * wall);
    EXPECT_EQ((area[{1, 0.0}]), (area[{1, 4.0}]));
  }
}

TEST(Samples, OfPlanarPartsAreExactInSinglePrecision) {
  for (const char* name : {"box", "bracket"})
    for (const Vec3& p : make_sample(name, 20000).positions)
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(double(float(p[axis])), p[axis]) << name;
}

TEST(Samples, RefuseAnUnknownNameAndListTheKnown) {
  const InputError error = error_of([] { make_sample("teapot", 1000); });
  EXPECT_EQ(error.defect(), Defect::InvalidOption);
  EXPECT_NE(std::string(error.what()).find("teapot"), std::string::npos);
  for (const SampleInfo& info : samples()) EXPECT_NE(std::string(error.what()).find(info.name), std::string::npos);
}

TEST(Samples, RefuseAFaceCountOutOfRange) {
  for (const std::size_t faces : {std::size_t(0), std::size_t(3), (std::size_t(1) << 30) + 1})
    EXPECT_EQ(error_of([&] { make_sample("sphere", faces); }).defect(), Defect::InvalidOption) << faces;
}

}  // namespace
}  // namespace prohull

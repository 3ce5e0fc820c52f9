#include "prohull/mesh_report.h"

#include <gtest/gtest.h>

#include <limits>

#include "meshes.h"
#include "prohull/detail/text.h"
#include "prohull/sample.h"

namespace prohull {
namespace {

using namespace meshes;

TEST(MeshReport, OfASoundMesh) {
  const MeshReport report = inspect(box({0, 0, 0}, {2, 3, 4}));
  EXPECT_TRUE(report.is_watertight());
  EXPECT_TRUE(report.is_closed_manifold());
  EXPECT_EQ(report.first_defect, "");
  EXPECT_EQ(report.faces, 12u);
  EXPECT_EQ(report.vertices, 8u);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.euler_characteristic, 2);
  EXPECT_DOUBLE_EQ(report.volume, 24);
  EXPECT_EQ(report.box.max, (Vec3{2, 3, 4}));
}

TEST(MeshReport, VolumeIsNegativeInsideOut) {
  EXPECT_DOUBLE_EQ(inspect(inside_out(box({0, 0, 0}, {2, 3, 4}))).volume, -24);
  EXPECT_TRUE(inspect(inside_out(octahedron())).is_closed_manifold());
}

TEST(MeshReport, EulerCharacteristicTellsTheGenus) {
  EXPECT_EQ(inspect(torus(9, 5)).euler_characteristic, 0);
  EXPECT_EQ(inspect(make_sample("bracket", 1500)).euler_characteristic, 2 - 2 * 5);
  EXPECT_EQ(inspect(together(octahedron(), torus(9, 5))).euler_characteristic, 2);
}

TEST(MeshReport, CountsComponentsAndUnusedVertices) {
  TriangleMesh mesh = together(together(octahedron(), tetrahedron()), torus(5, 4));
  mesh.positions.push_back({7, 7, 7});
  mesh.positions.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  const MeshReport report = inspect(mesh);
  EXPECT_EQ(report.components, 3u);
  EXPECT_EQ(report.unused_vertices, 2u);
  EXPECT_EQ(report.vertices, 6u + 4 + 20);
  EXPECT_TRUE(report.is_closed_manifold()) << "unused vertices do no harm, not even NaN";
}

TEST(MeshReport, OpenEdges) {
  TriangleMesh mesh = octahedron();
  mesh.triangles.pop_back();  // 0-3-5
  const MeshReport report = inspect(mesh);
  EXPECT_EQ(report.open_edges, 3u);
  EXPECT_FALSE(report.is_watertight());
  EXPECT_EQ(report.first_defect, "edge 0-3 has 1 face, expected 2");
  EXPECT_EQ(report.non_manifold_vertices, 0u) << "a fan is one disk with a border";
}

TEST(MeshReport, NonManifoldEdge) {
  TriangleMesh mesh = tetrahedron();  // and a fin on edge 0-1
  const VertexId tip = mesh.positions.push_back({0.5, -1, -1});
  mesh.triangles.push_back({VertexId(0), VertexId(1), tip});
  const MeshReport report = inspect(mesh);
  EXPECT_EQ(report.non_manifold_edges, 1u);
  EXPECT_EQ(report.open_edges, 2u);
  EXPECT_EQ(report.first_defect, "edge 0-1 has 3 faces, expected 2") << "worse than open edges";
  EXPECT_FALSE(report.is_watertight());
}

/// Two tetrahedra that share the edge 0-1.
TriangleMesh two_tetrahedra_on_one_edge() {
  TriangleMesh mesh = tetrahedron();
  const VertexId c = mesh.positions.push_back({0, -1, 0}), d = mesh.positions.push_back({0, 0, -1});
  const VertexId a{0}, b{1};
  for (const auto& t : {std::array{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}}) mesh.triangles.push_back(t);
  return mesh;
}

TEST(MeshReport, TwoSolidsThatShareAnEdge) {
  const MeshReport report = inspect(two_tetrahedra_on_one_edge());
  EXPECT_EQ(report.non_manifold_edges, 1u);
  EXPECT_EQ(report.open_edges, 0u);
  EXPECT_EQ(report.first_defect, "edge 0-1 has 4 faces, expected 2");
}

TEST(MeshReport, BowTieVertex) {
  // Two tetrahedra that share the vertex 0.
  TriangleMesh mesh = together(tetrahedron(), moved(tetrahedron(), {5, 0, 0}));
  for (auto& t : mesh.triangles) std::ranges::replace(t, VertexId(4), VertexId(0));
  const MeshReport report = inspect(mesh);
  EXPECT_EQ(report.non_manifold_vertices, 1u);
  EXPECT_EQ(report.components, 1u);
  EXPECT_TRUE(report.is_watertight());
  EXPECT_FALSE(report.is_closed_manifold());
  EXPECT_EQ(report.first_defect, "vertex 0: the faces around it are more than one disk");
}

TEST(MeshReport, MisorientedEdges) {
  TriangleMesh mesh = octahedron();
  std::swap(mesh.triangles[FaceId(0)][0], mesh.triangles[FaceId(0)][1]);
  const MeshReport report = inspect(mesh);
  EXPECT_EQ(report.misoriented_edges, 3u);
  EXPECT_EQ(report.open_edges + report.non_manifold_edges + report.non_manifold_vertices, 0u);
  EXPECT_FALSE(report.is_watertight());
  EXPECT_EQ(report.first_defect, "edge 0-2: its two faces disagree about which side is outside");
}

TEST(MeshReport, NamesEachKindOfDefectOnce) {
  TriangleMesh mesh = octahedron();
  mesh.triangles.pop_back();
  mesh.positions.push_back({9, 9, 9});
  std::vector<std::string> found;
  for (const DefectCount& defect : defect_counts(inspect(mesh)))
    if (defect.count > 0)
      found.push_back(grouped(1000 * defect.count) + " " + std::string(defect.name) +
                      (defect.allowed ? ", allowed" : ""));
  EXPECT_EQ(found, (std::vector<std::string>{"3,000 open_edges", "1,000 unused_vertices, allowed"}));
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(1234567), "1,234,567");
}

TEST(MeshReport, RepeatedCorner) {
  TriangleMesh mesh = octahedron();
  mesh.triangles.push_back({VertexId(0), VertexId(2), VertexId(2)});
  const MeshReport report = inspect(mesh);
  EXPECT_EQ(report.repeated_corner_faces, 1u);
  EXPECT_EQ(report.zero_area_faces, 0u);
  EXPECT_FALSE(report.is_watertight());
  EXPECT_EQ(report.first_defect, "face 8 has the same vertex twice");
}

TEST(MeshReport, FacesWithoutAreaAreCountedExactlyAndAllowed) {
  // The vertex 6 is on the edge 0-2 of a box, in the upper of its two faces only by a triangle without area.
  TriangleMesh mesh = octahedron();
  const VertexId middle = mesh.positions.push_back({0.5, 0.5, 0});
  mesh.triangles[FaceId(0)] = {VertexId(0), middle, VertexId(4)};
  mesh.triangles.push_back({middle, VertexId(2), VertexId(4)});
  mesh.triangles.push_back({VertexId(0), VertexId(2), middle});
  const MeshReport report = inspect(mesh);
  EXPECT_EQ(report.zero_area_faces, 1u);
  EXPECT_TRUE(report.is_closed_manifold());
  EXPECT_EQ(report.first_defect, "");
  mesh.positions[middle].z = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(inspect(mesh).zero_area_faces, 0u);
}

TEST(MeshReport, NonFiniteVertices) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = octahedron();
    mesh.positions[VertexId(3)].y = bad;
    const MeshReport report = inspect(mesh);
    EXPECT_EQ(report.non_finite_vertices, 1u);
    EXPECT_TRUE(report.is_watertight());
    EXPECT_FALSE(report.is_closed_manifold());
    EXPECT_EQ(report.first_defect, "vertex 3 has a coordinate that is not finite");
  }
}

TEST(MeshReport, OfNothing) {
  const MeshReport report = inspect({});
  EXPECT_EQ(report.faces + report.vertices + report.components, 0u);
  EXPECT_FALSE(report.is_watertight());
  EXPECT_TRUE(report.box.is_empty());
}

TEST(MeshReport, OfASoup) {
  const MeshReport report = inspect(soup(octahedron()));
  EXPECT_EQ(report.components, 8u);
  EXPECT_EQ(report.open_edges, 24u);
}

TEST(SignedVolume, KeepsItsDigitsFarFromTheOriginAndForAnySize) {
  EXPECT_NEAR(signed_volume(moved(octahedron(), {0x1p30, -0x1p30, 0x1p30})), 4.0 / 3, 1e-12);
  EXPECT_DOUBLE_EQ(signed_volume(scaled(octahedron(), 0x1p-100)), 4.0 / 3 * 0x1p-300);
  EXPECT_DOUBLE_EQ(signed_volume(scaled(octahedron(), 0x1p300)), 4.0 / 3 * 0x1p900);
  EXPECT_EQ(signed_volume(scaled(octahedron(), 0x1p600)), std::numeric_limits<double>::infinity());
  EXPECT_EQ(signed_volume(scaled(inside_out(octahedron()), 0x1p1000)), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(signed_volume({}), 0);
}

}  // namespace
}  // namespace prohull

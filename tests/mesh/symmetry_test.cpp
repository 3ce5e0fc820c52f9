#include "prohull/detail/symmetry.h"

#include <gtest/gtest.h>

#include <limits>

#include "meshes.h"

namespace prohull {
namespace {

using namespace meshes;

TEST(Symmetry, OfAnOctahedronIsAlongAllAxes) {
  for (const auto& [name, axis] : axis_names()) {
    const SymmetryReport found = inspect_symmetry(octahedron(), axis);
    EXPECT_TRUE(found.is_symmetric()) << name;
    EXPECT_EQ(found.plane, 0) << name;
    EXPECT_EQ(found.first_defect, "") << name;
  }
}

TEST(Symmetry, IsAboutTheMiddleOfTheBox) {
  const SymmetryReport found = inspect_symmetry(moved(octahedron(), {2.5, 0, 0}), Axis::X);
  EXPECT_TRUE(found.is_symmetric());
  EXPECT_EQ(found.plane, 2.5);
}

TEST(Symmetry, CountsVerticesWithoutAnImage) {
  const SymmetryReport found = inspect_symmetry(tetrahedron(), Axis::X);
  EXPECT_EQ(found.vertices_without_image, 2u) << "(0, 0, 0) and (1, 0, 0) are images of each other";
  EXPECT_EQ(found.first_defect.find("vertex 2 at (0, 1, 0)"), 0u) << found.first_defect;
}

TEST(Symmetry, CountsFacesWithoutAnImage) {
  const SymmetryReport found = inspect_symmetry(box({-1, -1, -1}, {1, 1, 1}), Axis::X);
  EXPECT_EQ(found.vertices_without_image, 0u);
  EXPECT_GT(found.faces_without_image, 0u) << "its diagonals all run one way";
  EXPECT_FALSE(found.is_symmetric());
}

TEST(Symmetry, DependsOnTheSideThatAFaceLooksTo) {
  TriangleMesh mesh = octahedron();
  std::swap(mesh.triangles[FaceId{0}][1], mesh.triangles[FaceId{0}][2]);
  EXPECT_GT(inspect_symmetry(mesh, Axis::Y).faces_without_image, 0u);
}

TEST(Symmetry, TakesAnyMesh) {
  EXPECT_TRUE(inspect_symmetry({}, Axis::X).is_symmetric());
  TriangleMesh mesh = octahedron();
  mesh.positions.push_back({7, 7, 7});
  EXPECT_TRUE(inspect_symmetry(mesh, Axis::Z).is_symmetric()) << "no face uses the vertex";
  mesh.positions[VertexId{4}].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(inspect_symmetry(mesh, Axis::Z).is_symmetric());
}

}  // namespace
}  // namespace prohull

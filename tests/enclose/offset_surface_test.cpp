#include "enclose/offset_surface.h"

#include <gtest/gtest.h>

#include "meshes.h"
#include "prohull/enclosure.h"
#include "prohull/mesh_report.h"

namespace prohull {
namespace {

using namespace meshes;

TEST(OffsetSurface, IsOutsideOfAClosedMesh) {
  const auto around = offset_surface(box({0, 0, 0}, {1, 1, 1}), 0.1);
  ASSERT_TRUE(around);
  EXPECT_EQ(around->face_count(), 12U);
  EXPECT_NEAR(signed_volume(*around), 1.2 * 1.2 * 1.2, 1e-6);
}

TEST(OffsetSurface, IsOnBothSidesOfASheet) {
  TriangleMesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}};
  sheet.triangles = {{VertexId{0}, VertexId{1}, VertexId{2}},
                     {VertexId{0}, VertexId{3}, VertexId{2}}};  // one is turned
  const auto around = offset_surface(sheet, 0.01);
  ASSERT_TRUE(around);
  EXPECT_TRUE(inspect(*around).is_closed_manifold());
  EXPECT_EQ(around->face_count(), 12U);
  EXPECT_TRUE(verify_cover(sheet, *around).encloses);
}

TEST(OffsetSurface, JoinsVerticesThatAreNear) {
  TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  const auto [a, b, c] = mesh.triangles[FaceId{0}];
  const VertexId m = mesh.positions.push_back(mesh.positions[a] + (mesh.positions[b] - mesh.positions[a]) * 1e-9);
  for (const FaceId f : mesh.triangles.ids()) {
    const auto corners = mesh.triangles[f];
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId from = corners[i], to = corners[(i + 1) % 3], third = corners[(i + 2) % 3];
      if ((from == a && to == b) || (from == b && to == a)) {
        mesh.triangles[f] = {from, m, third};
        mesh.triangles.push_back({m, to, third});
        break;
      }
    }
  }
  ASSERT_EQ(mesh.face_count(), 14U);
  const auto around = offset_surface(mesh, 0.1);
  ASSERT_TRUE(around);
  EXPECT_EQ(around->face_count(), 12U);
}

TEST(OffsetSurface, IsNotOfFacesThatBranch) {
  TriangleMesh three;
  three.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, -1}};
  for (const std::uint32_t tip : {2U, 3U, 4U}) three.triangles.push_back({VertexId{0}, VertexId{1}, VertexId{tip}});
  EXPECT_FALSE(offset_surface(three, 0.01));
}

TEST(OffsetSurface, IsCutIntoSheetsWhereFacesBranchAndFoldBack) {
  const TriangleMesh faces =
      make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, -1}, {0.9, 0.9, 0.01}, {2, 0, 0}},
           {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {2, 1, 5}, {5, 1, 6}, {5, 6, 0}});
  const TriangleMesh around = sheets_around(faces, 0.01);
  EXPECT_TRUE(inspect(around).is_closed_manifold());
  EXPECT_TRUE(verify_cover(faces, around).encloses);
}

}  // namespace
}  // namespace prohull

#include "construct/progressive/cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "meshes.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

std::vector<BoxedFace> boxed_faces(const TriangleMesh& mesh, const UnitCube& cube) {
  std::vector<BoxedFace> faces;
  for (const FaceId f : mesh.triangles.ids()) {
    const auto& [a, b, c] = mesh.triangles[f];
    faces.push_back({f, cube.at(Triangle{mesh.positions[a], mesh.positions[b], mesh.positions[c]})});
  }
  return faces;
}

Box box_of(const TriangleMesh& mesh) {
  Box box;
  for (const Vec3& p : mesh.positions) box.extend(p);
  return box;
}

TEST(Cells, HaveAllFacesThatReachIntoThemAndNoPointInCommon) {
  const TriangleMesh mesh = make_sample("pony", 20000);
  const UnitCube cube(box_of(mesh));
  const auto faces = boxed_faces(mesh, cube);
  for (const double shift : {0.0, 0.6, 0.99}) {
    const auto cells = split_into_cells(faces, 1000, shift);
    ASSERT_GT(cells.size(), 20u);
    for (const auto& [box, inside] : cells) {
      EXPECT_LE(inside.size(), 1000u);
      EXPECT_TRUE(std::ranges::is_sorted(inside));
      const std::set<FaceId> listed(inside.begin(), inside.end());
      for (const BoxedFace& face : faces) EXPECT_EQ(listed.count(face.face) == 1, face.box.overlaps(box));
    }
    std::size_t free = 0;
    for (const Vec3& p : mesh.positions) {
      const auto homes = std::ranges::count_if(cells, [&](const Cell& c) { return c.box.has_inside(cube.at(p)); });
      EXPECT_LE(homes, 1);
      free += homes == 1;
    }
    EXPECT_GT(free, mesh.vertex_count() * 9 / 10);
  }
}

TEST(Cells, OfOtherShiftsHaveOtherBorders) {
  const TriangleMesh mesh = meshes::sphere(4);
  const auto faces = boxed_faces(mesh, UnitCube(box_of(mesh)));
  const auto first = split_into_cells(faces, 200, 0), second = split_into_cells(faces, 200, 0.6);
  ASSERT_GT(std::min(first.size(), second.size()), 4u);
  for (const Cell& a : first)
    for (const Cell& b : second)
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_TRUE(std::isinf(a.box.max[axis]) || a.box.max[axis] != b.box.max[axis]);
}

// As of a fan of needles: each of them reaches into every cell.
TEST(Cells, AreNotSplitWhereThatDoesNotSeparateFaces) {
  std::vector<BoxedFace> faces;
  for (std::uint32_t i = 0; i < 5000; ++i) faces.push_back({FaceId{i}, {{-1, -1, -1}, {1, 1, 1}}});
  const auto cells = split_into_cells(faces, 100, 0.3);
  ASSERT_EQ(cells.size(), 1u);
  EXPECT_EQ(cells.front().faces.size(), faces.size());
}

// Every sixth reaches far to the right, and the sample that chooses where to split may have these only.
TEST(Cells, AreNotSplitForEverWhereTheSampleIsUnlikeTheRest) {
  std::vector<BoxedFace> faces;
  for (std::uint32_t i = 0; i < 6000; ++i)
    faces.push_back({FaceId{i}, {{-1, 0, 0}, {i % 6 == 0 || i % 24 == 1 ? 1.0f : -0.5f, 0, 0}}});
  const auto cells = split_into_cells(faces, 100, 0.3);
  std::set<FaceId> all;
  std::size_t with_shared = 0;
  for (const Cell& cell : cells) all.insert(cell.faces.begin(), cell.faces.end()), with_shared += cell.faces.size();
  EXPECT_EQ(all.size(), faces.size());
  EXPECT_LT(with_shared, 2 * faces.size());
}

TEST(SpatialOrder, BringsNeighborsTogether) {
  const TriangleMesh mesh = meshes::sphere(5);  // by subdivision: neighbours are far apart
  const auto faces = boxed_faces(mesh, UnitCube(box_of(mesh)));
  const auto mean_step = [&](const std::vector<FaceId>& order) {
    double sum = 0;
    for (std::size_t i = 1; i < order.size(); ++i)
      for (int axis = 0; axis < 3; ++axis)
        sum += std::abs(faces[index(order[i])].box.min[axis] - faces[index(order[i - 1])].box.min[axis]);
    return sum / static_cast<double>(order.size());
  };
  const std::vector<FaceId> sorted = along_curve(faces);
  const std::set<FaceId> all(sorted.begin(), sorted.end());
  EXPECT_EQ(all.size(), mesh.face_count());
  std::vector<FaceId> shuffled = sorted;
  std::ranges::shuffle(shuffled, std::mt19937(test_seed()));
  EXPECT_LT(mean_step(sorted), mean_step(shuffled) / 4);
}

}  // namespace
}  // namespace prohull

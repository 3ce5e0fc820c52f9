#include "build/spatial_order.h"

#include <gtest/gtest.h>

#include <cmath>

#include "meshes.h"
#include "prohull/sample.h"

namespace prohull {
namespace {

TEST(SpatialOrder, RenumbersVerticesAndFacesOnly) {
  TriangleMesh mesh = make_sample("pony", 2000);
  mesh.positions.push_back({9, 9, 9});  // unused
  const SpatialOrder order(mesh);
  const TriangleMesh other = order.reordered(mesh);
  ASSERT_EQ(other.vertex_count(), mesh.vertex_count());
  ASSERT_EQ(other.face_count(), mesh.face_count());
  PerVertex<int> seen(mesh.vertex_count(), 0);
  for (const VertexId v : other.positions.ids()) {
    EXPECT_EQ(other.positions[v], mesh.positions[order.given(v)]);
    ++seen[order.given(v)];
  }
  for (const VertexId v : seen.ids()) EXPECT_EQ(seen[v], 1);
  for (const FaceId f : other.triangles.ids())
    for (std::uint32_t c = 0; c < 3; ++c) {
      EXPECT_EQ(order.given(other.triangles[f][c]), mesh.triangles[order.given(f)][c]);
      EXPECT_EQ(order.given_corner(3 * index(f) + c), 3 * index(order.given(f)) + c);
    }
  EXPECT_EQ(order.given(other.positions.next_id()), other.positions.next_id()) << "made later";
}

TEST(SpatialOrder, BringsNeighborsTogether) {
  const TriangleMesh mesh = meshes::sphere(5);  // by subdivision: the corners of most faces are far apart
  const auto mean_distance = [](const TriangleMesh& of) {
    double sum = 0;
    for (const auto& [a, b, c] : of.triangles) sum += std::abs(double(index(a)) - double(index(b)));
    return sum / static_cast<double>(of.face_count());
  };
  EXPECT_LT(mean_distance(SpatialOrder(mesh).reordered(mesh)), mean_distance(mesh) / 4);
}

}  // namespace
}  // namespace prohull

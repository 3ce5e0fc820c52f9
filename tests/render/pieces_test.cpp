#include "render/pieces.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "meshes.h"
#include "render/compose.h"
#include "render/draw.h"

namespace prohull::render {
namespace {

TriangleMesh three_boxes() {
  TriangleMesh mesh;
  for (const double x : {-4., 0., 4.}) append(mesh, meshes::box({x - 1, -1, -1}, {x + 1, 1, 1}));
  return mesh;
}

Box box_of_part(const Exploded& apart, std::uint32_t part) {
  Box box;
  for (std::uint32_t f = 12 * part; f < 12 * part + 12; ++f)
    for (const VertexId v : apart.mesh.triangles[FaceId(f)]) box.extend(apart.mesh.positions[v]);
  return box;
}

std::tuple<float, float, float> values(const Rgb& color) { return {color.r, color.g, color.b}; }

TEST(PieceColor, DiffersForTheFirst21) {
  std::set<std::tuple<float, float, float>> colors;
  for (std::size_t i = 0; i < 21; ++i) colors.insert(values(piece_color(i)));
  EXPECT_EQ(colors.size(), 21u);
  EXPECT_EQ(values(piece_color(21)), values(piece_color(0)));
}

TEST(Exploded, MovesPartsAwayFromTheMiddle) {
  const Exploded apart = exploded(three_boxes(), 0.5);
  EXPECT_EQ(apart.parts, 3u);
  EXPECT_EQ(box_of_part(apart, 0).center(), (Vec3{-6, 0, 0}));
  EXPECT_EQ(box_of_part(apart, 1).center(), Vec3{});
  EXPECT_EQ(box_of_part(apart, 2).max, (Vec3{7, 1, 1}));
}

TEST(Exploded, GivesEachPartAColour) {
  const Exploded apart = exploded(three_boxes(), 0);
  EXPECT_EQ(apart.mesh.positions, three_boxes().positions);
  ASSERT_EQ(apart.colors.size(), 36u);
  for (std::uint32_t f = 0; f < 36; ++f) EXPECT_EQ(values(apart.colors[FaceId(f)]), values(piece_color(f / 12)));
}

TEST(Exploded, KeepsAMeshOfOnePartAndVerticesOfNone) {
  TriangleMesh mesh = meshes::moved(meshes::octahedron(), {5, 5, 5});
  mesh.positions.push_back({100, 0, 0});
  const Exploded apart = exploded(mesh, 3);
  EXPECT_EQ(apart.parts, 1u);
  EXPECT_EQ(apart.mesh.positions, mesh.positions);
}

TEST(Draw, ShowsPartsInTheirColours) {
  const TriangleMesh mesh = three_boxes();
  PanelPlan plan;
  plan.color = *parse_color("red");
  for (const FaceId f : mesh.triangles.ids()) plan.face_colors.push_back(*parse_color(index(f) < 12 ? "blue" : "red"));
  Look look;
  look.view.azimuth = 0;
  const Image image = draw(120, 40, compose({plan}, {mesh}, look, 120, 40), {});
  const Pixel left = image.at(20, 20), right = image.at(100, 20);
  EXPECT_GT(left[2], left[0] + 30);
  EXPECT_GT(right[0], right[2] + 30);
}

}  // namespace
}  // namespace prohull::render

#include "prohull/regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "input_error.h"
#include "meshes.h"
#include "prohull/error.h"

namespace prohull {
namespace {

using namespace meshes;

const TriangleMesh kCube = box({0, 0, 0}, {1, 1, 1});
constexpr std::uint32_t kCubeFaces = 12;
constexpr Box kTop{{0, 0, 1}, {1, 1, 1}};
constexpr Box kNowhere{{5, 5, 5}, {6, 6, 6}};

std::size_t count(const PerFace<std::uint32_t>& regions, std::uint32_t region) {
  return static_cast<std::size_t>(std::ranges::count(regions, region));
}

std::size_t count_of(const RegionFaces& faces, const MeshMarks& marks = {}) {
  return count(regions_of_faces(kCube, marks, {{"it", 0, faces}}), 0);
}

void expect_refused(const RegionFaces& faces, const MeshMarks& marks, std::string_view why) {
  const std::string refusal = error_of([&] { count_of(faces, marks); }).what();
  EXPECT_NE(refusal.find(why), std::string::npos) << refusal << ", not " << why;
  EXPECT_TRUE(refusal.starts_with("region it")) << refusal;
}

TEST(Regions, OfABoxHaveTheFacesWithAllCornersInIt) {
  EXPECT_EQ(count_of(kTop), 2u);
  EXPECT_EQ(count_of(Box{{-1, -1, -1}, {2, 2, 2}}), kCubeFaces);
  expect_refused(kNowhere, {}, "no face has all its corners in the box");
}

TEST(Regions, OfNumbersHaveTheseFacesOrTheFacesBetweenTheseVertices) {
  EXPECT_EQ(count_of(NumberedFaces{{{0, 2}, {7, 7}}}), 4u);
  EXPECT_EQ(count_of(NumberedVertices{{{4, 7}}}), 2u) << "the top";
  EXPECT_EQ(count_of(NumberedVertices{{{0, 7}}}), kCubeFaces);
  expect_refused(NumberedFaces{{}}, {}, "it has no faces");
  expect_refused(NumberedFaces{{{3, 3}, {7, 12}}}, {}, "the mesh has no face 12; its last one is 11");
  expect_refused(NumberedVertices{{{0, 8}}}, {}, "the mesh has no vertex 8; its last one is 7");
}

TEST(Regions, OfAColorHaveTheFacesPaintedInItOrBetweenPaintedVertices) {
  MeshMarks marks;
  expect_refused(PaintedColor{{255, 0, 0}}, marks, "the mesh has none");
  marks.vertex_colors.resize(8, {10, 20, 30});
  for (const std::uint32_t v : {4, 5, 6, 7}) marks.vertex_colors[VertexId{v}] = {250, 0, 5};
  expect_refused(PaintedColor{{255, 0, 0}}, marks, "no face has that colour");
  EXPECT_EQ(count_of(PaintedColor{{255, 0, 0}, 5}, marks), 2u);
  marks.face_colors.resize(kCubeFaces, {});
  marks.face_colors[FaceId{0}] = {255, 0, 0};
  EXPECT_EQ(count_of(PaintedColor{{255, 0, 0}}, marks), 1u);
  EXPECT_EQ(count_of(PaintedColor{{255, 0, 0}, 5}, marks), 3u);
}

TEST(Regions, OfAGroupHaveItsFaces) {
  MeshMarks marks;
  expect_refused(NamedGroup{"lid"}, marks, "the mesh has none");
  marks.names = {{"body", "steel"}, {"lid", "steel"}};
  marks.names_of.resize(kCubeFaces, 0);
  marks.names_of[FaceId{3}] = 1;
  EXPECT_EQ(count_of(NamedGroup{"lid"}, marks), 1u);
  EXPECT_EQ(count_of(NamedGroup{"steel"}, marks), kCubeFaces);
  expect_refused(NamedGroup{"lids"}, marks, "the file has body, lid, steel");
}

TEST(Regions, TakeFacesInTheirOrder) {
  const std::vector<Region> regions{{"first", 0, NumberedFaces{{{0, 3}}}}, {"second", 0.5, NumberedFaces{{{2, 7}}}}};
  const PerFace<std::uint32_t> of_faces = regions_of_faces(kCube, {}, regions);
  EXPECT_EQ(count(of_faces, 0), 4u);
  EXPECT_EQ(count(of_faces, 1), 4u);
  EXPECT_EQ(count(of_faces, 2), 4u) << "in none";
  const PerFace<double> tolerances = tolerances_of(of_faces, regions);
  EXPECT_EQ(tolerances[FaceId{2}], 0);
  EXPECT_EQ(tolerances[FaceId{5}], 0.5);
  EXPECT_EQ(tolerances[FaceId{9}], std::numeric_limits<double>::infinity());
}

TEST(Regions, RefuseDistancesBelowZero) {
  EXPECT_THROW(regions_of_faces(kCube, {}, {{"it", -1, kTop}}), InputError);
  EXPECT_THROW(regions_of_faces(kCube, {}, {{"it", std::numeric_limits<double>::quiet_NaN(), kTop}}), InputError);
}

}  // namespace
}  // namespace prohull

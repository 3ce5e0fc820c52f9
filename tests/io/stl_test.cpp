#include <limits>

#include "io_testing.h"

namespace prohull {
namespace {

const std::string kFacet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n";

std::string binary_stl(std::string header, std::uint32_t count, std::initializer_list<std::array<float, 9>> triangles) {
  header.resize(80, ' ');
  header += bytes_of(count);
  for (const auto& t : triangles) {
    header += std::string(12, '\0');
    for (const float value : t) header += bytes_of(value);
    header += std::string(2, '\0');
  }
  return header;
}

constexpr std::array<float, 9> kOne = {0, 0, 0, 1, 0, 0, 0, 1, 0};

void expect_one_triangle(std::string_view content, const char* name = "a.stl") {
  const TriangleMesh mesh = read_mesh(content, name);
  EXPECT_EQ(mesh.positions, PerVertex<Vec3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << content;
  ASSERT_EQ(mesh.face_count(), 1u) << content;
  EXPECT_EQ(mesh.triangles[FaceId(0)], corners(0, 1, 2)) << content;
}

TEST(Stl, ReadsBinaryEvenIfItStartsWithSolid) {
  expect_one_triangle(binary_stl("exported by hand", 1, {kOne}));
  expect_one_triangle(binary_stl("solid part", 1, {kOne}));
  expect_one_triangle(binary_stl("solid part", 1, {kOne}), "named_wrongly");
}

TEST(Stl, ReadsAsciiOfAnyCaseAndSpacing) {
  expect_one_triangle("solid\n" + kFacet + "endsolid\n");
  expect_one_triangle("  solid a part\r\n\r\n" + kFacet + "endsolid a part");
  expect_one_triangle(
      "SOLID\nFACET NORMAL 0 0 1\nOUTER LOOP\nVertex 0 0 0\nVERTEX 1E+0 0 -0e5\nVERTEX 0 1.0 0\n"
      "ENDLOOP\nENDFACET\nENDSOLID\n");
  expect_one_triangle(
      "solid a\nfacet normal nan nan nan outer loop vertex 0 0 0 vertex 1 0 0\nvertex\t0 1 0 endloop "
      "endfacet\nendsolid\n");
}

TEST(Stl, ReadsAsciiOnOneLineOrWithOtherLineEnds) {
  std::string line = "solid a facet of steel\n" + kFacet + "endsolid a";
  std::ranges::replace(line, '\n', '\r');
  expect_one_triangle(line);
  std::ranges::replace(line, '\r', ' ');
  expect_one_triangle(line);
  EXPECT_EQ(read_mesh(line + " " + line, "a.stl").face_count(), 2u);
}

TEST(Stl, KnowsAnObjFileByItsContent) {
  std::string obj = "# a part\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  obj.resize(200, ' ');
  expect_refused(obj, "a.stl", "a.stl: line 1: the name says STL, but the content is OBJ; name it .obj");
}

TEST(Stl, JoinsSeveralSolids) {
  const TriangleMesh mesh =
      read_mesh("solid a\n" + kFacet + "endsolid a\nsolid b\n" + kFacet + "endsolid\nsolid\nendsolid", "a.stl");
  EXPECT_EQ(mesh.face_count(), 2u);
  EXPECT_EQ(mesh.vertex_count(), 3u);
}

TEST(Stl, WeldsEqualPositionsOnly) {
  const float next = std::nextafter(1.f, 2.f);
  const TriangleMesh mesh =
      read_mesh(binary_stl("", 2, {{-0.f, 0, 0, 1, 0, 0, 0, 1, 0}, {0, -0.f, 0, 0, 1, -0.f, next, 0, 0}}), "a.stl");
  EXPECT_EQ(mesh.vertex_count(), 4u);
  EXPECT_EQ(mesh.triangles, (PerFace<std::array<VertexId, 3>>{corners(0, 1, 2), corners(0, 2, 3)}));
  EXPECT_TRUE(std::signbit(mesh.positions[VertexId(0)].x));
}

TEST(Stl, RefusesATruncatedBinaryFile) {
  expect_refused(
      binary_stl("solid x", 4000000000u, {kOne, kOne}), "a.stl",
      "a.stl: byte 184: the file ends within triangle 3 of 4000000000; it is truncated or its count is wrong");
  const std::string content = binary_stl("", 2, {kOne, kOne});
  expect_refused(std::string_view(content).substr(0, 150), "a.stl",
                 "a.stl: byte 150: the file ends within triangle 2 of 2; it is truncated or its count is wrong");
  expect_refused("short", "a.stl",
                 "a.stl: byte 5: the file ends within the header; a binary STL has 84 bytes of it, and an ascii STL "
                 "starts with solid");
}

TEST(Stl, RefusesMoreTrianglesThanItsCount) {
  const std::string wrong = "; correct it, or export the mesh again";
  expect_refused(binary_stl("", 1, {kOne, kOne, kOne}), "a.stl",
                 "a.stl: byte 80: the count says 1 triangle, but the file holds 3" + wrong);
  expect_refused(binary_stl("", 0, {kOne}) + "end", "a.stl",
                 "a.stl: byte 80: the count says 0 triangles, but the file holds 1" + wrong);
  expect_one_triangle(binary_stl("", 1, {kOne}) + "less than a triangle");
}

TEST(Stl, RefusesATruncatedOrMalformedAsciiFile) {
  expect_refused("solid\n" + kFacet, "a.stl",
                 "a.stl: line 9: the file ends where facet or endsolid was expected; it is truncated");
  expect_refused("solid\n" + kFacet.substr(0, kFacet.find("  vertex 0 1")), "a.stl",
                 "a.stl: line 6: the file ends where vertex was expected; it is truncated");
  expect_refused("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0\nvertex 0 1 0\n", "a.stl",
                 "a.stl: line 5: the line ends where a coordinate was expected");
  expect_refused("solid\nvertex 0 0 0\n", "a.stl", "a.stl: line 2: 'vertex' where facet or endsolid was expected");
}

TEST(Stl, RefusesNonFiniteCoordinates) {
  const float infinity = std::numeric_limits<float>::infinity();
  expect_refused(binary_stl("", 2, {kOne, {0, 0, 0, 1, infinity, 0, 0, 1, 0}}), "a.stl",
                 "a.stl: byte 134: corner 2 of triangle 2 has y = inf; coordinates must be finite; `prohull repair` "
                 "drops such triangles",
                 Defect::NonFiniteCoordinate);
  expect_refused("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 nan\nvertex 0 1 0\nendloop\nendfacet",
                 "a.stl",
                 "a.stl: line 2: corner 2 of triangle 1 has z = nan; coordinates must be finite; `prohull repair` "
                 "drops such triangles",
                 Defect::NonFiniteCoordinate);
}

TEST(Stl, KeepsNonFiniteCornersAsOneVertexIfAsked) {
  const std::string text =
      "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 nan 0\nendloop\nendfacet\n"
      "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex inf 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n";
  const TriangleMesh mesh = read_mesh(text, "a.stl", {.non_finite = NonFinite::Keep});
  EXPECT_EQ(mesh.face_count(), 2u);
  EXPECT_EQ(mesh.vertex_count(), 3u);
  EXPECT_FALSE(is_finite(mesh.positions[VertexId(2)]));
}

}  // namespace
}  // namespace prohull

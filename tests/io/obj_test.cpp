#include "io_testing.h"

namespace prohull {
namespace {

const std::string kThreeVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

void expect_one_triangle(std::string_view content) {
  const TriangleMesh mesh = read_mesh(content, "a.obj");
  ASSERT_EQ(mesh.face_count(), 1u) << content;
  EXPECT_EQ(mesh.triangles[FaceId(0)], corners(0, 1, 2)) << content;
}

TEST(Obj, ReadsEveryFormOfCorner) {
  for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/4/5 2/4/5 3/4/5", "f 1/ 2// 3/7"})
    expect_one_triangle(kThreeVertices + face);
}

TEST(Obj, CountsNegativeIndicesBackFromTheLastVertexSoFar) {
  expect_one_triangle(kThreeVertices + "f -3 -2 -1\nv 7 7 7\n");
}

TEST(Obj, ReadsFacesBeforeTheirVertices) { expect_one_triangle("f 1 2 3\n" + kThreeVertices); }

TEST(Obj, JoinsLinesThatEndWithABackslash) {
  expect_one_triangle(kThreeVertices + "f 1 2 \\\n3\n");
  expect_one_triangle(kThreeVertices + "f 1\\\r\n 2\\\r\n 3\r\n");
}

TEST(Obj, ReadsWindowsLinesTabsCommentsAndAByteOrderMark) {
  expect_one_triangle("\xEF\xBB\xBF# made by hand\r\n\r\nv\t0 0 0 # here\r\n  v +1 0 0\r\nv 0 1e0 0\r\nf 1 2 3\r\n");
}

TEST(Obj, SkipsColoursAndRecordsThatAreNoFaces) {
  expect_one_triangle(
      "mtllib a.mtl\no f 1 2 3\nv 0 0 0 1 0.5 0\nv 1 0 0 1 1 1\nv 0 1 0 0 0 0\nvt 0 0\nvn 0 0 1\n"
      "g a b\ns off\nusemtl\nl 1 2\np 1\nf 1 2 3\n");
}

TEST(Obj, TellsTheGroupObjectAndMaterialOfEachTriangle) {
  MeshMarks marks;
  const TriangleMesh mesh = read_mesh(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\ng lid top\nusemtl steel\nf 1 2 3 4\ng\nf 1 2 3\ng lid top\nf 1 2 "
      "3\n",
      "a.obj", {.marks = &marks});
  ASSERT_EQ(mesh.face_count(), 5u);
  const std::vector<std::vector<std::string>> names{{}, {"lid", "top", "steel"}, {"steel"}};
  EXPECT_EQ(marks.names, names);
  EXPECT_EQ(marks.names_of, PerFace<std::uint32_t>({0, 1, 1, 2, 1})) << "both triangles of the square";
}

TEST(Obj, ReadsAFileWithoutFacesAsItIs) {
  EXPECT_EQ(read_mesh("", "a.obj"), TriangleMesh());
  EXPECT_EQ(read_mesh(kThreeVertices, "a.obj").vertex_count(), 3u);
}

TEST(Obj, RefusesIndicesThatNoVertexHas) {
  expect_refused(kThreeVertices + "f 1 2 4\n", "a.obj",
                 "a.obj: line 4: the face has vertex 4, but the file has 3 vertices, counted from 1");
  expect_refused(kThreeVertices + "f 1 2 99999999999\n", "a.obj",
                 "a.obj: line 4: the face has vertex 99999999999, but the file has 3 vertices, counted from 1");
  expect_refused(kThreeVertices + "f 1 2 0\n", "a.obj", "a.obj: line 4: the face has vertex 0; vertices count from 1");
  expect_refused(kThreeVertices + "\nf -4 2 1\n", "a.obj",
                 "a.obj: line 5: the face has vertex -4, but only 3 vertices come before it");
}

TEST(Obj, RefusesWhatIsNotANumber) {
  expect_refused("v 0 abc 0\n", "a.obj", "a.obj: line 1: 'abc' is not a number; expected a coordinate");
  expect_refused("v 0 1.#QNAN 0\n", "a.obj", "a.obj: line 1: '1.#QNAN' is not a number; expected a coordinate");
  expect_refused("v 0 0,5 0\n", "a.obj", "a.obj: line 1: '0,5' is not a number; expected a coordinate");
  expect_refused("v 0 1e400 0\n", "a.obj", "a.obj: line 1: '1e400' is beyond the range of a number in 64 bits");
  expect_refused("v 0 \x1b[2J 0\n", "a.obj", "a.obj: line 1: '\\x1b[2J' is not a number; expected a coordinate");
  expect_refused(kThreeVertices + "f 1 2 x\n", "a.obj",
                 "a.obj: line 4: 'x' is not a corner of a face; expected a vertex number");
}

TEST(Obj, RefusesNonFiniteCoordinates) {
  expect_refused(
      "v 0 0 0\n\nv 0 nan 0\n", "a.obj",
      "a.obj: line 3: vertex 2 has y = nan; coordinates must be finite; `prohull repair` drops such triangles",
      Defect::NonFiniteCoordinate);
  expect_refused(
      "v 0 0 -inf\n", "a.obj",
      "a.obj: line 1: vertex 1 has z = -inf; coordinates must be finite; `prohull repair` drops such triangles",
      Defect::NonFiniteCoordinate);
}

TEST(Obj, KeepsNonFiniteCoordinatesIfAsked) {
  const TriangleMesh mesh = read_mesh("v 0 nan 0\nv 1 0 0\nv 1 1 0\nv 0 1 -inf\nf 1 2 3 4\nf 2 3 2\n", "a.obj",
                                      {.non_finite = NonFinite::Keep});
  EXPECT_EQ(mesh.face_count(), 3u);
  EXPECT_TRUE(std::isnan(mesh.positions[VertexId(0)].y));
}

TEST(Obj, TakesFacesOfOneOrTwoCornersForTrianglesWithoutArea) {
  const TriangleMesh mesh = read_mesh(kThreeVertices + "f 1 2\nf 3\nf\n", "a.obj");
  ASSERT_EQ(mesh.face_count(), 2u);
  EXPECT_EQ(mesh.triangles[FaceId(0)], (std::array{VertexId(0), VertexId(1), VertexId(1)}));
  EXPECT_EQ(mesh.triangles[FaceId(1)], (std::array{VertexId(2), VertexId(2), VertexId(2)}));
}

TEST(Obj, RefusesIncompleteRecords) {
  expect_refused("v 0 0\nv 1 1 1\n", "a.obj", "a.obj: line 1: the line ends where a coordinate was expected");
}

TEST(Obj, RefusesUnknownRecordsRatherThanLoseFaces) {
  expect_refused(kThreeVertices + "ff 1 2 3\n", "a.obj", "a.obj: line 4: 'ff' is not a record of an OBJ file");
}

}  // namespace
}  // namespace prohull

#include <fmt/format.h>

#include "io_testing.h"

namespace prohull {
namespace {

const std::string kBody = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

void expect_one_triangle(std::string_view content) {
  const TriangleMesh mesh = read_mesh(content, "a.off");
  ASSERT_EQ(mesh.face_count(), 1u) << content;
  EXPECT_EQ(mesh.positions, PerVertex<Vec3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << content;
  EXPECT_EQ(mesh.triangles[FaceId(0)], corners(0, 1, 2)) << content;
}

TEST(Off, ReadsCountsBelowOrBesideTheKeyword) {
  expect_one_triangle("OFF\n3 1 0\n" + kBody);
  expect_one_triangle("OFF 3 1 0\n" + kBody);
  expect_one_triangle("OFF\r\n\r\n3 1\r\n" + kBody);
}

TEST(Off, SkipsCommentsColoursAndNormals) {
  expect_one_triangle("# a comment\nOFF # another\n\n3 1 0\n0 0 0 # one\n\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n");
  expect_one_triangle("COFF\n3 1 0\n0 0 0 192 192 192 255 \n1 0 0 0 0 0 0\n0 1 0 0 0 0 0\n3 0 1 2\n");
  expect_one_triangle("STCNOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2 0.5\n");
}

TEST(Off, RefusesMoreThanItsCounts) {
  expect_one_triangle("OFF\n3 1 0\n" + kBody + "\n# the end\n\n");
  expect_refused(
      "OFF\n3 1 0\n" + kBody + "\n3 0 1 2\n", "a.off",
      "a.off: line 8: more follows the last face of 1; the number of vertices or faces is wrong, or this line "
      "is too much");
}

TEST(Off, RefusesAMissingOrUnsupportedKeyword) {
  expect_refused("3 1 0\n" + kBody, "a.off", "a.off: line 1: the file starts with '3'; expected OFF");
  expect_refused("", "a.off", "a.off: line 1: the file starts with ''; expected OFF");
  expect_refused("4OFF\n3 1 0\n", "a.off",
                 "a.off: line 1: '4OFF' has other than three coordinates; only three are read");
  expect_refused("OFF BINARY\n", "a.off", "a.off: line 1: 'BINARY' is not an integer; expected the number of vertices");
}

TEST(Off, RefusesCountsThatTheBodyDoesNotHave) {
  expect_refused("OFF\n3 2 0\n" + kBody, "a.off",
                 "a.off: line 7: the file ends before face 2 of 2; it is truncated or its count is wrong");
  expect_refused("OFF\n4000000000 4000000000 0\n0 0 0\n", "a.off",
                 "a.off: line 4: the file ends before vertex 2 of 4000000000; it is truncated or its count is wrong");
  expect_refused("OFF\n3 4000000000 0\n" + kBody, "a.off",
                 "a.off: line 7: the file ends before face 2 of 4000000000; it is truncated or its count is wrong");
  expect_refused("OFF\n-3 1 0\n" + kBody, "a.off", "a.off: line 2: the number of vertices is negative");
  expect_refused("OFF\n99999999999999999999 1 0\n", "a.off",
                 "a.off: line 2: '99999999999999999999' is beyond the range of an integer in 64 bits");
  expect_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", "a.off",
                 "a.off: line 6: the line ends where a vertex number was expected");
}

TEST(Off, RefusesBadIndicesAndCoordinates) {
  expect_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a.off",
                 "a.off: line 6: the face has vertex 3, but the file has 3 vertices, counted from 0");
  expect_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "a.off",
                 "a.off: line 6: the face has vertex -1; vertices count from 0");
  expect_refused(
      "OFF\n3 1 0\n0 0 0\n1 inf 0\n", "a.off",
      "a.off: line 4: vertex 1 has y = inf; coordinates must be finite; `prohull repair` drops such triangles",
      Defect::NonFiniteCoordinate);
  expect_refused("OFF\n3 1 0\n0 0\n1 0 0\n", "a.off", "a.off: line 3: the line ends where a coordinate was expected");
}

TEST(Off, IsNotHeldUpByHostilePolygons) {
  std::string off = "OFF\n100000 1 0\n", face = "100000";
  for (int i = 0; i < 100000; ++i) {
    off += fmt::format("{} {} 0\n", i, i % 2);
    face += fmt::format(" {}", i * 7919ll % 100000);
  }
  off += face;
  try {
    EXPECT_EQ(read_mesh(off, "a.off").face_count(), 99998u);  // not simple: a fan
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "a.off: line 100003: a polygon with 100000 corners that is too intricate to triangulate; split it");
  }
}

}  // namespace
}  // namespace prohull

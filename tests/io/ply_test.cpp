#include <algorithm>
#include <bit>

#include "io_testing.h"

namespace prohull {
namespace {

const std::string kVertices = "property float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "property list uchar int vertex_indices\n";
const std::string kAsciiBody = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string header(std::string_view format, std::size_t vertices, std::size_t faces) {
  return "ply\nformat " + std::string(format) + " 1.0\nelement vertex " + std::to_string(vertices) + "\n" + kVertices +
         "element face " + std::to_string(faces) + "\n" + kFaces + "end_header\n";
}

template <class T>
std::string in_order(std::endian order, T value) {
  std::string bytes = bytes_of(value);
  if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string binary_body(std::endian order) {
  std::string body;
  for (const float value : {0, 0, 0, 1, 0, 0, 0, 1, 0}) body += in_order(order, value);
  body += '\3';
  for (const std::int32_t corner : {0, 1, 2}) body += in_order(order, corner);
  return body;
}

void expect_one_triangle(std::string_view content) {
  const TriangleMesh mesh = read_mesh(content, "a.ply");
  EXPECT_EQ(mesh.positions, PerVertex<Vec3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << content;
  ASSERT_EQ(mesh.face_count(), 1u) << content;
  EXPECT_EQ(mesh.triangles[FaceId(0)], corners(0, 1, 2)) << content;
}

// Of vertices in floats and of faces in bytes, as different programs write them.
TEST(Ply, TellsColorsOnRequest) {
  const std::string content =
      "ply\nformat ascii 1.0\nelement vertex 4\n" + kVertices +
      "property float red\nproperty float green\nproperty float blue\nelement face 2\nproperty uchar blue\n" + kFaces +
      "property uchar red\nproperty uchar green\nproperty uchar alpha\nend_header\n"
      "0 0 0 1 0 0\n1 0 0 0 0.5 2\n1 1 0 0 0 0\n0 1 0 -1 0 0\n7 4 0 1 2 3 255 0 9\n8 3 0 1 2 1 2 9\n";
  MeshMarks marks;
  const TriangleMesh mesh = read_mesh(content, "a.ply", {.marks = &marks});
  EXPECT_EQ(mesh, read_mesh(content, "a.ply")) << "colours change nothing else";
  EXPECT_EQ(marks.vertex_colors, PerVertex<Color>({{255, 0, 0}, {0, 128, 255}, {0, 0, 0}, {0, 0, 0}}));
  EXPECT_EQ(marks.face_colors, PerFace<Color>({{255, 0, 7}, {255, 0, 7}, {1, 2, 8}})) << "a square is two triangles";
  MeshMarks none;
  read_mesh(header("ascii", 3, 1) + kAsciiBody, "a.ply", {.marks = &none});
  EXPECT_TRUE(none.vertex_colors.empty() && none.face_colors.empty());
}

TEST(Ply, HasAColorForEachVertexAndFaceOrNone) {
  const std::string colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const auto marks_of = [&](bool first) {  // of two elements of vertices, and two of faces, which one has colours
    const std::string of_first = first ? colors : "", of_second = first ? "" : colors;
    const std::string red = " 255 0 0\n", plain = "\n";
    MeshMarks marks;
    read_mesh("ply\nformat ascii 1.0\nelement vertex 1\n" + kVertices + of_first + "element vertex 2\n" + kVertices +
                  of_second + "element face 1\n" + kFaces + of_first + "element face 1\n" + kFaces + of_second +
                  "end_header\n0 0 0" + (first ? red : plain) + "1 0 0" + (first ? plain : red) + "0 1 0" +
                  (first ? plain : red) + "3 0 1 2" + (first ? red : plain) + "3 2 1 0" + (first ? plain : red),
              "a.ply", {.marks = &marks});
    return marks;
  };
  const Color red{255, 0, 0}, none;
  EXPECT_EQ(marks_of(true).vertex_colors, PerVertex<Color>({red, none, none}));
  EXPECT_EQ(marks_of(false).vertex_colors, PerVertex<Color>({none, red, red}));
  EXPECT_EQ(marks_of(true).face_colors, PerFace<Color>({red, none}));
  EXPECT_EQ(marks_of(false).face_colors, PerFace<Color>({none, red}));
}

TEST(Ply, ReadsAsciiAndBothByteOrders) {
  expect_one_triangle(header("ascii", 3, 1) + kAsciiBody);
  expect_one_triangle(header("binary_little_endian", 3, 1) + binary_body(std::endian::little));
  expect_one_triangle(header("binary_big_endian", 3, 1) + binary_body(std::endian::big));
}

TEST(Ply, KeepsTheBitsOfBigEndianDoubles) {
  const double values[] = {5e-324, 1e300, -0.0};
  std::string content =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty double x\nproperty float64 y\n"
      "property double z\nend_header\n";
  for (const double value : values) content += in_order(std::endian::big, value);
  const Vec3 p = read_mesh(content, "a.ply").positions[VertexId(0)];
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(p[axis]), std::bit_cast<std::uint64_t>(values[axis]));
}

TEST(Ply, ReadsWindowsLinesCommentsAndTrailingData) {
  std::string content = header("ascii", 3, 1) + kAsciiBody + "\n\ncomment the end\n";
  content.replace(content.find("element"), 0, "comment element face 7\nobj_info made by hand\n");
  expect_one_triangle(content);
  for (std::size_t i = 0; (i = content.find('\n', i)) != std::string::npos; i += 2) content.insert(i, 1, '\r');
  expect_one_triangle(content);
  expect_one_triangle(header("binary_little_endian", 3, 1) + binary_body(std::endian::little) + "anything else");
}

TEST(Ply, KeepsTheBytesOfABinaryBodyBehindLinesThatEndWithCr) {
  std::string content = header("binary_big_endian", 3, 0);
  std::replace(content.begin(), content.end(), '\n', '\r');
  const float x = std::bit_cast<float>(0x0d0d0d0d), y = std::bit_cast<float>(0x0a0a0a0a);
  for (const float value : {x, x, x, x, x, x, y, y, y}) content += in_order(std::endian::big, value);
  EXPECT_EQ(read_mesh(content, "a.ply").positions, PerVertex<Vec3>({{x, x, x}, {x, x, x}, {y, y, y}}));
}

// Just above the middle of two floats, and of the doubles beside it the middle is the nearest.
TEST(Ply, RoundsDecimalsOfFloatsOnce) {
  const TriangleMesh mesh = read_mesh(
      header("ascii", 1, 0) + "1.0000000596046447753906250000001 +1.0000000596046447753906250000001 1e-60\n", "a.ply");
  const double above = std::nextafter(1.0f, 2.0f);
  EXPECT_EQ(mesh.positions[VertexId(0)], (Vec3{above, above, 0}));
}

TEST(Ply, SkipsPropertiesAndElementsThatAreNoGeometry) {
  const std::string elements =
      "element camera 2\nproperty double f\nproperty list uchar short s\n"
      "element face 1\nproperty uchar flags\nproperty list uint8 uint32 vertex_index\nproperty list uchar float uv\n"
      "element vertex 3\nproperty list ushort uchar l\nproperty double nx\nproperty float x\nproperty int8 y\n"
      "property uint16 q\nproperty uint16 z\nend_header\n";
  expect_one_triangle("ply\nformat ascii 1.0\n" + elements +
                      "0.5 2 1 2\n0.5 0\n7 3 0 1 2 2 0.5 0.5\n0 7 0 0 9 0\n1 4 7 1 0 9 0\n2 4 4 7 0 1 9 0\n");
  std::string body;
  body += bytes_of(0.5) + '\2' + bytes_of(std::int16_t{1}) + bytes_of(std::int16_t{2}) + bytes_of(0.5) + '\0';
  body += std::string("\7\3") + bytes_of(0u) + bytes_of(1u) + bytes_of(2u) + '\1' + bytes_of(0.5f);
  for (const auto& [x, y] : {std::pair(0.f, 0), std::pair(1.f, 0), std::pair(0.f, 1)})
    body += bytes_of(std::uint16_t{2}) + "ab" + bytes_of(7.0) + bytes_of(x) + static_cast<char>(y) +
            bytes_of(std::uint16_t{9}) + bytes_of(std::uint16_t{0});
  if constexpr (std::endian::native == std::endian::little)
    expect_one_triangle("ply\nformat binary_little_endian 1.0\n" + elements + body);
}

TEST(Ply, ReadsTriangleStripsWithRestartsAndAlternatingOrientation) {
  const TriangleMesh mesh = read_mesh("ply\nformat ascii 1.0\nelement vertex 5\n" + kVertices +
                                          "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                                          "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n14 0 1 2 3 4 -1 0 1 1 2 -1 2 1 0\n",
                                      "a.ply");
  EXPECT_EQ(mesh.triangles,
            (PerFace<std::array<VertexId, 3>>{corners(0, 1, 2), corners(2, 1, 3), corners(2, 3, 4), corners(2, 1, 0)}));
}

TEST(Ply, RefusesABadHeader) {
  const auto refused = [](const std::string& lines, std::string_view message) {
    expect_refused("ply\n" + lines, "a.ply", message);
  };
  expect_refused("plx\n", "a.ply", "a.ply: line 1: the file does not start with ply");
  refused("format ascii 1.0\n", "a.ply: line 3: the file ends within the header; expected end_header");
  refused("end_header\n", "a.ply: line 2: the header has no format");
  refused("format utf8 1.0\n",
          "a.ply: line 2: unknown format 'utf8'; expected ascii, binary_little_endian or binary_big_endian");
  refused("property float x\n", "a.ply: line 2: a property before any element");
  refused("element vertex\n", "a.ply: line 2: the line ends where the number of records of the element was expected");
  refused("element vertex -1\n", "a.ply: line 2: element 'vertex' has a negative count");
  refused("element vertex 1\nproperty quad x\n", "a.ply: line 3: unknown type 'quad'");
  refused("element vertex 1\nproperty list float int x\n",
          "a.ply: line 3: the type of a list's length must be an integer type");
  refused("format ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n",
          "a.ply: line 3: element vertex has no number named y");
  refused("format ascii 1.0\nelement face 1\nproperty list uchar float vertex_indices\nend_header\n",
          "a.ply: line 3: element face has no list of integers named vertex_indices");
  refused("vertices 3\n", "a.ply: line 2: 'vertices' is not a line of a PLY header");
}

TEST(Ply, RefusesCountsThatAnAsciiBodyDoesNotHave) {
  expect_refused(header("ascii", 3, 4000000000) + kAsciiBody, "a.ply",
                 "a.ply: line 14: the file ends before face 2 of 4000000000; it is truncated or its count is wrong");
  expect_refused(header("ascii", 4000000000, 1) + kAsciiBody, "a.ply",
                 "a.ply: line 13: vertex 4 of 4000000000 has more values than properties; or a count in the header is "
                 "wrong");
  expect_refused(
      header("ascii", 3, 1) + "0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", "a.ply",
      "a.ply: line 13: 4000000000 is beyond the range of its type; give the property a larger type in the header");
  expect_refused(header("ascii", 3, 1) + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", "a.ply",
                 "a.ply: line 13: a list has the length -3");
}

TEST(Ply, RefusesMoreRowsThanAnAsciiHeaderHas) {
  const std::string message =
      ": more follows the last record that the header tells of; a count in the header is wrong, or this line is too "
      "much";
  expect_refused(header("ascii", 3, 1) + kAsciiBody + "3 0 1 2\n", "a.ply", "a.ply: line 14" + message);
  expect_refused(header("ascii", 3, 0) + kAsciiBody, "a.ply", "a.ply: line 13" + message);
}

TEST(Ply, RefusesNumbersBeyondTheirType) {
  std::string content = header("ascii", 3, 1) + "0 0 0\n1 0 0\n0 1 300\n3 0 1 2\n";
  content.replace(content.find("float z"), 7, "uchar z");
  expect_refused(content, "a.ply",
                 "a.ply: line 12: 300 is beyond the range of its type; give the property a larger type in the header");
  content.replace(content.find("300"), 3, "255");
  EXPECT_EQ(read_mesh(content, "a.ply").positions[VertexId(2)].z, 255);
  content.replace(content.find("uchar z"), 7, "char z");
  expect_refused(content, "a.ply",
                 "a.ply: line 12: 255 is beyond the range of its type; give the property a larger type in the header");
}

TEST(Ply, RefusesCountsThatABinaryBodyDoesNotHave) {
  const std::string body = binary_body(std::endian::little);
  const auto end_of = [](const std::string& content) { return "a.ply: byte " + std::to_string(content.size()); };
  for (const auto& [vertices, faces, where] :
       {std::tuple(3ul, 4000000000ul, "face 2 of 4000000000"), std::tuple(4000000000ul, 1ul, "vertex 5 of 4000000000"),
        std::tuple(9223372036854775807ul, 1ul, "vertex 5 of 9223372036854775807")}) {
    const std::string content = header("binary_little_endian", vertices, faces) + body;
    expect_refused(content, "a.ply",
                   end_of(content) + ": the file ends within " + where + "; it is truncated or its count is wrong");
  }
  const std::string truncated = header("binary_little_endian", 3, 1) + body.substr(0, body.size() - 1);
  expect_refused(truncated, "a.ply",
                 end_of(truncated) + ": the file ends within face 1 of 1; it is truncated or its count is wrong");
  std::string hostile_list = header("binary_little_endian", 3, 1) + body.substr(0, 36) + std::string(12, '\xFF');
  hostile_list.replace(hostile_list.find("list uchar"), 10, "list uint");
  expect_refused(hostile_list, "a.ply",
                 end_of(hostile_list) + ": the file ends within face 1 of 1; it is truncated or its count is wrong");
}

TEST(Ply, RefusesBadIndicesAndCoordinates) {
  expect_refused(header("ascii", 3, 1) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a.ply",
                 "a.ply: line 13: the face has vertex 3, but the file has 3 vertices, counted from 0");
  expect_refused(header("ascii", 3, 1) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -2\n", "a.ply",
                 "a.ply: line 13: the face has vertex -2; vertices count from 0");
  expect_refused(
      header("ascii", 3, 1) + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "a.ply",
      "a.ply: line 11: vertex 1 has y = nan; coordinates must be finite; `prohull repair` drops such triangles",
      Defect::NonFiniteCoordinate);
  std::string content = header("binary_little_endian", 3, 1);
  const std::string place = "a.ply: byte " + std::to_string(content.size() + 12);
  content += binary_body(std::endian::little);
  content.replace(content.size() - 13 - 24 + 8, 4, std::string("\0\0\x80\x7f", 4));
  expect_refused(content, "a.ply",
                 place + ": vertex 1 has z = inf; coordinates must be finite; `prohull repair` drops such triangles",
                 Defect::NonFiniteCoordinate);
}

TEST(Ply, IsNotHeldUpByRecordsWithoutProperties) {
  EXPECT_EQ(read_mesh("ply\nformat ascii 1.0\nelement nothing 9000000000000000000\nend_header\n", "a.ply"),
            TriangleMesh());
}

}  // namespace
}  // namespace prohull

#include "prohull/detail/query_io.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "compressing.h"
#include "io_testing.h"
#include "random.h"

namespace prohull {
namespace {

/// An .npy file with any text as its header.
std::string npy(const std::string& header, const std::string& data, char version = 1) {
  const auto length = static_cast<std::uint32_t>(header.size());
  std::string bytes = std::string("\x93NUMPY") + version + '\0';
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i) bytes += static_cast<char>(length >> (8 * i) & 0xff);
  return bytes + header + data;
}

std::string header(const std::string& type, const std::string& shape, const std::string& fortran = "False") {
  return "{'descr': '" + type + "', 'fortran_order': " + fortran + ", 'shape': " + shape + ", }\n";
}

template <class Number>
std::string numbers(std::initializer_list<Number> values, bool big_endian = false) {
  std::string bytes;
  for (const Number value : values) {
    std::string number = bytes_of(value);
    if (big_endian == (std::endian::native == std::endian::little)) number = {number.rbegin(), number.rend()};
    bytes += number;
  }
  return bytes;
}

const std::string kTwoRows = numbers<double>({0, 1, 2, 3, 4, 5, 10, 11, 12, 13, 14, 15});
const std::string kTwoRowsInFortranOrder = numbers<double>({0, 10, 1, 11, 2, 12, 3, 13, 4, 14, 5, 15});
const std::string kShape = "(2, 6)";

void expect_two_rows(const std::string& content, const char* name = "s.npy") {
  const std::vector<Segment> segments = read_segments(content, name);
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0].a, (Vec3{0, 1, 2}));
  EXPECT_EQ(segments[0].b, (Vec3{3, 4, 5}));
  EXPECT_EQ(segments[1].a, (Vec3{10, 11, 12}));
  EXPECT_EQ(segments[1].b, (Vec3{13, 14, 15}));
}

void refused(const std::string& content, const char* name, std::string_view message,
             Defect defect = Defect::Malformed) {
  expect_input_error([&] { read_segments(content, name); }, defect, message);
}

std::string with_number(std::size_t place, double value) {
  std::string data = kTwoRows;
  return data.replace(place * sizeof(double), sizeof(double), bytes_of(value));
}

template <class Number>
void expect_two_rows_of(const std::string& type) {
  SCOPED_TRACE(type);
  const std::initializer_list<Number> values{0, 1, 2, 3, 4, 5, 10, 11, 12, 13, 14, 15};
  expect_two_rows(npy(header("<" + type, kShape), numbers<Number>(values)));
  expect_two_rows(npy(header(">" + type, kShape), numbers<Number>(values, true)));
}

TEST(NpyReader, TakesNumbersOfEveryKindAndByteOrder) {
  expect_two_rows_of<float>("f4");
  expect_two_rows_of<double>("f8");
  expect_two_rows_of<std::int16_t>("i2");
  expect_two_rows_of<std::int32_t>("i4");
  expect_two_rows_of<std::int64_t>("i8");
  expect_two_rows_of<std::uint16_t>("u2");
  expect_two_rows_of<std::uint32_t>("u4");
  expect_two_rows_of<std::uint64_t>("u8");
  const std::string bytes("\0\1\2\3\4\5\n\v\f\r\16\17", 12);
  expect_two_rows(npy(header("|i1", kShape), bytes));
  expect_two_rows(npy(header("|u1", kShape), bytes));
}

TEST(NpyReader, KeepsSignsAndBits) {
  const double least = std::numeric_limits<double>::denorm_min();
  const auto segments =
      read_segments(npy(header("<f8", "(1, 6)"), numbers<double>({-0.0, 0.1, -least, 1e308, 1, 1})), "s.npy");
  EXPECT_TRUE(std::signbit(segments[0].a.x));
  EXPECT_EQ(segments[0].a, (Vec3{0, 0.1, -least}));
  EXPECT_EQ(segments[0].b.x, 1e308);
  EXPECT_EQ(read_segments(npy(header("|i1", "(1, 6)"), "\xff\x80zzzz"), "s.npy")[0].a, (Vec3{-1, -128, 'z'}));
}

TEST(NpyReader, TakesEitherOrderAndShape) {
  expect_two_rows(npy(header("<f8", "(2, 2, 3)"), kTwoRows));
  expect_two_rows(npy(header("<f8", kShape, "True"), kTwoRowsInFortranOrder));
  // Index i of the row runs fastest, then that of the end, then that of the axis.
  expect_two_rows(npy(header("<f8", "(2, 2, 3)", "True"), numbers<double>({0, 10, 3, 13, 1, 11, 4, 14, 2, 12, 5, 15})));
}

TEST(NpyReader, TakesEveryWritingOfItsHeader) {
  expect_two_rows(npy(header("<f8", kShape), kTwoRows, 2));
  expect_two_rows(npy(header("<f8", kShape), kTwoRows, 3));
  expect_two_rows(npy("{ \"shape\":(2L,6L),\n\"descr\" : \"<f8\",\t'fortran_order':False}", kTwoRows));
  expect_two_rows(npy(header("<f8", kShape) + std::string(1000, ' ') + "\n", kTwoRows));
  EXPECT_TRUE(read_segments(npy(header("<f8", "(0, 6)"), ""), "s.npy").empty());
}

TEST(NpyReader, RefusesOtherShapes) {
  const auto message = [](const std::string& shape) {
    return "s.npy: byte " + std::to_string(10 + header("<f8", shape).size()) + ": its shape is " + shape +
           "; segments have the shape (n, 6) or (n, 2, 3), each row x0,y0,z0,x1,y1,z1";
  };
  for (const std::string shape : {"()", "(12,)", "(4, 3)", "(6, 2)", "(2, 3, 2)", "(1, 2, 2, 3)", "(2, 0)"})
    refused(npy(header("<f8", shape), kTwoRows), "s.npy", message(shape));
}

TEST(NpyReader, RefusesWhatIsNoNumber) {
  for (const std::string type : {"<c16", "|b1", "<f2", "<f16", "|O", "<U3", "|S8", "<M8[ns]", "=f8", "|f8", "<", ""})
    refused(npy(header(type, kShape), kTwoRows), "s.npy",
            "s.npy: byte " + std::to_string(10 + header(type, kShape).size()) + ": its elements are of type '" + type +
                "'; expected integers, or floating point of 32 or 64 bits: save array.astype('float64')");
  refused(npy("{'descr': [('x', '<f8'), ('y', '<f8')], 'fortran_order': False, 'shape': (2, 6), }\n", kTwoRows),
          "s.npy", "s.npy: byte 20: its elements have several fields; save one array of plain numbers");
}

TEST(NpyReader, BelievesNoCount) {
  const auto message = [](const std::string& shape, const std::string& rest) {
    return "s.npy: byte " + std::to_string(10 + header("<f8", shape).size()) + ": " + rest;
  };
  refused(npy(header("<f8", "(3, 6)"), kTwoRows), "s.npy",
          message("(3, 6)", "the file ends after 2 of 3 rows; it is truncated or its shape is wrong"));
  // 6 times this count of rows is 2 in 64 bits, and 48 times it 16.
  const std::string overflowing = "(3074457345618258603, 6)";
  refused(
      npy(header("<f8", overflowing), kTwoRows), "s.npy",
      message(overflowing, "the file ends after 2 of 3074457345618258603 rows; it is truncated or its shape is wrong"));
  refused(npy(header("<f8", "(1, 6)"), kTwoRows), "s.npy",
          message("(1, 6)", "48 bytes follow the 1 rows; save one array in a file"));
  refused(npy(header("<f8", kShape), kTwoRows.substr(1)), "s.npy",
          message(kShape, "the file ends after 1 of 2 rows; it is truncated or its shape is wrong"));
  refused(npy(header("<f8", "(18446744073709551616, 6)"), kTwoRows), "s.npy",
          "s.npy: byte 61: the header is damaged: a count below 2^64 was expected");
  refused(npy(header("<f8", "(-2, 6)"), kTwoRows), "s.npy",
          "s.npy: byte 61: the header is damaged: a count below 2^64 was expected");
}

TEST(NpyReader, RefusesAFileCutOffAnywhere) {
  const std::string whole = npy(header("<f8", kShape), kTwoRows);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW(read_segments(whole.substr(0, size), "s.npy"), InputError) << size;
}

TEST(NpyReader, RefusesDamagedHeaders) {
  const auto refuse = [](const std::string& text, const std::string& why) {
    refused(npy(text, kTwoRows), "s.npy", "s.npy: byte " + why);
  };
  refuse("", "10: the header is damaged: '{' was expected");
  refuse("{}", "12: the header lacks descr, fortran_order or shape");
  refuse("{'descr': '<f8', 'shape': (2, 6)}", "43: the header lacks descr, fortran_order or shape");
  refuse("{'descr' '<f8'}", "19: the header is damaged: ':' was expected");
  refuse("{'descr': '<f8}", "20: the header is damaged: a quote is missing");
  refuse("{'descr': f8}", "20: the header is damaged: a text in quotes was expected");
  refuse("{'fortran_order': 0}", "28: the header is damaged: True or False was expected");
  refuse("{'shape': [2, 6]}", "20: the header is damaged: '(' was expected");
  refuse("{'shape': (2 6)}", "23: the header is damaged: ')' was expected");
  refuse("{'color\n': 'red'}", "20: the header has an entry 'color\\x0a', which is not known");
  refused(npy(header("<f8", kShape), kTwoRows, 4), "s.npy",
          "s.npy: byte 8: version 4.0 of the format; versions 1 to 3 are read: save it with another numpy",
          Defect::UnknownFormat);
  refused("\x93NUMPY", "s.npy", "s.npy: byte 6: the file ends within its header");
  refused("\x93NUMPX", "s.npy", "s.npy: byte 0: this is no .npy file: it does not start with \\x93NUMPY");
  std::string longer = npy(header("<f8", kShape), "");
  longer[8] = '\xff';
  refused(longer, "s.npy", "s.npy: byte 10: the file ends within its header; it is truncated");
}

TEST(QueryReader, NamesTheRowThatCannotBeAsked) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  refused(npy(header("<f8", kShape), with_number(9, nan)), "s.npy",
          "s.npy: row 1 (from 0): x1 is nan; expected finite numbers", Defect::NonFiniteCoordinate);
  refused(npy(header("<f8", kShape), with_number(2, -infinity)), "s.npy",
          "s.npy: row 0 (from 0): z0 is -inf; expected finite numbers", Defect::NonFiniteCoordinate);
  refused(npy(header("<f8", "(1, 6)"), numbers<double>({0, 1, 2, -0.0, 1, 2})), "s.npy",
          "s.npy: row 0 (from 0): the segment's ends are equal; leave it out", Defect::NoLength);
  refused("0,0,0,1,1,1\n\n1,2,3,1,2,3\n", "s.csv", "s.csv: line 3: the segment's ends are equal; leave it out",
          Defect::NoLength);
  refused("nan,0,0,1,1,1\n", "s.csv", "s.csv: line 1: x0 is nan; expected finite numbers", Defect::NonFiniteCoordinate);
}

TEST(QueryReader, TakesRaysAndTriangles) {
  const auto rays = read_rays("x,y,z,dx,dy,dz\n1,2,3,0,0,-4\n", "r.csv");
  ASSERT_EQ(rays.size(), 1u);
  EXPECT_EQ(rays[0].origin, (Vec3{1, 2, 3}));
  EXPECT_EQ(rays[0].direction, (Vec3{0, 0, -4}));
  expect_input_error([] { read_rays("1,2,3,0,-0,0", "r.csv"); }, Defect::NoLength,
                     "r.csv: line 1: the ray's direction is zero; leave it out");

  const std::string nine = numbers<float>({0, 1, 2, 3, 4, 5, 6, 7, 8});
  for (const std::string shape : {"(1, 9)", "(1, 3, 3)"}) {
    const auto triangles = read_triangles(npy(header("<f4", shape), nine), "t.npy");
    ASSERT_EQ(triangles.size(), 1u);
    EXPECT_EQ(triangles[0].a, (Vec3{0, 1, 2}));
    EXPECT_EQ(triangles[0].b, (Vec3{3, 4, 5}));
    EXPECT_EQ(triangles[0].c, (Vec3{6, 7, 8}));
  }
  EXPECT_EQ(read_triangles("1,1,1,1,1,1,1,1,1", "t.csv").size(), 1u);
  EXPECT_THROW(read_triangles("0,0,0,1,1,1", "t.csv"), InputError);
}

TEST(QueryReader, TakesPosesOfThreeForms) {
  const Pose quarter{{Vec3{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}, {5, 6, 7}};
  EXPECT_EQ(read_poses("0,-1,0,5, 1,0,0,6, 0,0,1,7\n", "poses.csv"), std::vector{quarter});
  EXPECT_EQ(read_poses("0 -1 0 5 1 0 0 6 0 0 1 7 0 0 0 1\n", "poses.csv"), std::vector{quarter});
  const Pose half{{Vec3{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}, {5, 6, 7}};
  EXPECT_EQ(read_poses("x,y,z,qw,qx,qy,qz\n5,6,7,0,0,0,2\n", "poses.csv"), std::vector{half});
  EXPECT_TRUE(read_poses("x,y,z,qw,qx,qy,qz\n", "poses.csv").empty());
  const std::string matrix = numbers<double>({0, -1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1});
  EXPECT_EQ(read_poses(npy(header("<f8", "(1, 4, 4)"), matrix), "poses.npy"), std::vector{quarter});
  EXPECT_EQ(read_poses(npy(header("<f8", "(1, 3, 4)"), matrix.substr(0, 96)), "poses.npy"), std::vector{quarter});
}

TEST(QueryReader, RefusesWhatIsNoPose) {
  const auto refuse = [](const char* content, const char* message) {
    expect_input_error([&] { read_poses(content, "poses.csv"); }, Defect::Malformed, message);
  };
  const std::string forms =
      "a pose has 7 numbers, x,y,z,qw,qx,qy,qz; or 12, the upper three rows of a matrix of 4 x 4; or all 16; ";
  refuse("1,2,3\n", ("poses.csv: " + forms + "this one has 3").c_str());
  refuse("0,0,0,1,0,0,0\n1,2,3\n",
         "poses.csv: line 2: there is no comma after z; each line has 7 numbers: x,y,z,qw,qx,qy,qz");
  const auto refuse_option = [](const char* text, const std::string& message) {
    expect_input_error([&] { read_pose(text, "--pose"); }, Defect::Malformed, message.c_str());
  };
  refuse_option("1,2,3,4,5,6,7,8,9,10,11,12,13", "--pose: " + forms + "this one has 13");
  refuse_option("1,2,x,1,0,0,0", "--pose: 'x' is not a number; expected z");
  refuse_option("0,0,0,0,0,0,0", "--pose: a quaternion of a pose must be finite, and not 0");
  refuse_option("", "--pose: there are no numbers");
  refuse_option("0,0,0,1,0,0,0\n0,0,0,1,0,0,0", "--pose: there is more than one pose");
  refuse("0,0,0,1,0,0,0\n0,0,0,0,0,0,0\n", "poses.csv: line 2: a quaternion of a pose must be finite, and not 0");
  refuse("x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,1\n",
         "poses.csv: line 1: the w of the quaternion comes last; expected x, y, z, w, x, y, z");
  refuse("# made by savetxt\n# x y z qx qy qz qw\n0 0 0 0 0 0 1\n",
         "poses.csv: line 2: the w of the quaternion comes last; expected x, y, z, w, x, y, z");
  EXPECT_EQ(read_poses("# z is up in each row\n0,0,0,1,0,0,0\n", "poses.csv").size(), 1u);
  refuse("0,0,0,nan,0,0,0\n", "poses.csv: line 1: a quaternion of a pose must be finite, and not 0");
  refuse("2,0,0,0,0,2,0,0,0,0,2,0\n",
         "poses.csv: line 1: a pose is not rigid: the matrix times its transpose must be the identity within 1e-06, "
         "without mirroring");
  refuse("1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2\n", "poses.csv: line 1: the last row of the matrix is not 0,0,0,1");
}

TEST(CsvReader, TakesLinesAsPeopleWriteThem) {
  const std::string rows = "0,1,2,3,4,5\n10,11,12,13,14,15\n";
  expect_two_rows(rows, "s.csv");
  expect_two_rows("x0,y0,z0,x1,y1,z1\n" + rows, "s.csv");
  expect_two_rows(
      "\xEF\xBB\xBF# from a scan\r\n\r\nstart x,,\"y\", z, a , b ,c\r\n 0 , 1,2.0,+3,4e0,.5e1 # first\r\n"
      "\n10,11,12,13,14,15",
      "S.CSV");
  EXPECT_TRUE(read_segments("", "s.csv").empty());
  EXPECT_TRUE(read_segments("x0,y0,z0,x1,y1,z1\n", "s.csv").empty());
}

TEST(CsvReader, TakesSemicolonsTabsAndBlanksForCommas) {
  for (const std::string separator : {";", " ; ", "\t", " ", "  \t "}) {
    const auto row = [&](std::initializer_list<const char*> words) {
      std::string line;
      for (const char* word : words) line += (line.empty() ? "" : separator) + word;
      return line + "\n";
    };
    const std::string rows = row({"0", "1", "2", "3", "4", "5"}) + row({"10", "11", "12", "13", "14", "15"});
    expect_two_rows(rows, "s.csv");
    expect_two_rows(row({"x0", "y0", "z0", "x1", "y1", "z1"}) + rows, "s.csv");
  }
}

TEST(CsvReader, NamesTheLineThatItRefuses) {
  const std::string rows = "; each line has 6 numbers: x0,y0,z0,x1,y1,z1";
  refused("0,1,2,3,4,5\n0,1,2,3,4\n", "s.csv", "s.csv: line 2: there is no comma after y1" + rows);
  refused("0,1,2,3,4,\n", "s.csv", "s.csv: line 1: the line ends where z1 was expected");
  refused("0,1,2,3,4,5,6\n", "s.csv", "s.csv: line 1: the line goes on after the last number" + rows);
  refused("0,1,2,3,4,5,\n", "s.csv", "s.csv: line 1: the line goes on after the last number" + rows);
  refused("0;1;2;3;4;5\n0;1;2;3;4\n", "s.csv", "s.csv: line 2: there is no semicolon after y1" + rows);
  refused("0;1;2;3;4;5\n0,1,2,3,4,5\n", "s.csv", "s.csv: line 2: '0,1,2,3,4,5' is not a number; expected x0");
  refused("0,5;1;2;3;4;5\n", "s.csv", "s.csv: line 1: '0,5' is not a number; expected x0");
  refused("0 1 2 3 4\n", "s.csv", "s.csv: line 1: the line ends where z1 was expected");
  refused("0 1 2 3 4 5 6\n", "s.csv", "s.csv: line 1: the line goes on after the last number" + rows);
  refused("0,1,,3,4,5\n", "s.csv", "s.csv: line 1: ',' is not a number; expected z0");
  refused("0,1,2,3,4,1e999\n", "s.csv", "s.csv: line 1: '1e999' is beyond the range of a number in 64 bits");
}

TEST(CsvReader, TakesNoRowWithAMistakeForNames) {
  refused("1.O,1,2,3,4,5\n", "s.csv", "s.csv: line 1: '1.O' is not a number; expected x0");
  refused("0|1|2|3|4|5\n", "s.csv", "s.csv: line 1: '0|1|2|3|4|5' is not a number; expected x0");
  refused("x0,y0,z0,x1,y1,z1\nx0,y0,z0,x1,y1,z1\n", "s.csv", "s.csv: line 2: 'x0' is not a number; expected x0");
}

TEST(QueryReader, TakesTheFormatFromNameOrContent) {
  const std::string array = npy(header("<f8", kShape), kTwoRows);
  expect_two_rows(array, "s");
  expect_two_rows("0,1,2,3,4,5\n10,11,12,13,14,15\n", "s");
  expect_two_rows(zipped({{"arr_0.npy", array}}), "s");
  expect_two_rows(gzipped(array), "s.npy.gz");
  expect_two_rows(gzipped("0,1,2,3,4,5\n10,11,12,13,14,15\n"), "s.csv.gz");
  refused("0,0,0,1,1,1\n", "s.txt", "s.txt: unknown format; name it .npy, .npz or .csv", Defect::UnknownFormat);
  refused(array, "s.csv", "s.csv: its content is that of a .npy file; rename it");
  refused(zipped({{"arr_0.npy", array}}), "s.npy", "s.npy: its content is that of a .npz file; rename it");
}

TEST(NpzReader, TakesTheOnlyArrayOrTheOneOfThatName) {
  const std::string array = npy(header("<f8", kShape), kTwoRows), other = npy(header("<f8", "(0, 6)"), "");
  expect_two_rows(zipped({{"anything.npy", array}, {"readme.txt", "hello"}}), "s.npz");
  expect_two_rows(zipped({{"rays.npy", other}, {"segments.npy", array}}), "s.npz");
  refused(zipped({{"a.npy", array}, {"b.npy", array}}), "s.npz",
          "s.npz: none of its 2 arrays is called segments; save the one you mean alone");
  refused(zipped({{"readme.txt", "hello"}}), "s.npz",
          "s.npz: none of its 0 arrays is called segments; save the one you mean alone");
  refused(zipped({{"a.npy", array.substr(0, 30)}}), "s.npz",
          "s.npz/a.npy: byte 10: the file ends within its header; it is truncated");
  std::string damaged = zipped({{"a.npy", array}});
  damaged[damaged.size() / 2] ^= 1;
  EXPECT_THROW(read_segments(damaged, "s.npz"), InputError);
}

HitBatch two_hits() {
  return {{0, 0, 2, 2},
          {{FaceId(7), 0.1, {1, -2.5, 1e300}, true}, {FaceId(4294967295), 1.0 / 3, {-0.0, 5e-324, 3}, false}},
          {}};
}

TEST(HitsWriter, WritesOneLineForEachHit) {
  const TemporaryFolder folder;
  write_hits(folder / "hits.csv", two_hits());
  EXPECT_EQ(read_file(folder / "hits.csv"),
            "segment,t,face,x,y,z,entering\n"
            "1,0.1,7,1,-2.5,1e+300,1\n"
            "1,0.3333333333333333,4294967295,-0,5e-324,3,0\n");
  write_hits(folder / "hits.CSV", two_hits(), HitsOf::Rays);
  EXPECT_TRUE(read_file(folder / "hits.CSV").starts_with("ray,t,face"));
  write_faces_met(folder / "faces.csv", {{0, 1, 1, 3}, {FaceId(5), FaceId(2), FaceId(9)}, {}});
  EXPECT_EQ(read_file(folder / "faces.csv"), "triangle,face\n0,5\n2,2\n2,9\n");
  write_hits(folder / "hits.csv", {{0}, {}, {}});
  EXPECT_EQ(read_file(folder / "hits.csv"), "segment,t,face,x,y,z,entering\n");
}

TEST(HitsWriter, WritesTheSameArchiveEveryTime) {
  const TemporaryFolder folder;
  write_hits(folder / "a.npz", two_hits());
  setenv("TZ", "Asia/Tokyo", 1);
  write_hits(folder / "b.npz", two_hits());
  EXPECT_EQ(read_file(folder / "a.npz"), read_file(folder / "b.npz"));
  expect_input_error(
      [&] { read_segments(read_file(folder / "a.npz"), folder / "a.npz"); }, Defect::Malformed,
      (folder / "a.npz").string() + ": none of its 7 arrays is called segments; save the one you mean alone");
}

TEST(HitsWriter, RefusesOtherNames) {
  const TemporaryFolder folder;
  expect_input_error([&] { write_hits("hits.npy", two_hits()); }, Defect::UnknownFormat,
                     "hits.npy: hits are written to .npz or .csv; name the file like that");
  expect_input_error([&] { write_segments("s.npz", {}); }, Defect::UnknownFormat,
                     "s.npz: segments are written to .npy or .csv; name the file like that");
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(SegmentsWriter, WritesWhatReadsBackBitForBit) {
  const TemporaryFolder folder;
  std::mt19937_64 random(test_seed());
  std::vector<Segment> segments;
  const auto coordinate = [&] {
    while (true)
      if (const auto value = std::bit_cast<double>(std::uint64_t{random()}); std::isfinite(value)) return value;
  };
  for (int i = 0; i < 1000; ++i)
    segments.push_back({{coordinate(), coordinate(), coordinate()}, {coordinate(), coordinate(), coordinate()}});
  for (const char* name : {"s.npy", "s.csv"}) {
    write_segments(folder / name, segments);
    const auto read = read_segments(read_file(folder / name), folder / name);
    ASSERT_EQ(read.size(), segments.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      EXPECT_EQ(read[i].a, segments[i].a) << name << " row " << i;
      EXPECT_EQ(read[i].b, segments[i].b) << name << " row " << i;
    }
  }
  for (const char* name : {"none.npy", "none.csv"}) {
    write_segments(folder / name, {});
    EXPECT_TRUE(read_segments(read_file(folder / name), folder / name).empty());
  }
}

TEST(Points, AreReadAndWrittenAsSegmentsAre) {
  EXPECT_EQ(read_points("x,y,z\n1,2,3\n4,5,6 # one more\n", "p.csv").size(), 2u);
  const TemporaryFolder folder;
  const std::vector<Vec3> points{{0.1, -0.0, 1e-300}, {1, 2, 3}};
  for (const char* name : {"p.npy", "p.csv"}) {
    write_points(folder / name, points);
    EXPECT_EQ(read_points(read_file(folder / name), folder / name), points) << name;
  }
  expect_input_error([] { read_points("1,2,3\n1,nan,3\n", "p.csv"); }, Defect::NonFiniteCoordinate,
                     "p.csv: line 2: y is nan; expected finite numbers");
  expect_input_error([&] { write_points(folder / "p.npz", points); }, Defect::UnknownFormat,
                     (folder / "p.npz").string() + ": points are written to .npy or .csv; name the file like that");
}

TEST(Points, HaveAnswersInRowsAndInArrays) {
  const TemporaryFolder folder;
  const std::vector<ClosestPoint> distances{{FaceId{7}, {1, 2, 3}, -0.5, -0.75, -0.25}};
  write_inside(folder / "a.csv", {true, false});
  EXPECT_EQ(read_file(folder / "a.csv"), "point,inside\n0,1\n1,0\n");
  write_distances(folder / "a.csv", distances);
  EXPECT_EQ(read_file(folder / "a.csv"), "point,distance,lower,upper,face,x,y,z\n0,-0.5,-0.75,-0.25,7,1,2,3\n");
  write_distances(folder / "a.npz", distances);
  expect_input_error(
      [&] { read_points(read_file(folder / "a.npz"), folder / "a.npz"); }, Defect::Malformed,
      (folder / "a.npz").string() + ": none of its 8 arrays is called points; save the one you mean alone");
}

}  // namespace
}  // namespace prohull

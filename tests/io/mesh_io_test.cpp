#include <bit>
#include <cmath>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>

#include "io_testing.h"
#include "prohull/detail/missing_file.h"
#include "prohull/length.h"
#include "random.h"

namespace prohull {
namespace {

/// Compares -0.0 and 0.0 as different.
void expect_same_bits(const TriangleMesh& a, const TriangleMesh& b) {
  ASSERT_EQ(a.vertex_count(), b.vertex_count());
  EXPECT_EQ(a.triangles, b.triangles);
  for (const VertexId v : a.positions.ids())
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(a.positions[v][axis]), std::bit_cast<std::uint64_t>(b.positions[v][axis]))
          << "vertex " << index(v);
}

TEST(MeshFormat, IsToldByTheNameInAnyCase) {
  EXPECT_EQ(mesh_format("dir.off/a.ply"), MeshFormat::Ply);
  EXPECT_EQ(mesh_format("a.b.OBJ"), MeshFormat::Obj);
  EXPECT_EQ(mesh_format("a.off.gz"), MeshFormat::Off);
  EXPECT_EQ(mesh_format("A.STL.GZ"), MeshFormat::Stl);
  expect_input_error([] { mesh_format("a.step"); }, Defect::UnknownFormat,
                     "a.step: unknown format; name it .ply, .obj, .off, .stl or .glb");
  expect_input_error([] { mesh_format("a.dae"); }, Defect::UnknownFormat,
                     "a.dae: prohull reads this format, but does not write it; name it .ply, .obj, .off, .stl or .glb");
  EXPECT_EQ(mesh_format("a.Glb"), MeshFormat::Glb);
  EXPECT_THROW(mesh_format("ply"), InputError);
}

TEST(MeshFormat, IsToldByTheContentIfTheNameHasNone) {
  EXPECT_EQ(read_mesh("# x\no part\nv 0 0 0\n", "part").vertex_count(), 1u);
  EXPECT_EQ(read_mesh("OFF\n0 0 0\n", "part.txt"), TriangleMesh());
  EXPECT_EQ(read_mesh("ply\nformat ascii 1.0\nend_header\n", "part"), TriangleMesh());
  EXPECT_EQ(read_mesh("solid\nendsolid\n", "part"), TriangleMesh());
  expect_refused(
      "hello", "part",
      "part: neither its name nor its content is that of a PLY, OBJ, OFF, STL, GLB or another file that is read; "
      "give it the suffix of its format",
      Defect::UnknownFormat);
  expect_refused("ISO-10303-21;\n", "a.STEP",
                 "a.STEP: it holds surfaces and no triangles; export it as STL, OBJ or PLY where it was made",
                 Defect::UnknownFormat);
  expect_refused("<robot name='arm'/>", "arm.urdf",
                 "arm.urdf: it is a robot and no mesh; `prohull urdf` makes hulls of its links", Defect::UnknownFormat);
  expect_refused("", "standard input", "standard input: it is empty", Defect::UnknownFormat);
}

TEST(MeshFormat, ThatTheContentContradictsIsAnError) {
  expect_refused("OFF\n0 0 0\n", "a.ply", "a.ply: line 1: the name says PLY, but the content is OFF; name it .off");
  expect_refused("solid\nendsolid\n", "a.obj",
                 "a.obj: line 1: the name says OBJ, but the content is STL; name it .stl");
}

TEST(ReadMesh, PointsToWhatReadsAProgressiveHull) {
  expect_refused(
      "\x89PHULL\r\n", "knot.phull",
      "knot.phull: this is a progressive hull and not a mesh; `prohull lod` makes a mesh of any of its levels, "
      "and prohull.load of Python reads it",
      Defect::UnknownFormat);
}

TEST(ReadMesh, MultipliesCoordinatesByTheScale) {
  const std::string part = "OFF\n3 1 0\n1 0 -0.3\n25.4 1e3 0\n0 0 7\n3 0 1 2\n";
  const TriangleMesh mesh = read_mesh(part, "part.off");
  for (const auto& [unit, metres] : length_units()) {
    const TriangleMesh scaled = read_mesh(part, "part.off", {.scale = metres});
    EXPECT_EQ(scaled.triangles, mesh.triangles) << unit;
    for (const VertexId v : mesh.positions.ids()) EXPECT_EQ(scaled.positions[v], metres * mesh.positions[v]) << unit;
  }
  for (const double scale : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW(read_mesh(part, "part.off", {.scale = scale}), InputError);
  expect_input_error([&] { read_mesh(part, "part.off", {.scale = 1e307}); }, Defect::InvalidOption,
                     "part.off: a scale of 1e+307 makes coordinates too large; choose a smaller one");
}

TEST(ReadMesh, SaysWhyAFileCannotBeRead) {
  expect_input_error([] { read_mesh("no_such_file.ply"); }, Defect::CannotRead,
                     "no_such_file.ply: cannot read: there is no such file; look at its name and its folder");
  EXPECT_THROW(read_mesh("no_such_file.ply"), MissingFile);
  const TemporaryFolder folder;
  expect_input_error([&] { read_mesh(folder.path()); }, Defect::CannotRead,
                     folder.path().string() + ": cannot read: it is a folder; name a file in it");
}

TEST(WriteMesh, KeepsEveryBitOfDoubles) {
  TriangleMesh mesh = tetrahedron();
  mesh.positions = {{5e-324, -0.0, 1e300},
                    {0.1, 1.0 / 3, 2.2250738585072014e-308},
                    {-1e-310, 123456789.123456789, 1},
                    {std::numeric_limits<double>::max(), std::numeric_limits<double>::min(), -5e-324}};
  const TemporaryFolder folder;
  for (const char* name : {"a.ply", "a.obj", "a.off"}) {
    write_mesh(folder / name, mesh);
    expect_same_bits(read_mesh(folder / name), mesh);
  }
  EXPECT_NE(read_file(folder / "a.ply").find("property double x"), std::string::npos);
}

TEST(WriteMesh, KeepsEveryBitOfFloats) {
  TriangleMesh mesh = tetrahedron();
  mesh.positions = {{0.1f, -0.0, 1e-45f}, {1, 3.4028234663852886e38, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles[FaceId(0)] = corners(0, 1, 2);  // STL numbers vertices as they come
  const TemporaryFolder folder;
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl", "a.glb"}) {
    write_mesh(folder / name, mesh);
    expect_same_bits(read_mesh(folder / name), mesh);
  }
  EXPECT_NE(read_file(folder / "a.ply").find("property float x"), std::string::npos);
}

TEST(WriteMesh, WritesBinaryStlWithUnitNormals) {
  const TemporaryFolder folder;
  write_mesh(folder / "a.stl", tetrahedron());
  const std::string content = read_file(folder / "a.stl");
  ASSERT_EQ(content.size(), 84u + 4 * 50);
  EXPECT_TRUE(content.starts_with("prohull"));
  EXPECT_EQ(content.substr(84, 12), bytes_of(0.f) + bytes_of(0.f) + bytes_of(-1.f));
}

TEST(WriteMesh, RefusesCoordinatesThatTheFormatCannotStore) {
  TriangleMesh mesh = tetrahedron();
  const TemporaryFolder folder;
  const std::string path = (folder / "a.stl").string();
  mesh.positions[VertexId(1)].x = 0.1;
  expect_input_error([&] { write_mesh(path, mesh); }, Defect::NonFiniteCoordinate,
                     path +
                         ": vertex 1 is (0.1, 0, 0); STL stores float32 and would change it; build with "
                         "float32_coordinates (in JavaScript float32Coordinates), or write PLY, OBJ or OFF");
  mesh.positions[VertexId(1)].x = 1e300;
  EXPECT_THROW(write_mesh(path, mesh), InputError);
  mesh.positions[VertexId(1)].x = std::numeric_limits<double>::quiet_NaN();
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl", "a.glb"})
    EXPECT_THROW(write_mesh(folder / name, mesh), InputError);
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(WriteMesh, RefusesNamesItCannotWrite) {
  expect_input_error([] { write_mesh("a.ply.gz", tetrahedron()); }, Defect::UnknownFormat,
                     "a.ply.gz: prohull reads meshes from .gz files, but does not write them; leave .gz out");
  EXPECT_THROW(write_mesh("a.zip", tetrahedron()), InputError);
}

/// Some compilers take the rounding of two neighbouring doubles for nothing; see cmake/ProhullCompileOptions.cmake.
// Tests are compiled with -O1, with which it is right anyhow.
#ifndef __clang__
[[gnu::optimize("O3")]]
#endif
void round_to_float32(PerVertex<Vec3>& positions) {
  for (Vec3& p : positions) p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

TEST(Float32, RoundsEveryCoordinate) {
  PerVertex<Vec3> positions(3, {0.1, 0.2, 0.3});
  round_to_float32(positions);
  for (const Vec3& p : positions) EXPECT_EQ(p, (Vec3{0.1f, 0.2f, 0.3f}));
}

TEST(RoundTrip, GivesTheSameMeshForRandomBits) {
  std::mt19937_64 random(test_seed());
  const TemporaryFolder folder;
  for (int run = 0; run < 50; ++run) {
    const bool floats = run % 2 == 0;
    const auto any_finite = [&] {
      double value;
      do value = floats ? std::bit_cast<float>(static_cast<std::uint32_t>(random())) : std::bit_cast<double>(random());
      while (!std::isfinite(value));
      return value;
    };
    TriangleMesh mesh;
    for (std::uint64_t count = 3 + random() % 50; count > 0; --count)
      mesh.positions.push_back({any_finite(), any_finite(), any_finite()});
    const auto any_vertex = [&] { return static_cast<std::uint32_t>(random() % mesh.vertex_count()); };
    for (std::uint64_t count = random() % 100; count > 0; --count)
      mesh.triangles.push_back(corners(any_vertex(), any_vertex(), any_vertex()));
    for (const char* name : {"a.ply", "a.obj", "a.off"}) {
      write_mesh(folder / name, mesh);
      expect_same_bits(read_mesh(folder / name), mesh);
    }
    if (!floats) continue;
    if (mesh.face_count() > 0) {
      write_mesh(folder / "a.glb", mesh);
      expect_same_bits(read_mesh(folder / "a.glb"), mesh);
    }
    write_mesh(folder / "a.stl", mesh);
    const TriangleMesh soup = read_mesh(folder / "a.stl");
    ASSERT_EQ(soup.face_count(), mesh.face_count());
    for (const FaceId f : mesh.triangles.ids()) {
      const Triangle a = mesh.triangle(f), b = soup.triangle(f);
      ASSERT_TRUE(a.a == b.a && a.b == b.b && a.c == b.c) << "triangle " << index(f);
    }
  }
}

TEST(Truncation, IsNoticedAtEveryByteOfBinaryFiles) {
  const TemporaryFolder folder;
  for (const char* name : {"a.ply", "a.stl", "a.glb"}) {
    write_mesh(folder / name, tetrahedron());
    const std::string content = read_file(folder / name);
    for (std::size_t size = 0; size < content.size(); ++size)
      EXPECT_THROW(read_mesh(std::string_view(content).substr(0, size), name), InputError) << name << " " << size;
  }
}

}  // namespace
}  // namespace prohull

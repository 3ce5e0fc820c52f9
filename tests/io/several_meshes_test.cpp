#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io_testing.h"

namespace prohull {
namespace {

TriangleMesh tetrahedron_at(double x) {
  TriangleMesh mesh = tetrahedron();
  for (Vec3& p : mesh.positions) p.x += x;
  return mesh;
}

class WriteMeshes : public testing::Test {
 protected:
  /// What a GLB says of itself.
  nlohmann::json written_glb() const {
    write_meshes(folder_ / "a.glb", meshes_, names_);
    const std::string content = read_file(folder_ / "a.glb");
    std::uint32_t size = 0;
    std::memcpy(&size, content.data() + 12, sizeof size);
    return nlohmann::json::parse(content.substr(20, size));
  }
  std::vector<std::string> written_objects() const {
    write_meshes(folder_ / "a.obj", meshes_, names_);
    std::istringstream lines(read_file(folder_ / "a.obj"));
    std::vector<std::string> objects;
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("o ")) objects.push_back(line.substr(2));
    return objects;
  }

  const std::vector<TriangleMesh> meshes_{tetrahedron_at(0), tetrahedron_at(0.5), tetrahedron_at(-8)};
  std::vector<std::string> names_{"a_01", "a_02", "a_03"};
  TriangleMesh all_ = [this] {
    TriangleMesh mesh;
    for (const TriangleMesh& part : meshes_) append(mesh, part);
    return mesh;
  }();
  TemporaryFolder folder_;
};

TEST_F(WriteMeshes, AreReadAsOneMeshAgain) {
  for (const char* name : {"a.obj", "a.glb"}) {
    write_meshes(folder_ / name, meshes_, names_);
    const TriangleMesh mesh = read_mesh(folder_ / name);
    EXPECT_EQ(mesh.positions, all_.positions);
    EXPECT_EQ(mesh.triangles, all_.triangles);
  }
}

TEST_F(WriteMeshes, GiveAnObjFileAnObjectForEach) {
  EXPECT_EQ(written_objects(), names_);
  names_ = {"with blanks", "line\nv 1 2 3\\", "ü#"};
  EXPECT_EQ(written_objects(), (std::vector<std::string>{"with_blanks", "line_v_1_2_3_", "ü_"}));
  EXPECT_EQ(read_mesh(folder_ / "a.obj").positions, all_.positions);
}

TEST_F(WriteMeshes, GiveAGlbFileANodeAMeshAndAColourForEach) {
  names_ = {"a", "\"b\"\n", "not UTF-8: \xff"};
  const nlohmann::json glb = written_glb();
  EXPECT_EQ(glb["scenes"][0]["nodes"], (nlohmann::json{0, 1, 2}));
  ASSERT_EQ(glb["nodes"].size(), 3U);
  ASSERT_EQ(glb["meshes"].size(), 3U);
  EXPECT_EQ(glb["nodes"][1]["name"], "\"b\"\n");
  EXPECT_EQ(glb["meshes"][2]["name"], "not UTF-8: \ufffd");
  EXPECT_EQ(glb["meshes"][2]["primitives"][0]["material"], 2);
  EXPECT_EQ(glb["materials"].size(), 3U);
  EXPECT_NE(glb["materials"][0], glb["materials"][1]);
  EXPECT_EQ(glb["accessors"][4]["min"], (nlohmann::json{-8, 0, 0}));
  EXPECT_EQ(read_mesh(folder_ / "a.glb").positions, all_.positions);
}

TEST_F(WriteMeshes, LetColoursTakeTurns) {
  const std::vector<TriangleMesh> many(40, tetrahedron());
  write_meshes(folder_ / "a.glb", many, std::vector<std::string>(40, "piece"));
  EXPECT_EQ(read_mesh(folder_ / "a.glb").face_count(), 160U);
}

TEST_F(WriteMeshes, LeaveMeshesWithoutTrianglesOutOfGlb) {
  const std::vector<TriangleMesh> meshes{TriangleMesh{{{5, 5, 5}}, {}}, tetrahedron()};
  write_meshes(folder_ / "a.glb", meshes, std::vector<std::string>{"none", "some"});
  EXPECT_EQ(read_mesh(folder_ / "a.glb").positions, tetrahedron().positions);
  write_meshes(folder_ / "b.glb", {}, {});
  EXPECT_EQ(read_mesh(folder_ / "b.glb").vertex_count(), 0U);
}

TEST_F(WriteMeshes, RefuseFormatsThatHoldOneMesh) {
  for (const char* name : {"a.stl", "a.ply", "a.off"}) {
    EXPECT_FALSE(holds_several_meshes(mesh_format(name)));
    EXPECT_THROW(write_meshes(folder_ / name, meshes_, names_), InputError);
  }
  expect_input_error([&] { write_meshes("a.stl", meshes_, names_); }, Defect::UnknownFormat,
                     "a.stl: STL files hold one mesh each; write a file for each mesh, or name it .obj or .glb");
  EXPECT_TRUE(holds_several_meshes(MeshFormat::Obj) && holds_several_meshes(MeshFormat::Glb));
}

TEST_F(WriteMeshes, RefuseWhatCannotBeWritten) {
  names_.pop_back();
  expect_input_error([&] { write_meshes("a.obj", meshes_, names_); }, Defect::InvalidOption,
                     "a.obj: 2 names for 3 meshes");
  const std::vector<TriangleMesh> meshes{tetrahedron(), tetrahedron_at(0.1)};
  expect_input_error([&] { write_meshes("a.glb", meshes, names_); }, Defect::NonFiniteCoordinate,
                     "a.glb: a_02: vertex 0 is (0.1, 0, 0); GLB stores float32 and would change it; build with "
                     "float32_coordinates (in JavaScript float32Coordinates), or write PLY, OBJ or OFF");
}

}  // namespace
}  // namespace prohull

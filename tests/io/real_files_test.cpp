#include <algorithm>
#include <cstdlib>

#include "io_testing.h"

namespace prohull {
namespace {

/// The folder with real meshes, from the environment or CMake's cache; empty if there is none.
std::filesystem::path test_data() {
  const char* const environment = std::getenv("PROHULL_TEST_DATA");
  return environment ? environment : PROHULL_TEST_DATA;
}

class RealFiles : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(test_data() / "models"))
      GTEST_SKIP() << "PROHULL_TEST_DATA names no folder with models";
  }
};

std::vector<std::array<VertexId, 3>> sorted_triangles(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(mesh.triangles.begin(), mesh.triangles.end());
  return {mesh.triangles.begin(), mesh.triangles.end()};
}

TEST_F(RealFiles, HaveTheFacesThatTheirNamesSay) {
  for (const auto& entry : std::filesystem::directory_iterator(test_data() / "models")) {
    const std::string name = entry.path().filename().string();
    const std::size_t digits = name.find_first_of("0123456789", name.find('_'));
    if ((!name.ends_with(".gz") && !name.ends_with(".zip")) || name.find("bunny00") != name.npos ||
        digits == name.npos || name.find("res2") != name.npos)
      continue;
    EXPECT_EQ(read_mesh(entry.path()).face_count(), std::stoul(name.substr(digits))) << name;
  }
}

TEST_F(RealFiles, StripsGiveTheSameTrianglesAsFaces) {
  const TriangleMesh strips = read_mesh(test_data() / "models/igea_original_tristrips.ply.gz");
  const TriangleMesh faces = read_mesh(test_data() / "models/igea_268686.ply.gz");
  EXPECT_EQ(strips.positions, faces.positions);
  EXPECT_EQ(sorted_triangles(strips), sorted_triangles(faces));
  // Closed and 2-manifold at its edges: each half-edge occurs once, and so does its twin.
  std::vector<std::pair<VertexId, VertexId>> edges, twins;
  for (const auto& t : strips.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      edges.emplace_back(t[i], t[(i + 1) % 3]);
      twins.emplace_back(t[(i + 1) % 3], t[i]);
    }
  std::sort(edges.begin(), edges.end());
  std::sort(twins.begin(), twins.end());
  EXPECT_EQ(edges, twins);
  EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end());
}

TEST_F(RealFiles, DirtyOnesAreReadOrRefusedWithTheirPath) {
  if (!std::filesystem::exists(test_data() / "dirty")) GTEST_SKIP() << "no dirty corpus";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test_data() / "dirty")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".ply" && extension != ".obj" && extension != ".off" && extension != ".stl" && extension != ".STL")
      continue;
    try {
      read_mesh(entry.path());
    } catch (const InputError& error) {
      EXPECT_TRUE(std::string_view(error.what()).starts_with(entry.path().string() + ": line ")) << error.what();
    }
  }
}

}  // namespace
}  // namespace prohull

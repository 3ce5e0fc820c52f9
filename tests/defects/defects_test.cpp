#include "defects/defects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/mesh_io.h"
#include "prohull/mesh_report.h"
#include "prohull/repair.h"

namespace prohull {
namespace {

using meshes::DefectiveFile;

const DefectiveFile& file_named(const std::vector<DefectiveFile>& files, std::string_view name) {
  const auto found = std::ranges::find(files, name, &DefectiveFile::name);
  if (found == files.end()) throw std::out_of_range(std::string(name));
  return *found;
}

/// Nothing if no closed mesh can be made of it.
std::optional<TriangleMesh> closed(const DefectiveFile& file) {
  try {
    return closed_mesh(read_mesh(file.content, file.name)).mesh;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

TEST(DefectiveFiles, HaveNamesOfTheirOwn) {
  std::vector<std::string> names;
  for (const DefectiveFile& file : meshes::defective_files()) names.push_back(file.name);
  std::ranges::sort(names);
  EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

TEST(DefectiveFiles, HaveTheirDefect) {
  struct Expected {
    std::string_view file;
    std::size_t MeshReport::*count;
  };
  const std::vector<DefectiveFile> files = meshes::defective_files();
  for (const auto& [name, count] :
       {Expected{"flipped_faces.off", &MeshReport::misoriented_edges}, Expected{"holes.off", &MeshReport::open_edges},
        Expected{"open_shell.off", &MeshReport::open_edges}, Expected{"t_junction.off", &MeshReport::open_edges},
        Expected{"non_manifold_vertex.off", &MeshReport::non_manifold_vertices},
        Expected{"non_manifold_edge.off", &MeshReport::non_manifold_edges},
        Expected{"duplicated_faces.off", &MeshReport::non_manifold_edges},
        Expected{"zero_area.off", &MeshReport::zero_area_faces}})
    EXPECT_GT(inspect(read_mesh(file_named(files, name).content, name)).*count, 0u) << name;
  const auto self_intersections = [&](std::string_view name) {
    return count_self_intersections(read_mesh(file_named(files, name).content, name));
  };
  EXPECT_EQ(self_intersections("sound.off"), 0u);
  EXPECT_GT(self_intersections("self_intersecting.off"), 0u);
  EXPECT_GT(self_intersections("overlapping_components.off"), 0u);
}

TEST(DefectiveFiles, AreRefusedOrEnclosed) {
  std::size_t enclosed = 0;
  for (const DefectiveFile& file : meshes::defective_files())
    if (const auto mesh = closed(file)) {
      const TriangleMesh hull = build_hull(*mesh, {.target_faces = 50, .threads = 1}).hull.base();
      EXPECT_TRUE(verify_enclosure(*mesh, hull).encloses) << file.name;
      ++enclosed;
    }
  EXPECT_GE(enclosed, 10u);
}

}  // namespace
}  // namespace prohull

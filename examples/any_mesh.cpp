// Triangles of any kind in, hulls for STL out: repaired where that is needed, certified with the numbers of the file.
#include <prohull/enclosing_hull.h>
#include <prohull/mesh_io.h>
#include <prohull/sample.h>
#include <prohull/verification.h>

#include <array>
#include <cstdio>
#include <filesystem>

int main() {
  const auto folder = std::filesystem::temp_directory_path();
  const auto input = folder / "prohull_example_part.stl", output = folder / "prohull_example_collision.stl";
  prohull::write_mesh(input, prohull::make_sample("bracket", 4000));

  // docs: any_mesh
  const std::array<std::size_t, 2> budgets{1000, 200};
  const prohull::EnclosingHulls made =
      prohull::enclosing_hulls(prohull::read_mesh(input), budgets, {.hull = {.float32_coordinates = true}});
  for (const prohull::EnclosingHull& hull : made.hulls)
    std::printf("%4zu faces, %s\n", hull.mesh.face_count(), hull.certified ? "certified" : "NOT CERTIFIED");
  prohull::write_mesh(output, made.hulls.back().mesh);
  // docs: end

  const bool encloses = prohull::verify_hull(prohull::read_mesh(output), prohull::read_mesh(input)).encloses;
  std::filesystem::remove(input);
  std::filesystem::remove(output);
  return encloses && made.hulls[0].certified && made.hulls[1].target_reached ? 0 : 1;
}

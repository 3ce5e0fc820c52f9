// The common case: a mesh in, a hull of 500 faces out, and the proof that it encloses.
#include <prohull/enclosing_hull.h>
#include <prohull/mesh_io.h>
#include <prohull/sample.h>
#include <prohull/verification.h>

#include <cstdio>
#include <filesystem>

int main() {
  const auto folder = std::filesystem::temp_directory_path();
  const auto input = folder / "prohull_example_rock.ply", output = folder / "prohull_example_hull.ply";
  prohull::write_mesh(input, prohull::make_sample("asteroid", 20000));

  // docs: build
  const prohull::EnclosingHull hull = prohull::enclosing_hull(prohull::read_mesh(input), 500);
  prohull::write_mesh(output, hull.mesh);

  const prohull::Verification found = prohull::verify_hull(prohull::read_mesh(output), prohull::read_mesh(input));
  std::printf("%zu faces, void %.2f %%, %s\n", hull.mesh.face_count(), 100 * found.void_ratio,
              found.encloses ? "encloses" : "DOES NOT ENCLOSE");
  // docs: end

  std::filesystem::remove(input);
  std::filesystem::remove(output);
  return found.encloses && hull.certified && hull.target_reached ? 0 : 1;
}

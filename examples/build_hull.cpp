// The common case: a mesh in, a hull of 500 faces out, and the proof that it encloses.
#include <prohull/enclosure.h>
#include <prohull/hull_builder.h>
#include <prohull/mesh_io.h>
#include <prohull/repair.h>
#include <prohull/sample.h>

#include <cstdio>
#include <filesystem>

int main() {
  const auto folder = std::filesystem::temp_directory_path();
  const auto input = folder / "prohull_example_rock.ply", output = folder / "prohull_example_hull.ply";
  prohull::write_mesh(input, prohull::make_sample("asteroid", 20000));

  // docs: build
  const prohull::TriangleMesh rock = prohull::closed_mesh(prohull::read_mesh(input)).mesh;
  const prohull::HullResult result = prohull::build_hull(rock, {.target_faces = 500});
  prohull::write_mesh(output, result.hull.base());

  const prohull::EnclosureReport report = prohull::verify_enclosure(rock, prohull::read_mesh(output));
  std::printf("%zu faces, void %.2f %%, %s\n", result.hull.base_face_count(), 100 * report.void_ratio,
              report.encloses ? "encloses" : "DOES NOT ENCLOSE");
  // docs: end

  std::filesystem::remove(input);
  std::filesystem::remove(output);
  return report.encloses && result.stopped == prohull::Stopped::TargetReached ? 0 : 1;
}

// One hierarchy, every level: each encloses the next finer one, and the file is a proof of it.
#include <prohull/enclosure.h>
#include <prohull/hull_builder.h>
#include <prohull/hull_file.h>
#include <prohull/sample.h>
#include <prohull/verification.h>

#include <cstdio>
#include <filesystem>

int main() {
  const auto file = std::filesystem::temp_directory_path() / "prohull_example_knot.phull";
  const prohull::TriangleMesh knot = prohull::make_sample("knot", 10000);

  // docs: levels
  prohull::save_hull(file, prohull::build_hull(knot, {.target_faces = 400}).hull);

  const prohull::ProgressiveHull hull = prohull::load_hull(file);
  for (const std::size_t faces : {400, 1000, 4000})
    std::printf("%5zu faces: volume %.4f\n", faces, prohull::signed_volume(hull.level(faces)));
  const bool proven = prohull::verify_hull(hull, knot).encloses;
  // docs: end

  std::filesystem::remove(file);
  const bool nested = prohull::verify_enclosure(hull.level(4000), hull.level(400)).encloses;
  return proven && nested && hull.original() == knot ? 0 : 1;
}

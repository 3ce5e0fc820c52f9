#include <prohull/enclosure.h>
#include <prohull/hull_builder.h>
#include <prohull/sample.h>

int main() {
  const prohull::TriangleMesh torus = prohull::make_sample("torus", 2000);
  const prohull::HullResult result = prohull::build_hull(torus, {.target_faces = 200});
  return prohull::verify_enclosure(torus, result.hull.base()).encloses ? 0 : 1;
}

// Whatever bytes a file has, read_mesh returns a mesh that can be used, or throws InputError. The first byte chooses
// the name of the file, the rest is its content.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "prohull/error.h"
#include "prohull/mesh_io.h"

namespace {

using prohull::TriangleMesh;

constexpr std::array<const char*, 8> kNames = {"fuzz.ply", "fuzz.obj", "fuzz.off",  "fuzz.stl",
                                               "fuzz.zip", "fuzz",     "fuzz.gltf", "fuzz.glb"};

bool is_usable(const TriangleMesh& mesh) {
  for (const auto& p : mesh.positions)
    if (!is_finite(p)) return false;
  for (const auto& t : mesh.triangles)
    for (const auto v : t)
      if (index(v) >= mesh.vertex_count()) return false;
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view content(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    if (!is_usable(prohull::read_mesh(content, kNames[data[0] % kNames.size()]))) std::abort();
  } catch (const prohull::InputError&) {
  }
  return 0;
}

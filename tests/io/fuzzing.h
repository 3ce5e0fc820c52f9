#pragma once

#include <cstdlib>
#include <string_view>

#include "prohull/error.h"
#include "prohull/mesh_io.h"

namespace prohull {

/// The law of all readers of meshes: whatever bytes a file has, read_mesh returns a mesh that can be used, or throws
/// InputError. Aborts where that is broken.
inline void read_or_refuse(std::string_view content, const char* name) {
  try {
    const TriangleMesh mesh = read_mesh(content, name);
    for (const auto& p : mesh.positions)
      if (!is_finite(p)) std::abort();
    for (const auto& t : mesh.triangles)
      for (const auto v : t)
        if (index(v) >= mesh.vertex_count()) std::abort();
  } catch (const InputError&) {
  }
}

}  // namespace prohull

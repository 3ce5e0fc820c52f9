#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// Reads a COLLADA file with the bits that prohull-import, which runs assimp 5.2, gives it: in metres, and with
/// `up_axis` ignored. Throws InputError; also where the mesh would take more than `most` bytes.
TriangleMesh collada_mesh(std::string_view content, const std::string& file, std::size_t most);

}  // namespace prohull

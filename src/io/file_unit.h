#pragma once

#include <filesystem>
#include <string_view>

#include "prohull/mesh_io.h"

namespace prohull {

/// The unit of a mesh file by its content, which is not compressed. 3MF and AMF files that say none are in millimetres,
/// as their standards have it.
FileUnit unit_of_file(std::string_view content, const std::filesystem::path& name);

}  // namespace prohull

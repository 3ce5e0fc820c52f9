#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// ".3ds", ".3mf" and so on.
std::span<const std::string_view> imported_extensions();

/// Whether imported_mesh reads files of that name: .dae, .3mf, .fbx and others, also with .gz behind.
bool is_imported(const std::filesystem::path& name);

/// What prohull-import may use for one file.
struct ImportLimits {
  std::chrono::seconds time;   ///< by the clock; of the processor half of it
  std::size_t memory, output;  ///< bytes
  bool alone = false;          ///< no other files
};
ImportLimits import_limits(std::size_t file_size);

/// Reads the file with prohull-import. Throws InputError, whatever becomes of that program; Cancelled.
TriangleMesh mesh_by_assimp(std::string_view content, const std::string& file, const ImportLimits& limits,
                            const Progress& progress);

/// The same, but for COLLADA, which read_collada reads if it can.
TriangleMesh imported_mesh(std::string_view content, const std::string& file, const ImportLimits& limits,
                           const Progress& progress);

}  // namespace prohull

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>

namespace prohull {

/// How many bytes of memory this process can still get: what the system says is available, or less where a control
/// group allows less, as in a container. Nothing where the system does not say it.
std::optional<std::size_t> available_memory();

/// Throws InputError(InvalidOption) if there is less memory than what is asked for, "1,000 faces", needs.
void require_available(std::size_t count, std::string_view what, double bytes_each);

/// What reading a mesh file, and working with the mesh, takes at least.
struct MemoryNeed {
  std::size_t faces = 0;  ///< as the beginning of the file claims, where its format does; otherwise estimated
  std::size_t file = 0;   ///< bytes of the file, which are in memory while it is read
  std::size_t mesh = 0;   ///< bytes of the mesh
  std::size_t work = 0;   ///< bytes of what is made of it

  /// The file is gone when the work begins.
  std::size_t sum() const { return mesh + (file > work ? file : work); }
};

/// Reads no more than the beginning of the file. `work_per_face` is in bytes. A compressed file counts as it is.
MemoryNeed memory_need(const std::filesystem::path& mesh_file, double work_per_face = 0);

/// Throws InputError(CannotRead) if a mesh file needs more memory than there is; the message has the sum. Files that do
/// not exist, pipes and the like are left to whoever reads them.
void require_memory(const std::filesystem::path& mesh_file, double work_per_face = 0);

}  // namespace prohull

// What is left out of src/io in the browser: files, compressed contents and the program that runs assimp. What of it
// readers of meshes ask for stands here.
#include <fmt/format.h>

#include "io/file.h"
#include "io/file_content.h"
#include "io/file_unit.h"
#include "io/imported_mesh.h"
#include "io/mesh_readers.h"
#include "prohull/detail/extension.h"
#include "prohull/detail/memory.h"
#include "prohull/error.h"

namespace prohull {
namespace {

[[noreturn]] void refuse_file(const std::string& name) {
  throw InputError(Defect::CannotRead, fmt::format("{}: no file can be opened here, only what is in memory", name));
}

}  // namespace

std::optional<std::size_t> available_memory() { return {}; }

std::string read_file(const std::filesystem::path& path) { refuse_file(path.string()); }

void write_file(const std::filesystem::path& path, std::string_view) { refuse_file(path.string()); }

std::size_t decompression_limit(std::size_t compressed) { return (std::size_t{64} << 20) + 200 * compressed; }

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1F\x8B"); }

bool is_zip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04") || bytes.starts_with("PK\x05\x06"); }

std::optional<FileContent> decompressed(std::string_view bytes, const std::filesystem::path& name) {
  if (is_zip(bytes))
    throw InputError(Defect::UnknownFormat,
                     fmt::format("{}: a zip archive, which is not read here; take the file out of it", name.string()));
  return {};
}

FileUnit unit_of_file(std::string_view content, const std::filesystem::path& name) {
  if (is_collada(name)) return {1, true};
  return lower_case_extension(without_gz(name)) == ".gltf" || is_glb(content) ? FileUnit{1, false} : FileUnit{};
}

ImportLimits import_limits(std::size_t) { return {}; }

TriangleMesh imported_mesh(std::string_view content, const std::string& file, const ImportLimits&, const Progress&) {
  if (is_collada(file)) return read_collada(content, file, decompression_limit(content.size()));
  throw InputError(Defect::UnknownFormat,
                   fmt::format("{}: only the program prohull reads this format; convert it to PLY, OBJ, STL or GLB, "
                               "with Blender or MeshLab for example",
                               file));
}

}  // namespace prohull

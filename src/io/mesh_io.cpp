#include "prohull/mesh_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "io/extension.h"
#include "io/file_content.h"
#include "io/mesh_readers.h"
#include "io/mesh_writers.h"
#include "io/place.h"
#include "io/text_scanner.h"
#include "prohull/error.h"
#include "prohull/file.h"

namespace prohull {
namespace {

struct FormatTraits {
  MeshFormat format;
  std::string_view extension, name;
  TriangleMesh (*read)(std::string_view content, const std::string& file);
  std::string (*content)(const TriangleMesh& mesh);
};

constexpr std::array<FormatTraits, 4> kFormats = {{
    {MeshFormat::Ply, ".ply", "PLY", read_ply, ply_content},
    {MeshFormat::Obj, ".obj", "OBJ", read_obj, obj_content},
    {MeshFormat::Off, ".off", "OFF", read_off, off_content},
    {MeshFormat::Stl, ".stl", "STL", read_stl, stl_content},
}};

const FormatTraits& traits(MeshFormat format) {
  return *std::find_if(kFormats.begin(), kFormats.end(), [&](const FormatTraits& t) { return t.format == format; });
}

std::string_view first_word(std::string_view content) {
  TextScanner scanner(content, "", {.comments = true});
  scanner.next_line();
  return scanner.word();
}

/// The format that only its own files start like.
std::optional<MeshFormat> format_of_magic(std::string_view content) {
  if (is_binary_stl(content) || is_ascii_stl(content)) return MeshFormat::Stl;
  if (first_word(content) == "ply") return MeshFormat::Ply;
  if (is_off_keyword(first_word(content))) return MeshFormat::Off;
  return {};
}

MeshFormat format_of(std::string_view content, const std::filesystem::path& name) {
  const auto named = format_of_extension(name), found = format_of_magic(content);
  if (named && found && named != found)
    fail(name.string(), {Place::Unit::Line, 1},
         fmt::format("the name says {}, but the content is {}; name it {}", traits(*named).name, traits(*found).name,
                     traits(*found).extension));
  if (named) return *named;
  if (found) return *found;
  if (is_obj_keyword(first_word(content))) return MeshFormat::Obj;
  throw InputError(
      Defect::UnknownFormat,
      fmt::format("{}: neither its name nor its content is that of a PLY, OBJ, OFF or STL file", name.string()));
}

void check_coordinates(const TriangleMesh& mesh, MeshFormat format, const std::filesystem::path& path) {
  for (const VertexId v : mesh.positions.ids()) {
    const Vec3& p = mesh.positions[v];
    const auto refuse = [&](std::string_view why) {
      throw InputError(Defect::NonFiniteCoordinate,
                       fmt::format("{}: vertex {} is ({}, {}, {}); {}", path.string(), index(v), p.x, p.y, p.z, why));
    };
    if (!is_finite(p)) refuse("coordinates must be finite");
    if (stores_float32(format) && !(is_float32(p.x) && is_float32(p.y) && is_float32(p.z)))
      refuse("STL stores float32 and would change it; round the mesh to float32 first, or write PLY, OBJ or OFF");
  }
}

}  // namespace

std::optional<MeshFormat> format_of_extension(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".gz") return format_of_extension(path.stem());
  const auto found =
      std::find_if(kFormats.begin(), kFormats.end(), [&](const FormatTraits& t) { return t.extension == extension; });
  return found == kFormats.end() ? std::nullopt : std::optional(found->format);
}

MeshFormat mesh_format(const std::filesystem::path& path) {
  if (const auto format = format_of_extension(path)) return *format;
  throw InputError(Defect::UnknownFormat,
                   fmt::format("{}: unknown format; name it .ply, .obj, .off or .stl", path.string()));
}

bool stores_float32(MeshFormat format) { return format == MeshFormat::Stl; }

TriangleMesh read_mesh(std::string_view content, const std::filesystem::path& name) {
  if (const auto inside = decompressed(content, name))
    return traits(format_of(inside->bytes, inside->name)).read(inside->bytes, inside->name.string());
  return traits(format_of(content, name)).read(content, name.string());
}

TriangleMesh read_mesh(const std::filesystem::path& path) { return read_mesh(read_file(path), path); }

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
  const MeshFormat format = mesh_format(path);
  if (lower_case_extension(path) == ".gz")
    throw InputError(Defect::UnknownFormat,
                     fmt::format("{}: meshes are read from .gz, but not written; leave it out", path.string()));
  check_coordinates(mesh, format, path);
  write_file(path, traits(format).content(mesh));
}

}  // namespace prohull

#include "prohull/mesh_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "io/file.h"
#include "io/file_content.h"
#include "io/file_unit.h"
#include "io/imported_mesh.h"
#include "io/mesh_readers.h"
#include "io/mesh_writers.h"
#include "io/place.h"
#include "io/text_scanner.h"
#include "prohull/detail/extension.h"
#include "prohull/detail/memory.h"
#include "prohull/detail/refuse.h"
#include "prohull/error.h"
#include "prohull/hull_file.h"

namespace prohull {
namespace {

/// What is read here; those with a writer are written too.
struct FormatTraits {
  std::string_view extension, name;
  TriangleMesh (*read)(std::string_view content, const std::string& file, const ReadOptions& options);
  std::optional<MeshFormat> format;
  std::string (*content)(const TriangleMesh& mesh);
  std::string (*content_of_several)(std::span<const TriangleMesh> meshes, std::span<const std::string> names);
};

constexpr std::array<FormatTraits, 7> kFormats = {{
    {".ply", "PLY", read_ply, MeshFormat::Ply, ply_content, nullptr},
    {".obj", "OBJ", read_obj, MeshFormat::Obj, obj_content, obj_content},
    {".off", "OFF", read_off, MeshFormat::Off, off_content, nullptr},
    {".stl", "STL", read_stl, MeshFormat::Stl, stl_content, nullptr},
    {".glb", "GLB", read_gltf, MeshFormat::Glb, glb_content, glb_content},
    {".gltf", "glTF", read_gltf, {}, nullptr, nullptr},
    {".msh", "MSH", read_msh, {}, nullptr, nullptr},
}};

const FormatTraits& traits(MeshFormat format) {
  return *std::find_if(kFormats.begin(), kFormats.end(), [&](const FormatTraits& t) { return t.format == format; });
}

const FormatTraits* named_format(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(without_gz(path));
  const auto found =
      std::find_if(kFormats.begin(), kFormats.end(), [&](const FormatTraits& t) { return t.extension == extension; });
  return found == kFormats.end() ? nullptr : found;
}

std::string_view first_word(std::string_view content) {
  TextScanner scanner(content, "", {.comments = true});
  scanner.next_line();
  return scanner.word();
}

/// The format that only its own files start like.
const FormatTraits* format_of_magic(std::string_view content) {
  if (is_binary_stl(content) || is_ascii_stl(content)) return &traits(MeshFormat::Stl);
  if (is_glb(content)) return &traits(MeshFormat::Glb);
  if (first_word(content) == "ply") return &traits(MeshFormat::Ply);
  if (is_off_keyword(first_word(content))) return &traits(MeshFormat::Off);
  return nullptr;
}

/// Only a binary file has a byte of zeros in its header.
bool is_text(std::string_view content) { return content.substr(0, 1024).find('\0') == content.npos; }

/// Of files that hold no mesh, by their names: what to do with them; else empty.
std::string_view advice_for(const std::filesystem::path& name) {
  const std::string extension = lower_case_extension(name);
  const auto is_one_of = [&](auto... known) { return ((extension == known) || ...); };
  if (is_one_of(".step", ".stp", ".iges", ".igs"))
    return "it holds surfaces and no triangles; export it as STL, OBJ or PLY where it was made";
  if (is_one_of(".urdf", ".xacro", ".sdf")) return "it is a robot and no mesh; `prohull urdf` makes hulls of its links";
  return "";
}

const FormatTraits& format_of(std::string_view content, const std::filesystem::path& name) {
  const FormatTraits* const named = named_format(name);
  const FormatTraits* found = format_of_magic(content);
  if (named == &traits(MeshFormat::Stl) && !found && is_text(content) && is_obj_keyword(first_word(content)))
    found = &traits(MeshFormat::Obj);
  if (named && found && named->read != found->read)
    fail(
        name.string(), {Place::Unit::Line, 1},
        fmt::format("the name says {}, but the content is {}; name it {}", named->name, found->name, found->extension));
  if (named) return *named;
  if (found) return *found;
  if (is_obj_keyword(first_word(content))) return traits(MeshFormat::Obj);
  if (is_hull_content(content))
    throw InputError(
        Defect::UnknownFormat,
        fmt::format("{}: this is a progressive hull and not a mesh; `prohull lod` makes a mesh of any of its "
                    "levels, and prohull.load of Python reads it",
                    name.string()));
  if (const auto advice = advice_for(name); !advice.empty())
    throw InputError(Defect::UnknownFormat, fmt::format("{}: {}", name.string(), advice));
  if (content.empty()) throw InputError(Defect::UnknownFormat, fmt::format("{}: it is empty", name.string()));
  throw InputError(Defect::UnknownFormat,
                   fmt::format("{}: neither its name nor its content is that of a PLY, OBJ, OFF, STL, GLB or another "
                               "file that is read; give it the suffix of its format",
                               name.string()));
}

/// How much of a file is text: of a binary PLY its header, and the CR behind it.
std::size_t text_size(std::string_view content) {
  if (is_binary_stl(content)) return 0;
  constexpr std::string_view kEnd = "\rend_header\r";
  const std::size_t end = content.starts_with("ply\r") ? content.find(kEnd) : content.npos;
  const bool is_binary_ply = end != content.npos && content.substr(0, end).find("\rformat binary") != content.npos;
  return is_binary_ply ? end + kEnd.size() : content.size();
}

/// Texts of old systems end their lines with CR alone; others are left as they are.
std::optional<std::string> with_line_feeds(std::string_view content) {
  const std::string_view text = content.substr(0, text_size(content));
  if (text.find('\n') != text.npos || text.find('\r') == text.npos || text.find('\0') != text.npos) return {};
  std::string lines(content);
  std::replace(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(text.size()), '\r', '\n');
  return lines;
}

TriangleMesh read_plain(std::string_view content, const std::filesystem::path& name, const ReadOptions& options) {
  if (options.unit) *options.unit = unit_of_file(content, name);
  if (is_imported(name)) {
    ImportLimits limits = import_limits(content.size());
    limits.alone = options.alone;
    return imported_mesh(content, name.string(), limits, options.progress);
  }
  const std::optional<std::string> text = with_line_feeds(content);
  const std::string_view lines = text ? *text : content;
  return format_of(lines, name).read(lines, name.string(), options);
}

TriangleMesh read_unscaled(std::string_view content, const std::filesystem::path& name, const ReadOptions& options) {
  const bool is_zip_by_itself = is_zip(content) && is_imported(name);  // as 3MF is
  if (!is_zip_by_itself)
    if (const auto inside = decompressed(content, name)) return read_plain(inside->bytes, inside->name, options);
  return read_plain(content, name, options);
}

void scale(TriangleMesh& mesh, double factor, const std::filesystem::path& name) {
  for (Vec3& p : mesh.positions) {
    const bool was_finite = is_finite(p);
    p = factor * p;
    if (was_finite && !is_finite(p))
      refuse(fmt::format("{}: a scale of {} makes coordinates too large; choose a smaller one", name.string(), factor));
  }
}

/// `name` is that of the mesh, for messages.
void check_coordinates(const TriangleMesh& mesh, MeshFormat format, const std::string& name) {
  for (const VertexId v : mesh.positions.ids()) {
    const Vec3& p = mesh.positions[v];
    const auto refuse = [&](std::string_view why) {
      throw InputError(Defect::NonFiniteCoordinate,
                       fmt::format("{}: vertex {} is ({}, {}, {}); {}", name, index(v), p.x, p.y, p.z, why));
    };
    if (!is_finite(p)) refuse("coordinates must be finite");
    if (stores_float32(format) && !float32_stores(p))
      refuse(
          fmt::format("{} stores float32 and would change it; build with float32_coordinates (in JavaScript "
                      "float32Coordinates), or write PLY, OBJ or OFF",
                      traits(format).name));
  }
}

MeshFormat format_to_write(const std::filesystem::path& path) {
  const MeshFormat format = mesh_format(path);
  if (lower_case_extension(path) == ".gz")
    throw InputError(
        Defect::UnknownFormat,
        fmt::format("{}: prohull reads meshes from .gz files, but does not write them; leave .gz out", path.string()));
  return format;
}

void check_glb_size(std::span<const TriangleMesh> meshes, std::span<const std::string> names,
                    const std::filesystem::path& path) {
  if (glb_size(meshes, names) > std::numeric_limits<std::uint32_t>::max())
    throw InputError(Defect::CannotWrite, fmt::format("{}: a GLB holds at most 4 GiB; write PLY", path.string()));
}

}  // namespace

bool is_mesh_name(const std::filesystem::path& path) { return named_format(path) || is_imported(path); }

std::vector<std::string> written_mesh_extensions() {
  std::vector<std::string> extensions;
  for (const FormatTraits& format : kFormats)
    if (format.content) extensions.emplace_back(format.extension);
  return extensions;
}

std::vector<std::string> read_mesh_extensions() {
  std::vector<std::string> extensions;
  for (const FormatTraits& format : kFormats) extensions.emplace_back(format.extension);
  extensions.insert(extensions.end(), imported_extensions().begin(), imported_extensions().end());
  return extensions;
}

MeshFormat mesh_format(const std::filesystem::path& path) {
  if (const auto* const named = named_format(path); named && named->format) return *named->format;
  throw InputError(
      Defect::UnknownFormat,
      fmt::format("{}: {}; name it .ply, .obj, .off, .stl or .glb", path.string(),
                  is_mesh_name(path) ? "prohull reads this format, but does not write it" : "unknown format"));
}

bool stores_float32(MeshFormat format) { return format == MeshFormat::Stl || format == MeshFormat::Glb; }

TriangleMesh read_mesh(std::string_view content, const std::filesystem::path& name, const ReadOptions& options) {
  if (!(options.scale > 0 && std::isfinite(options.scale)))
    refuse(fmt::format("the scale is {}, but must be greater than 0", options.scale));
  TriangleMesh mesh = read_unscaled(content, name, options);
  if (options.scale != 1) scale(mesh, options.scale, name);
  return mesh;
}

TriangleMesh read_mesh(const std::filesystem::path& path, const ReadOptions& options) {
  require_memory(path);
  return read_mesh(read_file(path), path, options);
}

std::string mesh_content(const std::filesystem::path& name, const TriangleMesh& mesh) {
  const MeshFormat format = format_to_write(name);
  check_coordinates(mesh, format, name.string());
  if (format == MeshFormat::Glb) check_glb_size({&mesh, 1}, {}, name);
  return traits(format).content(mesh);
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
  write_file(path, mesh_content(path, mesh));
}

bool holds_several_meshes(MeshFormat format) { return traits(format).content_of_several; }

std::string meshes_content(const std::filesystem::path& path, std::span<const TriangleMesh> meshes,
                           std::span<const std::string> names) {
  const MeshFormat format = format_to_write(path);
  if (!holds_several_meshes(format))
    throw InputError(Defect::UnknownFormat,
                     fmt::format("{}: {} files hold one mesh each; write a file for each mesh, or name it .obj or .glb",
                                 path.string(), traits(format).name));
  if (names.size() != meshes.size())
    refuse(fmt::format("{}: {} names for {} meshes", path.string(), names.size(), meshes.size()));
  for (std::size_t i = 0; i < meshes.size(); ++i)
    check_coordinates(meshes[i], format, fmt::format("{}: {}", path.string(), names[i]));
  if (format == MeshFormat::Glb) check_glb_size(meshes, names, path);
  return traits(format).content_of_several(meshes, names);
}

void write_meshes(const std::filesystem::path& path, std::span<const TriangleMesh> meshes,
                  std::span<const std::string> names) {
  write_file(path, meshes_content(path, meshes, names));
}

}  // namespace prohull

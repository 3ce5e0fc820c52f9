#include "prohull/detail/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

#include "io/mesh_readers.h"
#include "io/ply_header.h"
#include "prohull/detail/extension.h"
#include "prohull/detail/refuse.h"
#include "prohull/detail/text.h"
#include "prohull/error.h"

namespace prohull {
namespace {

std::string beginning_of(const std::filesystem::path& file) {
  constexpr std::size_t kMost = 1 << 16;
  std::string bytes(kMost, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

struct Counts {
  std::size_t vertices = 0, faces = 0;
};

/// Claims are believed as far as the file has room for them.
Counts counts_of_ply(const std::string& beginning, std::size_t size) {
  Counts counts;
  const PlyHeader header = read_ply_header(beginning, "");
  for (const PlyElement& element : header.elements) {
    const std::size_t record =
        header.encoding == PlyEncoding::Ascii ? 2 * element.properties.size() : element.min_record_size();
    const std::size_t count = std::min(element.count, size / std::max(record, std::size_t{1}));
    if (element.name == "vertex") counts.vertices = count;
    if (element.name == "face") counts.faces = count;
  }
  return counts;
}

Counts counts_of(const std::filesystem::path& file, std::size_t size) {
  constexpr std::size_t kStlHeader = 84, kStlTriangle = 50, kAsciiStlTriangle = 300, kTextTriangle = 120,
                        kMshTriangle = 18;
  const std::string extension = lower_case_extension(file);
  const std::string beginning = beginning_of(file);
  const auto closed = [](std::size_t faces) { return Counts{faces / 2, faces}; };
  if (extension == ".obj" || extension == ".off") return closed(size / kTextTriangle);
  if (extension == ".msh") return closed(size / kMshTriangle);
  if (extension == ".stl" && size > kStlHeader)
    return closed(is_ascii_stl(beginning) ? size / kAsciiStlTriangle : (size - kStlHeader) / kStlTriangle);
  try {
    if (extension == ".ply") return counts_of_ply(beginning, size);
  } catch (const InputError&) {  // whoever reads it says what is wrong
  }
  return {};
}

std::string in_units(std::size_t bytes) {
  constexpr double kMegabyte = 1e6, kGigabyte = 1e9;
  const double all = static_cast<double>(bytes);
  return all < kGigabyte ? fmt::format("{:.0f} MB", all / kMegabyte) : fmt::format("{:.1f} GB", all / kGigabyte);
}

}  // namespace

void require_available(std::size_t count, std::string_view what, double bytes_each) {
  const auto available = available_memory();
  const double need = bytes_each * static_cast<double>(count);
  if (!available || need <= static_cast<double>(*available)) return;
  refuse(fmt::format("{} {} need about {} of memory, but {} are available; ask for fewer", grouped(count), what,
                     in_units(static_cast<std::size_t>(need)), in_units(*available)));
}

MemoryNeed memory_need(const std::filesystem::path& mesh_file, double work_per_face) {
  MemoryNeed need;
  need.file = std::filesystem::file_size(mesh_file);
  const Counts counts = counts_of(mesh_file, need.file);
  need.faces = counts.faces;
  need.mesh = counts.vertices * sizeof(Vec3) + counts.faces * sizeof(std::array<VertexId, 3>);
  need.work = static_cast<std::size_t>(work_per_face * static_cast<double>(counts.faces));
  return need;
}

void require_memory(const std::filesystem::path& mesh_file, double work_per_face) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(mesh_file, ignored)) return;
  const MemoryNeed need = memory_need(mesh_file, work_per_face);
  const auto available = available_memory();
  if (!available || need.sum() <= *available) return;
  const std::string faces = need.faces > 0 ? fmt::format(" of {} faces", grouped(need.faces)) : "";
  const std::string work = need.work > 0 ? fmt::format(", then {} for the work", in_units(need.work)) : "";
  throw InputError(Defect::CannotRead,
                   fmt::format("{}: a mesh{} needs {} of memory ({} for the file, {} for the mesh{}), but {} are "
                               "available; end other programs, use a computer with more memory, or divide the mesh",
                               mesh_file.string(), faces, in_units(need.sum()), in_units(need.file),
                               in_units(need.mesh), work, in_units(*available)));
}

}  // namespace prohull

#include "prohull/detail/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <string>

#include "io/available_memory.h"
#include "io/extension.h"
#include "io/mesh_readers.h"
#include "io/ply_header.h"
#include "prohull/detail/text.h"
#include "prohull/error.h"
#include "prohull/triangle_mesh.h"

namespace prohull {
namespace {

constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

/// The number that follows a word in a file, such as "MemAvailable:".
std::optional<std::size_t> number_after(const std::filesystem::path& file, const std::string& word) {
  std::ifstream in(file);
  for (std::string found; in >> found;)
    if (found == word) {
      std::size_t number = 0;
      return in >> number ? std::optional(number) : std::nullopt;
    }
  return {};
}

std::optional<std::size_t> number_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::size_t number = 0;
  return in >> number ? std::optional(number) : std::nullopt;  // "max" is no number
}

/// What a control group has left; what it only keeps of files would be given up.
std::size_t left_in(const std::filesystem::path& group, const char* limit, const char* usage, const char* of_files) {
  const auto most = number_in(group / limit), used = number_in(group / usage);
  if (!most || !used) return kUnlimited;
  const std::size_t held = *used - std::min(*used, number_after(group / "memory.stat", of_files).value_or(0));
  return *most - std::min(*most, held);
}

/// A group may use no more than the groups that it is in.
std::size_t left_in_groups(const std::filesystem::path& mount, const std::filesystem::path& group, const char* limit,
                           const char* usage, const char* of_files) {
  std::size_t least = kUnlimited;
  for (std::filesystem::path at = group.relative_path();; at = at.parent_path()) {
    least = std::min(least, left_in(mount / at, limit, usage, of_files));
    if (at.empty()) return least;
  }
}

std::size_t left_in_groups(const std::filesystem::path& root) {
  const std::filesystem::path mount = root / "sys/fs/cgroup";
  std::size_t least = kUnlimited;
  std::ifstream groups(root / "proc/self/cgroup");  // "0::/a/b" of version 2, "4:memory:/a/b" of version 1
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controller = line.substr(first + 1, second - first - 1), group = line.substr(second + 1);
    if (controller.empty())
      least = std::min(least, left_in_groups(mount, group, "memory.max", "memory.current", "inactive_file"));
    else if (controller == "memory")
      least = std::min(least, left_in_groups(mount / "memory", group, "memory.limit_in_bytes", "memory.usage_in_bytes",
                                             "total_inactive_file"));
  }
  return least;
}

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

std::optional<std::size_t> available_memory(const std::filesystem::path& root) {
  const auto kibibytes = number_after(root / "proc/meminfo", "MemAvailable:");
  const std::size_t left = left_in_groups(root);
  if (!kibibytes) return left == kUnlimited ? std::nullopt : std::optional(left);
  return std::min(left, 1024 * *kibibytes);
}

std::optional<std::size_t> available_memory() {
#ifdef __EMSCRIPTEN__  // no file can be opened there
  return std::nullopt;
#else
  return available_memory("/");
#endif
}

void require_available(std::size_t count, std::string_view what, double bytes_each) {
  const auto available = available_memory();
  const double need = bytes_each * static_cast<double>(count);
  if (!available || need <= static_cast<double>(*available)) return;
  throw InputError(Defect::InvalidOption,
                   fmt::format("{} {} need about {} of memory, but {} are available; ask for fewer", grouped(count),
                               what, in_units(static_cast<std::size_t>(need)), in_units(*available)));
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

#include "io/imported_mesh.h"

#include <fmt/format.h>

#include <bit>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <system_error>
#include <vector>

#include "io/byte_cursor.h"
#include "io/file_content.h"
#include "io/import_protocol.h"
#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/utf8.h"
#include "prohull/detail/extension.h"
#include "prohull/detail/run_program.h"

namespace prohull {
namespace {

constexpr std::string_view kProgram = "prohull-import";
constexpr const char* kProgramVariable = "PROHULL_IMPORTER";
constexpr std::string_view kConvert = "convert it to PLY, OBJ, STL or GLB, with Blender or MeshLab for example";

std::filesystem::path folder_of_this_program() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

/// Where prohull-import is: the one that the environment names, or the first of those beside the running program, in
/// the libexec folder of its installation, of that of the library, and, within another project, of its build.
std::optional<std::filesystem::path> importer() {
  if (const char* const named = std::getenv(kProgramVariable); named && *named) return named;
  const std::filesystem::path here = folder_of_this_program();
  const std::filesystem::path libexec = std::filesystem::path(PROHULL_LIBEXEC_FOLDER);
  std::vector<std::filesystem::path> folders{here, here.parent_path() / libexec.filename(), libexec};
#ifdef PROHULL_BUILD_FOLDER
  folders.emplace_back(PROHULL_BUILD_FOLDER);
#endif
  for (const std::filesystem::path& folder : folders) {
    std::error_code error;
    if (std::filesystem::is_regular_file(folder / kProgram, error)) return folder / kProgram;
  }
  return {};
}

/// "arm.dae" -> "DAE"
std::string upper_case_format(const std::filesystem::path& file) {
  std::string name = lower_case_extension(without_gz(file)).substr(1);
  for (char& c : name)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return name;
}

[[noreturn]] void refuse(const std::string& file, std::string_view what, Defect defect = Defect::Malformed) {
  throw InputError(defect, fmt::format("{}: {}; {}", file, what, kConvert));
}

[[noreturn]] void refuse_without_importer(const std::string& file) {
  throw InputError(
      Defect::UnknownFormat,
      fmt::format("{}: {} is read by {}, which is not installed: build prohull where libassimp-dev is, or name the "
                  "program in {}; or {}",
                  file, upper_case_format(file), kProgram, kProgramVariable, kConvert));
}

/// ": why", if there is a reason.
std::string reason_in(std::string_view output) {
  constexpr std::size_t kLongest = 200;
  return output.empty() ? "" : fmt::format(": {}", printable(output, kLongest));
}

std::string name_of_signal(int number) {
  const char* const description = strsignal(number);
  return fmt::format("signal {}, {}", number, description ? description : "unknown");
}

std::string mebibytes(std::size_t bytes) { return fmt::format("{} MiB", bytes >> 20); }

/// Throws unless the program wrote a mesh and ended well.
void check(const ProgramResult& result, const std::string& file, const std::filesystem::path& program,
           const ImportLimits& limits) {
  using End = ProgramResult::End;
  const auto out_of_time = [&] {
    refuse(file, fmt::format("reading it takes more than {} s, the limit for its size", limits.time.count()),
           Defect::CannotRead);
  };
  const auto out_of_memory = [&] {
    refuse(file, fmt::format("reading it takes more than {}, the limit for its size", mebibytes(limits.memory)),
           Defect::CannotRead);
  };
  switch (result.end) {
    case End::NotStarted:
      throw InputError(Defect::CannotRead,
                       fmt::format("{}: cannot run {}: {}; correct {} or install {} anew", file, program.string(),
                                   std::generic_category().message(result.number), kProgramVariable, kProgram));
    case End::TimedOut:
      out_of_time();
      break;
    case End::TooMuchOutput:
      refuse(file, fmt::format("it holds more than {}, the limit for its size", mebibytes(limits.output)),
             Defect::CannotRead);
    case End::Signalled:
      if (result.number == SIGXCPU) out_of_time();
      refuse(file, fmt::format("assimp crashed on it ({})", name_of_signal(result.number)));
    case End::Exited:
      if (result.number == 0) return;
      if (result.number == kImportRefused) refuse(file, fmt::format("assimp refuses it{}", reason_in(result.output)));
      if (result.number == kImportOutOfMemory) out_of_memory();
      refuse(file, fmt::format("{} failed on it with exit code {}", program.string(), result.number));
    case End::Unknown:
      return;  // what it wrote tells whether it came to its end
  }
}

/// Takes what the program wrote for as hostile as any file.
class ImportReader {
 public:
  ImportReader(std::string_view output, const std::string& file)
      : file_(file), cursor_(output, 0, std::endian::native), builder_(file, 0, output, {}) {}

  TriangleMesh read() {
    expect(kImportMagic);
    const std::uint64_t vertices = count(3 * sizeof(double)), polygons = count(4 * sizeof(std::uint32_t));
    require(vertices, 3 * sizeof(double));
    builder_.reserve_vertices(vertices);
    for (std::uint64_t i = 0; i < vertices; ++i) read_vertex();
    require(polygons, 4 * sizeof(std::uint32_t));
    builder_.reserve_triangles(polygons);
    for (std::uint64_t i = 0; i < polygons; ++i) read_polygon();
    expect(kImportEnd);
    if (cursor_.remaining() > 0) fail_as_garbled();
    return builder_.finish();
  }

 private:
  [[noreturn]] void fail_as_garbled() const {
    refuse(file_, fmt::format("what {} wrote about it breaks off or is garbled", kProgram));
  }
  void require(std::size_t items, std::size_t size) const {
    if (!cursor_.has(items, size)) fail_as_garbled();
  }

  void expect(std::string_view mark) {
    require(mark.size(), 1);
    for (const char c : mark)
      if (cursor_.read<char>() != c) fail_as_garbled();
  }

  /// Of items that have each at least `size` bytes.
  std::uint64_t count(std::size_t size) {
    require(1, sizeof(std::uint64_t));
    const auto number = cursor_.read<std::uint64_t>();
    require(number, size);
    return number;
  }

  void read_vertex() {
    Vec3 position;
    for (int axis = 0; axis < 3; ++axis) position[axis] = cursor_.read<double>();
    builder_.add_vertex(position, kNowhere);
  }

  void read_polygon() {
    require(1, sizeof(std::uint32_t));
    corners_.resize(count_of_corners());
    for (std::int64_t& corner : corners_) corner = cursor_.read<std::uint32_t>();
    builder_.add_polygon(corners_, kNowhere);
  }

  std::size_t count_of_corners() {
    const std::size_t corners = cursor_.read<std::uint32_t>();
    require(corners, sizeof(std::uint32_t));
    return corners;
  }

  const std::string& file_;
  ByteCursor cursor_;
  MeshBuilder builder_;
  std::vector<std::int64_t> corners_;
};

}  // namespace

/// assimp 5.2.5 takes 0.1 s and 30 MiB of memory for a COLLADA file of 3 MiB (docs/formats.md); a 3MF of
/// blanks grows a thousand times and does not get through.
ImportLimits import_limits(std::size_t file_size) {
  constexpr std::size_t kMebibyte = std::size_t{1} << 20;
  return {std::chrono::seconds(20 + 2 * (file_size / kMebibyte)), 1024 * kMebibyte + 200 * file_size,
          decompression_limit(file_size)};
}

TriangleMesh mesh_by_assimp(std::string_view content, const std::string& file, const ImportLimits& limits,
                            const Progress& progress) {
  const auto program = importer();
  if (!program) refuse_without_importer(file);
  const std::vector<std::string> arguments = {without_gz(file).string(),
                                              fmt::format("{}", (limits.time.count() + 1) / 2),
                                              fmt::format("{}", limits.memory), limits.alone ? kImportAlone : ""};
  ProgressMeter meter(progress, "read");
  const ProgramResult result = run_program(*program, arguments, content, {limits.time, limits.output},
                                           [&](double fraction) { meter.at(fraction); });
  check(result, file, *program, limits);
  return ImportReader(result.output, file).read();
}

TriangleMesh imported_mesh(std::string_view content, const std::string& file, const ImportLimits& limits,
                           const Progress& progress) {
  const std::optional<std::string> utf8 = utf8_of_utf16(content);  // assimp 5.2.5 reads XML in UTF-8 only
  if (utf8) content = *utf8;
  if (is_collada(file)) try {
      return read_collada(content, file, limits.output);
    } catch (const InputError&) {  // assimp may read it
    }
  return mesh_by_assimp(content, file, limits, progress);
}

}  // namespace prohull

#include "inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include "command.h"
#include "prohull/detail/memory.h"
#include "prohull/detail/missing_file.h"
#include "prohull/hull_file.h"

namespace prohull::cli {
namespace {

/// The name by which a reader knows a file, of which it takes the format.
std::filesystem::path known_as(const std::filesystem::path& path, const InputOptions& options) {
  if (!is_standard_stream(path)) return path;
  return options.format.empty() ? "standard input" : "standard input." + options.format;
}

/// "in"; "of 1e-06 m" if --unit has none of that length.
std::string name_of_unit(double metres) {
  for (const auto& [name, length] : length_units())
    if (length == metres) return std::string(name);
  return fmt::format("of {:g} m", metres);
}

/// A file that says its unit is not in another one. glTF files often are not in the metres of their standard.
void check_unit(const FileUnit& file, const InputOptions& options, const std::filesystem::path& name) {
  if (options.unit > 0 && file.is_said && file.metres > 0 && options.unit != file.metres)
    refuse(
        fmt::format("{}: --unit is for files that do not say their unit; this one says it, and is read in "
                    "the unit {}; leave --unit out, or use --scale",
                    name.string(), name_of_unit(file.metres)));
}

/// Standard input has no suffix that could tell its format.
TriangleMesh read_known_as(const std::filesystem::path& name, std::string_view content, bool is_named,
                           const ReadOptions& how) {
  try {
    return read_mesh(content, name, how);
  } catch (const InputError& error) {
    if (is_named || error.defect() != Defect::UnknownFormat || content.empty()) throw;
    throw InputError(error.defect(), fmt::format("{}; --in-format names its format", error.what()));
  }
}

TriangleMesh mesh_in(std::string_view content, const std::filesystem::path& path, const InputOptions& options,
                     NonFinite non_finite, MeshMarks* marks = nullptr, FileUnit* unit = nullptr) {
  const std::filesystem::path name = known_as(path, options);
  ProgressLine line;
  FileUnit of_file;
  TriangleMesh mesh = read_known_as(name, content, !is_standard_stream(path) || !options.format.empty(),
                                    {.non_finite = non_finite,
                                     .scale = options.factor(),
                                     .marks = marks,
                                     .unit = &of_file,
                                     .progress = std::ref(line)});
  check_unit(of_file, options, name);
  if (unit) *unit = of_file;
  return mesh;
}

std::vector<std::string> input_formats() {
  std::vector<std::string> formats;
  for (const std::string& extension : read_mesh_extensions()) formats.push_back(extension.substr(1));
  return formats;
}

/// One path, or several.
template <class In>
void add_input(CLI::App& command, In& in, InputOptions& options, const std::string& what) {
  add_value(command, "in", in, "IN", what)->required();
  add_format_option(command, options);
  add_unit_options(command, options, "the mesh");
}

}  // namespace

void add_format_option(CLI::App& command, InputOptions& options) {
  add_value(command, "--in-format", options.format, "FORMAT",
            "Format of a mesh that comes from standard input (-): ply, stl, dae or any other suffix of a format that "
            "is read. Without this option its content tells.")
      ->transform(one_of("--in-format", input_formats()));
}

void add_unit_options(CLI::App& command, InputOptions& options, const std::string& what) {
  CLI::Option* const scale =
      add_optional_number(command, "--scale", options.scale, kPositive,
                          "Multiply the coordinates of " + what + " by this number when it is read.")
          ->type_name("S");
  add_choice(command, "--unit", options.unit, length_units(),
             "Unit of the numbers in " + what +
                 ", which are converted to metres when it is read; numbers in other options are then metres, too. For "
                 "files that do not say their unit, such as STL, OBJ, PLY and OFF.")
      ->excludes(scale);
}

void add_robot_input(CLI::App& command, std::filesystem::path& in) {
  add_value(command, "in", in, "ROBOT",
            "Robot: URDF, SDF or MJCF. A .xacro file is expanded by the program xacro, if that is installed.")
      ->required();
}

void add_geometry_option(CLI::App& command, robot::Geometry& geometry) {
  add_choice(command, "--geometry", geometry, robot::geometry_names(),
             "Geometry of the links that counts. A link that has none of it counts by the other one.");
}

void add_robot_file_options(CLI::App& command, robot::FileOptions& options) {
  add_package_path_option(command, options.package_paths);
  command.add_flag("--no-outside-files", options.no_outside_files,
                   "Refuse a robot that names mesh files outside of its package, or of its folder if it is in no "
                   "package; --package-path and the environment variables of ROS name other folders. Refuse xacro, and "
                   "meshes that have data in other files, as .gltf may. For robots of people whom you do not trust.");
}

void add_mesh_input(CLI::App& command, std::filesystem::path& in, InputOptions& options, const std::string& purpose) {
  add_input(command, in, options, purpose + " " + kMeshFiles);
}

void add_mesh_inputs(CLI::App& command, std::vector<std::filesystem::path>& in, InputOptions& options,
                     const std::string& purpose) {
  add_input(command, in, options, purpose + " " + kMeshFiles + " A folder stands for the mesh files in it.");
}

namespace {

/// What is said of a mesh that is no more than a point.
std::optional<InputError> why_no_size(const TriangleMesh& mesh) {
  try {
    repaired_mesh(mesh);
    return std::nullopt;
  } catch (const InputError& error) {
    return error;
  }
}

}  // namespace

MeshUnit::MeshUnit(const TriangleMesh& mesh, const std::filesystem::path& path, const InputOptions& options,
                   const FileUnit& file)
    : name_(input_name(path)),
      diagonal_(finite_bounding_box(mesh).diagonal()),
      scale_(options.scale),
      why_no_size_(diagonal_ == 0 ? why_no_size(mesh) : std::nullopt),
      metres_(options.unit > 0     ? 1
              : options.scale == 1 ? file.metres
                                   : 0) {}

double MeshUnit::number_of(const Length& length, const std::string& what) const {
  if (length.needs_metres() && metres_ == 0)
    refuse(fmt::format("{} {:g}{}: {}, or say a number in the mesh's unit", what, length.number, length.unit,
                       scale_ != 1 ? "with --scale, the unit of " + name_ + " is not known; use --unit instead"
                                   : name_ + " does not say its unit; add --unit mm (lengths are then in metres)"));
  if (length.unit == "%" && length.number > 0 && why_no_size_)
    throw InputError(why_no_size_->defect(), fmt::format("{}: {}", name_, why_no_size_->what()));
  return length.needs_metres() ? length.of(diagonal_) / metres_ : length.of(diagonal_);
}

bool is_sphere_file(const std::filesystem::path& path) {
  return path.extension() == ".yaml" || path.extension() == ".yml";
}

std::string read_bytes(const std::filesystem::path& path) {
  if (!is_standard_stream(path)) require_memory(path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      is_standard_stream(path) ? stdin : std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) fail_to_read(input_name(path), errno);
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  std::error_code unknown;  // the size of a pipe
  const auto expected = is_standard_stream(path) ? 0 : std::filesystem::file_size(path, unknown);
  std::string bytes;
  if (!unknown) bytes.reserve(expected + 2 * kChunk);
  std::size_t size = 0;
  do {
    stop_if_interrupted();
    if (bytes.size() < size + kChunk) bytes.resize(std::max(size + kChunk, std::min(2 * size, bytes.capacity())));
    size += std::fread(bytes.data() + size, 1, bytes.size() - size, file.get());
    if (std::ferror(file.get())) fail_to_read(input_name(path), errno);
  } while (!std::feof(file.get()));
  bytes.resize(size);
  return bytes;
}

TriangleMesh read_input(const std::filesystem::path& path, const InputOptions& options, NonFinite non_finite,
                        MeshMarks* marks, FileUnit* unit) {
  return mesh_in(read_bytes(path), path, options, non_finite, marks, unit);
}

InputMesh read_given(const std::filesystem::path& path, const InputOptions& options, MeshMarks* marks) {
  const Stopwatch reading;
  FileUnit unit;
  TriangleMesh mesh = read_input(path, options, NonFinite::Keep, marks, &unit);
  const double seconds = reading.seconds();
  const MeshUnit of_mesh(mesh, path, options, unit);
  return {std::move(mesh), of_mesh, seconds};
}

MeshOrHull read_mesh_or_hull(const std::filesystem::path& path, const InputOptions& options, NonFinite non_finite) {
  const std::string content = read_bytes(path);
  if (!is_hull_content(content)) return mesh_in(content, path, options, non_finite);
  if (options.factor() != 1)
    refuse(fmt::format(
        "{}: --scale and --unit are for mesh files; a .phull file has the coordinates that it was built with",
        input_name(path)));
  return load_hull(content, known_as(path, options));
}

ProgressiveHull read_hull(const std::filesystem::path& path) { return load_hull(read_bytes(path), known_as(path, {})); }

std::string input_name(const std::filesystem::path& path) {
  return is_standard_stream(path) ? "standard input" : path.string();
}

}  // namespace prohull::cli

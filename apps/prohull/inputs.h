#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "console.h"
#include "prohull/error.h"
#include "prohull/length.h"
#include "prohull/mesh_io.h"
#include "prohull/progressive_hull.h"
#include "robot/files/robot_file.h"

namespace prohull::cli {

/// What --help says of an argument that is a mesh file.
constexpr const char* kMeshFiles =
    "Meshes are PLY, OBJ, OFF, STL, GLB, glTF, DAE, 3MF and others (docs/formats.md), also as .gz or .zip. With - "
    "the file is read from standard input.";

/// How mesh files are read.
struct InputOptions {
  std::string format;  ///< of standard input, such as "stl"; empty: its content tells
  double scale = 1;
  double unit = 0;  ///< of the file's numbers, in metres; 0: none is said

  double factor() const { return unit > 0 ? unit : scale; }  ///< ReadOptions::scale
};
void add_format_option(CLI::App& command, InputOptions& options);
/// --scale and --unit, which apply to `what`.
void add_unit_options(CLI::App& command, InputOptions& options, const std::string& what);

/// The argument IN, a mesh that is used as `purpose` says, with all of these options.
void add_mesh_input(CLI::App& command, std::filesystem::path& in, InputOptions& options, const std::string& purpose);
/// The argument IN with all of these options, for one or several meshes, and folders of them.
void add_mesh_inputs(CLI::App& command, std::vector<std::filesystem::path>& in, InputOptions& options,
                     const std::string& purpose);

using robot::is_robot_file;
/// The argument ROBOT.
void add_robot_input(CLI::App& command, std::filesystem::path& in);
/// --geometry of the links of a robot.
void add_geometry_option(CLI::App& command, robot::Geometry& geometry);
/// --package-path and --no-outside-files.
void add_robot_file_options(CLI::App& command, robot::FileOptions& options);
/// By the suffix: YAML.
bool is_sphere_file(const std::filesystem::path& path);

/// What lengths of options are in numbers: in the unit of a mesh, as it was read.
class MeshUnit {
 public:
  /// `file` is what read_input says of its unit.
  MeshUnit(const TriangleMesh& mesh, const std::filesystem::path& path, const InputOptions& options,
           const FileUnit& file);

  /// Throws InputError(InvalidOption) that calls the length `what`, if it has a unit, but the mesh's is not known.
  double number_of(const Length& length, const std::string& what) const;
  /// Sets a bound that was given as a length greater than 0.
  void set(double& bound, const Length& length, const std::string& what) const {
    if (length.number > 0) bound = number_of(length, what);
  }

 private:
  std::string name_;
  double diagonal_, scale_;
  std::optional<InputError> why_no_size_;  ///< if the diagonal is 0
  double metres_;                          ///< of the unit; 0: not known
};

/// The name of an input in messages: that of "-" is "standard input".
std::string input_name(const std::filesystem::path& path);

/// The bytes of a file, or of standard input for "-". Throws InputError(CannotRead).
std::string read_bytes(const std::filesystem::path& path);

/// The rows of a file of queries. Throws InputError(Malformed) if there are none: `what` would have no answers.
template <class Row>
std::vector<Row> require_some(std::vector<Row> rows, std::string_view what, const std::filesystem::path& path) {
  if (rows.empty()) throw InputError(Defect::Malformed, input_name(path) + ": there are no " + std::string(what));
  return rows;
}

/// read_mesh of a file, or of standard input for "-"; ended by Ctrl-C.
TriangleMesh read_input(const std::filesystem::path& path, const InputOptions& options = {},
                        NonFinite non_finite = NonFinite::Refuse, MeshMarks* marks = nullptr, FileUnit* unit = nullptr);

/// A mesh as it was given, for covers, hulls and the like: with triangles that are not finite.
struct InputMesh {
  TriangleMesh mesh;
  MeshUnit unit;
  double seconds;  ///< that reading took
};
InputMesh read_given(const std::filesystem::path& path, const InputOptions& options, MeshMarks* marks = nullptr);

/// What a mesh or .phull file holds; it is read once, so that it may be a pipe.
using MeshOrHull = std::variant<TriangleMesh, ProgressiveHull>;
MeshOrHull read_mesh_or_hull(const std::filesystem::path& path, const InputOptions& options = {},
                             NonFinite non_finite = NonFinite::Refuse);

ProgressiveHull read_hull(const std::filesystem::path& path);

/// work(); what InputError it throws then names the file.
template <class Work>
auto naming(const std::filesystem::path& path, Work work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(error.defect(), input_name(path) + ": " + error.what());
  }
}

/// work(options) as above, which draws how far it is.
template <class Options, class Work>
auto naming(const std::filesystem::path& path, Options options, Work work) {
  ProgressLine line;
  options.progress = std::ref(line);
  return naming(path, [&] { return work(options); });
}

}  // namespace prohull::cli

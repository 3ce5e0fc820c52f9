#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/detail/refuse.h"
#include "prohull/triangle_mesh.h"

namespace prohull::cli {

/// The files that a command writes. They are written under other names beside their own, and appear together, whole,
/// when the command is done; otherwise none of them does. "-" is standard output, which then gets the bytes; so does
/// any other file that cannot be replaced, such as a pipe.
class Outputs {
 public:
  Outputs() = default;
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;
  ~Outputs();

  /// Lets `write` fill a file whose name ends in `suffix`, unless `target` is empty. If it returns false, there will be
  /// no such output.
  bool add(const std::filesystem::path& target, const std::string& suffix,
           const std::function<bool(const std::filesystem::path&)>& write);
  void add(const std::filesystem::path& target, std::string_view bytes);
  /// Returns whether the file holds the triangles of `mesh`, bit for bit. If not, there will be no such output. STL
  /// does not keep how vertices are numbered.
  bool add(const std::filesystem::path& target, const std::string& suffix, const TriangleMesh& mesh);
  /// A report as JSON, to which the version of the program is added.
  void add_report(const std::filesystem::path& target, nlohmann::json report);

  /// Makes a folder, and those above it, where it is not there. If the outputs do not appear, what was made vanishes.
  void add_folder(const std::filesystem::path& folder);

  /// Lets the one that was added last appear before the others.
  void put_last_first();

  /// Lets all of them appear, in their order. Throws Cancelled if the user has interrupted, InputError(CannotWrite).
  void commit();

 private:
  struct Pending {
    std::filesystem::path target, temporary;
  };
  std::vector<Pending> pending_;
  std::vector<std::filesystem::path> folders_;
};

/// Whether a mesh file has the triangles of `mesh`, bit for bit. STL does not keep how vertices are numbered.
bool holds_triangles_of(const std::filesystem::path& file, const TriangleMesh& mesh);

/// Whether any output has appeared: where a command writes several times, what it finishes stays.
bool has_any_output_appeared();

/// Removes what was not committed, for a program that ends without unwinding. No output can be committed after that.
void remove_unfinished_outputs();

/// What was printed is not lost: throws InputError(CannotWrite) if standard output has not taken all of it. A pipe
/// whose reader has gone away is no error.
void flush_standard_output();

bool is_standard_stream(const std::filesystem::path& path);

/// Before any work: throws InputError(InvalidOption) if two of the outputs are the same file, or one of them is an
/// input too, or if several inputs are standard input; InputError(CannotWrite) if the folder of an output does not take
/// files. Empty paths are none. If an output is standard output, the summary goes to standard error from now on.
void check_files(const std::vector<std::filesystem::path>& inputs, const std::vector<std::filesystem::path>& outputs);

/// What files of some kind may be named.
struct OutputKind {
  std::string_view what;  ///< "meshes"
  std::vector<std::string> suffixes;
};
OutputKind mesh_outputs();

/// -o and --out-format of a command that writes a mesh. `what` is written: "the level".
void add_mesh_output_options(CLI::App& command, std::filesystem::path& out, std::string& format,
                             const std::string& what);
CLI::Option* add_out_format_option(CLI::App& command, std::string& format, const OutputKind& kind);

/// {faces} in the pattern becomes the number of faces that a hull was asked to have.
std::filesystem::path path_for(const std::filesystem::path& pattern, std::size_t faces);

/// The name of an output in messages: that of "-" is "standard output".
std::string output_name(const std::filesystem::path& path);

/// What the name ends in, ".stl"; where it says nothing, as "-" does, `format` tells ("stl"). Throws
/// InputError(InvalidOption) for what is none of the kind, or if name and format contradict each other.
std::string output_suffix(const std::filesystem::path& path, const OutputKind& kind, const std::string& format = "");

}  // namespace prohull::cli

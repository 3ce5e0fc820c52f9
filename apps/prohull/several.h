#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace prohull::cli {

/// The files that are named; in the place of a folder the mesh files in it, by name. Throws InputError(CannotRead) for
/// a folder without any.
std::vector<std::filesystem::path> mesh_files(const std::vector<std::filesystem::path>& named);

/// What a command writes for one of its meshes: {name} in the pattern becomes the name of the mesh's file, without its
/// suffix.
std::filesystem::path named_after(const std::filesystem::path& pattern, const std::filesystem::path& in);

/// DIR/ and folders that exist stand for DIR/{name}`tail`.
std::filesystem::path pattern_of(const std::filesystem::path& out, const std::string& tail);

/// Options and the names that they have.
using NamedOutputs = std::vector<std::pair<const char*, std::filesystem::path>>;

/// Refuses, before any work, what would be the same file for several of the meshes, and files that are written over.
/// `outputs_of` has what is written for a mesh; of "{name}.stl", the patterns.
void check_outputs(const std::vector<std::filesystem::path>& meshes,
                   const std::function<NamedOutputs(const std::filesystem::path&)>& outputs_of);

/// What became of one of several meshes.
struct MeshOutcome {
  int exit_code = 0;
  std::vector<std::string> rows;  ///< of the table, without the name
  bool is_as_asked = false;       ///< also where the exit code does not tell it
};

/// Does `one` with each, in their order, and prints a table under this head. A mesh that throws InputError is told to
/// standard error, and the others go on. Returns the greatest exit code.
int run_each(const std::vector<std::filesystem::path>& meshes, const std::string& head,
             const std::function<MeshOutcome(const std::filesystem::path&)>& one);

}  // namespace prohull::cli

#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull::bench {

/// Which meshes to measure: those of a folder, or bundled samples, so that every user can run every table.
struct ModelOptions {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files = {};
  std::vector<std::string> samples{"sphere", "asteroid", "bracket", "pony"};
  std::size_t sample_faces = 50000;
  bool record_sample = false;  ///< that alone
};

void add_model_options(CLI::App& command, ModelOptions& options);

/// Says where a mesh comes from; it is loaded when its turn comes.
struct ModelSource {
  std::string name;            ///< of the file up to its first dot, or of the sample
  std::filesystem::path path;  ///< empty for a sample
  std::string sample = {};
  std::size_t sample_faces = 0;
  bool is_record_sample = false;
};

/// By the extension, in any case, before .gz: of a format that prohull may read, or a .zip.
bool is_named_like_a_mesh(const std::filesystem::path& path);

/// The models of a folder are sorted by name; files that are no meshes by their name are passed over. After them comes
/// the record sample, a bundled mesh large enough for construction in rounds. Every recorded table has its rows, and
/// scripts/records measures them again: they tell whether the record is of this build.
std::vector<ModelSource> model_sources(const ModelOptions& options);

/// Closed and oriented outwards; throws InputError where that cannot be.
TriangleMesh load(const ModelSource& source);

struct Refused {
  std::string name, reason;
};

/// Calls `measure` with each model in turn. A std::runtime_error of a mesh of the folder, such as an InputError, is
/// told on stderr and kept; one of a sample is thrown on.
std::vector<Refused> measure_each(const ModelOptions& options, const std::function<void(const ModelSource&)>& measure);

/// A section of markdown; empty if nothing was refused.
std::string listed(const std::vector<Refused>& refused);

}  // namespace prohull::bench

#include "models.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "prohull/repair.h"
#include "prohull/sample.h"

namespace prohull::bench {
namespace {

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

bool is_named_like_a_mesh(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 9> kExtensions{".stl", ".obj",  ".ply", ".off", ".dae",
                                                        ".glb", ".gltf", ".3mf", ".zip"};
  const bool is_compressed = lower(path.extension()) == ".gz";
  return std::ranges::find(kExtensions, lower((is_compressed ? path.stem() : path).extension())) != kExtensions.end();
}

void add_model_options(CLI::App& command, ModelOptions& options) {
  CLI::Option* folder = command.add_option("--models", options.folder, "Measure every mesh of this folder")
                            ->check(CLI::ExistingDirectory)
                            ->type_name("DIR");
  CLI::Option* files = command.add_option("--mesh", options.files, "Measure these meshes")
                           ->check(CLI::ExistingFile)
                           ->type_name("FILE")
                           ->excludes(folder);
  command.add_option("--samples", options.samples, "Measure these bundled meshes (see prohull sample)")
      ->delimiter(',')
      ->excludes(folder)
      ->excludes(files)
      ->type_name("NAME,...")
      ->capture_default_str();
  command.add_option("--sample-faces", options.sample_faces, "About how many faces samples have")
      ->capture_default_str();
  command
      .add_flag("--record-sample", options.record_sample,
                "Measure only the bundled mesh that comes after those of --models")
      ->excludes(folder)
      ->excludes(files);
}

std::vector<ModelSource> model_sources(const ModelOptions& options) {
  const ModelSource record_sample{"bundled_pony", {}, "pony", 20000, true};
  if (options.record_sample) return {record_sample};
  std::vector<ModelSource> sources;
  const auto add = [&](const std::filesystem::path& path) {
    const std::string file = path.filename().string();
    sources.push_back({file.substr(0, file.find('.')), path});
  };
  for (const auto& path : options.files) add(path);
  if (!sources.empty()) return sources;
  if (options.folder.empty()) {
    for (const std::string& sample : options.samples) sources.push_back({sample, {}, sample, options.sample_faces});
    return sources;
  }
  for (const auto& entry : std::filesystem::directory_iterator(options.folder))
    if (entry.is_regular_file() && is_named_like_a_mesh(entry.path())) add(entry.path());
  std::ranges::sort(sources, {}, &ModelSource::name);
  sources.push_back(record_sample);
  return sources;
}

TriangleMesh load(const ModelSource& source) {
  if (source.path.empty()) return make_sample(source.sample, source.sample_faces);
  return closed_mesh(read_mesh(source.path)).mesh;
}

std::vector<Refused> measure_each(const ModelOptions& options, const std::function<void(const ModelSource&)>& measure) {
  std::vector<Refused> refused;
  for (const ModelSource& source : model_sources(options)) try {
      measure(source);
    } catch (const std::runtime_error& error) {
      if (options.folder.empty()) throw;
      refused.push_back({source.name, error.what()});
      fmt::print(stderr, "{}: refused, {}\n", source.name, error.what());
    }
  return refused;
}

std::string listed(const std::vector<Refused>& refused) {
  if (refused.empty()) return "";
  std::string text = "## No closed mesh can be made of\n\n";
  for (const Refused& r : refused) text += fmt::format("- {}: {}\n", r.name, r.reason);
  return text;
}

}  // namespace prohull::bench

#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "apart.h"
#include "command.h"
#include "machine.h"
#include "models.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "strategies.h"
#include "table.h"

namespace prohull::bench {
namespace {

// The peak of resident memory is a property of a process, and reading a file may need more than building a hull. Hence
// three children for each mesh: one loads it and leaves its arrays in a temporary file; one reads those into memory and
// does nothing else; one reads them and builds the hull. What a child has that does nothing at all is subtracted.

struct MemoryOptions {
  ModelOptions models;
  std::size_t hull_faces = 2000;
  std::filesystem::path out;
};

int run_memory(const MemoryOptions& options) {
  Table table({"model", "faces", "mesh", "peak", "bytes per face"});
  Table csv({"mesh", "faces", "hull_faces", "mesh_bytes", "peak_bytes", "bytes_per_face"});
  std::vector<ModelSource> sources = model_sources(options.models);
  if (!options.models.folder.empty()) sources.push_back({"asteroid", {}, "asteroid", 1000000});
  const std::size_t nothing = run_apart([] {}).peak_bytes;
  for (const ModelSource& source : sources) {
    fmt::print(stderr, "{}", source.name);
    const File file = temporary_file();
    const Ended loaded = run_apart([&] { put_mesh(file.get(), load(source)); });
    if (loaded.failure.empty()) {
      const std::size_t faces = get_mesh_size(file.get()).faces;
      const Ended held = run_apart([&] { get_mesh(file.get()); });
      const Ended built = run_apart([&] {
        const TriangleMesh mesh = get_mesh(file.get());
        build_hull(mesh, hull_options(Strategy::Lazy, options.hull_faces));
      });
      if (!built.failure.empty()) throw std::runtime_error("no hull of " + source.name + ": " + built.failure);
      const std::size_t mesh_bytes = held.peak_bytes - nothing, peak_bytes = built.peak_bytes - nothing;
      const double per_face = static_cast<double>(peak_bytes) / static_cast<double>(faces);
      constexpr double kMegabyte = 1e6;
      table.add(
          {source.name, fmt::to_string(faces), fmt::format("{:.1f} MB", static_cast<double>(mesh_bytes) / kMegabyte),
           fmt::format("{:.1f} MB", static_cast<double>(peak_bytes) / kMegabyte), fmt::format("{:.0f}", per_face)});
      csv.add({source.name, fmt::to_string(faces), fmt::to_string(options.hull_faces), fmt::to_string(mesh_bytes),
               fmt::to_string(peak_bytes), fmt::format("{:.1f}", per_face)});
    } else {
      fmt::print(stderr, ": {}", loaded.failure);
    }
    fmt::print(stderr, "\n");
  }
  const std::string text = fmt::format(
      "# Memory: the peak while a hull of {} faces is built by lazy, the mesh and the result included\n\n{}\n\n{}",
      options.hull_faces, machine(), table.markdown());
  publish(options.out, "memory", text, csv.csv());
  return kDone;
}

}  // namespace

void add_memory(CLI::App& app, Run& run) {
  const auto options = std::make_shared<MemoryOptions>();
  CLI::App& command = *app.add_subcommand("memory", "Peak memory per input face, also of a sample of 1,000,000 faces");
  add_model_options(command, options->models);
  add_faces_option(command, options->hull_faces);
  add_out_option(command, options->out, "memory.md and memory.csv");
  command.callback([options, &run] { run = [options] { return run_memory(*options); }; });
}

}  // namespace prohull::bench

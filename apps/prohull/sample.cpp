#include <fmt/format.h>

#include "command.h"
#include "prohull/mesh_io.h"
#include "prohull/sample.h"

namespace prohull::cli {
namespace {

struct Options {
  std::string name;
  std::filesystem::path out;
  std::size_t faces = 20000;
};

int make(const Options& options) {
  require_writable(options.out);
  const TriangleMesh mesh = make_sample(options.name, options.faces);
  if (interrupted()) throw Interrupted{};
  write_mesh(options.out, mesh);
  fmt::print("{}: {} of {} faces\n", options.out.string(), options.name, grouped(mesh.face_count()));
  return kDone;
}

}  // namespace

void add_sample(CLI::App& app, Run& run) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("sample", "Make one of the bundled meshes");
  std::string names;
  for (const SampleInfo& sample : samples()) names += fmt::format("\n    {:<10} {}", sample.name, sample.description);
  command.add_option("name", options->name, "Which:" + names)->required()->type_name("NAME");
  command.add_option("-o,--out", options->out, "PLY, OBJ, OFF or STL")->required()->type_name("FILE");
  command.add_option("--faces", options->faces, "About how many, within 20 % where the shape allows")
      ->capture_default_str()
      ->check(CLI::Range(4.0, 1e9));
  add_examples(command, {"prohull sample asteroid -o asteroid.ply --faces 100000"});
  command.callback([options, &run] { run = [options] { return make(*options); }; });
}

}  // namespace prohull::cli

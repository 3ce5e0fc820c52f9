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

/// What a file of float32 keeps; one shape is as good a sample as the other.
void round_to_float32(TriangleMesh& mesh) {
  for (Vec3& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<double>(static_cast<float>(p[axis]));
}

int make(const Options& options) {
  const bool float32 = stores_float32(mesh_format(options.out));
  require_writable(options.out);
  TriangleMesh mesh = make_sample(options.name, options.faces);
  if (float32) round_to_float32(mesh);
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
  std::vector<std::string_view> words;
  for (const SampleInfo& sample : samples()) {
    names += fmt::format("\n    {:<10} {}", sample.name, sample.description);
    words.push_back(sample.name);
  }
  command.add_option("name", options->name, "Which:" + names)->required()->type_name(CLI::detail::join(words, "|"));
  command.add_option("-o,--out", options->out, "PLY, OBJ, OFF, STL or GLB; these two round to float32")
      ->required()
      ->type_name("OUT");
  command.add_option("--faces", options->faces, "About how many, within 20 % where the shape allows")
      ->capture_default_str()
      ->check(CLI::Range(4.0, 1e9));
  add_examples(command, {"prohull sample asteroid -o asteroid.ply --faces 100000"});
  command.callback([options, &run] { run = [options] { return make(*options); }; });
}

}  // namespace prohull::cli

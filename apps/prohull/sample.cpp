#include "prohull/sample.h"

#include <fmt/format.h>

#include "command.h"
#include "prohull/mesh_io.h"

namespace prohull::cli {
namespace {

struct Options {
  std::string name, out_format;
  std::filesystem::path out;
  std::size_t faces = 20000;
};

/// What a file of float32 keeps; one shape is as good a sample as the other.
void round_to_float32(TriangleMesh& mesh) {
  for (Vec3& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<double>(static_cast<float>(p[axis]));
}

int make(const Options& options) {
  const Stopwatch watch;
  const std::string suffix = output_suffix(options.out, mesh_outputs(), options.out_format);
  check_files({}, {options.out});
  TriangleMesh mesh = make_sample(options.name, options.faces);
  if (stores_float32(mesh_format("mesh" + suffix))) round_to_float32(mesh);
  Outputs outputs;
  outputs.add(options.out, suffix, [&](const auto& file) { return write_mesh(file, mesh), true; });
  outputs.commit();
  say("{}: {} of {}\n", output_name(options.out), options.name, counted(mesh.face_count(), "face", "faces"));
  say_more("  {}, made and written in {:.2f} s\n", counted(mesh.vertex_count(), "vertex", "vertices"), watch.seconds());
  return kDone;
}

}  // namespace

void add_sample(CLI::App& app, Run& run) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("sample", "Makes one of the bundled meshes, to try other commands with.");
  std::string list;
  std::vector<std::string> words;
  for (const SampleInfo& sample : samples()) {
    list += fmt::format("\n  {:<10} {}", sample.name, sample.description);
    words.emplace_back(sample.name);
  }
  command.add_option("name", options->name, "The mesh to make:" + list)
      ->required()
      ->transform(one_of("NAME", words))
      ->type_name(CLI::detail::join(words, "|"));
  add_mesh_output_options(command, options->out, options->out_format, "the mesh");
  add_number(command, "--faces", options->faces, {4, 1e9},
             "Number of faces, which the mesh has within 20 % where its shape allows.")
      ->capture_default_str();
  add_examples(command, {"prohull sample asteroid -o asteroid.ply --faces 1e5",
                         "prohull sample knot -o - --out-format stl | prohull info -"});
  command.callback([options, &run] { run = [options] { return make(*options); }; });
}

}  // namespace prohull::cli

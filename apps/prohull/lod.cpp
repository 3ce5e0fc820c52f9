#include <fmt/format.h>

#include "command.h"
#include "prohull/float32_hull.h"
#include "prohull/hull_file.h"
#include "prohull/mesh_io.h"

namespace prohull::cli {
namespace {

struct Options {
  std::filesystem::path in, out, report;
  std::size_t faces = 0;
};

int extract(const Options& options) {
  const bool float32 = stores_float32(mesh_format(options.out));
  require_distinct({options.in, options.out, options.report});
  for (const auto& path : {options.out, options.report}) require_writable(path);
  const ProgressiveHull hull = load_hull(options.in);
  TriangleMesh level = hull.level(options.faces);
  if (float32 && level.face_count() < hull.original_face_count())
    level = with_float32_coordinates(level, hull.side()).mesh;
  if (interrupted()) throw Interrupted{};
  write_mesh(options.out, level);
  fmt::print("{}: {} faces of {}{}\n", options.out.string(), grouped(level.face_count()),
             grouped(hull.original_face_count()),
             options.faces != 0 && level.face_count() > options.faces ? " (the base mesh; there is none coarser)" : "");
  write_report(options.report, {{"path", options.out.string()},
                                {"faces", level.face_count()},
                                {"vertices", level.vertex_count()},
                                {"volume", signed_volume(level)}});
  return kDone;
}

}  // namespace

void add_lod(CLI::App& app, Run& run) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("lod", "Extract any level of a .phull file");
  command.add_option("in", options->in, "What build --hierarchy wrote")->required()->type_name("H.phull");
  command.add_option("-o,--out", options->out, "Where the level goes: .ply, .obj, .off, .stl or .glb")
      ->required()
      ->type_name("OUT");
  command.add_option("--faces", options->faces, "The finest level of at most this many faces; without, the base mesh")
      ->check(CLI::Range(0.0, 1e10));
  add_report_option(command, options->report);
  add_examples(command, {"prohull lod horse.phull --faces 5000 -o level.ply", "prohull lod horse.phull -o base.stl"});
  command.callback([options, &run] { run = [options] { return extract(*options); }; });
}

}  // namespace prohull::cli

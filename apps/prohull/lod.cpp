#include <fmt/format.h>

#include "command.h"
#include "prohull/detail/float32_hull.h"
#include "prohull/detail/summary.h"
#include "prohull/mesh_io.h"

namespace prohull::cli {
namespace {

struct LodOptions {
  std::filesystem::path in, out, report;
  std::string out_format;
  std::size_t faces = 0;
  std::optional<Axis> mirror;
};

int extract(const LodOptions& options) {
  const std::string suffix = output_suffix(options.out, mesh_outputs(), options.out_format);
  check_files({options.in}, {options.out, options.report});
  const Stopwatch reading;
  const ProgressiveHull hull = read_hull(options.in);
  const double read_seconds = reading.seconds();
  stop_if_interrupted();
  const Stopwatch extracting;
  TriangleMesh level =
      hull.level(options.mirror ? symmetric_faces(hull, *options.mirror, options.faces) : options.faces);
  if (stores_float32(mesh_format("mesh" + suffix)) && level.face_count() < hull.original_face_count())
    level = with_float32_coordinates(level, hull.side()).mesh;
  const double extract_seconds = extracting.seconds();
  Outputs outputs;
  outputs.add(options.out, suffix, [&](const auto& file) { return write_mesh(file, level), true; });
  outputs.add_report(options.report, {{"path", options.out.string()},
                                      {"faces", level.face_count()},
                                      {"vertices", level.vertex_count()},
                                      {"volume", signed_volume(level)},
                                      {"finest_level", name_of(finest_level_names(), hull.finest_level())}});
  outputs.commit();
  say("{}: {} of {}{}\n", output_name(options.out), counted(level.face_count(), "face"),
      grouped(hull.original_face_count()),
      options.faces != 0 && level.face_count() > options.faces ? ", which is the coarsest level of the file" : "");
  if (const std::string finest = described_finest_level(hull.finest_level()); !finest.empty())
    say("  the finest level of the file is {}, not the input itself\n", finest);
  say_more("  read {:.2f} s, extracted {:.2f} s\n", read_seconds, extract_seconds);
  return kDone;
}

}  // namespace

void add_lod(CLI::App& app, Run& run) {
  const auto options = std::make_shared<LodOptions>();
  CLI::App& command = *app.add_subcommand(
      "lod",
      "Extracts a level of a .phull file as a mesh. Every level encloses the next finer one (of an inner hull: is "
      "enclosed by it), and the finest is the mesh that the hull was built from, bit for bit: the input, or what was "
      "made of it, which "
      "is then said.");
  command
      .add_option("in", options->in,
                  "File with all levels of a hull, which `prohull build --hierarchy` wrote. With - it is "
                  "read from standard input.")
      ->required()
      ->type_name("H.phull");
  add_mesh_output_options(command, options->out, options->out_format, "the level");
  add_optional_number(
      command, "--faces", options->faces, {0, 1e10},
      "Take the finest level that has at most this number of faces. Without it, the coarsest level is taken.");
  add_choice(command, "--mirror", options->mirror, axis_names(),
             "Take a symmetric level, of a hull that was built with the same option: of two levels that follow each "
             "other, one is at least.");
  add_report_option(command, options->report);
  add_examples(command, {"prohull lod horse.phull --faces 5000 -o level.ply", "prohull lod horse.phull -o base.stl",
                         "prohull lod horse.phull -o - --out-format obj >base.obj"});
  command.callback([options, &run] { run = [options] { return extract(*options); }; });
}

}  // namespace prohull::cli

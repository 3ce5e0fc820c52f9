
#include <cmath>

#include "command.h"
#include "prohull/closed_solid.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "verdict.h"

namespace prohull::cli {
namespace {

struct RepairRunOptions {
  std::filesystem::path in, out, report;
  std::string out_format;
  InputOptions input;
  Length spacing;
  ClosedSolidOptions solid;
};

struct RepairOutcome {
  ClosedSolid solid;
  InsideVolume inside;  ///< of it
  Verdict verdict;      ///< of the file
  double read_seconds = 0, seconds = 0;

  bool is_wrap() const { return solid.source == Source::Wrap; }
};

/// Parts that overlap count once; what the verdict has measured is not measured again.
InsideVolume inside_of(const ClosedSolid& solid) {
  if (!std::isnan(solid.verdict.hull_volume)) return {solid.verdict.hull_volume};
  ProgressLine line;
  return volume_inside(solid.mesh, std::ref(line));
}

void print_summary(const RepairRunOptions& options, const RepairOutcome& outcome) {
  const ClosedSolid& solid = outcome.solid;
  say("{}\n", line_of_input(input_name(options.in), solid.input));
  for (const std::string& line : lines_of_repairs(solid.input)) say("  {}\n", line);
  if (outcome.is_wrap() && solid.input.closed)
    say("  the repaired mesh{} does not cover all triangles\n",
        options.solid.float32_coordinates ? ", with float32 coordinates (.ply, .obj and .off keep doubles)," : "");
  const auto& [volume, is_estimated] = outcome.inside;
  say("{}: {} of {}, volume {}\n", output_name(options.out), outcome.is_wrap() ? "wrap" : "solid",
      counted(solid.mesh.face_count(), "face"),
      is_estimated ? fmt::format("about {:.3g} (estimated)", volume) : fmt::format("{:.9g}", volume));
  if (solid.folds.faces > 0)
    say("  {}: the faces around them were replaced by others, which cover them\n", describe(solid.folds));
  if (solid.rounded_vertices > 0)
    say("  moved {} to coordinates that the file keeps\n", counted(solid.rounded_vertices, "vertex", "vertices"));
  if (outcome.is_wrap())
    say("  it is another solid than the mesh: a wrap with a spacing of {0:.4g}, about a third of that farther out "
        "(around sheets about half, in places more than all of it), which closes openings narrower than about twice "
        "that (--spacing)\n",
        solid.wrap_spacing);
  say("  certified: {}\n", certificate_of(outcome.verdict));
  say("  read {:.2f} s, repair and verify {:.2f} s\n", outcome.read_seconds, outcome.seconds);
}

nlohmann::json report_of(const RepairRunOptions& options, const RepairOutcome& outcome) {
  const ClosedSolid& solid = outcome.solid;
  const Repairs& repairs = solid.input.repairs;
  nlohmann::json in = facts(solid.input.found);
  in["path"] = options.in.string();
  in["repairs"] = describe(repairs);
  in["obstacle"] = solid.input.obstacle;
  return {{"input", in},
          {"path", options.out.string()},
          {"faces", solid.mesh.face_count()},
          {"vertices", solid.mesh.vertex_count()},
          {"volume", outcome.inside.volume},
          {"volume_is_estimated", outcome.inside.is_estimated},
          {"source", name_of(source_names(), solid.source)},
          {"wrap_spacing", outcome.is_wrap() ? nlohmann::json(solid.wrap_spacing) : nlohmann::json()},
          {"rounded_vertices", solid.rounded_vertices},
          {"folds", facts(solid.folds)},
          {"openings", {{"closed", repairs.closed_openings}, {"largest", repairs.largest_opening}}},
          {"verdict", facts(outcome.verdict)},
          {"seconds", {{"read", outcome.read_seconds}, {"repair", outcome.seconds}}}};
}

int run_repair(RepairRunOptions options) {
  const std::string suffix = output_suffix(options.out, mesh_outputs(), options.out_format);
  check_files({options.in}, {options.out, options.report});
  options.solid.float32_coordinates = stores_float32(mesh_format("solid" + suffix));
  RepairOutcome outcome;
  InputMesh in = read_given(options.in, options.input);
  outcome.read_seconds = in.seconds;
  options.solid.spacing = in.unit.number_of(options.spacing, "--spacing");
  const Stopwatch repairing;
  outcome.solid = naming(options.in, options.solid,
                         [&](const ClosedSolidOptions& how) { return closed_solid(std::move(in.mesh), how); });
  outcome.inside = inside_of(outcome.solid);
  outcome.seconds = repairing.seconds();
  const ClosedSolid& solid = outcome.solid;
  Outputs outputs;
  const bool holds_bits = solid.verdict.certified && outputs.add(options.out, suffix, solid.mesh);
  outcome.verdict = as_written(solid.verdict, holds_bits);
  outputs.add_report(options.report, report_of(options, outcome));
  outputs.commit();
  print_summary(options, outcome);
  return outcome.verdict.certified ? kDone : kAnswerIsNo;
}

}  // namespace

void add_repair(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<RepairRunOptions>(
      app, run, "repair",
      "Writes the solid of a mesh: a closed mesh, whose openings have caps and whose faces look outwards, as `prohull "
      "build` makes it before it builds a hull. Where repairs do not give one that covers all triangles, it is a wrap, "
      "a "
      "new closed surface around them. The file that was written is certified to cover every finite triangle of the "
      "mesh, exactly; else nothing is written and the exit code is 1.",
      run_repair);
  add_mesh_input(command, options.in, options.input, "Mesh to close.");
  add_mesh_output_options(command, options.out, options.out_format, "the solid");
  add_length(
      command, "--spacing", options.spacing,
      "Spacing of the grid that a wrap is made on, if there has to be one. Halving it takes up to 8 times as long. "
      "Without this option it is 1/256 of the diagonal of the bounding box.");
  add_choice(
      command, "--open-shells", options.solid.repair.open_shells, open_shells_names(),
      "What to do with openings. close gives them caps, so that what they lead into is inside; keep makes a thin "
      "solid of the triangles. A leaf or a bedsheet always stays a sheet.");
  command.add_flag("!--drop-inside", options.solid.repair.keep_cavities,
                   "Drop parts of the mesh that lie inside of other parts, as `prohull build` does.");
  add_report_option(command, options.report);
  add_examples(command, {"prohull repair scan.obj -o solid.ply",
                         "prohull repair part.stl --unit mm --spacing 0.2mm -o solid.stl",
                         "prohull repair soup.ply -o solid.obj --report solid.json"});
}

}  // namespace prohull::cli

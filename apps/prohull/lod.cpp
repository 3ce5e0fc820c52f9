
#include <functional>
#include <optional>

#include "command.h"
#include "prohull/detail/float32_hull.h"
#include "prohull/detail/summary.h"
#include "prohull/mesh_io.h"
#include "verdict.h"

namespace prohull::cli {
namespace {

struct LodOptions {
  std::filesystem::path in, out, report;
  std::string out_format;
  std::size_t faces = 0;
  std::optional<Axis> mirror;
};

TriangleMesh level_of(const ProgressiveHull& hull, const LodOptions& options, const std::string& suffix) {
  TriangleMesh level =
      hull.level(options.mirror ? symmetric_faces(hull, *options.mirror, options.faces) : options.faces);
  if (stores_float32(mesh_format("mesh" + suffix))) level = float32_level(hull, level);
  if (options.mirror && !inspect_symmetry(level, *options.mirror).is_symmetric())
    refuse(
        fmt::format("{}: the file keeps float32 coordinates, and rounded to them the level is not symmetric "
                    "any more; build the hull with an .stl or .glb file as output, or write .ply, .obj or .off",
                    output_name(options.out)));
  return level;
}

struct LodOutcome {
  TriangleMesh level, written;  ///< `written`: what the file holds
  HullSide side = HullSide::Outer;
  std::optional<Verification> found = {};  ///< against the finest level, unless it is that, bit for bit
  double read_seconds = 0, extract_seconds = 0, verify_seconds = 0;

  /// The finest level encloses its own solid.
  Verdict verdict() const {
    if (found) return *found;
    return {
        .certified = true, .proof = "identity", .side = side, .encloses_solid = Answer::Yes, .original_closed = true};
  }
};

Verification verified(const TriangleMesh& written, const TriangleMesh& finest, HullSide side) {
  ProgressLine line;
  return verify_hull(written, finest, side, {.progress = std::ref(line)});
}

nlohmann::json report_of(const LodOptions& options, const ProgressiveHull& hull, const LodOutcome& outcome) {
  nlohmann::json report = {
      {"path", options.out.string()},
      {"target_faces", options.faces > 0 ? nlohmann::json(options.faces) : nlohmann::json()},
      {"faces", outcome.level.face_count()},
      {"vertices", outcome.level.vertex_count()},
      {"volume", signed_volume(outcome.level)},
      {"finest_faces", hull.original_face_count()},
      {"coarsest", outcome.level.face_count() == hull.base_face_count()},
      {"finest_level", name_of(finest_level_names(), hull.finest_level())},
      {"verdict", facts(outcome.verdict())},
      {"seconds",
       {{"read", outcome.read_seconds}, {"extract", outcome.extract_seconds}, {"verify", outcome.verify_seconds}}}};
  if (outcome.found) report["faces_outside"] = outcome.found->faces_outside;
  return report;
}

void print_summary(const LodOptions& options, const ProgressiveHull& hull, const LodOutcome& outcome) {
  const auto lines =
      lines_of_level(output_name(options.out), {hull, options.faces, outcome.level.face_count(), outcome.found});
  for (const std::string& line : lines) say("{}{}\n", &line == &lines.front() ? "" : "  ", line);
  say_more("  read {:.2f} s, extracted {:.2f} s, verified in {:.2f} s\n", outcome.read_seconds, outcome.extract_seconds,
           outcome.verify_seconds);
}

int extract(LodOptions options) {
  const std::string suffix = output_suffix(options.out, mesh_outputs(), options.out_format);
  check_files({options.in}, {options.out, options.report});
  LodOutcome outcome;
  const Stopwatch reading;
  const ProgressiveHull hull = read_hull(options.in);
  outcome.read_seconds = reading.seconds();
  stop_if_interrupted();
  const Stopwatch extracting;
  outcome.level = level_of(hull, options, suffix);
  outcome.extract_seconds = extracting.seconds();
  options.out = path_for(options.out, options.faces > 0 ? options.faces : outcome.level.face_count());
  Outputs outputs;
  outputs.add(options.out, suffix, [&](const auto& file) {
    write_mesh(file, outcome.level);
    outcome.written = read_mesh(file);
    return true;
  });
  const Stopwatch verifying;
  const TriangleMesh finest = hull.original();
  if (!has_triangles_of(outcome.written, finest)) outcome.found = verified(outcome.written, finest, hull.side());
  outcome.verify_seconds = verifying.seconds();
  outcome.side = hull.side();
  outputs.add_report(options.report, report_of(options, hull, outcome));
  outputs.commit();
  print_summary(options, hull, outcome);
  return kDone;
}

}  // namespace

void add_lod(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<LodOptions>(
      app, run, "lod",
      "Extracts a level of a .phull file as a mesh. Every level encloses the solid of the next finer one (of an inner "
      "hull: is enclosed by it), and the finest is the mesh that the hull was built from, bit for bit: the input, or "
      "what was made of it, which is then said. Where the finest level folds over itself, as that of an input with "
      "openings or overlapping parts may, a level can leave some of its faces uncovered. Each level is compared with "
      "the finest one as it is written, and the summary says whether it encloses it.",
      extract);
  add_value(
      command, "in", options.in, "H.phull",
      "File with all levels of a hull, which `prohull build --hierarchy` wrote. With - it is read from standard input.")
      ->required();
  add_mesh_output_options(command, options.out, options.out_format, "the level");
  add_optional_number(
      command, "--faces", options.faces, {0, 1e10},
      "Take the finest level that has at most this number of faces. Without it, the coarsest level is taken.");
  add_choice(command, "--mirror", options.mirror, axis_names(),
             "Take a symmetric level, of a hull that was built with the same option: of two levels that follow each "
             "other, one is at least.");
  add_report_option(command, options.report);
  add_examples(command, {"prohull lod horse.phull --faces 5000 -o level.ply", "prohull lod horse.phull -o base.stl",
                         "prohull lod horse.phull -o - --out-format obj >base.obj"});
}

}  // namespace prohull::cli

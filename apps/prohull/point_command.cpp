#include "point_command.h"

#include <fmt/format.h>

#include "command.h"
#include "paper/engines.h"
#include "prohull/detail/memory.h"
#include "prohull/detail/query_io.h"
#include "prohull/detail/random_segments.h"
#include "prohull/error.h"

namespace prohull::cli {
namespace {

std::vector<Vec3> make_points(const PointOptions& options, const AskedMesh& asked) {
  if (options.points.empty()) {
    require_available(options.random.count, "random points", options.bytes_per_point);
    return random_points(asked.box(), options.random.count, options.random.seed);
  }
  return require_some(read_points(read_bytes(options.points), input_name(options.points)), "points", options.points);
}

/// All but the filter, which needs two hulls: these commands take one.
std::vector<std::string_view> engines() {
  std::vector<std::string_view> names(hull_engine_names().begin(), hull_engine_names().end());
  std::erase(names, name_of(prohull::engine_names(), Engine::Filter));
  return names;
}

}  // namespace

void add_point_options(CLI::App& command, PointOptions& options, const OutputKind& answers) {
  add_mesh_input(command, options.in, options.input, "Mesh or .phull file to ask.");
  add_value(command, "-o,--out", options.out, "FILE",
            fmt::format("File for {}, .npz or .csv. With - they go to standard output. Without this option only the "
                        "summary is printed.",
                        answers.what));
  add_out_format_option(command, options.out_format, answers);
  CLI::App& points = *command.add_option_group(
      "Points", "One of these is required. Files are .npy, .npz or .csv, and - is standard input");
  add_value(points, "--points", options.points, "FILE", "File of points, one a row: x,y,z.");
  add_random_queries(command, points, options.random, "points",
                     "They are spread evenly over the bounding box of the mesh.");
  points.require_option(1);
  add_engine_option(command, options.engine, engines());
  add_threads_option(command, options.threads, "The answers are the same for any number.");
  add_report_option(command, options.report);
}

int run_points(const PointOptions& options, const OutputKind& answers, const AskPoints& ask) {
  const std::string suffix = options.out.empty() ? "" : output_suffix(options.out, answers, options.out_format);
  const std::string points_suffix = options.random.suffix("points");
  check_files({options.in, options.points}, {options.out, options.random.file, options.report});

  QuerySeconds seconds;
  const Stopwatch reading;
  AskedMesh asked(options.in, options.input);
  const std::vector<Vec3> points = make_points(options, asked);
  seconds.read = reading.seconds();
  stop_if_interrupted();
  const Stopwatch indexing;
  if (options.closes) asked.close();
  const SolidNotes notes = options.is_about_inside ? asked.turn_outwards() : SolidNotes{};
  const QueryIndex index = asked.index(options.engine);
  seconds.index = indexing.seconds();
  stop_if_interrupted();
  const Stopwatch asking;
  const PointAnswers found = naming(options.in, BatchOptions{.threads = options.threads},
                                    [&](const auto& how) { return ask(index, points, how); });
  seconds.query = asking.seconds();
  const Stopwatch writing;
  Outputs outputs;
  outputs.add(options.out, suffix, [&](const auto& file) { return found.write(file), true; });
  seconds.write = writing.seconds();
  outputs.add(options.random.file, points_suffix, [&](const auto& file) { return write_points(file, points), true; });

  const double per_second = seconds.query > 0 ? static_cast<double>(points.size()) / seconds.query : 0;
  const unsigned threads = threads_used(options.threads);
  nlohmann::json report = {{"points", points.size()},       {"points_per_second", per_second},
                           {"engine", index.engine_name()}, {"threads", threads},
                           {"seconds", seconds.facts()},    {"input", asked.facts()}};
  if (options.random.count > 0) report["seed"] = options.random.seed;
  report.update(found.facts);
  if (options.is_about_inside) {
    report["input"]["inside_out"] = notes.is_inside_out();
    report["notes"] = notes.all();
  }
  outputs.add_report(options.report, report);
  outputs.commit();
  asked.say_what();
  options.random.say_what("points");
  say("{}{}\n", options.out.empty() ? "" : output_name(options.out) + ": ", found.summary);
  notes.say_them();
  say("  engine {}, {}: {} points per second\n", index.engine_name(), counted(threads, "thread"),
      grouped(static_cast<std::size_t>(per_second)));
  seconds.say_them();
  return kDone;
}

}  // namespace prohull::cli

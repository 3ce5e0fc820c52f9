#include <fmt/format.h>

#include "command.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "prohull/replay.h"

namespace prohull::cli {
namespace {

struct Options {
  std::filesystem::path hull, original, report;
  HullSide side = HullSide::Outer;
};

std::string text(const Vec3& p) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", p.x, p.y, p.z); }

int replay(const Options& options, const ProgressiveHull& hull) {
  const TriangleMesh original = read_input(options.original);
  Stopwatch verifying;
  ProgressLine line("verify");
  const ReplayReport report = verify_replay(hull, original, [&](double fraction) { return line(fraction); });
  if (interrupted()) throw Interrupted{};
  const char* relation = hull.side() == HullSide::Outer ? "encloses" : "is enclosed by";
  if (report.holds)
    fmt::print("yes: every level of {} {} {}; {} splits replayed, {} signs exact, {:.2f} s\n", options.hull.string(),
               relation, options.original.string(), grouped(report.splits), grouped(report.signs), verifying.seconds());
  else
    fmt::print("NO: {} proves nothing about {}: {}\n", options.hull.string(), options.original.string(),
               report.why_not);
  write_report(options.report, {{"hull", options.hull.string()},
                                {"original", options.original.string()},
                                {"encloses", report.holds},
                                {"route", "replay"},
                                {"why_not", report.why_not},
                                {"splits", report.splits},
                                {"signs", report.signs},
                                {"seconds", verifying.seconds()}});
  return report.holds ? kDone : kAnswerIsNo;
}

int compare(const Options& options, const TriangleMesh& hull) {
  TriangleMesh original = read_input(options.original);
  const bool outer = options.side == HullSide::Outer;
  Stopwatch verifying;
  EnclosureReport report;
  {
    ProgressLine line("verify");
    EnclosureOptions enclosure;
    enclosure.progress = [&](double fraction) { return line(fraction); };
    try {
      original = turned_outwards(std::move(original));
      report = outer ? verify_enclosure(original, hull, enclosure) : verify_enclosure(hull, original, enclosure);
    } catch (const Cancelled&) {
      throw Interrupted{};
    } catch (const InputError& error) {
      throw InputError(error.defect(),
                       fmt::format("{} and {}: {}", options.hull.string(), options.original.string(), error.what()));
    }
  }
  const std::string inside = (outer ? options.original : options.hull).string();
  const std::string outside = (outer ? options.hull : options.original).string();
  const double hull_volume = outer ? report.outer_volume : report.inner_volume;
  const double original_volume = outer ? report.inner_volume : report.outer_volume;
  if (report.encloses) {
    fmt::print("yes: {} encloses {}, exactly, {:.2f} s\n", outside, inside, verifying.seconds());
  } else {
    fmt::print("NO: {} does not enclose {}, {:.2f} s\n", outside, inside, verifying.seconds());
    if (report.faces_outside > 0)
      fmt::print("  {} faces of {} lie outside, at least in part; the farthest:\n", grouped(report.faces_outside),
                 inside);
    for (const Offender& o : report.worst)
      fmt::print("    face {} at {}, {:.6g} outside\n", index(o.face), text(o.point), o.distance);
    if (report.cavities > 0 && report.faces_outside == 0)
      fmt::print("  {} cavities inside it are not covered\n", grouped(report.cavities));
  }
  fmt::print("  hull: volume {:.9g}, void {:.3f} %\n", hull_volume, 100 * (hull_volume / original_volume - 1));
  const std::size_t self_intersections = outer ? report.self_intersections : count_self_intersections(hull);
  fmt::print("  {} intersects itself in {} pairs of faces\n", options.hull.string(), grouped(self_intersections));

  nlohmann::json worst = nlohmann::json::array();
  for (const Offender& o : report.worst)
    worst.push_back({{"face", index(o.face)}, {"point", {o.point.x, o.point.y, o.point.z}}, {"distance", o.distance}});
  write_report(options.report, {{"hull", options.hull.string()},
                                {"original", options.original.string()},
                                {"side", outer ? "outer" : "inner"},
                                {"encloses", report.encloses},
                                {"route", "two_meshes"},
                                {"faces_outside", report.faces_outside},
                                {"worst", worst},
                                {"cavities", report.cavities},
                                {"self_intersections", self_intersections},
                                {"void_ratio", hull_volume / original_volume - 1},
                                {"seconds", verifying.seconds()}});
  return report.encloses ? kDone : kAnswerIsNo;
}

int run_verify(const Options& options) {
  const auto hull = read_mesh_or_hull(options.hull);
  const auto* const levels = std::get_if<ProgressiveHull>(&hull);
  return levels ? replay(options, *levels) : compare(options, std::get<TriangleMesh>(hull));
}

}  // namespace

void add_verify(CLI::App& app, Run& run) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "verify",
      "Decide exactly whether a hull encloses a mesh; exits with 1 if it does not. A .phull file is a proof and "
      "is replayed; any two closed mesh files are compared by exact predicates");
  command.add_option("hull", options->hull, "Mesh or .phull file")->required()->type_name("HULL");
  command.add_option("original", options->original, "The mesh that it should enclose")
      ->required()
      ->type_name("ORIGINAL");
  add_choice(command, "--side", options->side, side_names(),
             "inner: decide whether ORIGINAL encloses HULL (a .phull file knows its side)");
  add_report_option(command, options->report);
  add_examples(command, {"prohull verify hull.stl horse.ply", "prohull verify horse.phull horse.ply",
                         "prohull verify occluder.obj rock.obj --side inner"});
  command.callback([options, &run] { run = [options] { return run_verify(*options); }; });
}

}  // namespace prohull::cli

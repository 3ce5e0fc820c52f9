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
  bool every_triangle = false;
};

std::string text(const Vec3& p) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", p.x, p.y, p.z); }

void print_offenders(const EnclosureReport& report, const std::string& mesh) {
  if (report.faces_outside > 0)
    fmt::print("  {} faces of {} lie outside, at least in part; the farthest:\n", grouped(report.faces_outside), mesh);
  for (const Offender& o : report.worst)
    fmt::print("    face {} at {}, {:.6g} outside\n", index(o.face), text(o.point), o.distance);
}

nlohmann::json facts(const std::vector<Offender>& worst) {
  nlohmann::json all = nlohmann::json::array();
  for (const Offender& o : worst)
    all.push_back({{"face", index(o.face)}, {"point", {o.point.x, o.point.y, o.point.z}}, {"distance", o.distance}});
  return all;
}

/// Whether the original bounds a solid; else, or where it is asked for, every triangle of it must be covered.
bool is_solid(const Options& options, HullSide side, const TriangleMesh& original) {
  const bool closed = is_closed(original);
  if (side == HullSide::Inner && options.every_triangle)
    throw InputError(Defect::InvalidOption, "--every-triangle: only an outer hull can cover triangles");
  if (side == HullSide::Inner && !closed)
    throw InputError(Defect::OpenEdge, "the original is not closed: it has no inside that could enclose an inner hull");
  return closed;
}

constexpr const char* kNotClosed = "  {} is not closed: every triangle of it must be covered, no volume\n";

int replay(const Options& options, const ProgressiveHull& hull, const TriangleMesh& original) {
  const std::string name = options.hull.string(), of = options.original.string();
  Stopwatch verifying;
  const bool solid = is_solid(options, hull.side(), original), every_triangle = options.every_triangle || !solid;
  const TriangleMesh finest = every_triangle ? hull.original() : TriangleMesh{};
  ReplayReport report;
  EnclosureReport cover;
  {
    ProgressLine line("verify");
    report = verify_replay(hull, solid ? original : finest, [&](double fraction) { return line(fraction); });
    if (interrupted()) throw Interrupted{};
    if (every_triangle && report.holds)
      cover = verify_cover(original, finest, {.progress = [&](double fraction) { return line(fraction); }});
  }
  const bool holds = report.holds && (!every_triangle || cover.encloses);
  const char* relation = hull.side() == HullSide::Inner ? "is enclosed by"
                         : !solid                       ? "covers every triangle of"
                         : every_triangle               ? "encloses, and covers every triangle of,"
                                                        : "encloses";
  if (holds)
    fmt::print("yes: every level of {} {} {}; {} splits replayed, {} signs exact, {:.2f} s\n", name, relation, of,
               grouped(report.splits), grouped(report.signs), verifying.seconds());
  else if (report.holds)
    fmt::print("NO: the finest level of {} does not cover every triangle of {}, {:.2f} s\n", name, of,
               verifying.seconds());
  else
    fmt::print("NO: {} proves nothing about {}: {}\n", name, of, report.why_not);
  print_offenders(cover, of);
  if (!solid) fmt::print(kNotClosed, of);
  write_report(options.report, {{"hull", name},
                                {"original", of},
                                {"original_closed", solid},
                                {"every_triangle", every_triangle},
                                {"encloses", holds},
                                {"route", "replay"},
                                {"why_not", report.why_not},
                                {"splits", report.splits},
                                {"signs", report.signs},
                                {"faces_outside", cover.faces_outside},
                                {"worst", facts(cover.worst)},
                                {"seconds", verifying.seconds()}});
  return holds ? kDone : kAnswerIsNo;
}

/// The mesh as turned_outwards turns it, and how many faces that were.
std::pair<TriangleMesh, std::size_t> turned(const TriangleMesh& mesh) {
  TriangleMesh result = turned_outwards(mesh);
  std::size_t count = 0;
  for (const FaceId f : mesh.triangles.ids()) count += result.triangles[f] != mesh.triangles[f];
  return {std::move(result), count};
}

int compare(const Options& options, const TriangleMesh& given_hull, const TriangleMesh& given_original) {
  const bool outer = options.side == HullSide::Outer;
  Stopwatch verifying;
  const bool solid = is_solid(options, options.side, given_original);
  const bool every_triangle = options.every_triangle || !solid;
  const auto [hull, turned_of_hull] = turned(given_hull);
  const auto [original, turned_of_original] =
      solid ? turned(given_original) : std::pair{given_original, std::size_t{0}};
  EnclosureReport report;
  {
    ProgressLine line("verify");
    EnclosureOptions enclosure;
    enclosure.progress = [&](double fraction) { return line(fraction); };
    if (solid)
      report = outer ? verify_enclosure(original, hull, enclosure) : verify_enclosure(hull, original, enclosure);
    if (every_triangle && (!solid || report.encloses)) {
      const EnclosureReport cover = verify_cover(original, hull, enclosure);
      report.encloses = cover.encloses;
      report.faces_outside = cover.faces_outside;
      report.worst = cover.worst;
      report.self_intersections = cover.self_intersections;
      report.outer_volume = cover.outer_volume;
    }
  }
  const std::string inside = (outer ? options.original : options.hull).string();
  const std::string outside = (outer ? options.hull : options.original).string();
  const double hull_volume = outer ? report.outer_volume : report.inner_volume;
  const double original_volume = outer ? report.inner_volume : report.outer_volume;
  const char* does = !solid           ? "covers every triangle of"
                     : every_triangle ? "encloses, and covers every triangle of,"
                                      : "encloses";
  const char* does_not = !solid           ? "does not cover every triangle of"
                         : every_triangle ? "does not enclose, or not cover every triangle of,"
                                          : "does not enclose";
  if (report.encloses) {
    fmt::print("yes: {} {} {}, exactly, {:.2f} s\n", outside, does, inside, verifying.seconds());
  } else {
    fmt::print("NO: {} {} {}, {:.2f} s\n", outside, does_not, inside, verifying.seconds());
    print_offenders(report, inside);
    if (report.cavities > 0 && report.faces_outside == 0)
      fmt::print("  {} cavities inside it are not covered\n", grouped(report.cavities));
  }
  if (!solid) fmt::print(kNotClosed, inside);
  for (const auto& [path, count] : {std::pair{options.hull, turned_of_hull}, {options.original, turned_of_original}})
    if (count > 0) fmt::print("  {}: {} faces face inwards and count as turned\n", path.string(), grouped(count));
  if (solid)
    fmt::print("  hull: volume {:.9g}, void {:.3f} %\n", hull_volume, 100 * (hull_volume / original_volume - 1));
  else
    fmt::print("  hull: volume {:.9g}\n", hull_volume);
  const std::size_t self_intersections = outer ? report.self_intersections : count_self_intersections(hull);
  fmt::print("  {} intersects itself in {} pairs of faces\n", options.hull.string(), grouped(self_intersections));

  nlohmann::json facts_found = {{"hull", options.hull.string()},
                                {"original", options.original.string()},
                                {"original_closed", solid},
                                {"every_triangle", every_triangle},
                                {"side", outer ? "outer" : "inner"},
                                {"encloses", report.encloses},
                                {"route", "two_meshes"},
                                {"faces_outside", report.faces_outside},
                                {"worst", facts(report.worst)},
                                {"cavities", report.cavities},
                                {"self_intersections", self_intersections},
                                {"turned_faces", {{"hull", turned_of_hull}, {"original", turned_of_original}}},
                                {"seconds", verifying.seconds()}};
  if (solid) facts_found["void_ratio"] = hull_volume / original_volume - 1;
  write_report(options.report, std::move(facts_found));
  return report.encloses ? kDone : kAnswerIsNo;
}

int run_verify(const Options& options) {
  const auto hull = read_mesh_or_hull(options.hull);
  TriangleMesh original = read_input(options.original, NonFinite::Keep);
  if (const std::size_t dropped = drop_non_finite_faces(original))
    fmt::print("{} faces of {} are not finite and left out\n", grouped(dropped), options.original.string());
  try {
    const auto* const levels = std::get_if<ProgressiveHull>(&hull);
    return levels ? replay(options, *levels, original) : compare(options, std::get<TriangleMesh>(hull), original);
  } catch (const Cancelled&) {
    throw Interrupted{};
  } catch (const InputError& error) {
    throw InputError(error.defect(),
                     fmt::format("{} and {}: {}", options.hull.string(), options.original.string(), error.what()));
  }
}

}  // namespace

void add_verify(CLI::App& app, Run& run) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "verify",
      "Decide exactly whether a hull encloses a mesh; exits with 1 if it does not. A .phull file is a proof and "
      "is replayed; mesh files are compared by exact predicates. Of an original that is not closed, every triangle "
      "must "
      "be covered");
  command.add_option("hull", options->hull, "Mesh or .phull file")->required()->type_name("HULL");
  command.add_option("original", options->original, "The mesh that it should enclose")
      ->required()
      ->type_name("ORIGINAL");
  add_choice(command, "--side", options->side, hull_side_names(),
             "inner: decide whether ORIGINAL encloses HULL (a .phull file knows its side)");
  command.add_flag(
      "--every-triangle", options->every_triangle,
      "Also of a closed original every triangle must be covered, even those of folds and inside-out parts, "
      "which bound no part of the solid");
  add_report_option(command, options->report);
  add_examples(command, {"prohull verify hull.stl horse.ply", "prohull verify horse.phull horse.ply",
                         "prohull verify occluder.obj rock.obj --side inner", "prohull verify hull.stl soup.stl"});
  command.callback([options, &run] { run = [options] { return run_verify(*options); }; });
}

}  // namespace prohull::cli

#include "build_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "certificate_output.h"
#include "prohull/detail/rounded.h"
#include "recenter.h"
#include "verdict.h"

namespace prohull::cli {
namespace {

ToldHull told(const BuildOptions& options, const BuildOutcome& outcome, const Written& written) {
  return {outcome.made, written.hull, options.enclosing, written.measures, outcome.input_self_intersections};
}

void say_all(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) say("  {}\n", line);
}

void print_input(const BuildOptions& options, const BuildOutcome& outcome) {
  say("{}\n", line_of_input(input_name(options.in), outcome.made.input));
  if (options.recenter && outcome.offset == Vec3{})
    say("  not recentered: the mesh is near the origin\n");
  else if (options.recenter)
    say("  recentered: {0} was subtracted from the coordinates; add it to place the hull (verify --offset {0})\n",
        text_of_offset(outcome.offset));
  say_all(lines_of_repairs(outcome.made.input));
}

void print_regions(const BuildOutcome& outcome, const Written& written) {
  for (std::size_t i = 0; i < written.regions.size(); ++i) {
    const Region& region = outcome.regions.all[i];
    const std::string faces = counted(outcome.regions.faces[i].face_count(), "face", "faces");
    if (region.max_distance == 0)
      say("  region {}: {}, kept: the hull has them with the same coordinates\n", region.name, faces);
    else
      say("  region {}: {}, at most {:.4g} from the hull, proven; {}\n", region.name, faces,
          rounded_up(written.regions[i].upper, 4),
          std::isfinite(region.max_distance) ? fmt::format("{:.4g} are allowed", region.max_distance)
                                             : "any distance is allowed");
  }
}

void print_levels(const BuildOptions& options, const BuildOutcome& outcome, const EnclosingHull& hull) {
  say("{}: all levels from {} to {} faces\n", output_name(options.hierarchy), grouped(hull.mesh.face_count()),
      grouped(outcome.solid(hull).mesh.face_count()));
  if (const std::string finest = described_finest_level(finest_level(outcome.made, hull)); !finest.empty())
    say("  its finest level is {}, not the input itself\n", finest);
}

void print_hull(const BuildOptions& options, const BuildOutcome& outcome, const Written& written) {
  const ToldHull hull = told(options, outcome, written);
  say("{}\n", line_of_hull(output_name(written.path), hull));
  if (outcome.written.size() > 1) say_all(written.hull.notes);
  say_all(lines_of_shape(hull));
  print_regions(outcome, written);
  say_all(lines_of_limits(hull));
  if (written.certified() && !options.hierarchy.empty()) print_levels(options, outcome, written.hull);
  say_all(lines_of_proof(written.measures.verdict));
  if (written.certified() && !options.certificate.empty())
    print_certificate(written.certificate_path, written.certificate, {written.path}, options.in);
}

// Without regions and symmetry the report is as it was before there were any.
nlohmann::json facts_of(const RefusalCounts& counts) {
  nlohmann::json json;
  for (const auto& [name, refusal] : refusal_names())
    if ((refusal != Refusal::Tolerance && refusal != Refusal::Symmetry) || counts[refusal] > 0)
      json[std::string(name)] = counts[refusal];
  return json;
}

nlohmann::json options_report(const BuildOptions& options) {
  const HullOptions& hull = options.enclosing.hull;
  const HullBounds& bounds = options.enclosing.bounds;
  nlohmann::json report = {
      {"target_faces", options.faces},
      {"scale", options.input.factor()},
      {"side", name_of(hull_side_names(), hull.side)},
      {"max_distance", finite_or_null(bounds.max_distance)},
      {"max_void_percent", options.max_void_percent > 0 ? nlohmann::json(options.max_void_percent) : nlohmann::json()},
      {"padding", options.enclosing.padding},
      {"repair", name_of(repair_names(), options.enclosing.repair)},
      {"keep_cavities", options.enclosing.keep_cavities},
      {"open_shells", name_of(open_shells_names(), options.enclosing.open_shells)},
      {"seal_holes", options.enclosing.seal_holes},
      {"tight", options.enclosing.tight},
      {"strategy", name_of(strategy_names(), hull.strategy)},
      {"max_valence", hull.guards.max_valence},
      {"min_compactness_ratio", hull.guards.min_compactness_ratio},
      {"sufficient_compactness", hull.guards.sufficient_compactness},
      {"max_normal_deviation_degrees", options.normal_deviation_degrees},
      {"max_overhang", hull.guards.max_overhang},
      {"self_intersections", options.enclosing.tight || hull.refuses_self_intersections() ? "refused" : "allowed"},
      {"relax_guards", hull.relax_guards},
      {"seed", hull.seed},
      {"best_of", options.enclosing.best_of},
      {"float32_coordinates", hull.float32_coordinates}};
  if (hull.mirror) report["mirror"] = name_of(axis_names(), *hull.mirror);
  return report;
}

nlohmann::json regions_report(const BuildOutcome& outcome, const Written& written) {
  nlohmann::json regions = nlohmann::json::array();
  for (std::size_t i = 0; i < written.regions.size(); ++i) {
    const Region& region = outcome.regions.all[i];
    regions.push_back({{"name", region.name},
                       {"faces", outcome.regions.faces[i].face_count()},
                       {"kept", region.max_distance == 0},
                       {"max_distance", finite_or_null(region.max_distance)},
                       {"distance_bound", written.regions[i].upper}});
  }
  return regions;
}

std::string_view why_stopped(const EnclosingHull& hull) {
  return hull.mesh.face_count() <= hull.target_faces ? "target_reached"
         : hull.target_reached                       ? "bounds_reached"
                                                     : "no_legal_collapse";
}

nlohmann::json hull_report(const BuildOptions& options, const BuildOutcome& outcome, const Written& written) {
  const EnclosingHull& hull = written.hull;
  nlohmann::json report = facts(hull);
  report.update(
      nlohmann::json{{"path", written.path.string()},
                     {"void_is_estimated", outcome.made.is_estimated},
                     {"wrap_spacing", hull.source == Source::Wrap ? nlohmann::json(outcome.solid(hull).wrap_spacing)
                                                                  : nlohmann::json()},
                     {"folds", facts(outcome.solid(hull).folds)},
                     {"added_self_intersections", told(options, outcome, written).added_self_intersections()},
                     {"quality", facts(written.measures.quality)},
                     {"rounded_vertices", hull.rounded_vertices},
                     {"verdict", facts(written.measures.verdict)},
                     {"relaxed_guards", hull.relaxed_guards},
                     {"stopped", why_stopped(hull)},
                     {"within_bounds", hull.within_bounds},
                     {"excess", finite_or_null(hull.excess)},
                     {"refusals", facts_of(hull.refusals)},
                     {"blocked", facts_of(hull.blocked)}});
  if (!written.regions.empty()) report["regions"] = regions_report(outcome, written);
  return report;
}

std::string repair_of(const BuildOutcome& outcome) {
  const auto is_of_wrap = [](const Written& written) { return written.hull.source == Source::Wrap; };
  return std::ranges::any_of(outcome.written, is_of_wrap) ? "wrap"
         : outcome.made.input.repairs.any()               ? "repaired"
                                                          : "none";
}

/// The notes of all hulls, each once.
std::vector<std::string> notes_of(const BuildOutcome& outcome) {
  std::vector<std::string> notes;
  for (const Written& written : outcome.written)
    for (const std::string& note : written.hull.notes)
      if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
  return notes;
}

/// Of all hulls.
struct Seconds {
  double build = 0, write = 0, verify = 0;
};

Seconds seconds_of(const BuildOutcome& outcome) {
  Seconds all;
  for (const Written& w : outcome.written)
    all.build += w.hull.build_seconds, all.write += w.write_seconds, all.verify += w.hull.verify_seconds;
  return all;
}

/// What the ladder looked at before it chose: docs/repair.md.
void print_search(const BuildOutcome& outcome) {
  for (const Solid& solid : outcome.made.solids)
    say_more("  tried {}: {}, {} of its faces intersecting\n", source_of(solid),
             counted(solid.mesh.face_count(), "face", "faces"), counted(solid.self_intersections, "pair", "pairs"));
  for (const Written& written : outcome.written) {
    say_more("  {}: built in {:.2f} s, verified in {:.2f} s by {}\n", output_name(written.path),
             written.hull.build_seconds, written.hull.verify_seconds,
             written.hull.certified ? written.hull.verdict.proof : "nothing");
    if (const std::string refused = describe_refusals(written.hull.refusals); !refused.empty())
      say_more("    collapses refused on the way: {}\n", refused);
  }
}

std::string table_row(const auto& cells) {
  return fmt::format("{:>11}  {:>9}  {:>8}  {:>9}  {}", cells[0], cells[1], cells[2], cells[3], cells[4]);
}

}  // namespace

void print_summary(const BuildOptions& options, const BuildOutcome& outcome) {
  print_input(options, outcome);
  if (outcome.written.size() == 1) say_all(outcome.written.front().hull.notes);
  for (const Written& written : outcome.written) print_hull(options, outcome, written);
  const Seconds seconds = seconds_of(outcome);
  say("  read {:.2f} s, {}build {:.2f} s, write {:.2f} s, verify {:.2f} s\n", outcome.read_seconds,
      outcome.made.repair_seconds >= 0.005 ? fmt::format("repair {:.2f} s, ", outcome.made.repair_seconds) : "",
      seconds.build, seconds.write, seconds.verify);
  print_search(outcome);
}

std::string table_head() { return table_row(kTableHead); }

std::vector<std::string> table_rows(const BuildOptions& options, const BuildOutcome& outcome) {
  std::vector<std::string> rows;
  for (const Written& written : outcome.written)
    rows.push_back(table_row(cells_of_hull(told(options, outcome, written), written.measures.verdict)));
  return rows;
}

nlohmann::json report_of(const BuildOptions& options, const BuildOutcome& outcome) {
  nlohmann::json in = facts(outcome.made.input.found);
  in["path"] = options.in.string();
  in["repair"] = repair_of(outcome);
  in["repairs"] = describe(outcome.made.input.repairs);
  in["obstacle"] = outcome.made.input.obstacle;
  in["offset"] = outcome.offset;
  in["notes"] = notes_of(outcome);
  in["self_intersections"] = count_self_intersections(outcome.made.input.original);
  in["repaired_self_intersections"] = outcome.input_self_intersections;
  const nlohmann::json hulls =
      json_list(outcome.written, [&](const Written& written) { return hull_report(options, outcome, written); });
  const Seconds seconds = seconds_of(outcome);
  return {{"input", in},
          {"hull", hulls.back()},
          {"hulls", hulls},
          {"certified", std::ranges::all_of(outcome.written, &Written::certified)},
          {"stopped", hulls.back()["stopped"]},
          {"refusals", hulls.back()["refusals"]},
          {"blocked", hulls.back()["blocked"]},
          {"seconds",
           {{"read", outcome.read_seconds},
            {"repair", outcome.made.repair_seconds},
            {"build", seconds.build},
            {"write", seconds.write},
            {"verify", seconds.verify}}},
          {"options", options_report(options)}};
}

}  // namespace prohull::cli

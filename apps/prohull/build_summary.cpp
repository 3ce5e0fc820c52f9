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

std::string source_of(const Solid& solid) {
  switch (solid.source) {
    case Source::Mesh:
      return "the mesh";
    case Source::ConvexHull:
      return "the convex hull";
    default:
      return fmt::format("a wrap with a spacing of {:.4g}", solid.wrap_spacing);
  }
}

/// Not what it is made of: repairs change the mesh, and the convex hull may have become a slab, or a polytope of fewer
/// faces around it.
std::string solid_name(const BuildOutcome& outcome, const Solid& solid) {
  if (solid.source == Source::ConvexHull) return "the convex solid that it is built from";
  const bool is_changed = outcome.made.input.repairs.any() || solid.folds.faces > 0;
  return solid.source == Source::Mesh && is_changed ? "the repaired mesh" : source_of(solid);
}

std::size_t added_self_intersections(const BuildOutcome& outcome, const EnclosingHull& hull) {
  return hull.self_intersections - std::min(hull.self_intersections, outcome.input_self_intersections);
}

std::string described_self_intersections(const BuildOutcome& outcome, const EnclosingHull& hull) {
  const std::size_t input = outcome.input_self_intersections;
  const Solid& first = outcome.made.solids.front();  // what was looked at, if it is of the mesh
  const std::string mesh = first.source == Source::Mesh ? solid_name(outcome, first) : "the mesh";
  if (hull.self_intersections == 0)
    return input == 0 ? "none" : fmt::format("none ({}: {})", mesh, counted(input, "pair of faces", "pairs of faces"));
  return fmt::format("{} ({}: {}; added: {})", counted(hull.self_intersections, "pair of faces", "pairs of faces"),
                     mesh, grouped(input), grouped(added_self_intersections(outcome, hull)));
}

void print_input(const BuildOptions& options, const BuildOutcome& outcome) {
  say("{}: {}, {}\n", input_name(options.in), counted(outcome.made.input.found.faces, "face", "faces"),
      counted(outcome.made.input.found.components, "component", "components"));
  if (options.recenter && outcome.offset == Vec3{})
    say("  not recentered: the mesh is near the origin\n");
  else if (options.recenter)
    say("  recentered: {0} was subtracted from the coordinates; add it to place the hull (verify --offset {0})\n",
        text_of_offset(outcome.offset));
  for (const std::string& repair : describe(outcome.made.input.repairs)) say("  {}\n", repair);
  if (!outcome.made.input.closed) say("  bounds no solid: {}\n", outcome.made.input.obstacle);
  for (const std::string& note : outcome.written.back().hull.notes) say("  {}\n", note);
}

// What no collapse changes. A closed surface with h handles has an Euler characteristic of 2 - 2 h.
std::string described_topology(const TriangleMesh& hull) {
  const MeshReport report = inspect(hull);
  const auto handles = static_cast<std::size_t>(static_cast<long>(report.components) - report.euler_characteristic / 2);
  return fmt::format("{} and {}", counted(report.components, "component", "components"),
                     counted(handles, "handle", "handles"));
}

void print_regions(const BuildOutcome& outcome, const Written& written) {
  for (std::size_t i = 0; i < written.regions.size(); ++i) {
    const Region& region = outcome.regions.all[i];
    const std::string faces = counted(outcome.regions.faces[i].face_count(), "face", "faces");
    if (region.max_distance == 0)
      say("  region {}: {}, kept: the hull has them with the same coordinates\n", region.name, faces);
    else
      say("  region {}: {}, at most {:.4g} from the hull, proven; {:.4g} are allowed\n", region.name, faces,
          rounded_up(written.regions[i].upper, 4), region.max_distance);
  }
}

void print_hull(const BuildOptions& options, const BuildOutcome& outcome, const Written& written) {
  const EnclosingHull& hull = written.hull;
  const std::size_t faces = hull.mesh.face_count();
  say("{}: {} hull of {}{}{}, at most {:.4g} from the mesh{}\n", output_name(written.path),
      options.is_outer() ? "outer" : "inner", counted(faces, "face", "faces"),
      hull.source == Source::Mesh ? "" : fmt::format(", of {}", source_of(outcome.solid(hull))),
      described_void(outcome.made, hull), rounded_up(written.to_solid.upper, 4),
      text_of_openings(written.has_openings, written.to_triangles));
  say("  self-intersections: {}\n", described_self_intersections(outcome, hull));
  say("  triangles: {}\n", described(written.quality));
  if (faces == outcome.solid(hull).mesh.face_count() && faces <= hull.target_faces)
    say("  {} has no more faces than were asked for: the hull is {}\n", solid_name(outcome, outcome.solid(hull)),
        hull.source == Source::Mesh && hull.mesh == outcome.solid(hull).mesh
            ? solid_name(outcome, outcome.solid(hull)) + " itself"
            : "simplified no further");
  print_regions(outcome, written);
  if (const auto axis = options.enclosing.hull.mirror)
    say("  symmetric: exactly its own mirror image in the plane {} = {:g}\n", name_of(axis_names(), *axis),
        inspect_symmetry(hull.mesh, *axis).plane);
  if (hull.rounded_vertices > 0)
    say("  moved {} to coordinates that the file keeps\n", counted(hull.rounded_vertices, "vertex", "vertices"));
  if (hull.relaxed_guards > 0)
    say("  shape guards relaxed to reach it: normals may turn by {:.0f} degrees{}, step {} of {}\n",
        kRelaxedGuards[hull.relaxed_guards - 1].max_normal_deviation / kDegree,
        std::isfinite(kRelaxedGuards[hull.relaxed_guards - 1].max_overhang) ? "" : " and spikes are allowed",
        hull.relaxed_guards, kRelaxedGuards.size());
  if (!hull.target_reached)
    say("  no legal collapse is left above the {} faces asked for: {}; of the {} edges left, {}\n",
        grouped(hull.target_faces), described_topology(hull.mesh), grouped(3 * faces / 2),
        describe_refusals(hull.blocked));
  if (!hull.within_bounds)
    say("  NOT within the bounds asked for: of all that was tried, this hull misses them least, by {:.3g} %; allow "
        "that "
        "much, or mend the mesh where it is open or intersects itself\n",
        rounded_up(100 * (hull.excess - 1), 3));
  if (written.certified && !options.hierarchy.empty())
    say("{}: all levels from {} to {} faces\n", output_name(options.hierarchy), grouped(faces),
        grouped(outcome.solid(hull).mesh.face_count()));
  if (const std::string finest = described_finest_level(finest_level(outcome.made, hull));
      written.certified && !options.hierarchy.empty() && !finest.empty())
    say("  its finest level is {}, not the input itself\n", finest);
  say("  certified: {}\n", certificate_of(outcome.made, hull, written.certified));
  if (written.certified && hull.padding > 0)
    say("  gap: the least distance from the mesh is at least {:.6g}, proven{}\n", rounded_down(hull.padding, 6),
        options.is_outer() ? "; all points within it are inside" : "");
  if (written.certified && !options.certificate.empty())
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
      {"best_of", hull.best_of},
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

nlohmann::json facts_of_hull(const BuildOutcome& outcome, const Written& written) {
  const EnclosingHull& hull = written.hull;
  return {{"path", written.path.string()},
          {"target_faces", hull.target_faces},
          {"faces", hull.mesh.face_count()},
          {"vertices", hull.mesh.vertex_count()},
          {"volume", signed_volume(hull.mesh)},
          {"void_ratio", finite_or_null(hull.void_ratio)},
          {"void_is_estimated", outcome.made.is_estimated},
          {"source", name_of(source_names(), hull.source)},
          {"wrap_spacing",
           hull.source == Source::Wrap ? nlohmann::json(outcome.solid(hull).wrap_spacing) : nlohmann::json()},
          {"folds", facts(outcome.solid(hull).folds)},
          {"distance_bound", written.to_solid.upper},
          {"distance_to_solid", facts(written.to_solid)},
          {"distance_to_triangles", facts(written.to_triangles)},
          {"self_intersections", hull.self_intersections},
          {"added_self_intersections", added_self_intersections(outcome, hull)},
          {"quality", facts(written.quality)},
          {"rounded_vertices", hull.rounded_vertices},
          {"certified", written.certified},
          {"proof", std::string(hull.proof)},
          {"verdict", facts(hull.verdict)},
          {"padding", hull.padding},
          {"relaxed_guards", hull.relaxed_guards},
          {"stopped", hull.target_reached ? "target_reached" : "no_legal_collapse"},
          {"within_bounds", hull.within_bounds},
          {"excess", finite_or_null(hull.excess)},
          {"refusals", facts_of(hull.refusals)},
          {"blocked", facts_of(hull.blocked)}};
}

nlohmann::json hull_report(const BuildOutcome& outcome, const Written& written) {
  nlohmann::json report = facts_of_hull(outcome, written);
  if (!written.regions.empty()) report["regions"] = regions_report(outcome, written);
  return report;
}

std::string repair_of(const BuildOutcome& outcome) {
  const auto is_of_wrap = [](const Written& written) { return written.hull.source == Source::Wrap; };
  return std::ranges::any_of(outcome.written, is_of_wrap) ? "wrap"
         : outcome.made.input.repairs.any()               ? "repaired"
                                                          : "none";
}

template <class Value>
double total(const std::vector<Written>& written, Value value) {
  double sum = 0;
  for (const Written& w : written) sum += value(w);
  return sum;
}

double build_seconds(const BuildOutcome& outcome) {
  return total(outcome.written, [](const Written& w) { return w.hull.build_seconds; });
}
double verify_seconds(const BuildOutcome& outcome) {
  return total(outcome.written, [](const Written& w) { return w.hull.verify_seconds; });
}
double write_seconds(const BuildOutcome& outcome) {
  return total(outcome.written, [](const Written& w) { return w.write_seconds; });
}

/// What the ladder looked at before it chose: docs/repair.md.
void print_search(const BuildOutcome& outcome) {
  for (const Solid& solid : outcome.made.solids)
    say_more("  tried {}: {}, {} of its faces intersecting\n",
             solid.source == Source::ConvexHull ? "a convex solid" : source_of(solid),
             counted(solid.mesh.face_count(), "face", "faces"), counted(solid.self_intersections, "pair", "pairs"));
  for (const Written& written : outcome.written) {
    say_more("  {}: built in {:.2f} s, verified in {:.2f} s by {}\n", output_name(written.path),
             written.hull.build_seconds, written.hull.verify_seconds,
             written.hull.proof.empty() ? "nothing" : written.hull.proof);
    if (const std::string refused = describe_refusals(written.hull.refusals); !refused.empty())
      say_more("    collapses refused on the way: {}\n", refused);
  }
}

}  // namespace

void print_summary(const BuildOptions& options, const BuildOutcome& outcome) {
  print_input(options, outcome);
  for (const Written& written : outcome.written) print_hull(options, outcome, written);
  say("  read {:.2f} s, {}build {:.2f} s, write {:.2f} s, verify {:.2f} s\n", outcome.read_seconds,
      outcome.made.repair_seconds >= 0.005 ? fmt::format("repair {:.2f} s, ", outcome.made.repair_seconds) : "",
      build_seconds(outcome), write_seconds(outcome), verify_seconds(outcome));
  print_search(outcome);
}

std::string table_head() {
  return fmt::format("{:>11}  {:>9}  {:>8}  {:>9}  {}", "faces", "hull", "void", "distance", "certified");
}

std::vector<std::string> table_rows(const BuildOutcome& outcome) {
  std::vector<std::string> rows;
  for (const Written& written : outcome.written)
    rows.push_back(
        fmt::format("{:>11}  {:>9}  {:>8}  {:>9.4g}  {}", grouped(outcome.made.input.found.faces),
                    grouped(written.hull.mesh.face_count()),
                    std::isnan(written.hull.void_ratio) ? "" : fmt::format("{:.2f} %", 100 * written.hull.void_ratio),
                    rounded_up(written.to_solid.upper, 4),
                    !written.certified            ? "NO"
                    : !written.hull.within_bounds ? "yes, NOT within the bounds"
                                                  : "yes"));
  return rows;
}

nlohmann::json report_of(const BuildOptions& options, const BuildOutcome& outcome) {
  nlohmann::json in = facts(outcome.made.input.found);
  in["path"] = options.in.string();
  in["repair"] = repair_of(outcome);
  in["repairs"] = describe(outcome.made.input.repairs);
  in["obstacle"] = outcome.made.input.obstacle;
  in["offset"] = {outcome.offset.x, outcome.offset.y, outcome.offset.z};
  in["notes"] = outcome.written.back().hull.notes;
  in["self_intersections"] = outcome.input_self_intersections;
  nlohmann::json hulls = nlohmann::json::array();
  for (const Written& written : outcome.written) hulls.push_back(hull_report(outcome, written));
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
            {"build", build_seconds(outcome)},
            {"write", write_seconds(outcome)},
            {"verify", verify_seconds(outcome)}}},
          {"options", options_report(options)}};
}

}  // namespace prohull::cli

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "command.h"
#include "loose_hull.h"
#include "machine.h"
#include "models.h"
#include "paper/engines.h"
#include "prohull/detail/random_segments.h"
#include "prohull/detail/replay.h"
#include "prohull/mesh_query.h"
#include "strategies.h"
#include "table.h"

namespace prohull::bench {
namespace {

// P&T 4.1: looser and stricter parameters than the paper's. P&T 5: looser places for new vertices. What becomes of the
// void, of the time and of queries.

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kTimedFaces = 2000, kFewFaces = 200;

struct NamedGuards {
  std::string_view name;
  ShapeGuards guards;
};
constexpr double kNoLimit = std::numeric_limits<double>::infinity();  // of overhang: there is none in the paper
constexpr std::array kGuards{
    NamedGuards{"the paper's", {.max_overhang = kNoLimit}},
    NamedGuards{"valence 8", {.max_valence = 8, .max_overhang = kNoLimit}},
    NamedGuards{"valence 16", {.max_valence = 16, .max_overhang = kNoLimit}},
    NamedGuards{"valence 32", {.max_valence = 32, .max_overhang = kNoLimit}},
    NamedGuards{"compactness 0.95", {.min_compactness_ratio = 0.95, .max_overhang = kNoLimit}},
    NamedGuards{"compactness 0.5", {.min_compactness_ratio = 0.5, .max_overhang = kNoLimit}},
    NamedGuards{"compactness 0", {.min_compactness_ratio = 0, .max_overhang = kNoLimit}},
    NamedGuards{"deviation pi/8", {.max_normal_deviation = kPi / 8, .max_overhang = kNoLimit}},
    NamedGuards{"deviation pi/3", {.max_normal_deviation = kPi / 3, .max_overhang = kNoLimit}},
    NamedGuards{"deviation pi/2", {.max_normal_deviation = kPi / 2, .max_overhang = kNoLimit}},
    NamedGuards{
        "all looser",
        {.max_valence = 32, .min_compactness_ratio = 0, .max_normal_deviation = kPi / 2, .max_overhang = kNoLimit}},
};

struct NamedRule {
  std::string_view name;
  PlacementRule rule;
};
constexpr std::array kRules{NamedRule{"linear program", by_linear_program}, NamedRule{"best lifted", best_lifted},
                            NamedRule{"lifted centre", lifted_center}, NamedRule{"lifted midpoint", lifted_midpoint}};

struct LooserOptions {
  ModelOptions models;
  std::size_t segments = 10000, rounds = 3;
  std::filesystem::path out;
};

struct LooserVariant {
  std::string_view experiment, strategy, name;
  std::function<ProgressiveHull(std::size_t target_faces)> build;
};

/// Of one variant; those of the query are for each segment, from kTimedFaces.
struct HullFacts {
  std::string mesh;
  std::size_t faces = 0;
  LooserVariant variant;
  double seconds = std::numeric_limits<double>::infinity();        ///< to kTimedFaces
  double void_percent = kUnknown, void_percent_of_few = kUnknown;  ///< at kTimedFaces and kFewFaces, if reached
  std::size_t fewest_faces = 0;
  double microseconds = std::numeric_limits<double>::infinity(), tests = 0, splits = 0;
  bool certified = false;
};

std::vector<LooserVariant> variants(const TriangleMesh& mesh) {
  constexpr std::array kPapers{kStrategies[0], kStrategies[1]};
  std::vector<LooserVariant> all;
  for (const NamedStrategy& s : kPapers)
    for (const NamedGuards& g : kGuards)
      all.push_back({"parameters", s.name, g.name, [&mesh, s, g](std::size_t target_faces) {
                       HullOptions options = hull_options(s.strategy, target_faces);
                       options.guards = g.guards;
                       return build_hull(mesh, options).hull;
                     }});
  for (const NamedStrategy& s : kPapers)
    for (const NamedRule& r : kRules)
      all.push_back({"positions", s.name, r.name, [&mesh, s, r](std::size_t target_faces) {
                       return loose_hull(mesh, s.strategy, r.rule, target_faces);
                     }});
  return all;
}

void judge(const TriangleMesh& mesh, HullFacts& facts) {
  const ProgressiveHull hull = facts.variant.build(4);
  const double volume = signed_volume(mesh);
  const auto void_at = [&](std::size_t faces) {
    return hull.base_face_count() <= faces ? void_percent(hull.level(faces), volume) : kUnknown;
  };
  facts.void_percent = void_at(kTimedFaces), facts.void_percent_of_few = void_at(kFewFaces);
  facts.fewest_faces = hull.base_face_count();
  facts.certified = verify_replay(hull, mesh).holds;
}

std::vector<HullFacts> measure(const ModelSource& source, const LooserOptions& options) {
  const TriangleMesh mesh = load(source);
  const std::size_t count = source.is_record_sample ? 1000 : options.segments;
  const auto segments = random_segments(bounding_box(mesh), count, 1);
  fmt::print(stderr, "{}: {} faces", source.name, mesh.face_count());
  std::vector<HullFacts> all;
  for (LooserVariant& variant : variants(mesh))
    all.push_back({.mesh = source.name, .faces = mesh.face_count(), .variant = std::move(variant)});
  for (std::size_t round = 0; round < options.rounds; ++round) {
    for (HullFacts& facts : all) {
      std::optional<ProgressiveHull> hull;
      facts.seconds = std::min(facts.seconds, seconds_of([&] { hull = facts.variant.build(kTimedFaces); }));
      MeshQuery query{prohull::index_called("paper-refinement", *hull)};
      const double seconds = seconds_of([&] {
        for (const Segment& s : segments) query.all_hits(s);
      });
      const auto each = [&](auto sum) { return static_cast<double>(sum) / static_cast<double>(count); };
      facts.microseconds = std::min(facts.microseconds, 1e6 * each(seconds));
      facts.tests = each(query.counts().tests), facts.splits = each(query.counts().splits);
    }
    fmt::print(stderr, ", round {}", round + 1);
  }
  for (HullFacts& facts : all) judge(mesh, facts);
  fmt::print(stderr, "\n");
  return all;
}

std::string text_of(const std::vector<HullFacts>& all, std::string_view experiment) {
  Table table({"model", "strategy", experiment == "parameters" ? "parameters" : "position", "time", "void at 2000",
               "void at 200", "ends at", "query", "tests", "splits"});
  for (const HullFacts& f : all)
    if (f.variant.experiment == experiment)
      table.add({f.mesh, std::string(f.variant.strategy), std::string(f.variant.name), number(f.seconds, 3, " s"),
                 number(f.void_percent, 2, " %"), number(f.void_percent_of_few, 1, " %"),
                 fmt::to_string(f.fewest_faces), number(f.microseconds, 1, " us"), number(f.tests, 0),
                 number(f.splits, 0)});
  return table.markdown();
}

std::string csv_of(const std::vector<HullFacts>& all) {
  Table table({"mesh", "faces", "experiment", "strategy", "variant", "seconds", "void_percent_at_2000",
               "void_percent_at_200", "fewest_faces", "query_us_per_segment", "tests", "splits", "certified"});
  for (const HullFacts& f : all)
    table.add({f.mesh, fmt::to_string(f.faces), std::string(f.variant.experiment), std::string(f.variant.strategy),
               std::string(f.variant.name), number(f.seconds, 4), number(f.void_percent, 4),
               number(f.void_percent_of_few, 4), fmt::to_string(f.fewest_faces), number(f.microseconds, 2),
               number(f.tests, 1), number(f.splits, 1), f.certified ? "yes" : "no"});
  return table.csv();
}

int run_looser(const LooserOptions& options) {
  std::vector<HullFacts> all;
  const std::vector<Refused> refused = measure_each(options.models, [&](const ModelSource& source) {
    for (HullFacts& facts : measure(source, options)) all.push_back(std::move(facts));
  });
  const std::string text = fmt::format(
      "# Looser hulls\n\n{}; processor time of one thread, best of {}: to {} faces, and of a query of these with a "
      "random segment\n\n## Parameters (P&T 4.1)\n\n{}\n## Positions (P&T 5)\n\n{}\n{}",
      machine(), options.rounds, kTimedFaces, text_of(all, "parameters"), text_of(all, "positions"), listed(refused));
  publish(options.out, "looser", text, csv_of(all));
  return std::ranges::all_of(all, &HullFacts::certified) ? kDone : kAnswerIsNo;
}

}  // namespace

void add_looser(CLI::App& app, Run& run) {
  const auto options = std::make_shared<LooserOptions>();
  CLI::App& command =
      *app.add_subcommand("looser", "Other parameters than the paper's (4.1), and looser positions (5)");
  add_model_options(command, options->models);
  command.add_option("--segments", options->segments, "Random segments for each hull")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_rounds_option(command, options->rounds);
  add_out_option(command, options->out, "looser.md and looser.csv");
  command.callback([options, &run] { run = [options] { return run_looser(*options); }; });
}

}  // namespace prohull::bench

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "command.h"
#include "machine.h"
#include "models.h"
#include "paper_tables.h"
#include "peers.h"
#include "prohull/detail/replay.h"
#include "prohull/enclosure.h"
#include "prohull/hull_builder.h"
#include "strategies.h"
#include "table.h"

namespace prohull::bench {
namespace {

// P&T Tables 1 and 2 with the paper's parameters, our own strategy beside the paper's two, and a peer beside ours.

struct Variant {
  Strategy strategy;
  SelfIntersections intersections;
  std::string_view name;
};
// The paper does not look for self-intersections; our default refuses them.
constexpr std::array kTimed{Variant{Strategy::Paper1, SelfIntersections::Allowed, "paper1"},
                            Variant{Strategy::Paper2, SelfIntersections::Allowed, "paper2"},
                            Variant{Strategy::Lazy, SelfIntersections::Refused, "lazy"},
                            Variant{Strategy::Lazy, SelfIntersections::Allowed, "lazy unguarded"}};
constexpr std::size_t kPaper1 = 0, kPaper2 = 1, kLazy = 2, kUnguarded = 3;

HullOptions hull_options(const Variant& variant, std::size_t faces) {
  HullOptions options = bench::hull_options(variant.strategy, faces);
  options.self_intersections = variant.intersections;
  return options;
}

struct ConstructionOptions {
  ModelOptions models;
  std::vector<std::size_t> hull_faces{2000, 200};  ///< descending; the first is the one that is timed
  std::size_t rounds = 3;
  std::filesystem::path out;
};

struct VariantFacts {
  double seconds = std::numeric_limits<double>::infinity();  ///< to the first of hull_faces, best of the rounds
  std::size_t collapses = 0, linear_programs = 0;            ///< in that time
  std::vector<double> void_percent;                          ///< at hull_faces; kUnknown where not reached
  std::size_t fewest_faces = 0;
  bool certified = false;

  double linear_programs_per_collapse() const {
    return static_cast<double>(linear_programs) / static_cast<double>(collapses);
  }
};

struct ConstructionFacts {
  std::string name;
  std::size_t faces = 0;
  const PaperModel* paper = nullptr;
  std::array<VariantFacts, kTimed.size()> of;  ///< by the order of kTimed
  std::optional<PeerRun> peer;                 ///< best of the rounds
};

void time_variant(const TriangleMesh& mesh, const Variant& variant, std::size_t faces, VariantFacts& facts) {
  std::optional<HullResult> result;
  facts.seconds = std::min(facts.seconds, seconds_of([&] { result = build_hull(mesh, hull_options(variant, faces)); }));
  facts.collapses = result->hull.splits().size();
  facts.linear_programs = result->linear_programs;
}

void time_peer(const TriangleMesh& mesh, std::size_t faces, std::optional<PeerRun>& best) {
  const auto run = run_garland_heckbert(mesh, faces);
  if (run && (!best || run->seconds < best->seconds)) best = run;
}

// One hull down to the last of hull_faces holds all others; it is the whole of the proof but for the first, which is
// also compared with the original by the exact verifier, which knows nothing of hulls.
void judge_fit(const TriangleMesh& mesh, const Variant& variant, const ConstructionOptions& options,
               VariantFacts& facts) {
  const ProgressiveHull hull = build_hull(mesh, hull_options(variant, options.hull_faces.back())).hull;
  const double volume = signed_volume(mesh);
  facts.fewest_faces = hull.base_face_count();
  for (const std::size_t faces : options.hull_faces) {
    const TriangleMesh level = hull.level(faces);
    facts.void_percent.push_back(level.face_count() <= faces ? void_percent(level, volume) : kUnknown);
  }
  facts.certified =
      verify_replay(hull, mesh).holds && verify_enclosure(mesh, hull.level(options.hull_faces.front())).encloses;
}

ConstructionFacts measure(const ModelSource& source, const ConstructionOptions& options) {
  const TriangleMesh mesh = load(source);
  fmt::print(stderr, "{}: {} faces", source.name, mesh.face_count());
  ConstructionFacts facts{.name = source.name,
                          .faces = mesh.face_count(),
                          .paper = paper_model(source.name, mesh.face_count()),
                          .of = {},
                          .peer = {}};
  const std::size_t faces = options.hull_faces.front();
  for (std::size_t round = 0; round < options.rounds; ++round) {
    for (std::size_t i = 0; i < kTimed.size(); ++i) time_variant(mesh, kTimed[i], faces, facts.of[i]);
    time_peer(mesh, faces, facts.peer);
    fmt::print(stderr, ", round {}", round + 1);
  }
  for (std::size_t i = 0; i < kTimed.size(); ++i) {
    judge_fit(mesh, kTimed[i], options, facts.of[i]);
    fmt::print(stderr, ", {} {}", kTimed[i].name, facts.of[i].certified ? "certified" : "NOT CERTIFIED");
  }
  fmt::print(stderr, "\n");
  return facts;
}

// A hull that ends before the size asked for says so beside its time.
std::string time_taken(const VariantFacts& s) {
  const bool reached = !std::isnan(s.void_percent.front());
  return number(s.seconds, 3, " s") + (reached ? "" : fmt::format(" (ends at {})", s.fewest_faces));
}

double papers_void(const ConstructionFacts& m, Strategy strategy, std::size_t hull_faces) {
  return m.paper ? m.paper->void_percent(strategy, hull_faces).value_or(kUnknown) : kUnknown;
}

double papers_seconds(const ConstructionFacts& m, Strategy strategy, std::size_t hull_faces) {
  return m.paper ? m.paper->seconds_of(strategy, hull_faces).value_or(kUnknown) : kUnknown;
}

std::string construction_times(const std::vector<ConstructionFacts>& models, std::size_t faces) {
  Table table({"model", "faces", "paper1", "paper2", "paper1 / paper2", "paper's 1st", "paper's 2nd",
               "paper's 1st / 2nd", "lazy", "lazy unguarded"});
  for (const ConstructionFacts& m : models) {
    const double first = papers_seconds(m, Strategy::Paper1, faces),
                 second = papers_seconds(m, Strategy::Paper2, faces);
    table.add({m.name, fmt::to_string(m.faces), time_taken(m.of[kPaper1]), time_taken(m.of[kPaper2]),
               number(m.of[kPaper1].seconds / m.of[kPaper2].seconds, 2), number(first, 0, " s"),
               number(second, 0, " s"), number(first / second, 2), time_taken(m.of[kLazy]),
               time_taken(m.of[kUnguarded])});
  }
  return fmt::format("## Table 1: time to a hull of {} faces\n\n{}\n", faces, table.markdown());
}

std::string voids(const std::vector<ConstructionFacts>& models, const std::vector<std::size_t>& hull_faces) {
  Table table({"model", "hull", "paper1", "paper's 1st", "difference", "paper2", "paper's 2nd", "difference", "lazy",
               "lazy unguarded"});
  for (const ConstructionFacts& m : models)
    for (std::size_t k = 0; k < hull_faces.size(); ++k) {
      std::vector<std::string> row{m.name, fmt::to_string(hull_faces[k])};
      for (std::size_t i = 0; i < kTimed.size(); ++i) {
        const double ours = m.of[i].void_percent[k];
        row.push_back(std::isnan(ours) ? fmt::format("(ends at {})", m.of[i].fewest_faces) : number(ours, 3, " %"));
        if (kTimed[i].strategy == Strategy::Lazy) continue;
        const double theirs = papers_void(m, kTimed[i].strategy, hull_faces[k]);
        row.push_back(number(theirs, 2, " %"));
        row.push_back(difference(ours, theirs));
      }
      table.add(std::move(row));
    }
  return fmt::format("## Table 2: void of hulls\n\n{}\n", table.markdown());
}

std::string peers(const std::vector<ConstructionFacts>& models, std::size_t faces) {
  Table table({"model", "faces", "lazy", "CGAL Garland-Heckbert", "lazy / Garland-Heckbert", "lazy per collapse",
               "unguarded / Garland-Heckbert", "unguarded per collapse", "lazy / unguarded"});
  for (const ConstructionFacts& m : models) {
    const VariantFacts &lazy = m.of[kLazy], &unguarded = m.of[kUnguarded];
    const double peer = m.peer ? m.peer->seconds : kUnknown;
    const auto per_collapse = [](const VariantFacts& v) {
      return number(1e6 * v.seconds / static_cast<double>(v.collapses), 2, " us");
    };
    table.add({m.name, fmt::to_string(m.faces), time_taken(lazy), m.peer ? number(peer, 3, " s") : "not built",
               number(lazy.seconds / peer, 2), per_collapse(lazy), number(unguarded.seconds / peer, 2),
               per_collapse(unguarded), number(lazy.seconds / unguarded.seconds, 2)});
  }
  return fmt::format("## Peer: time to {} faces, in the same run (Garland-Heckbert does not enclose)\n\n{}\n", faces,
                     table.markdown());
}

std::string work(const std::vector<ConstructionFacts>& models) {
  Table table(
      {"model", "collapses", "paper1: programs per collapse", "paper2", "lazy", "lazy unguarded", "certified hulls"});
  for (const ConstructionFacts& m : models) {
    std::vector<std::string> row{m.name, fmt::to_string(m.of[kLazy].collapses)};
    for (const VariantFacts& s : m.of) row.push_back(number(s.linear_programs_per_collapse(), 1));
    row.push_back(fmt::format("{} of {}", std::ranges::count(m.of, true, &VariantFacts::certified), m.of.size()));
    table.add(std::move(row));
  }
  return fmt::format("## Linear programs, and proof\n\n{}\n", table.markdown());
}

std::string csv(const std::vector<ConstructionFacts>& models, const std::vector<std::size_t>& hull_faces) {
  Table table({"mesh", "faces", "strategy", "hull_faces", "void_percent", "paper_void_percent", "seconds",
               "paper_seconds", "collapses", "linear_programs", "peer_seconds", "certified"});
  for (const ConstructionFacts& m : models)
    for (std::size_t i = 0; i < kTimed.size(); ++i)
      for (std::size_t k = 0; k < hull_faces.size(); ++k) {
        const Variant& variant = kTimed[i];
        const VariantFacts& s = m.of[i];
        const bool timed = k == 0;
        table.add({m.name, fmt::to_string(m.faces), std::string(variant.name), fmt::to_string(hull_faces[k]),
                   number(s.void_percent[k], 4), number(papers_void(m, variant.strategy, hull_faces[k]), 2),
                   timed ? number(s.seconds, 4) : "", number(papers_seconds(m, variant.strategy, hull_faces[k]), 0),
                   timed ? fmt::to_string(s.collapses) : "", timed ? fmt::to_string(s.linear_programs) : "",
                   timed && m.peer ? number(m.peer->seconds, 4) : "", s.certified ? "yes" : "no"});
      }
  return table.csv();
}

int run_construction(ConstructionOptions options) {
  std::ranges::sort(options.hull_faces, std::greater());
  std::vector<ConstructionFacts> models;
  const std::vector<Refused> refused =
      measure_each(options.models, [&](const ModelSource& source) { models.push_back(measure(source, options)); });
  const std::size_t faces = options.hull_faces.front();
  const std::string text = fmt::format(
                               "# Construction\n\n{}; processor time, best of {}; lazy refuses self-intersections, the "
                               "others allow them\n\n",
                               machine(), options.rounds) +
                           construction_times(models, faces) + voids(models, options.hull_faces) +
                           peers(models, faces) + work(models) + listed(refused);
  publish(options.out, "construction", text, csv(models, options.hull_faces));
  const bool all_certified = std::ranges::all_of(
      models, [](const ConstructionFacts& m) { return std::ranges::all_of(m.of, &VariantFacts::certified); });
  return all_certified ? kDone : kAnswerIsNo;
}

}  // namespace

void add_construction(CLI::App& app, Run& run) {
  const auto options = std::make_shared<ConstructionOptions>();
  CLI::App& command = *app.add_subcommand("construction", "The paper's Tables 1 and 2: time and void of hulls");
  add_model_options(command, options->models);
  add_faces_option(command, options->hull_faces, "Sizes of hulls; the time is that to the largest");
  add_rounds_option(command, options->rounds);
  add_out_option(command, options->out, "construction.md and construction.csv");
  command.callback([options, &run] { run = [options] { return run_construction(*options); }; });
}

}  // namespace prohull::bench

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "command.h"
#include "machine.h"
#include "prohull/detail/random_segments.h"
#include "query_section.h"
#include "strategies.h"

namespace prohull::bench {

const ProgressiveHull& QueryModel::hull(Strategy strategy) const {
  const auto named = std::ranges::find(kStrategies, strategy, &NamedStrategy::strategy);
  return hulls[static_cast<std::size_t>(named - kStrategies.begin())];
}

QueryIndex index_called(std::string_view engine, const QueryModel& model) {
  return engine.ends_with("refinement") ? prohull::index_called(engine, model.hull_of_table4())
                                        : prohull::index_called(engine, model.mesh);
}

std::vector<double> best_seconds(std::size_t rounds, std::span<const std::function<void()>> contestants) {
  std::vector<double> best(contestants.size(), std::numeric_limits<double>::infinity());
  for (std::size_t round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < contestants.size(); ++i) best[i] = std::min(best[i], seconds_of(contestants[i]));
  return best;
}

std::size_t ask_all(MeshQuery& query, std::span<const Segment> segments) {
  std::size_t hits = 0;
  for (const Segment& s : segments) hits += query.all_hits(s).size();
  return hits;
}

namespace {

QueryModel load_model(const ModelSource& source, const QueryOptions& options) {
  QueryModel model{.name = source.name, .mesh = load(source), .hulls = {}, .segments = {}, .paper = nullptr};
  for (const auto& [strategy, name] : kStrategies)
    model.hulls.push_back(build_hull(model.mesh, hull_options(strategy, QueryModel::kSmallestBase)).hull);
  model.segments = random_segments(bounding_box(model.mesh), options.segments, options.seed);
  model.paper = paper_model(model.name, model.mesh.face_count());
  return model;
}

struct NamedSection {
  std::string_view name;
  std::unique_ptr<QuerySection> (*make)();
};
constexpr std::array kSections{NamedSection{"bases", make_bases_section}, NamedSection{"kdops", make_kdops_section},
                               NamedSection{"updates", make_updates_section},
                               NamedSection{"memory", make_memory_section},
                               NamedSection{"correctness", make_correctness_section}};

int run_queries(QueryOptions options) {
  if (options.segments == 0) options.segments = options.models.folder.empty() ? 1000 : 10000;
  std::vector<std::unique_ptr<QuerySection>> sections;
  for (const auto& [name, make] : kSections)
    if (options.sections.empty() || std::ranges::count(options.sections, name) > 0) sections.push_back(make());
  measure_each(options.models, [&](const ModelSource& source) {
    QueryOptions mine = options;
    if (source.is_record_sample) mine.segments = mine.checked = 1000;  // it is measured by a test
    const QueryModel model = load_model(source, mine);
    fmt::print(stderr, "{}: {} faces", source.name, model.mesh.face_count());
    for (const auto& section : sections) section->measure(model, mine);
    fmt::print(stderr, "\n");
  });
  std::string text = fmt::format(
      "# Queries\n\n{}; {} random segments per model (P&T 4.2), of the bundled one fewer, seed {}; processor time of "
      "one "
      "thread, best of {}\n",
      machine(), options.segments, options.seed, options.rounds);
  for (const auto& section : sections) text += '\n' + section->text();
  publish(options.out, "queries", text);
  if (!options.out.empty())
    for (const auto& section : sections) section->write(options.out);
  const bool all_hold = std::ranges::all_of(sections, [](const auto& section) { return section->holds(); });
  return all_hold ? kDone : kAnswerIsNo;
}

}  // namespace

void add_queries(CLI::App& app, Run& run) {
  const auto options = std::make_shared<QueryOptions>();
  CLI::App& command = *app.add_subcommand("queries", "The paper's Tables 3 and 4, Figure 8 and section 3.2.2");
  add_model_options(command, options->models);
  command.add_option("--segments", options->segments, "That are timed [10000; for samples 1000]")
      ->check(CLI::PositiveNumber);
  command.add_option("--check", options->checked, "How many segments are compared with exact brute force")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  std::vector<std::string> names;
  for (const NamedSection& section : kSections) names.emplace_back(section.name);
  command.add_option("--only", options->sections, "Measure only these parts [all]")
      ->delimiter(',')
      ->type_name("PART,...")
      ->check(CLI::IsMember(names));
  add_rounds_option(command, options->rounds);
  command.add_option("--seed", options->seed, "Of the random segments")->capture_default_str();
  add_out_option(command, options->out, "queries.md, one CSV per table and Figure 8");
  command.callback([options, &run] { run = [options] { return run_queries(*options); }; });
}

}  // namespace prohull::bench

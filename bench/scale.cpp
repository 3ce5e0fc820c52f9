#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>

#include "command.h"
#include "machine.h"
#include "models.h"
#include "prohull/hull_builder.h"
#include "strategies.h"
#include "subdivided.h"
#include "table.h"

namespace prohull::bench {
namespace {

// What a collapse costs as meshes grow, what the guard of self-intersections adds, and what threads save.

struct ScaleOptions {
  ModelOptions models{.folder = {}, .samples = {"pony"}, .sample_faces = 97000};
  std::size_t hull_faces = 2000, subdivisions = 3, rounds = 3;
  std::filesystem::path out;
};

struct Cost {
  double seconds = std::numeric_limits<double>::infinity();  ///< best of the rounds
  std::size_t collapses = 0, linear_programs = 0;

  double microseconds_per_collapse() const { return 1e6 * seconds / static_cast<double>(collapses); }
};

struct ScaleVariant {
  const char* name;
  SelfIntersections self_intersections;
  unsigned threads;
};
constexpr std::array<ScaleVariant, 3> kScaleVariants{{{"unguarded", SelfIntersections::Allowed, 1},
                                                      {"guarded", SelfIntersections::Refused, 1},
                                                      {"all cores", SelfIntersections::Refused, 0}}};

void measure(const TriangleMesh& mesh, const HullOptions& options, Cost& cost) {
  std::optional<HullResult> result;
  cost.seconds = std::min(cost.seconds, elapsed_seconds_of([&] { result = build_hull(mesh, options); }));
  cost.collapses = result->hull.splits().size();
  cost.linear_programs = result->linear_programs;
}

int run_scale(const ScaleOptions& options) {
  Table table({"mesh", "faces", "unguarded", "guarded", "guarded / unguarded", "on all cores", "one thread / all cores",
               "programs per collapse"});
  Table csv({"mesh", "faces", "variant", "seconds", "collapses", "linear_programs", "us_per_collapse"});
  for (const ModelSource& source : model_sources(options.models)) {
    TriangleMesh mesh = load(source);
    for (std::size_t level = 0; level <= options.subdivisions; ++level) {
      if (level > 0) mesh = subdivided(mesh);
      fmt::print(stderr, "{}: {} faces\n", source.name, mesh.face_count());
      std::array<Cost, kScaleVariants.size()> costs;
      for (std::size_t round = 0; round < options.rounds; ++round)
        for (std::size_t i = 0; i < kScaleVariants.size(); ++i) {
          HullOptions hull = hull_options(Strategy::Lazy, options.hull_faces);
          hull.self_intersections = kScaleVariants[i].self_intersections;
          hull.threads = kScaleVariants[i].threads;
          measure(mesh, hull, costs[i]);
        }
      const auto us = [&](std::size_t i) { return costs[i].microseconds_per_collapse(); };
      table.add({source.name, fmt::to_string(mesh.face_count()), fmt::format("{:.2f} us", us(0)),
                 fmt::format("{:.2f} us", us(1)), fmt::format("{:.2f}", us(1) / us(0)), fmt::format("{:.2f} us", us(2)),
                 fmt::format("{:.2f}", us(1) / us(2)),
                 fmt::format("{:.1f}",
                             static_cast<double>(costs[0].linear_programs) / static_cast<double>(costs[0].collapses))});
      for (std::size_t i = 0; i < kScaleVariants.size(); ++i)
        csv.add({source.name, fmt::to_string(mesh.face_count()), kScaleVariants[i].name,
                 fmt::format("{:.4f}", costs[i].seconds), fmt::to_string(costs[i].collapses),
                 fmt::to_string(costs[i].linear_programs), fmt::format("{:.3f}", us(i))});
    }
  }
  const std::string text = fmt::format(
      "# Scale: hulls of {} faces by lazy; each mesh has every triangle of the one before in four, roughened\n\n"
      "{}; time per collapse, one thread unless said; best of {}\n\n{}",
      options.hull_faces, machine(), options.rounds, table.markdown());
  publish(options.out, "scale", text, csv.csv());
  return kDone;
}

}  // namespace

void add_scale(CLI::App& app, Run& run) {
  const auto options = std::make_shared<ScaleOptions>();
  CLI::App& command = *app.add_subcommand("scale", "Cost of a collapse from 100 thousand to millions of faces");
  add_model_options(command, options->models);
  add_faces_option(command, options->hull_faces);
  command
      .add_option("--subdivisions", options->subdivisions, "How often to subdivide, each time to four times the faces")
      ->check(CLI::Range(0, 8))
      ->capture_default_str();
  add_rounds_option(command, options->rounds);
  add_out_option(command, options->out, "scale.md and scale.csv");
  command.callback([options, &run] { run = [options] { return run_scale(*options); }; });
}

}  // namespace prohull::bench

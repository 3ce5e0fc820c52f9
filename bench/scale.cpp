#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>

#include "command.h"
#include "machine.h"
#include "models.h"
#include "prohull/file.h"
#include "prohull/hull_builder.h"
#include "strategies.h"
#include "subdivided.h"
#include "table.h"

namespace prohull::bench {
namespace {

// What a collapse costs as meshes grow, and what the guard of self-intersections adds.

struct Options {
  ModelOptions models{.folder = {}, .samples = {"pony"}, .sample_faces = 97000};
  std::size_t hull_faces = 2000, subdivisions = 3, rounds = 3;
  std::filesystem::path out;
};

struct Cost {
  double seconds = std::numeric_limits<double>::infinity();  ///< best of the rounds
  std::size_t collapses = 0, linear_programs = 0;

  double microseconds_per_collapse() const { return 1e6 * seconds / static_cast<double>(collapses); }
};

void measure(const TriangleMesh& mesh, const HullOptions& options, Cost& cost) {
  std::optional<HullResult> result;
  cost.seconds = std::min(cost.seconds, seconds_of([&] { result = build_hull(mesh, options); }));
  cost.collapses = result->hull.splits().size();
  cost.linear_programs = result->linear_programs;
}

int run_scale(const Options& options) {
  Table table({"mesh", "faces", "per collapse", "guarded", "guarded / unguarded", "programs per collapse"});
  Table csv({"mesh", "faces", "guarded", "seconds", "collapses", "linear_programs", "us_per_collapse"});
  for (const ModelSource& source : model_sources(options.models)) {
    TriangleMesh mesh = load(source);
    for (std::size_t level = 0; level <= options.subdivisions; ++level) {
      if (level > 0) mesh = subdivided(mesh);
      fmt::print(stderr, "{}: {} faces\n", source.name, mesh.face_count());
      std::array<Cost, 2> costs;
      for (std::size_t round = 0; round < options.rounds; ++round)
        for (const bool guarded : {false, true}) {
          HullOptions hull = hull_options(Strategy::Lazy, options.hull_faces);
          hull.self_intersections = guarded ? SelfIntersections::Refused : SelfIntersections::Allowed;
          measure(mesh, hull, costs[guarded]);
        }
      const double plain = costs[0].microseconds_per_collapse(), guarded = costs[1].microseconds_per_collapse();
      table.add({source.name, fmt::to_string(mesh.face_count()), fmt::format("{:.2f} us", plain),
                 fmt::format("{:.2f} us", guarded), fmt::format("{:.2f}", guarded / plain),
                 fmt::format("{:.1f}",
                             static_cast<double>(costs[0].linear_programs) / static_cast<double>(costs[0].collapses))});
      for (const bool is_guarded : {false, true}) {
        const Cost& cost = costs[is_guarded];
        csv.add({source.name, fmt::to_string(mesh.face_count()), is_guarded ? "yes" : "no",
                 fmt::format("{:.4f}", cost.seconds), fmt::to_string(cost.collapses),
                 fmt::to_string(cost.linear_programs), fmt::format("{:.3f}", cost.microseconds_per_collapse())});
      }
    }
  }
  const std::string text = fmt::format(
      "# Scale: hulls of {} faces by lazy; each mesh has every triangle of the one before in four, roughened\n\n"
      "{}; processor time, best of {}\n\n{}",
      options.hull_faces, machine(), options.rounds, table.markdown());
  fmt::print("{}", text);
  if (!options.out.empty()) {
    std::filesystem::create_directories(options.out);
    write_file(options.out / "scale.md", text);
    write_file(options.out / "scale.csv", csv.csv());
  }
  return kDone;
}

}  // namespace

void add_scale(CLI::App& app, Run& run) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("scale", "Cost of a collapse from 100 thousand to millions of faces");
  add_model_options(command, options->models);
  command.add_option("--faces", options->hull_faces, "Size of the hulls")
      ->check(CLI::Range(4, 1000000000))
      ->capture_default_str();
  command
      .add_option("--subdivisions", options->subdivisions, "How often to subdivide, each time to four times the faces")
      ->check(CLI::Range(0, 8))
      ->capture_default_str();
  command.add_option("--repeat", options->rounds, "Rounds, of which the best time counts")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--out", options->out, "Also write scale.md and scale.csv here")->type_name("DIR");
  command.callback([options, &run] { run = [options] { return run_scale(*options); }; });
}

}  // namespace prohull::bench

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "command.h"
#include "machine.h"
#include "models.h"
#include "prohull/hull_builder.h"
#include "strategies.h"
#include "table.h"

namespace prohull::bench {
namespace {

// P&T 3.1.4, "Priority queue": is the red-black tree faster than the heap?

struct QueuesOptions {
  ModelOptions models;
  std::size_t hull_faces = 2000, rounds = 3;
  std::filesystem::path out;
};

struct NamedQueue {
  QueueKind kind;
  std::string_view name;
};
constexpr std::array kQueues{NamedQueue{QueueKind::Heap, "heap"}, NamedQueue{QueueKind::RedBlackTree, "red-black tree"},
                             NamedQueue{QueueKind::Bucket, "buckets"}};

struct QueueFacts {
  double seconds = std::numeric_limits<double>::infinity();
  double void_percent = 0;
};
using AllQueues = std::array<QueueFacts, kQueues.size()>;

AllQueues measure(const TriangleMesh& mesh, Strategy strategy, const QueuesOptions& options) {
  AllQueues all;
  for (std::size_t round = 0; round < options.rounds; ++round)
    for (std::size_t q = 0; q < kQueues.size(); ++q) {
      std::optional<HullResult> result;
      HullOptions hull = hull_options(strategy, options.hull_faces, kQueues[q].kind);
      hull.self_intersections = SelfIntersections::Allowed;  // as in the paper
      const double seconds = seconds_of([&] { result = build_hull(mesh, hull); });
      all[q].seconds = std::min(all[q].seconds, seconds);
      all[q].void_percent = void_percent(result->hull.base(), signed_volume(mesh));
    }
  return all;
}

int run_queues(const QueuesOptions& options) {
  Table table({"model", "strategy", "heap", "red-black tree", "buckets", "red-black tree / heap", "buckets / heap",
               "void: heap", "void: red-black tree", "void: buckets"});
  Table csv({"mesh", "faces", "strategy", "queue", "hull_faces", "seconds", "void_percent"});
  measure_each(options.models, [&](const ModelSource& source) {
    const TriangleMesh mesh = load(source);
    for (const auto& [strategy, strategy_name] : kStrategies) {
      fmt::print(stderr, "{}: {} faces, {}\n", source.name, mesh.face_count(), strategy_name);
      const AllQueues all = measure(mesh, strategy, options);
      std::vector<std::string> row{source.name, std::string(strategy_name)};
      for (const QueueFacts& q : all) row.push_back(fmt::format("{:.3f} s", q.seconds));
      for (std::size_t q = 1; q < all.size(); ++q)
        row.push_back(fmt::format("{:.2f}", all[q].seconds / all[0].seconds));
      for (const QueueFacts& q : all) row.push_back(fmt::format("{:.3f} %", q.void_percent));
      table.add(std::move(row));
      for (std::size_t q = 0; q < all.size(); ++q)
        csv.add({source.name, fmt::to_string(mesh.face_count()), std::string(strategy_name),
                 std::string(kQueues[q].name), fmt::to_string(options.hull_faces),
                 fmt::format("{:.4f}", all[q].seconds), fmt::format("{:.4f}", all[q].void_percent)});
    }
  });
  const std::string text =
      fmt::format("# Priority queues: time and void of hulls of {} faces\n\n{}; processor time, best of {}\n\n{}",
                  options.hull_faces, machine(), options.rounds, table.markdown());
  publish(options.out, "queues", text, csv.csv());
  return kDone;
}

}  // namespace

void add_queues(CLI::App& app, Run& run) {
  const auto options = std::make_shared<QueuesOptions>();
  CLI::App& command = *app.add_subcommand("queues", "Heap, red-black tree and bucket queue against each other");
  add_model_options(command, options->models);
  add_faces_option(command, options->hull_faces);
  add_rounds_option(command, options->rounds);
  add_out_option(command, options->out, "queues.md and queues.csv");
  command.callback([options, &run] { run = [options] { return run_queues(*options); }; });
}

}  // namespace prohull::bench

#include <fmt/format.h>

#include <algorithm>

#include "command.h"
#include "point_command.h"
#include "prohull/detail/query_io.h"

namespace prohull::cli {
namespace {

struct DistanceOptions : PointOptions {
  bool is_signed = false;
};

const OutputKind& distance_outputs() {
  static const OutputKind kind{"the distances", {".npz", ".csv"}};
  return kind;
}

std::vector<ClosestPoint> distances_of(const QueryIndex& index, const std::vector<Vec3>& points,
                                       const BatchOptions& batch, bool is_signed) {
  if (is_signed) return signed_distances(index, points, batch);
  std::vector<ClosestPoint> distances;
  distances.reserve(points.size());
  for (const auto& closest : closest_points(index, points, std::numeric_limits<double>::infinity(), batch))
    distances.push_back(closest.value());  // the mesh has faces
  return distances;
}

PointAnswers answers(std::vector<ClosestPoint> distances, bool is_signed) {
  PointAnswers answers{"no points", nlohmann::json::object(),
                       [distances](const auto& file) { write_distances(file, distances); }, is_signed};
  if (distances.empty()) return answers;
  const auto [least, greatest] = std::ranges::minmax(distances, {}, &ClosestPoint::distance);
  answers.summary = fmt::format("{} at distances from {:.6g} to {:.6g}", counted(distances.size(), "point"),
                                least.distance, greatest.distance);
  answers.facts = {{"least_distance", least.distance}, {"greatest_distance", greatest.distance}};
  return answers;
}

}  // namespace

void add_distance(CLI::App& app, Run& run) {
  const auto options = std::make_shared<DistanceOptions>();
  CLI::App& command = *app.add_subcommand(
      "distance", "Finds how far points are from a mesh, with proven bounds, and the closest point of the mesh.");
  add_point_options(command, *options, distance_outputs());
  command.add_flag("--signed", options->is_signed,
                   "Make the distances of points that are inside negative. The mesh must be closed.");
  add_examples(command,
               {"prohull distance horse.ply --random 1e5", "prohull distance scan.stl --points p.npy -o distances.npz",
                "prohull distance part.stl --points p.csv -o distances.csv --signed"});
  command.callback([options, &run] {
    run = [options] {
      return run_points(*options, distance_outputs(),
                        [&](const QueryIndex& index, const std::vector<Vec3>& points, const BatchOptions& batch) {
                          return answers(distances_of(index, points, batch, options->is_signed), options->is_signed);
                        });
    };
  });
}

}  // namespace prohull::cli

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "command.h"
#include "point_command.h"
#include "prohull/detail/query_io.h"
#include "prohull/detail/rounded.h"

namespace prohull::cli {
namespace {

const OutputKind kDistances{"the distances", {".npz", ".csv"}};

std::vector<ClosestPoint> distances_of(const QueryIndex& index, const std::vector<Vec3>& points,
                                       const BatchOptions& batch, bool is_signed) {
  if (is_signed) return signed_distances(index, points, batch);
  std::vector<ClosestPoint> distances;
  distances.reserve(points.size());
  for (const auto& closest : closest_points(index, points, std::numeric_limits<double>::infinity(), batch))
    distances.push_back(closest.value());  // the mesh has faces
  return distances;
}

/// With its bounds where they tell less than the digits do, as beyond 1e150.
std::string text_of(const ClosestPoint& closest) {
  constexpr double kDigits = 1e-6;
  const bool is_known = closest.upper - closest.lower <= kDigits * std::abs(closest.distance);
  return is_known ? fmt::format("{:.6g}", closest.distance)
                  : fmt::format("{:.6g} (between {:.3g} and {:.3g})", closest.distance, rounded_down(closest.lower, 3),
                                rounded_up(closest.upper, 3));
}

PointAnswers answers(std::vector<ClosestPoint> distances) {
  const auto [least, greatest] = std::ranges::minmax(distances, {}, &ClosestPoint::distance);
  return {fmt::format("{} at distances from {} to {}", counted(distances.size(), "point"), text_of(least),
                      text_of(greatest)),
          {{"least_distance", least.distance}, {"greatest_distance", greatest.distance}},
          [distances = std::move(distances)](const auto& file) { write_distances(file, distances); }};
}

}  // namespace

void add_distance(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<PointOptions>(
      app, run, "distance",
      "Finds how far points are from a mesh, with proven bounds, and the closest point of the mesh.",
      [](const PointOptions& chosen) {
        return run_points(chosen, kDistances,
                          [&](const QueryIndex& index, const std::vector<Vec3>& points, const BatchOptions& batch) {
                            return answers(distances_of(index, points, batch, chosen.is_about_inside));
                          });
      });
  options.bytes_per_point = 220;
  add_point_options(command, options, kDistances);
  command.add_flag("--signed", options.is_about_inside,
                   "Make the distances of points that are inside negative. The mesh must be closed; what is inside out "
                   "is turned.");
  add_examples(command,
               {"prohull distance horse.ply --random 1e5", "prohull distance scan.stl --points p.npy -o distances.npz",
                "prohull distance part.stl --points p.csv -o distances.csv --signed"});
}

}  // namespace prohull::cli

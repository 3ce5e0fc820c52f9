#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "command.h"
#include "machine.h"
#include "models.h"
#include "prohull/detail/random_segments.h"
#include "prohull/mesh_query.h"
#include "query_peers.h"
#include "table.h"

namespace prohull::bench {
namespace {

// The closest point of a mesh, beside Embree's point queries, whose callback measures the faces of its leaves in
// doubles.

struct ClosestOptions {
  ModelOptions models;
  std::size_t points = 100'000, rounds = 5;
  std::filesystem::path out;
};

struct PointSet {
  const char* name;
  double away;  ///< from the surface, along each axis, in diagonals; less than 0: anywhere in the box
};
constexpr PointSet kSets[]{{"in the box", -1}, {"near the surface", 0.005}, {"on the surface", 0}};

std::vector<Vec3> points_of(const PointSet& set, const TriangleMesh& mesh, std::size_t count) {
  constexpr std::uint64_t kSeed = 1;
  const Box box = bounding_box(mesh);
  if (set.away < 0) return random_points(box, count, kSeed);
  const Vec3 away = Vec3{1, 1, 1} * (set.away * box.diagonal());
  std::vector<Vec3> points = random_points({-away, away}, count, kSeed);
  std::mt19937_64 random(kSeed);
  const auto fraction = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (Vec3& p : points) {
    const Triangle t = mesh.triangle(FaceId(static_cast<std::uint32_t>(random() % mesh.face_count())));
    const double u = std::sqrt(fraction()), v = fraction();
    p = p + t.a * (1 - u) + t.b * (u * (1 - v)) + t.c * (u * v);
  }
  return points;
}

/// The least seconds of all rounds.
template <class Work>
double least_seconds(std::size_t rounds, Work&& work) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t round = 0; round < rounds; ++round) least = std::min(least, seconds_of(work));
  return least;
}

/// How many points have another distance than Embree says, by more than float32 rounds.
std::size_t measure(const ModelSource& source, const ClosestOptions& options, Table& table) {
  const TriangleMesh mesh = load(source);
  const QueryIndex index{TriangleMesh(mesh)};
  MeshQuery query(index);
  const auto embree = make_embree(mesh, /*robust=*/true);
  const double rounding = 1e-6 * bounding_box(mesh).diagonal();
  std::size_t different = 0;
  for (const PointSet& set : kSets) {
    const std::vector<Vec3> points = points_of(set, mesh, options.points);
    std::vector<double> distances(points.size()), of_embree(points.size());
    const double ours = least_seconds(options.rounds, [&] {
      for (std::size_t i = 0; i < points.size(); ++i) distances[i] = query.closest_point(points[i])->distance;
    });
    double theirs = kUnknown;
    if (embree && embree->distance(points[0])) {
      theirs = least_seconds(options.rounds, [&] {
        for (std::size_t i = 0; i < points.size(); ++i) of_embree[i] = *embree->distance(points[i]);
      });
      for (std::size_t i = 0; i < points.size(); ++i) different += std::abs(distances[i] - of_embree[i]) > rounding;
    }
    const auto per_point = [&](double seconds) { return 1e9 * seconds / static_cast<double>(points.size()); };
    table.add({source.name, std::to_string(mesh.face_count()), set.name, number(per_point(ours), 0),
               number(per_point(theirs), 0), number(ours / theirs, 2)});
  }
  return different;
}

int run_closest(const ClosestOptions& options) {
  Table table{{"mesh", "faces", "points", "prohull_ns", "embree_ns", "ratio"}};
  std::size_t different = 0;
  measure_each(options.models, [&](const ModelSource& source) { different += measure(source, options, table); });
  publish(options.out, "closest",
          fmt::format("# Closest points\n\n{}; processor time of one thread for each of {} points, the least of {} "
                      "rounds.\n\n{}",
                      machine(), options.points, options.rounds, table.markdown()),
          table.csv());
  return different == 0 ? kDone : kAnswerIsNo;
}

}  // namespace

void add_closest(CLI::App& app, Run& run) {
  const auto options = std::make_shared<ClosestOptions>();
  CLI::App& command =
      *app.add_subcommand("closest", "Time of the closest point of a mesh, beside Embree's point queries");
  add_model_options(command, options->models);
  command.add_option("--points", options->points, "Of each set")->check(CLI::PositiveNumber)->capture_default_str();
  command.add_option("--rounds", options->rounds, "Of which the fastest counts")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_out_option(command, options->out, "closest.md and closest.csv");
  command.callback([options, &run] { run = [options] { return run_closest(*options); }; });
}

}  // namespace prohull::bench

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "collide_peers.h"
#include "command.h"
#include "machine.h"
#include "models.h"
#include "table.h"

namespace prohull::bench {
namespace {

// Two copies of a mesh in random poses: do they collide, and how far apart are they?

struct CollideOptions {
  ModelOptions models;
  std::size_t poses = 200, rounds = 5;
  std::uint64_t seed = 1;
  double spread = 1.1;
  std::filesystem::path out;
};

/// The one mesh stays where it is. The other one is turned at random about the center of its box, and moved in a random
/// direction by up to `spread` diagonals: about two in five collide with the default.
std::vector<PosePair> random_poses(const TriangleMesh& mesh, const CollideOptions& options) {
  std::mt19937_64 random(options.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> fraction(0, options.spread);
  const Box box = bounding_box(mesh);
  std::vector<PosePair> poses;
  for (std::size_t i = 0; i < options.poses; ++i) {
    const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
    Pose pose = pose_of_quaternion(w, x, y, z);
    const double dx = normal(random), dy = normal(random), dz = normal(random);
    const Vec3 direction = Vec3{dx, dy, dz} / norm(Vec3{dx, dy, dz});
    pose.translation = box.center() + direction * (fraction(random) * box.diagonal()) - placed(pose, box.center());
    poses.push_back({{}, pose});
  }
  return poses;
}

struct CollideContestant {
  std::string name;
  std::function<bool(const PosePair&)> collide;
};

/// Means over the poses that collide, and over those that do not.
struct Microseconds {
  double hit = kUnknown, miss = kUnknown;
};

/// Medians of rounds in which the contestants take turns.
std::vector<Microseconds> race(const std::vector<CollideContestant>& contestants, const std::vector<PosePair>& hits,
                               const std::vector<PosePair>& misses, std::size_t rounds) {
  const auto mean = [](const CollideContestant& contestant, const std::vector<PosePair>& poses) {
    const double seconds = seconds_of([&] {
      for (const PosePair& at : poses) contestant.collide(at);
    });
    return poses.empty() ? kUnknown : 1e6 * seconds / static_cast<double>(poses.size());
  };
  std::vector<std::vector<double>> hit(contestants.size()), miss(contestants.size());
  for (std::size_t round = 0; round < rounds; ++round)
    for (std::size_t c = 0; c < contestants.size(); ++c) {
      hit[c].push_back(mean(contestants[c], hits));
      miss[c].push_back(mean(contestants[c], misses));
    }
  std::vector<Microseconds> results;
  for (std::size_t c = 0; c < contestants.size(); ++c) results.push_back({median(hit[c]), median(miss[c])});
  return results;
}

void measure(const ModelSource& source, const CollideOptions& options, Table& table, Table& csv) {
  const TriangleMesh mesh = load(source);
  fmt::print(stderr, "{}: {} faces\n", source.name, mesh.face_count());
  std::optional<CollisionIndex> index;
  const double build = seconds_of([&] { index.emplace(mesh); });
  std::vector<std::unique_ptr<CollisionPeer>> peers;
  for (const auto make : {make_fcl_obb, make_fcl_obbrss, make_cgal_collision})
    if (auto peer = make(mesh, mesh)) peers.push_back(std::move(peer));
  std::vector<CollideContestant> contestants{
      {"prohull", [&](const PosePair& at) { return collide(*index, at.a, *index, at.b); }}};
  for (const auto& peer : peers)
    contestants.push_back({peer->name(), [&](const PosePair& at) { return peer->collide(at); }});
  contestants.push_back(
      {"prohull distance", [&](const PosePair& at) { return separation(*index, at.a, *index, at.b).collide(); }});
  const auto fcl_distance = make_fcl_distance(mesh, mesh);
  if (fcl_distance)
    contestants.push_back({fcl_distance->name(), [&](const PosePair& at) { return fcl_distance->collide(at); }});
  std::vector<PosePair> hits, misses;
  for (const PosePair& at : random_poses(mesh, options)) (contestants[0].collide(at) ? hits : misses).push_back(at);
  const auto share = static_cast<double>(hits.size()) / static_cast<double>(options.poses);
  const std::vector<Microseconds> results = race(contestants, hits, misses, options.rounds);
  const auto mean = [&](const Microseconds& r) {
    return (hits.empty() ? 0 : share * r.hit) + (misses.empty() ? 0 : (1 - share) * r.miss);
  };
  for (std::size_t c = 0; c < contestants.size(); ++c) {
    const auto collide = [&](const PosePair& at) { return contestants[c].collide(at); };
    const auto others = std::ranges::count_if(hits, std::not_fn(collide)) + std::ranges::count_if(misses, collide);
    const Microseconds& r = results[c];
    table.add({source.name, contestants[c].name, fmt::format("{} of {}", hits.size(), options.poses),
               number(r.hit, 2, " us"), number(r.miss, 2, " us"), number(mean(r), 2, " us"),
               number(mean(r) / mean(results[0]), 2), fmt::to_string(others)});
    csv.add({source.name, fmt::to_string(mesh.face_count()), contestants[c].name, fmt::to_string(options.poses),
             fmt::to_string(hits.size()), number(r.hit, 3), number(r.miss, 3), number(mean(r), 3),
             fmt::to_string(others), c == 0 ? number(build, 3) : ""});
  }
}

int run_collide(const CollideOptions& options) {
  Table table({"model", "by", "collide", "hit", "miss", "mean", "/ prohull", "other answers"});
  Table csv(
      {"mesh", "faces", "by", "poses", "collide", "hit_us", "miss_us", "mean_us", "other_answers", "build_seconds"});
  const std::vector<Refused> refused =
      measure_each(options.models, [&](const ModelSource& source) { measure(source, options, table, csv); });
  publish(
      options.out, "collide",
      fmt::format("# Meshes against meshes\n\n{}. Two copies of each mesh in {} random poses (seed {}), "
                  "processor time of one thread. Hit and miss are means over the poses that collide and that do not, "
                  "medians of {} rounds in turns. Other answers than prohull's: FCL knows surfaces only.\n\n{}\n{}",
                  machine(), options.poses, options.seed, options.rounds, table.markdown(), listed(refused)),
      csv.csv());
  return kDone;
}

}  // namespace

void add_collide(CLI::App& app, Run& run) {
  const auto options = std::make_shared<CollideOptions>();
  CLI::App& command = *app.add_subcommand("collide", "Meshes against meshes in random poses, beside FCL and CGAL");
  add_model_options(command, options->models);
  command.add_option("--poses", options->poses, "Random poses")->capture_default_str()->check(CLI::PositiveNumber);
  command.add_option("--spread", options->spread, "How far apart the meshes are at most, in diagonals of their box")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command.add_option("--seed", options->seed, "Of the poses")->capture_default_str();
  add_rounds_option(command, options->rounds);
  add_out_option(command, options->out, "collide.md and collide.csv");
  command.callback([options, &run] { run = [options] { return run_collide(*options); }; });
}

}  // namespace prohull::bench

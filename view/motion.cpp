#include "view/motion.h"

#include <algorithm>
#include <cmath>

namespace prohull::view {
namespace {

using nlohmann::json;

constexpr double kFewestMoments = 240, kMostMoments = 5000;  // more are not seen, and take megabytes

/// All rows, if there are not too many, places between them, and where the robot meets something.
std::vector<double> places_of(const robot::JointPath& path, const robot::PathProof& proof) {
  const double length = path.length();
  const double steps = length > kMostMoments ? kMostMoments
                       : length > 0          ? length * std::ceil(kFewestMoments / length)
                                             : 0;
  std::vector<double> places{0};
  for (double i = 1; i <= steps; ++i) places.push_back(length * (i / steps));
  if (const robot::PathPairProof* const first = proof.first()) places.push_back(first->end);
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

}  // namespace

ShownMotion shown_motion(const robot::JointPath& path, const robot::PathProof& proof,
                         std::span<const robot::PathBody> bodies) {
  ShownMotion motion{.in_seconds = !path.rows().times.empty()};
  for (const double place : places_of(path, proof)) {
    motion.times.push_back(path.time_at(place));
    motion.positions.push_back(path.positions_at(place));
  }
  for (const robot::DistanceBound& bound : proof.curve) {
    const robot::PathPairProof& pair = proof.pairs[bound.pair];
    motion.bounds.push_back({path.time_at(bound.begin), path.time_at(bound.end), bound.distance,
                             bodies[pair.a].name + " and " + bodies[pair.b].name});
  }
  return motion;
}

json motion_facts(const ShownMotion& motion) {
  const auto facts_of = [](const ShownMotion::Bound& bound) -> json {
    return {bound.begin, bound.end, bound.distance, bound.pair};
  };
  return {{"times", motion.times},     {"positions", motion.positions}, {"in_seconds", motion.in_seconds},
          {"verdict", motion.verdict}, {"is_good", motion.is_good},     {"bounds", json_list(motion.bounds, facts_of)}};
}

}  // namespace prohull::view

#include "motion_attack.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "collide_peers.h"
#include "robot/motion/kinematics.h"
#include "robot/motion/sampling.h"

namespace prohull::bench {
namespace {

using namespace prohull::robot;

constexpr std::uint64_t kPoses = 101, kClimbs = 102;   // seeds
constexpr double kFirstStep = 0.25, kLastStep = 1e-5;  // as shares of what a joint can do

class Attacker {
 public:
  Attacker(const Robot& robot, const Bodies& bodies) : robot_(robot), moves_(sampled_joints(robot)) {
    for (const TriangleMesh& mesh : bodies.hull)
      indices_.push_back(mesh.face_count() > 0 ? std::optional<CollisionIndex>(mesh) : std::nullopt);
  }

  bool collides(const PairProof& pair, std::span<const double> positions) const {
    const std::vector<Pose> poses = link_poses(robot_, positions);
    return collide(*indices_[pair.a], poses[pair.a], *indices_[pair.b], poses[pair.b]);
  }

  bool surfaces_meet(const PairProof& pair, std::span<const double> positions) const {
    const std::vector<Pose> poses = link_poses(robot_, positions);
    return !intersecting_faces(*indices_[pair.a], poses[pair.a], *indices_[pair.b], poses[pair.b]).empty();
  }

  /// The distance where no joint makes it less by a step.
  double climb(const PairProof& pair, std::vector<double> positions) const {
    double least = distance(pair, positions);
    for (double step = kFirstStep; step >= kLastStep && least > 0; step /= 2)
      for (std::size_t j = 0; j < robot_.joints.size(); ++j)
        while (least > 0 && (goes(pair, positions, j, step, least) || goes(pair, positions, j, -step, least))) {
        }
    return least;
  }

 private:
  /// At least `limit` counts as `limit`.
  double distance(const PairProof& pair, std::span<const double> positions,
                  double limit = std::numeric_limits<double>::infinity()) const {
    const std::vector<Pose> poses = link_poses(robot_, positions);
    const Separation found = separation(*indices_[pair.a], poses[pair.a], *indices_[pair.b], poses[pair.b], limit);
    return std::min(found.upper, limit);
  }

  bool goes(const PairProof& pair, std::vector<double>& positions, std::size_t j, double step, double& least) const {
    const Joint& joint = robot_.joints[j];
    if (!moves_[j] || !moves(joint) || joint.mimic) return false;
    const double range = joint.upper - joint.lower, before = positions[j];
    positions[j] += step * (std::isfinite(range) ? range : 2 * std::numbers::pi);
    if (joint.type != JointType::Continuous) positions[j] = std::clamp(positions[j], joint.lower, joint.upper);
    follow(robot_, positions);
    if (const double there = distance(pair, positions, least); there < least) {
      least = there;
      return true;
    }
    positions[j] = before;
    follow(robot_, positions);
    return false;
  }

  const Robot& robot_;
  std::vector<bool> moves_;
  std::vector<std::optional<CollisionIndex>> indices_;
};

void attack_never(const Robot& robot, const Attacker& attacker, std::span<const PairProof* const> never,
                  const AttackOptions& options, Attack& found) {
  if (never.empty()) return;
  for (; found.poses < options.poses; ++found.poses) {
    const auto positions = random_positions(robot, kPoses, found.poses / never.size());
    found.contradictions += attacker.collides(*never[found.poses % never.size()], positions);
  }
  for (; found.climbs < options.climbs; ++found.climbs) {
    const double least =
        attacker.climb(*never[found.climbs % never.size()], random_positions(robot, kClimbs, found.climbs));
    found.least = std::min(found.least, least);
    found.contradictions += least == 0;
  }
}

void confirm(const Robot& robot, const Bodies& bodies, const Attacker& attacker, const PairProof& pair, Attack& found) {
  ++found.witnesses;
  found.confirmed += attacker.collides(pair, pair.positions);
  if (!attacker.surfaces_meet(pair, pair.positions)) return;
  ++found.by_surfaces;
  const std::vector<Pose> poses = link_poses(robot, pair.positions);
  const auto fcl = make_fcl_obb(bodies.hull[pair.a], bodies.hull[pair.b]);
  found.by_fcl += fcl && fcl->collide({poses[pair.a], poses[pair.b]});
}

}  // namespace

Attack& Attack::operator+=(const Attack& other) {
  never += other.never, poses += other.poses, climbs += other.climbs, contradictions += other.contradictions;
  least = std::min(least, other.least);
  witnesses += other.witnesses, confirmed += other.confirmed;
  by_surfaces += other.by_surfaces, by_fcl += other.by_fcl;
  return *this;
}

Attack attack(const Robot& robot, const Bodies& bodies, std::span<const PairProof> proofs,
              const AttackOptions& options) {
  const Attacker attacker(robot, bodies);
  Attack found;
  std::vector<const PairProof*> never;
  for (const PairProof& proof : proofs) {
    if (proof.verdict == PairVerdict::Never) never.push_back(&proof);
    if (proof.verdict == PairVerdict::Meets) confirm(robot, bodies, attacker, proof, found);
  }
  found.never = never.size();
  attack_never(robot, attacker, never, options, found);
  return found;
}

}  // namespace prohull::bench

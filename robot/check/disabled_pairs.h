#pragma once

#include <span>
#include <vector>

#include "robot/model.h"
#include "robot/motion/motion.h"

namespace prohull::robot {

/// A row of an SRDF file, decided by the collision geometry that the robot ships with, and by its visual geometry.
struct DisabledCheck {
  DisabledRow row;
  PairProof collision = {}, visual = {};

  /// Whether the row disables a pair that meets somewhere, by one of the geometries, and its reason does not say so.
  /// The reasons "Adjacent", "Always", "Default" and "User" allow for it, as MoveIt's assistant writes them.
  bool is_refuted() const;
  /// Whether the reason is "Always", and the pair never meets.
  bool has_refuted_reason() const;
};

/// Decides each row, in their order. The result is the same for any number of threads. Throws as prove_pairs.
std::vector<DisabledCheck> check_disabled_pairs(const Robot& robot, std::span<const DisabledRow> rows,
                                                const ProofOptions& options = {});

}  // namespace prohull::robot

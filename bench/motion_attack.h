#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "robot/model.h"
#include "robot/motion/motion.h"
#include "robot/motion/pair_proof.h"

namespace prohull::bench {

struct AttackOptions {
  std::size_t poses = 1'000;  ///< random ones, each of one pair
  std::size_t climbs = 10;    ///< from random positions to ever smaller distances, each of one pair
};

/// What was tried to contradict what is proven about pairs of links, on the same meshes.
struct Attack {
  std::size_t never = 0, poses = 0, climbs = 0;            ///< of pairs that never meet
  std::size_t contradictions = 0;                          ///< poses and ends of climbs in which such a pair collides
  double least = std::numeric_limits<double>::infinity();  ///< distance that a climb has ended with, in metres
  std::size_t witnesses = 0;                               ///< pairs that meet, at positions that are told,
  std::size_t confirmed = 0;                               ///< where collide agrees,
  std::size_t by_surfaces = 0;                             ///< and the surfaces meet, so that FCL can know,
  std::size_t by_fcl = 0;                                  ///< and FCL agrees; 0 without it

  Attack& operator+=(const Attack& other);
};

Attack attack(const robot::Robot& robot, const robot::Bodies& bodies, std::span<const robot::PairProof> proofs,
              const AttackOptions& options);

}  // namespace prohull::bench

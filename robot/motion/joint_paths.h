#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "robot/model.h"

namespace prohull::robot {

/// What the joints say about pairs of links.
class JointPaths {
 public:
  explicit JointPaths(const Robot& robot);

  /// Whether a joint connects the links directly, or fixed joints do: of the joints between them, which lead over links
  /// without geometry, at most one moves. Joints in a row (Joint) are one. Floating and planar joints connect nothing.
  bool are_adjacent(std::size_t a, std::size_t b) const {
    return rigid_group_[a] == rigid_group_[b] || (hangs_on_[a] == b && moves_between_[a] <= 1) ||
           (hangs_on_[b] == a && moves_between_[b] <= 1);
  }
  /// Whether random positions move them as they can move.
  bool are_sampled(std::size_t a, std::size_t b) const { return sampled_group_[a] == sampled_group_[b]; }

 private:
  void hang(const Robot& robot, std::size_t j);

  std::vector<std::size_t> rigid_group_;              // the same number: only fixed joints connect them
  std::vector<std::size_t> sampled_group_;            // the same number: only sampled joints connect them
  std::vector<std::optional<std::size_t>> hangs_on_;  // the next link with geometry on the way to the root
  std::vector<std::size_t> moves_between_;            // joints that move between the link and this one
};

}  // namespace prohull::robot

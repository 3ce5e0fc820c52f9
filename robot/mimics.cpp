#include "robot/mimics.h"

#include <algorithm>

namespace prohull::robot {

std::vector<std::size_t> leaders_first(const Robot& robot) {
  std::vector<std::size_t> order;
  std::vector<std::vector<std::size_t>> followers(robot.joints.size());
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    if (const auto& mimic = robot.joints[j].mimic)
      followers[mimic->joint].push_back(j);
    else
      order.push_back(j);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::vector<std::size_t>& next = followers[order[i]];
    order.insert(order.end(), next.begin(), next.end());
  }
  return order;
}

const Joint* joint_in_mimic_loop(const Robot& robot) {
  std::vector<bool> is_ordered(robot.joints.size());
  for (const std::size_t j : leaders_first(robot)) is_ordered[j] = true;
  const auto left_out = std::ranges::find(is_ordered, false);
  if (left_out == is_ordered.end()) return nullptr;
  auto at = static_cast<std::size_t>(left_out - is_ordered.begin());
  for (std::size_t steps = 0; steps < robot.joints.size(); ++steps) at = robot.joints[at].mimic->joint;
  return &robot.joints[at];
}

}  // namespace prohull::robot

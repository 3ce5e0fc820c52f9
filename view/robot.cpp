#include "view/robot.h"

#include <cmath>

#include "robot/json.h"

namespace prohull::view {
namespace {

using nlohmann::json;
using robot::Joint;
using robot::JointType;

constexpr std::size_t kPositions = 200;

const char* motion_of(JointType type) {
  switch (type) {
    case JointType::Revolute:
    case JointType::Continuous:
      return "turn";
    case JointType::Prismatic:
      return "slide";
    default:
      return "none";
  }
}

json limit(double value) { return std::isfinite(value) ? json(value) : json(); }

json facts_of(const Joint& joint, double rest) {
  json facts = {{"name", joint.name},
                {"motion", motion_of(joint.type)},
                {"parent", joint.parent},
                {"child", joint.child},
                {"rotation", joint.origin.rotation},
                {"translation", joint.origin.translation},
                {"anchor", joint.anchor},
                {"axis", joint.axis},
                {"lower", limit(joint.lower)},
                {"upper", limit(joint.upper)},
                {"rest", rest}};
  if (joint.mimic)
    facts["mimic"] = {
        {"joint", joint.mimic->joint}, {"multiplier", joint.mimic->multiplier}, {"offset", joint.mimic->offset}};
  return facts;
}

Box box_at(const ShownRobot& shown, const std::vector<double>& positions) {
  const std::vector<Pose> poses = robot::link_poses(shown.robot, positions);
  Box box;
  for (std::size_t i = 0; i < poses.size(); ++i)
    for (const auto* const meshes : {&shown.visual, &shown.collision})
      box.extend(finite_bounding_box(placed(poses[i], (*meshes)[i])));
  return box;
}

}  // namespace

json joint_facts(const robot::Robot& robot) {
  const std::vector<double> rest = robot::rest_positions(robot);
  json joints = json::array();
  for (std::size_t i = 0; i < robot.joints.size(); ++i) joints.push_back(facts_of(robot.joints[i], rest[i]));
  return joints;
}

json disabled_facts(const ShownRobot& shown, unsigned threads) {
  const auto found = [&] {
    const robot::Bodies bodies{.visual = shown.collision, .hull = shown.collision, .convex = {}};
    return pairs_always_together(check_motion(shown.robot, bodies, {.configurations = kPositions, .threads = threads}));
  };
  return {{"disabled", shown.disabled ? *shown.disabled : found()}, {"disabled_by_file", shown.disabled.has_value()}};
}

Box drawn_box(const ShownRobot& shown) {
  constexpr std::size_t kMoments = 50;
  if (!shown.motion) return box_at(shown, robot::rest_positions(shown.robot));
  const std::vector<std::vector<double>>& moments = shown.motion->positions;
  Box box;
  for (std::size_t m = 0; m < moments.size(); m += 1 + moments.size() / kMoments) box.extend(box_at(shown, moments[m]));
  return box;
}

}  // namespace prohull::view

#include "robot/motion/planner_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string_view>
#include <vector>

namespace prohull::robot {
namespace {

constexpr double kAcceleration = 15, kJerk = 500;  // of cuRobo's template

using Lines = std::vector<std::string>;

std::string text_of(const Lines& lines) { return fmt::format("{}\n", fmt::join(lines, "\n")); }

std::string list_of(const std::vector<std::string>& items) { return fmt::format("[{}]", fmt::join(items, ", ")); }

std::vector<std::string> repeated(double number, std::size_t count) {
  return std::vector<std::string>(count, yaml_decimal(number));
}

/// The joints that a planner moves.
std::vector<const Joint*> own_joints(const Robot& robot) {
  std::vector<const Joint*> joints;
  for (const Joint& joint : robot.joints)
    if (moves(joint) && !joint.mimic) joints.push_back(&joint);
  return joints;
}

double middle(const Joint& joint) {
  return std::isfinite(joint.lower) && std::isfinite(joint.upper) ? std::midpoint(joint.lower, joint.upper) : 0;
}

/// For each link, how many joints lead to it from a root.
std::vector<std::size_t> depths(const Robot& robot) {
  std::vector<std::size_t> depths(robot.links.size());
  for (const Joint& joint : robot.joints) depths[joint.child] = depths[joint.parent] + 1;
  return depths;
}

/// A comment that names the links to which the planner is blind.
void add_blind_spots(Lines& lines, const PlannerRobot& planned) {
  std::vector<std::string> links = links_without_spheres(planned.robot, planned.balls);
  if (links.empty()) return;
  std::ranges::transform(links, links.begin(), yaml_quoted);
  lines.push_back(
      fmt::format("# No spheres, and so no collisions, of these links that have geometry: {}", fmt::join(links, ", ")));
}

class Planner {
 public:
  explicit Planner(const PlannerRobot& planned)
      : planned_(planned), joints_(own_joints(planned.robot)), depths_(depths(planned.robot)) {
    for (const LinkBalls& link : planned.balls)
      if (!link.balls.empty()) links_.push_back(yaml_quoted(link.link));
  }

  std::string tool() const { return name_at(std::ranges::max_element(depths_)); }
  std::string base() const { return name_at(std::ranges::min_element(depths_)); }
  std::string links() const { return list_of(links_); }
  std::size_t joint_count() const { return joints_.size(); }

  std::string joint_names() const {
    std::vector<std::string> names;
    for (const Joint* const joint : joints_) names.push_back(yaml_quoted(joint->name));
    return list_of(names);
  }

  std::vector<std::string> rest() const {
    std::vector<std::string> positions;
    for (const Joint* const joint : joints_) positions.push_back(yaml_decimal(middle(*joint)));
    return positions;
  }

  void add_rest_by_name(Lines& lines) const {
    for (const Joint* const joint : joints_)
      lines.push_back(fmt::format("  {}: {}", yaml_quoted(joint->name), yaml_decimal(middle(*joint))));
  }

  void add_balls(Lines& lines, const std::string& indent) const {
    for (const LinkBalls& link : planned_.balls) {
      if (link.balls.empty()) continue;
      lines.push_back(fmt::format("{}{}:", indent, yaml_quoted(link.link)));
      for (const Ball& ball : link.balls) lines.push_back(fmt::format("{}  - {}", indent, yaml_ball(ball)));
    }
  }

  void add_of_each_link(Lines& lines, const std::string& indent, const std::string& value) const {
    for (const std::string& link : links_) lines.push_back(fmt::format("{}{}: {}", indent, link, value));
  }

  /// Pairs that are not checked, each under the name of one of the two.
  void add_ignored(Lines& lines, const std::string& key, const std::string& indent) const {
    std::map<std::string, std::vector<std::string>> ignored;
    for (const MotionPair& pair : planned_.pairs) {
      if (pair.kind == PairKind::Sometimes || is_sampled(pair.kind)) continue;
      const std::string a = yaml_quoted(planned_.robot.links[pair.a].name),
                        b = yaml_quoted(planned_.robot.links[pair.b].name);
      if (has(a) && has(b)) ignored[std::min(a, b)].push_back(std::max(a, b));
    }
    lines.push_back(key + (ignored.empty() ? ": {}" : ":"));
    for (auto& [link, others] : ignored) {
      std::ranges::sort(others);
      lines.push_back(fmt::format("{}{}: {}", indent, link, list_of(others)));
    }
  }

 private:
  std::string name_at(std::vector<std::size_t>::const_iterator depth) const {
    return yaml_quoted(planned_.robot.links[static_cast<std::size_t>(depth - depths_.begin())].name);
  }
  bool has(const std::string& link) const { return std::ranges::find(links_, link) != links_.end(); }

  const PlannerRobot& planned_;
  const std::vector<const Joint*> joints_;
  const std::vector<std::size_t> depths_;
  std::vector<std::string> links_;
};

}  // namespace

std::vector<std::string> links_without_spheres(const Robot& robot, std::span<const LinkBalls> balls) {
  std::set<std::string_view> covered;
  for (const LinkBalls& link : balls)
    if (!link.balls.empty()) covered.insert(link.link);
  std::vector<std::string> blind;
  for (const Link& link : robot.links)
    if (!(link.visual.empty() && link.collision.empty()) && !covered.contains(link.name)) blind.push_back(link.name);
  return blind;
}

std::string curobo_file(const PlannerRobot& planned) {
  const Planner planner(planned);
  Lines lines;
  add_blind_spots(lines, planned);
  lines.insert(
      lines.end(),
      {"# Give the folder of this file to cuRobo as external_asset_path and external_robot_configs_path.",
       "robot_cfg:", "  kinematics:", fmt::format("    urdf_path: {}", yaml_quoted(planned.urdf)),
       "    asset_root_path: \"\"", fmt::format("    base_link: {}", planner.base()),
       fmt::format("    ee_link: {}", planner.tool()), fmt::format("    collision_link_names: {}", planner.links()),
       fmt::format("    mesh_link_names: {}", planner.links()), "    collision_sphere_buffer: 0.0",
       "    collision_spheres:"});
  planner.add_balls(lines, "      ");
  planner.add_ignored(lines, "    self_collision_ignore", "      ");
  lines.emplace_back("    self_collision_buffer:");
  planner.add_of_each_link(lines, "      ", "0.0");
  const std::string ones = list_of(repeated(1, planner.joint_count()));
  lines.insert(lines.end(),
               {"    cspace:", fmt::format("      joint_names: {}", planner.joint_names()),
                fmt::format("      retract_config: {}", list_of(planner.rest())),
                fmt::format("      null_space_weight: {}", ones), fmt::format("      cspace_distance_weight: {}", ones),
                fmt::format("      max_acceleration: {}", yaml_decimal(kAcceleration)),
                fmt::format("      max_jerk: {}", yaml_decimal(kJerk))});
  return text_of(lines);
}

std::string xrdf_file(const PlannerRobot& planned) {
  const Planner planner(planned);
  Lines lines;
  add_blind_spots(lines, planned);
  lines.insert(lines.end(), {"format: xrdf", "format_version: 1.0", "default_joint_positions:"});
  planner.add_rest_by_name(lines);
  const auto limits = [&](double limit) { return list_of(repeated(limit, planner.joint_count())); };
  lines.insert(lines.end(),
               {"cspace:", fmt::format("  joint_names: {}", planner.joint_names()),
                fmt::format("  acceleration_limits: {}", limits(kAcceleration)),
                fmt::format("  jerk_limits: {}", limits(kJerk)), fmt::format("tool_frames: [{}]", planner.tool()),
                "collision:", "  geometry: spheres", "self_collision:", "  geometry: spheres"});
  planner.add_ignored(lines, "  ignore", "    ");
  lines.insert(lines.end(), {"geometry:", "  spheres:", "    spheres:"});
  planner.add_balls(lines, "      ");
  return text_of(lines);
}

}  // namespace prohull::robot

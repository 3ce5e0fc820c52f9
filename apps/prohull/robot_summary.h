#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "robot/check/check.h"
#include "robot/files/robot_file.h"
#include "robot/hulls/link_hulls.h"
#include "robot/motion/joint_path.h"
#include "robot/motion/mujoco_files.h"
#include "robot/report/report.h"

namespace prohull::cli {

// What `prohull urdf` tells its user. Lengths are told in millimetres.

/// What was read.
/// A line about the frame of what `what` has, where that is not the one which the file calls its own; or nothing.
std::string frame_text(const robot::RobotFile& file, std::string_view what);

void say_robot(const robot::RobotFile& file);

/// Where the path leaves the limits of a joint; empty if it does not.
std::string beyond_text(const robot::Robot& robot, const robot::JointPath& path);

/// The same as JSON: null if it does not leave them.
nlohmann::json beyond_facts(const robot::Robot& robot, const robot::JointPath& path);

/// What a run would do with each link. Returns whether all meshes that it needs are there.
bool say_plan(const robot::RobotFile& file, const robot::LinkHullOptions& options);

/// How the shipped collision geometry lies to the visual one.
void say_check(const robot::RobotFile& file, std::span<const robot::LinkCheck> checks, double allow);

/// What was decided about each pair that an SRDF file disables.
void say_disabled(const robot::Robot& robot, const std::string& file, std::span<const robot::DisabledCheck> checks);

/// What was made into the folder. `sampled_pairs` as of srdf_of.
std::string robot_summary(const std::filesystem::path& folder, const robot::ReportInput& facts, bool sampled_pairs);

/// What was made for MuJoCo, or would be: the file, its notes, and hulls of which MuJoCo takes more than they are.
std::string mujoco_text(const robot::MujocoFiles& made, std::span<const robot::LinkHulls> hulls);

/// Whether all hulls of a link are certified; true of a link without any.
bool is_certified(const robot::LinkHulls& link);

}  // namespace prohull::cli

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "robot/motion/path_sweep.h"

namespace prohull::robot {

/// Encloses all positions of links, with each joint anywhere within its limits, by convex pieces: what a robot may ever
/// reach. There is one sweep for each root that such links hang on, in its frame and with its name. `links` are numbers
/// in Robot::links. SweepOptions::max_distance is for each joint, in metres; 0: 2 % of the diagonal of what it moves.
/// For the rest, as sweep_links.
///
/// Guaranteed: as of `sweep`, for the robot that the file describes, in real numbers, at all positions at which each
/// joint is within its limits. Joints move independently, those that mimic too.
///
/// Throws InputError: as sweep_links; InvalidOption for a joint that has no limits, wrong ones, or several freedoms, if
/// such a link is behind it. Throws Cancelled.
///
/// How it works: from the tips to the root. The links behind a joint, at all their positions against the first of them,
/// are enclosed by a few convex pieces; `sweep` moves these by the joint.
std::vector<LinkSweep> sweep_workspace(const Robot& robot, std::span<const std::size_t> links, Geometry which,
                                       const SweepOptions& options = {});

}  // namespace prohull::robot

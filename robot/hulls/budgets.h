#pragma once

#include <string>
#include <string_view>

#include "robot/hulls/link_hulls.h"

namespace prohull::robot {

/// Reads a YAML file of budgets:
///
///     default: {faces: [500], gap: 2mm}
///     links:
///       forearm_link: {faces: 800, max_distance: 1.5mm}
///       hand_link: {collision: convex, pieces: 12, vertices: 32}
///       tool0: {skip: true}
///
/// What a link does not say is as `options.budget` has it after "default" was read. Lengths are numbers in metres, or
/// have a unit: mm, cm, m or in. Throws InputError(Malformed) with `name` and the line for anything else, for a
/// link that the robot does not have, and for faces, pieces, vertices or spheres where the collision geometry is of
/// another kind.
void read_budgets(std::string_view text, const std::string& name, const Robot& robot, LinkHullOptions& options);

/// A file of budgets with every link of the robot, as a start.
std::string budgets_text(const Robot& robot, const LinkHullOptions& options);

/// "2mm" as metres. Throws InputError(InvalidOption) that calls it `what`.
double length_of(std::string_view text, const std::string& what);

}  // namespace prohull::robot

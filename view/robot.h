#pragma once

#include <nlohmann/json.hpp>

#include "view/page.h"

namespace prohull::view {

/// How the links of a robot move: what web/src/data/robot.js needs for forward kinematics, with all joints at their
/// rest_positions at first.
nlohmann::json joint_facts(const robot::Robot& robot);

/// The pairs of links that the page does not compare, and whether a file says so: "disabled" and "disabled_by_file".
nlohmann::json disabled_facts(const ShownRobot& shown, unsigned threads);

/// The box of the whole robot as it is drawn: at rest, or all along its motion.
Box drawn_box(const ShownRobot& shown);

}  // namespace prohull::view

#pragma once

#include <span>

#include "robot/hulls/link_hulls.h"
#include "view/page.h"

namespace prohull::view {

/// A robot as its file has it: visual geometry, and the collision geometry that it ships with.
/// Throws InputError as link_triangles; Cancelled. The stage of `progress` is "read".
ShownRobot as_shipped(const robot::Robot& robot, const Progress& progress = {});

/// The robot within what link_hulls made of it: the first hull of each link, with the primitives beside it. Links that
/// were skipped keep their collision geometry. Meshes that were not found are left out. Throws as as_shipped.
ShownRobot with_hulls(const robot::Robot& robot, std::span<const robot::LinkHulls> hulls, robot::Geometry from,
                      const Progress& progress = {});

}  // namespace prohull::view

#pragma once

#include <cstddef>
#include <span>

#include "robot/hulls/link_hulls.h"
#include "robot/motion/motion.h"

namespace prohull::robot {

/// What a robot with these hulls moves: the geometry that was enclosed as `visual`, the hulls of number `set` with the
/// primitives that are kept as `hull`, and the convex hull of each link as `convex`. Links that were skipped, or have
/// no geometry, have no bodies. A link whose hull is not certified has no `hull`: the written robot keeps its old
/// collision elements, as output_files does.
Bodies bodies_of(const Robot& robot, std::span<const LinkHulls> links, Geometry from, std::size_t set = 0);

/// The robot as one mesh, with all joints at their rest_positions. `links` has a mesh for each link, in its frame.
TriangleMesh at_rest(const Robot& robot, std::span<const TriangleMesh> links);

}  // namespace prohull::robot

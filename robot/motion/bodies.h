#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "robot/hulls/link_hulls.h"
#include "robot/hulls/write_robot.h"
#include "robot/motion/motion.h"
#include "robot/motion/motion_certificate.h"

namespace prohull::robot {

/// What a robot with these hulls moves: the geometry that was enclosed as `visual`, the hulls of number `set` with the
/// primitives that are kept as `hull`, filled where the robot fills collision meshes, and the convex hull of each link
/// as `convex`. Links that were skipped, or have no geometry, have no bodies. A link whose hull is not certified has no
/// `hull`: the written robot keeps its old collision elements, as output_files does.
Bodies bodies_of(const Robot& robot, std::span<const LinkHulls> links, Geometry from, std::size_t set = 0);

/// The hulls of set 0, for a certificate in the folder of the robot: as the files of output_files, where one file
/// has all of a hull.
std::vector<std::optional<CertifiedBody>> certified_bodies(const Robot& robot, std::span<const LinkHulls> links,
                                                           std::span<const HullFiles> hulls, Geometry from);

/// The robot as one mesh, with all joints at their rest_positions. `links` has a mesh for each link, in its frame.
TriangleMesh at_rest(const Robot& robot, std::span<const TriangleMesh> links);

}  // namespace prohull::robot

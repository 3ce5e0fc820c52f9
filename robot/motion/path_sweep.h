#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "prohull/sweep.h"
#include "robot/model.h"
#include "robot/motion/joint_path.h"

namespace prohull::robot {

/// What encloses all positions of a link on a path, in the frame of the root that it hangs on.
struct LinkSweep {
  std::string link;                     ///< its name, or that of the root if these are all links of a workspace
  Sweep sweep;                          ///< its volume is not measured
  std::vector<std::string> links = {};  ///< of a workspace: whose pieces they are
};

/// Encloses all positions of links along a path, by convex pieces, as `sweep` does it for a mesh. `links` are numbers
/// in Robot::links. Links without the geometry have the other one; those with neither are left out.
/// SweepOptions::max_distance is in metres; 0: 2 % of the diagonal of each link.
///
/// Guaranteed: as of `sweep`, for the path that JointPath describes, in real numbers. Curved shapes count as meshes
/// around them.
///
/// Throws InputError: as mesh_triangles and convex_cover; EmptyMesh and NonFiniteCoordinate for a link with a mesh that
/// has no triangles, or corners that are not finite; InvalidOption for geometry that is not read, where positions
/// of joints do not say where a link is, and for more than kMostSweptPieces. Throws Cancelled.
///
/// How it works: The path is divided. In each part of it a vertex of a convex piece stays near the straight way between
/// its positions at the two ends: JointChain::travel. The convex hull of these positions, made larger by so much,
/// encloses the piece all along.
std::vector<LinkSweep> sweep_links(const Robot& robot, const JointPath& path, std::span<const std::size_t> links,
                                   Geometry which, const SweepOptions& options = {});

/// The triangles of this geometry of a link, or of the other one where it does not have this; no faces if it has
/// neither. Throws InputError as sweep_links.
TriangleMesh triangles_to_sweep(const Link& link, Geometry which);

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

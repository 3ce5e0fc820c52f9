#pragma once

#include "robot/files/packages.h"
#include "robot/files/robot_file.h"
#include "robot/files/xml.h"

namespace prohull::robot {

/// The robot of a document whose root is <sdf>: its first model, with the models nested in it, whose links are called
/// MODEL::LINK. Throws as read_robot does.
///
/// Universal and revolute2 joints are two joints in a row, the second one called NAME_axis2. Left out, with a note:
/// further models, joints that close a loop, and includes that with_included_models leaves. Screw and gearbox joints
/// are read as floating, with a note. Where links stand in the world that no joint connects, or a joint turns or slides
/// the only one, they hang on a link "world", which is added.
RobotFile read_sdf(const XmlDocument& document, const Packages& packages);

/// What with_collisions does for SDF. The first <collision> of a link keeps its name and what else is in it, and gets a
/// <pose> and a <geometry>; the others are removed, but for those that are kept, and those that meet nothing by their
/// collide_bitmask. New ones are called LINK_hull.
std::string sdf_with_collisions(const RobotFile& file, const XmlDocument& document,
                                std::span<const NewCollision> collisions, const std::filesystem::path& folder,
                                const NewUri& new_uri = {});

}  // namespace prohull::robot

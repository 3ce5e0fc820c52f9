#pragma once

#include "robot/files/packages.h"
#include "robot/files/robot_file.h"
#include "robot/files/xml.h"

namespace prohull::robot {

/// The robot of a document whose root is <robot>. Throws as read_robot does.
RobotFile read_urdf(const XmlDocument& document, const Packages& packages);

/// What <origin> of an element says; the identity if there is none. Throws InputError(Malformed).
Pose urdf_origin(const XmlDocument& document, const XmlElement& parent);

std::string urdf_with_collisions(const RobotFile& file, const XmlDocument& document,
                                 std::span<const NewCollision> collisions, const std::filesystem::path& folder,
                                 const NewUri& new_uri = {});

}  // namespace prohull::robot

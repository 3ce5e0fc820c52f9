#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "robot/files/packages.h"
#include "robot/files/robot_file.h"
#include "robot/files/xml.h"

namespace prohull::robot {

/// The robot of a document whose root is <mujoco>. Throws as read_robot does.
///
/// Geoms that collide, by contype, conaffinity or <contact>, are collision geometry, and the others are visual. A body
/// without others has its geoms as both. Where there is more than one body in the world, or a joint turns or slides the
/// only one, it becomes a link "world". Bodies of motion capture are floating. Left out, with a note: geoms of the
/// world, <replicate>, <composite>, <flexcomp>, <attach>, and <equality> but for joints that follow others in a
/// straight line. Included files are part of the document: with_included_files.
RobotFile read_mjcf(const XmlDocument& document, const Packages& packages);

/// What with_collisions does for MJCF. The hull of a body takes the place, the name and the contact parameters of its
/// first geom that collides; the others that collide are removed, and what named them names the hull. Where these geoms
/// are the visual geometry as well, they stay and stop colliding. MuJoCo collides with the convex hull of a mesh: that
/// encloses the mesh, so the robot stays covered, but it is fatter than the hull that was certified. Throws
/// InputError(InvalidOption) for a hull that MuJoCo cannot read: neither .stl nor .obj, or with a URI.
std::string mjcf_with_collisions(const RobotFile& file, const XmlDocument& document,
                                 std::span<const NewCollision> collisions, const std::filesystem::path& folder,
                                 const NewUri& new_uri = {});

/// Whether any <include> is in the element.
bool includes_files(const XmlElement& element);

/// A MuJoCo document with the content of files in the place of each <include> that names them, as MuJoCo's compiler
/// sees it. Their paths are relative to the folder of the document's file; where nothing is there, to that of the file
/// that includes. `read` reads the text of a file. Throws InputError: CannotRead for a file that does not exist, or
/// that FileOptions::no_outside_files refuses; Malformed for one that is included twice, which MuJoCo refuses, too,
/// whose root is neither <mujocoinclude> nor <mujoco>, or whose encoding is another one.
XmlDocument with_included_files(const XmlDocument& document, const Packages& packages,
                                const std::function<std::string(const std::filesystem::path&)>& read);

}  // namespace prohull::robot

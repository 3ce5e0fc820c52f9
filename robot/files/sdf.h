#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

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

/// "1.10" as 1010, so that versions compare as numbers; 0 if there is none.
int sdf_version(const XmlElement& root);

/// Whether axes of joints are in the frame of the model, as before SDF 1.5.
bool sdf_axes_are_old(const XmlElement& root);

/// Whether a <visual> or <collision> has no collide_bitmask of 0, with which it meets nothing.
bool sdf_collides(const XmlElement& shape);

/// The models of a document, in its worlds too.
std::vector<const XmlElement*> sdf_models(const XmlDocument& document);

/// The model that is read: the first one. Throws InputError(Malformed) if there is none.
const XmlElement& sdf_model(const XmlDocument& document);

/// The links of that model by their names in Robot::links.
std::map<std::string, const XmlElement*> sdf_links(const XmlDocument& document);

/// The file of the model that an <include> of SDF names: the file itself, or that of a folder, by its model.config, or
/// else model.sdf. `folder` is that of the file with the element, relative to the robot's. Throws InputError for a
/// model.config that is no XML, and for what FileOptions::no_outside_files refuses.
MeshFile included_model(const XmlElement& include, const Packages& packages, const std::filesystem::path& folder = {});

/// An SDF document with models in the place of each <include> of its first model; if it has no model, of its worlds,
/// too. Their names, poses and whatever else the element says are those that it says, and their files are found from
/// the document's folder. An <include> stays if its file is not found or has no model, if it merges, or if one of the
/// two documents is of before SDF 1.5, where axes mean another thing. `read` reads the text of a file.
/// Throws InputError(Malformed) for a model that includes itself, for more than 10,000 models, and for a file that is
/// no SDF or has another encoding; otherwise as included_model.
XmlDocument with_included_models(const XmlDocument& document, const Packages& packages,
                                 const std::function<std::string(const std::filesystem::path&)>& read);

}  // namespace prohull::robot

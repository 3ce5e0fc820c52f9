#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "robot/files/packages.h"
#include "robot/files/xml.h"

namespace prohull::robot {

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

#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "robot/files/packages.h"
#include "robot/files/xml.h"

namespace prohull::robot {

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

#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "robot/files/xml.h"

namespace prohull::robot {

/// A place in a mesh or material file that names another file.
struct FileReference {
  Span where;                       ///< the bytes of the name, of glTF with its quotes
  std::string name;                 ///< as the file says it
  std::filesystem::path file = {};  ///< which file that is; empty if it was not found
};

/// Returns the file of a name, or "".
using FindFile = std::function<std::filesystem::path(const std::string&)>;

/// What a file names, in the order of its bytes: an OBJ file its materials, a material file, DAE, glTF and GLB their
/// images, glTF its buffers too. Files of other formats name none. A name in an OBJ or material file may have blanks
/// and stand behind options: what `find` finds tells where it begins. Throws InputError for a file that cannot be read,
/// and for DAE that is no XML.
std::vector<FileReference> references_in(const std::filesystem::path& file, const FindFile& find);

/// The edits of a file after which its references name files of its own folder: `names` has one for each of them, of
/// letters, digits and _-. alone.
std::vector<XmlEdit> renamed(const std::filesystem::path& file, std::span<const FileReference> references,
                             std::span<const std::string> names);

}  // namespace prohull::robot

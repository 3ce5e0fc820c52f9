#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "robot/files/robot_file.h"
#include "robot/files/xml.h"

namespace prohull::robot {

/// The files that the text of a URDF or SDF file names, under new names: meshes, textures, and every attribute and text
/// that begins with package://. Without `new_uri`, they are found from `folder`, as with_collisions says.
class RenamedFiles {
 public:
  RenamedFiles(const RobotFile& file, const XmlDocument& document, const std::filesystem::path& folder, NewUri new_uri);

  /// The bytes of a part of the text with new URIs.
  std::string part(const Span& part) const;
  /// Adds the new URIs of what stays: it lies outside of what the other edits replace.
  void add_to(std::vector<XmlEdit>& edits) const;

 private:
  void collect(const XmlElement& element);
  std::vector<XmlEdit> renamed(const std::vector<XmlEdit>& old) const;

  const XmlDocument& document_;
  const NewUri new_uri_;
  std::vector<XmlEdit> old_;  // with the old URIs, in the order of the text
};

}  // namespace prohull::robot

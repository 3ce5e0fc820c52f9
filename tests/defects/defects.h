#pragma once

#include <string>
#include <vector>

namespace prohull::meshes {

/// A small file with one kind of defect, as exporters and scanners leave them.
struct DefectiveFile {
  std::string name;  ///< "holes.off": the defect, and the extension it goes by
  std::string content;
};

/// One of each kind, the same bytes every time; the first is sound.
std::vector<DefectiveFile> defective_files();

}  // namespace prohull::meshes

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull::cli {

/// What is said of a mesh as a solid; sentences, which may be empty.
struct SolidNotes {
  std::string turned;  ///< what was inside out
  std::string open;    ///< that the mesh is not closed, and has no inside

  /// Makes the mesh, which is closed, the solid that it stands for (outward_solid).
  static SolidNotes turning(TriangleMesh& closed, const std::filesystem::path& path);

  static SolidNotes not_closed(const std::filesystem::path& path);

  bool is_inside_out() const { return !turned.empty(); }
  std::vector<std::string> all() const;

  /// As lines of the summary. With --quiet, what has no inside is told on standard error.
  void say_them() const;
};

}  // namespace prohull::cli

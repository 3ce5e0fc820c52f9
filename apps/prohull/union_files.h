#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "inputs.h"
#include "prohull/detail/shapes.h"
#include "prohull/triangle_mesh.h"

namespace prohull::cli {

/// What the files of pieces hold: meshes or balls.
struct Union {
  std::vector<TriangleMesh> pieces;
  std::vector<Ball> balls;
  std::vector<std::string> notes;  ///< sentences for the user

  /// "3 pieces", "1 sphere"
  std::string description() const;
};

/// Each connected component of a mesh file is a piece. Of robots and YAML files, whose links may be many, `link` picks
/// one; it may be empty where only one link has pieces. Throws InputError.
Union read_union(const std::vector<std::filesystem::path>& files, const InputOptions& input, const std::string& link);

}  // namespace prohull::cli

#pragma once

#include <string>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// A closed mesh as the solid that it stands for, and what is to be said of it.
struct OutwardSolid {
  TriangleMesh mesh;   ///< turned_outwards: the same faces with the same numbers
  std::string turned;  ///< "arm is inside out: it was turned, so that its inside counts as solid"; may be empty
  /// "the component of face 12 of arm is inside out: nothing is inside of it": what crosses or repeats others, so that
  /// it stays as it is; may be empty.
  std::string hollow;

  bool was_inside_out() const { return !turned.empty() || !hollow.empty(); }
  std::vector<std::string> notes() const;  ///< those of the two that are not empty
};

/// Required: the mesh is closed and finite. As exact as turned_outwards.
OutwardSolid outward_solid(TriangleMesh closed, const std::string& name);

}  // namespace prohull

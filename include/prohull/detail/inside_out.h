#pragma once

#include <string>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// A closed mesh as the solid that it stands for, and what is to be said of it.
struct OutwardSolid {
  TriangleMesh mesh;   ///< the same faces with the same numbers; all components look outwards, but for cavities
  std::string turned;  ///< "arm is inside out: it was turned, so that its inside counts as solid"; may be empty
};

/// Required: the mesh is closed and finite. As exact as turned_outwards, which leaves components that are inside out
/// and cross or repeat others as they are: here they are turned, too, for what is free of them as solids is free of
/// them as holes.
OutwardSolid outward_solid(TriangleMesh closed, const std::string& name);

}  // namespace prohull

#pragma once

#include "prohull/triangle_mesh.h"

namespace prohull {

/// The tolerances of the faces of `given` for the faces of `repaired`, which are the same but for repairs: a face has
/// the least tolerance of those at its place. Faces that a repair has added may be at any distance. Throws
/// InputError(InvalidOption) if a face with a tolerance has no counterpart, unless it has no area or is not finite.
PerFace<double> carried_tolerances(const TriangleMesh& given, const PerFace<double>& tolerances,
                                   const TriangleMesh& repaired);

}  // namespace prohull

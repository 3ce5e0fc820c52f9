#pragma once

#include "prohull/tight_hull.h"

namespace prohull {

/// build_tight_hull without the search for hulls of few faces (few_faces.h).
TightHull build_unsearched_tight_hull(const TriangleMesh& mesh, const HullOptions& options, const TriangleMesh* wrapped,
                                      double padding);

}  // namespace prohull

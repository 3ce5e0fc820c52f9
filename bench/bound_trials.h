#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "prohull/enclosing_hull.h"

namespace prohull::bench {

/// A hull that was built to keep a bound of the distance.
struct BoundTrial {
  std::string what;  ///< "wrap 0.5 flat, within 0.85": lengths in largest distances
  std::size_t faces;
  bool is_kept;
};

/// An exhaustive search for the hull of fewest faces, at least `faces`, that keeps options.bounds.max_distance: levels
/// of the mesh, of its convex hull and of wraps with spacings of 2 to 1/4 of it, as they are and moved, and collapses
/// that keep 0.7 to 1.75 of it; each also with further collapses. Finer wraps than `finest` are left out.
std::vector<BoundTrial> bound_trials(const TriangleMesh& mesh, std::size_t faces, const EnclosingOptions& options,
                                     double finest);

}  // namespace prohull::bench

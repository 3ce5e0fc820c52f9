#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull::bench {

struct PiecesRun {
  double seconds;                    ///< elapsed, of the peer's work alone
  std::vector<TriangleMesh> pieces;  ///< convex, closed and outwards; those without a volume are left out
};

/// Hierarchical Approximate Convex Decomposition, with as many clusters as asked for and at most `vertices` vertices of
/// each. It claims neither to cover nor to enclose. It takes a minute for 20,000 faces: give it a coarser mesh. Nothing
/// if it was not built.
std::optional<PiecesRun> run_hacd(const TriangleMesh& mesh, std::size_t pieces, std::size_t vertices);

}  // namespace prohull::bench

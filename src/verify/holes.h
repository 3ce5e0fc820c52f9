#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "verify/cell.h"
#include "verify/solids.h"

namespace prohull::verify {

/// For a face of the outer surface, cells of it, one at least within each connected part beside which `outer` winds
/// less than once; nothing if that is not known.
using OpenCells = std::function<std::optional<std::vector<Cell>>(FaceIndex)>;

/// If `outer` covers every triangle of `inner` (verify_cover), it encloses `inner` if and only if there are no holes.
/// Exact: no triangle of `inner` reaches the open space around which `outer` winds less than once, so that the winding
/// of `inner` is the same all over each connected part of that space, and each is bounded by faces of `outer` alone.
Holes find_holes(const Surface& inner, const Surface& outer, const OpenCells& open_cells, const Progress& progress);

}  // namespace prohull::verify

#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// Corner count - 2 triangles with the polygon's boundary and orientation, whatever its shape; without overlap if the
/// polygon, seen along the main axis of its normal, is simple. A convex polygon becomes a fan of its first corner.
/// Empty if that would take more than 2,000 point-in-triangle tests per corner, which real polygons do not.
/// Ear clipping (Meisters, "Polygons have ears", 1975) with exact turns.
std::optional<std::vector<std::array<VertexId, 3>>> triangulate_polygon(std::span<const VertexId> corners,
                                                                        const PerVertex<Vec3>& positions);

}  // namespace prohull

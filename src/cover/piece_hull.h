#pragma once

#include <cstddef>

#include "cover/part.h"

namespace prohull::cover {

/// A convex polytope that encloses a part, of at most so many vertices. Vertices that were rounded where a plane cuts
/// the surface get a hair of room, so that the polytopes of both sides cover what is between them. Without faces if the
/// part is empty.
TriangleMesh piece_hull(const Part& part, std::size_t max_vertices, bool float32_coordinates);

}  // namespace prohull::cover

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "prohull/geometry.h"

namespace prohull {

/// Segments as in P&T 4.2: each from one side of a box twice as large as `box`, about the same centre, to another side;
/// the two sides, and the points on them, uniformly at random. The same bits for the same arguments with every
/// compiler and standard library. Throws InputError(EmptyMesh) for an empty box, InputError(NonFiniteCoordinate) for
/// one that is not finite when doubled.
std::vector<Segment> random_segments(const Box& box, std::size_t count, std::uint64_t seed);

}  // namespace prohull

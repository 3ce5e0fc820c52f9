#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "prohull/geometry.h"

namespace prohull {

/// Random segments as in P&T 4.2. Each runs from one side of a box to another; that box is twice as large as `box` and
/// has the same centre. The two sides, and the points on them, are uniformly random.
/// Guaranteed: the same arguments give the same bits, with every compiler and standard library.
/// Throws InputError(EmptyMesh) if the box is empty, InputError(NonFiniteCoordinate) if it is not finite when doubled.
std::vector<Segment> random_segments(const Box& box, std::size_t count, std::uint64_t seed);

/// Uniformly random points of the box. Guaranteed: the same arguments give the same bits. Throws as random_segments.
std::vector<Vec3> random_points(const Box& box, std::size_t count, std::uint64_t seed);

}  // namespace prohull

#pragma once

#include <cstdint>

#include "prohull/detail/scramble.h"
#include "prohull/geometry.h"

namespace prohull {

/// Perlin's gradient noise: smooth, about in [-1, 1], features of size 1.
double gradient_noise(const Vec3& p, std::uint64_t seed);

}  // namespace prohull

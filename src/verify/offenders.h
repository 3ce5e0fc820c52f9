#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prohull/enclosure.h"
#include "verify/surface.h"

namespace prohull::verify {

/// From p to the triangle, rounded.
double distance(const Vec3& p, const Triangle& t);

/// From p to the box; never above the distance to anything in it, but for rounding.
double distance(const Vec3& p, const Box& box);

/// The one of the points, all of `face`, that is farthest from the surface.
Offender farthest(FaceId face, std::span<const Vec3> points, const Surface& surface);

/// At most `count`, farthest first; of equal distances the first face first.
std::vector<Offender> worst_of(std::vector<Offender> offenders, std::size_t count);

}  // namespace prohull::verify

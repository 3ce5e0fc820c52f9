#pragma once

#include "prohull/geometry.h"

namespace prohull::verify {

/// From p to the triangle, rounded.
double distance(const Vec3& p, const Triangle& t);

/// From p to the box; never above the distance to anything in it, but for rounding.
double distance(const Vec3& p, const Box& box);

}  // namespace prohull::verify

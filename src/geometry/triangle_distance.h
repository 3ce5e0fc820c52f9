#pragma once

#include "prohull/geometry.h"

namespace prohull {

/// Bounds of the distance between two triangles, and rounded points of them that far apart.
struct TriangleDistance {
  double lower = 0, upper = 0;
  Vec3 s, t;
};

/// Both bounds hold for all triangles within 1e100, also without area. For triangles that do not meet they differ by
/// some 2^-45 of the size of both; else the lower one is 0.
TriangleDistance triangle_distance(const Triangle& s, const Triangle& t);

/// Whether no point of s is nearer to a point of t than `distance`, which is finite and at least 0. Exact for all
/// coordinates within 1e100: triangles that are precisely so far apart are apart. Triangles without area count as the
/// segments or points that they are.
bool are_apart(const Triangle& s, const Triangle& t, double distance);

}  // namespace prohull

#pragma once

#include <span>

#include "prohull/detail/shapes.h"
#include "prohull/triangle_mesh.h"

namespace prohull::render {

// Meshes that stand for lines, points and balls.

/// Around the segment, closed at both ends; nothing if that has no length.
TriangleMesh rod(const Segment& segment, double radius);
/// Short rods from end to end; with the gaps between them `period` long.
TriangleMesh dashes(const Segment& segment, double radius, double period);
TriangleMesh ball(const Vec3& center, double radius);
/// All of them; the more there are, the fewer faces each has.
TriangleMesh spheres(std::span<const Ball> balls);

}  // namespace prohull::render

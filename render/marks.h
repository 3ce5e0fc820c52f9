#pragma once

#include "prohull/triangle_mesh.h"

namespace prohull::render {

// Meshes that stand for lines and points.

/// Around the segment, closed at both ends; nothing if that has no length.
TriangleMesh rod(const Segment& segment, double radius);
/// Short rods from end to end; with the gaps between them `period` long.
TriangleMesh dashes(const Segment& segment, double radius, double period);
TriangleMesh ball(const Vec3& center, double radius);

}  // namespace prohull::render

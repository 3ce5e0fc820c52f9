#pragma once

#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull::cover {

/// A mesh that uses the points.
TriangleMesh fan_of(std::vector<Vec3> points);

/// The convex hull of points. No faces if they lie in a plane.
TriangleMesh convex_hull_of(std::vector<Vec3> points);

/// The mean of the vertices.
Vec3 middle(const TriangleMesh& polytope);

/// The distance of a point inside to the nearest plane of a face.
double depth(const Vec3& p, const TriangleMesh& polytope);

}  // namespace prohull::cover

#pragma once

#include <array>
#include <cmath>

#include "prohull/geometry.h"
#include "prohull/triangle_mesh.h"

namespace prohull::render {

/// The normal of length 1; zero for a face without area.
Vec3 face_normal(const Triangle& triangle);

using CornerNormals = PerFace<std::array<Vec3, 3>>;

/// For each corner of a face the mean, weighted by angle, of the normals around its vertex that are within
/// `crease_angle` (radians) of the face's own: smooth surfaces look smooth, and sharp edges stay sharp.
CornerNormals corner_normals(const TriangleMesh& mesh, double crease_angle);

/// At a point of the triangle, of length 1.
Vec3 interpolated_normal(const Triangle& triangle, const std::array<Vec3, 3>& corners, const Vec3& point);

/// Two directions that are orthogonal to n, of length 1, and to each other.
inline std::array<Vec3, 2> tangents(const Vec3& n) {
  const Vec3 other = std::abs(n.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = cross(n, other), first = across / norm(across);
  return {first, cross(n, first)};
}

}  // namespace prohull::render

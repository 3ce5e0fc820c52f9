#pragma once

#include <cstddef>
#include <numbers>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// How values are spread where greater is better: the worst of them, and those that 1, 10 and 50 % do not exceed.
struct Percentiles {
  double worst = 0, p1 = 0, p10 = 0, median = 0;
};

/// An edge with a smaller dihedral angle is sharp: its faces turn by more than 45 degrees.
constexpr double kSharpDihedralAngle = 0.75 * std::numbers::pi;

/// How good the triangles of a mesh are; rounded. Nothing is refused: what cannot be measured does not count.
struct MeshQuality {
  /// Of faces, P&T 3.1.4: 4 sqrt(3) area / (sum of the squared edges), 1 if equilateral, 0 without area.
  Percentiles compactness;
  /// Of edges between two faces of equal orientation, both with an area; radians, pi where flat and 0 where folded
  /// onto itself, whether convex or not.
  Percentiles dihedral_angle;
  std::size_t edges = 0;        ///< that have a dihedral angle
  std::size_t sharp_edges = 0;  ///< below kSharpDihedralAngle
};

MeshQuality mesh_quality(const TriangleMesh& mesh);

}  // namespace prohull

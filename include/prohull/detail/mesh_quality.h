#pragma once

#include <cstddef>
#include <numbers>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// The spread of values of which greater ones are better: the least value, and the values that 1 %, 10 % and 50 % of
/// all do not exceed.
struct Percentiles {
  double worst = 0, p1 = 0, p10 = 0, median = 0;
};

/// An edge is *sharp* if its dihedral angle is smaller than this: if its faces turn by more than 45 degrees.
constexpr double kSharpDihedralAngle = 0.75 * std::numbers::pi;

/// How good the triangles of a mesh are. All values are rounded. Elements that cannot be measured are left out.
struct MeshQuality {
  /// The compactness of faces (P&T 3.1.4): 4 sqrt(3) area / (sum of the squared edges); 1 if a face is equilateral, 0
  /// if it has no area.
  Percentiles compactness;
  /// The dihedral angle of edges between two faces that have an area and agree about the outside. In radians: pi where
  /// the surface is flat, 0 where it is folded onto itself. Convex and concave edges are not told apart.
  /// 0 if there is no such edge.
  Percentiles dihedral_angle;
  double smallest_angle = 0;      ///< of all corners of faces, in radians; 0 if a face has no area
  double worst_aspect_ratio = 0;  ///< longest edge of a face / its shortest altitude; 1.15 if all are equilateral,
                                  ///< infinite if a face has no area
  std::size_t edges = 0;          ///< edges that have a dihedral angle
  std::size_t sharp_edges = 0;    ///< edges below kSharpDihedralAngle
};

MeshQuality mesh_quality(const TriangleMesh& mesh);

}  // namespace prohull

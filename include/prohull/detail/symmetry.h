#pragma once

#include <cstddef>
#include <string>

#include "prohull/detail/names.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// Planes of symmetry are perpendicular to one of these.
enum class Axis { X, Y, Z };

/// "x", "y", "z"
Names<Axis> axis_names();

/// How a mesh lies to its mirror image in the plane through the middle of its bounding box, perpendicular to an axis.
///
/// A vertex has a mirror image if another vertex, or the vertex itself in the plane, lies exactly there: the two
/// coordinates along the axis have exactly twice that of the plane as their sum, and the other coordinates are equal. A
/// face has one if a face of the mirrored corners faces the mirrored way.
struct SymmetryReport {
  double plane = 0;  ///< its coordinate on the axis
  std::size_t vertices_without_image = 0;
  std::size_t faces_without_image = 0;
  /// The first of them: "vertex 12 at (1, 0, 2) has no mirror image in the plane x = 0.5"; empty if there is none.
  std::string first_defect;

  bool is_symmetric() const { return vertices_without_image == 0 && faces_without_image == 0; }
};

/// Exact. Vertices that no face uses do not count.
SymmetryReport inspect_symmetry(const TriangleMesh& mesh, Axis axis);

}  // namespace prohull

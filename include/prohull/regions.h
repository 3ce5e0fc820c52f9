#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "prohull/detail/mesh_marks.h"
#include "prohull/geometry.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// Faces that a file paints in a colour, or of which it paints all corners in it.
struct PaintedColor {
  Color color;
  unsigned spread = 0;  ///< red, green and blue may differ by so much, each; 0 to 255
};

/// Faces of a group, an object or a material of that name.
struct NamedGroup {
  std::string name;
};

/// From `first` to `last`, both included; numbers count from 0.
struct NumberRange {
  std::uint32_t first = 0, last = 0;
};

/// Faces by their numbers: those of the triangles, in the order in which they are read.
struct NumberedFaces {
  std::vector<NumberRange> ranges;
};

/// Faces of which all corners have these numbers.
struct NumberedVertices {
  std::vector<NumberRange> ranges;
};

/// Which faces; with a Box those of which all corners lie in the box or on its border.
using RegionFaces = std::variant<Box, PaintedColor, NamedGroup, NumberedFaces, NumberedVertices>;

/// Part of a mesh, and how far it may be from a hull.
struct Region {
  std::string name;         ///< for messages and reports
  double max_distance = 0;  ///< as HullOptions::tolerances: 0 keeps the faces, infinity allows any distance
  RegionFaces faces;
};

/// Of each face, the number of the first region that it belongs to; regions.size() if it belongs to none. Throws
/// InputError(InvalidOption) if a region has no faces, or none that no region before it has, and if it asks for
/// colours, names or numbers that the mesh has not.
PerFace<std::uint32_t> regions_of_faces(const TriangleMesh& mesh, const MeshMarks& marks,
                                        const std::vector<Region>& regions);

/// HullOptions::tolerances for these regions; faces that belong to none may be at any distance.
PerFace<double> tolerances_of(const PerFace<std::uint32_t>& regions_of_faces, const std::vector<Region>& regions);

}  // namespace prohull

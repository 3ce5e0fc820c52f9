#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "prohull/detail/ids.h"

namespace prohull {

struct Color {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const Color&) const = default;
};

/// What a mesh file says of its vertices and faces beside their geometry. What the file does not say is empty.
struct MeshMarks {
  PerVertex<Color> vertex_colors;               ///< of PLY
  PerFace<Color> face_colors;                   ///< of PLY
  std::vector<std::vector<std::string>> names;  ///< of OBJ: each combination of group, object and material that occurs
  PerFace<std::uint32_t> names_of;              ///< of OBJ: the combination that a face has
};

/// A polygon whose corner count - 2 triangles are not the fan of its first corner.
struct DividedFace {
  FaceId first_triangle;
  std::vector<VertexId> corners;
};

}  // namespace prohull

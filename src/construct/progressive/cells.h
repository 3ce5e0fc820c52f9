#pragma once

#include <vector>

#include "geometry/unit_cube.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// A box of a partition of all space, and the faces that reach into it, in their order.
struct Cell {
  FloatBox box;
  std::vector<FaceId> faces;
};

struct BoxedFace {
  FaceId face;
  FloatBox box;
};

FloatBox everywhere();

/// Splits a box until no cell has more than `most_faces`, or splitting does not help. What lies on the border between
/// two cells is in the boxes of both, but inside of none: other values of `shift`, in [0, 1), have other borders.
std::vector<Cell> split_into_cells(const std::vector<BoxedFace>& faces, std::size_t most_faces, double shift,
                                   const FloatBox& box = everywhere());

/// Along a curve through [-1, 1]^3: what lies near each other in space does so in the list, mostly.
std::vector<FaceId> along_curve(const std::vector<BoxedFace>& faces);

}  // namespace prohull

#pragma once

#include <array>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull::view {

/// The faces of an original, to leave them out of hulls: their distance from the original is 0, which a search for the
/// farthest point would only find out by cutting them into many parts.
class SharedFaces {
 public:
  explicit SharedFaces(const TriangleMesh& original);
  /// The faces that have other corners than those of the original.
  TriangleMesh left_out_of(TriangleMesh mesh) const;

 private:
  using Corners = std::array<std::array<double, 3>, 3>;  // in ascending order
  static Corners corners_of(const Triangle& face);

  std::vector<Corners> faces_;
};

}  // namespace prohull::view

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "prohull/detail/progress_meter.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// Nodes at equal spacing along each axis.
class Grid {
 public:
  /// With so many spacings beyond the box on each side.
  Grid(const Box& box, double spacing, double margin);

  double spacing() const { return spacing_; }
  std::size_t nodes(int axis) const { return nodes_[static_cast<std::size_t>(axis)]; }
  std::size_t node_count() const { return nodes_[0] * nodes_[1] * nodes_[2]; }
  std::size_t node(std::size_t x, std::size_t y, std::size_t z) const { return (z * nodes_[1] + y) * nodes_[0] + x; }
  Vec3 position(const Vec3& in_spacings) const { return origin_ + in_spacings * spacing_; }
  Vec3 in_spacings(const Vec3& position) const { return (position - origin_) / spacing_; }

  /// Whether a node is in the box, or nearer to it than a spacing.
  bool is_in_box(std::size_t node) const {
    const std::array<std::size_t, 3> at{node % nodes_[0], node / nodes_[0] % nodes_[1], node / nodes_[0] / nodes_[1]};
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (at[axis] < beyond_ || at[axis] + beyond_ >= nodes_[axis]) return false;
    return true;
  }

  /// use(neighbour) for the up to 14 nodes that a tetrahedron has in common with this one (level_surface.h).
  template <class Use>
  void around(std::size_t node, Use&& use) const {
    const std::array<std::size_t, 3> at{node % nodes_[0], node / nodes_[0] % nodes_[1], node / nodes_[0] / nodes_[1]};
    for (unsigned step = 1; step < 8; ++step) {
      const std::size_t length = (step & 1) + (step >> 1 & 1) * nodes_[0] + (step >> 2) * nodes_[0] * nodes_[1];
      bool has_next = true, has_last = true;
      for (unsigned axis = 0; axis < 3; ++axis)
        if (step >> axis & 1) has_next &= at[axis] + 1 < nodes_[axis], has_last &= at[axis] > 0;
      if (has_next) use(node + length);
      if (has_last) use(node - length);
    }
  }

 private:
  double spacing_;
  Vec3 origin_;
  std::array<std::size_t, 3> nodes_;
  std::size_t beyond_;  ///< this many nodes are beyond the box on each side, at least
};

/// The distance of each node from the triangles, in spacings, where it is less than `band`, and `band` elsewhere. The
/// triangles must be farther than `band` from the border of the grid.
std::vector<float> distances(const Grid& grid, const TriangleMesh& triangles, float band, ProgressMeter& meter);

}  // namespace prohull

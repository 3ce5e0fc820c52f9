#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "prohull/detail/progress_meter.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// Nodes at equal spacing along each axis.
class Grid {
 public:
  /// With so many spacings beyond the box on each side.
  Grid(const Box& box, double spacing, double margin);

  /// Its nodes are every so many of this one's.
  Grid coarser(std::size_t times) const;

  double spacing() const { return spacing_; }
  std::size_t nodes(int axis) const { return nodes_[static_cast<std::size_t>(axis)]; }
  std::size_t node_count() const { return nodes_[0] * nodes_[1] * nodes_[2]; }
  std::size_t node(std::size_t x, std::size_t y, std::size_t z) const { return (z * nodes_[1] + y) * nodes_[0] + x; }
  Vec3 place(std::size_t node) const {
    const std::size_t y = node / nodes_[0] % nodes_[1], z = node / nodes_[0] / nodes_[1];
    return {double(node % nodes_[0]), double(y), double(z)};
  }
  Vec3 position(const Vec3& in_spacings) const { return origin_ + in_spacings * spacing_; }
  Vec3 in_spacings(const Vec3& position) const { return (position - origin_) / spacing_; }

  /// Whether a node is in the box, or nearer to it than a spacing.
  bool is_in_box(std::size_t node) const {
    const std::array<std::size_t, 3> at{node % nodes_[0], node / nodes_[0] % nodes_[1], node / nodes_[0] / nodes_[1]};
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (at[axis] < beyond_ || at[axis] + beyond_ >= nodes_[axis]) return false;
    return true;
  }

  /// use(node) for each on the border.
  template <class Use>
  void along_border(Use&& use) const {
    const auto is_last = [&](std::size_t axis, std::size_t at) { return at == 0 || at + 1 == nodes_[axis]; };
    for (std::size_t z = 0; z < nodes_[2]; ++z)
      for (std::size_t y = 0; y < nodes_[1]; ++y) {
        const std::size_t step = is_last(1, y) || is_last(2, z) ? 1 : nodes_[0] - 1;
        for (std::size_t x = 0; x < nodes_[0]; x += step) use(node(x, y, z));
      }
  }

  /// use(neighbour) for the up to 14 nodes that a tetrahedron has in common with this one (level_surface.h).
  template <class Use>
  void around(std::size_t node, Use&& use) const {
    const std::array<std::size_t, 3> at{node % nodes_[0], node / nodes_[0] % nodes_[1], node / nodes_[0] / nodes_[1]};
    unsigned has_next = 0, has_last = 0;  // bit i: along axis i
    for (unsigned axis = 0; axis < 3; ++axis) {
      has_next |= unsigned{at[axis] + 1 < nodes_[axis]} << axis;
      has_last |= unsigned{at[axis] > 0} << axis;
    }
    for (unsigned step = 1; step < 8; ++step) {
      const std::size_t length = (step & 1) + (step >> 1 & 1) * nodes_[0] + (step >> 2) * nodes_[0] * nodes_[1];
      if ((step & has_next) == step) use(node + length);
      if ((step & has_last) == step) use(node - length);
    }
  }

 private:
  double spacing_;
  Vec3 origin_;
  std::array<std::size_t, 3> nodes_;
  std::size_t beyond_;  ///< this many nodes are beyond the box on each side, at least
};

/// The distance of each node from the triangles, in spacings, where it is less than `band`, and `band` elsewhere.
std::vector<float> distances(const Grid& grid, const TriangleMesh& triangles, float band, ProgressMeter& meter);

}  // namespace prohull

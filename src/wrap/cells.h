#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wrap/grid.h"

namespace prohull {

/// Cubes of 1, 2, 4 or 8 spacings that fill a grid, each at a multiple of its size.
class Cells {
 public:
  static constexpr std::size_t kLargest = 8;

  /// All of them have one spacing.
  explicit Cells(const Grid& grid) : grid_(grid) {}

  /// As large as possible where `values` are linear within `tolerance` near `level`, on the tetrahedra of the cell.
  /// There, they are made so, exactly: values between corners stay linear at nodes of smaller cells beside it.
  Cells(const Grid& grid, std::vector<float>& values, float level, float tolerance);

  std::size_t largest() const { return sizes_.empty() ? 1 : kLargest; }
  std::size_t size_at(std::size_t x, std::size_t y, std::size_t z) const {
    return sizes_.empty() ? 1 : sizes_[pair(x, y, z)];
  }

 private:
  std::size_t pair(std::size_t x, std::size_t y, std::size_t z) const {
    return (z / 2 * pairs(1) + y / 2) * pairs(0) + x / 2;
  }
  std::size_t pairs(int axis) const { return (grid_.nodes(axis) + 1) / 2; }
  void set_size(std::size_t x, std::size_t y, std::size_t z, std::size_t size);

  const Grid& grid_;
  std::vector<std::uint8_t> sizes_;  ///< of the cell in which two nodes along each axis are; empty if all are 1
};

}  // namespace prohull

#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/simd.h"
#include "geometry/unit_cube.h"

namespace prohull {

constexpr FloatBox kEmptyBox = [] {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  return FloatBox{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
}();

/// The boxes of four children, one in each lane; an empty one where there is none.
struct FourBoxes {
  static constexpr std::uint32_t kWidth = 4;
  Float4 min[3], max[3];

  /// The same box in all lanes.
  static FourBoxes four(const FloatBox& box) {
    FourBoxes boxes;
    for (int axis = 0; axis < 3; ++axis) {
      const float low = box.min[axis], high = box.max[axis];
      boxes.min[axis] = Float4{low, low, low, low}, boxes.max[axis] = Float4{high, high, high, high};
    }
    return boxes;
  }
  void set(std::uint32_t child, const FloatBox& box) {
    for (int axis = 0; axis < 3; ++axis) min[axis][child] = box.min[axis], max[axis][child] = box.max[axis];
  }
  FloatBox child(std::uint32_t i) const {
    return {{min[0][i], min[1][i], min[2][i]}, {max[0][i], max[1][i], max[2][i]}};
  }
  /// The box around all four.
  FloatBox around() const {
    FloatBox box = child(0);
    for (std::uint32_t i = 1; i < kWidth; ++i) box.extend(child(i));
    return box;
  }
  /// Bit i is set if the boxes in lane i overlap.
  unsigned overlapping(const FourBoxes& other) const {
    return mask((min[0] <= other.max[0]) & (max[0] >= other.min[0]) & (min[1] <= other.max[1]) &
                (max[1] >= other.min[1]) & (min[2] <= other.max[2]) & (max[2] >= other.min[2]));
  }
};

/// Levels of a tree over boxes: the children of node i are boxes, or nodes of the level before, from 4i on.
using FourWideTree = std::vector<std::vector<FourBoxes>>;

inline FourWideTree four_wide_tree(std::vector<FloatBox> boxes) {
  constexpr std::uint32_t kWidth = FourBoxes::kWidth;
  FourWideTree levels;
  do {
    std::vector<FloatBox> parents((boxes.size() + kWidth - 1) / kWidth, kEmptyBox);
    std::vector<FourBoxes>& level = levels.emplace_back(parents.size(), FourBoxes::four(kEmptyBox));
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      parents[i / kWidth].extend(boxes[i]);
      level[i / kWidth].set(i % kWidth, boxes[i]);
    }
    boxes = std::move(parents);
  } while (boxes.size() > 1);
  return levels;
}

}  // namespace prohull

#pragma once

#include <cstddef>
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

  static FourBoxes four(const FloatBox& box) {
    FourBoxes boxes;
    for (std::uint32_t child = 0; child < kWidth; ++child) boxes.set(child, box);
    return boxes;
  }
  void set(std::uint32_t child, const FloatBox& box) {
    for (int axis = 0; axis < 3; ++axis) min[axis][child] = box.min[axis], max[axis][child] = box.max[axis];
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

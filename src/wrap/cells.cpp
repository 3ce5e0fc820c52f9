#include "wrap/cells.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace prohull {
namespace {

constexpr float kClear = 0.5F;         ///< values that are farther from the level stay on their side of it
constexpr float kFarFromLevel = 1.5F;  ///< values that are farther from it are not near the surface

/// One cell that may become a large one.
class LargeCell {
 public:
  LargeCell(const Grid& grid, std::vector<float>& values, float level, std::size_t size)
      : values_(values),
        level_(level),
        size_(size),
        stride_{1, grid.nodes(0), grid.nodes(0) * grid.nodes(1)},
        unit_(0x1p19F / float(size)) {}

  void move_to(std::size_t node) {
    first_ = node;
    for (std::size_t c = 0; c < 8; ++c) corners_[c] = std::round(values_[first_ + size_ * along(c)] * unit_) / unit_;
  }

  bool is_clear() const {
    bool is_above = true, is_below = true;
    return each([&](float& value, const auto&) {
      is_above = is_above && value > level_ + kClear, is_below = is_below && value < level_ - kClear;
      return is_above || is_below;
    });
  }

  bool is_linear(float tolerance) const {
    return each([&](float& value, const auto& at) {
      const float linear = interpolated(at);
      const auto is_far = [&](float v) { return std::abs(v - level_) > kFarFromLevel; };
      return std::abs(linear - value) <= tolerance ||
             (is_far(linear) && is_far(value) && (linear > level_) == (value > level_));
    });
  }

  void make_linear() {
    each([&](float& value, const auto& at) { return value = interpolated(at), true; });
  }

 private:
  std::size_t along(std::size_t axes) const {
    return (axes & 1) * stride_[0] + (axes >> 1 & 1) * stride_[1] + (axes >> 2) * stride_[2];
  }

  /// Calls use(value, node in the cell) for each node until it says no.
  template <class Use>
  bool each(Use use) const {
    std::array<std::size_t, 3> at{};
    for (at[2] = 0; at[2] <= size_; ++at[2])
      for (at[1] = 0; at[1] <= size_; ++at[1]) {
        float* const row = &values_[first_ + at[2] * stride_[2] + at[1] * stride_[1]];
        for (at[0] = 0; at[0] <= size_; ++at[0])
          if (!use(row[at[0]], at)) return false;
      }
    return true;
  }

  /// Exact: corners are multiples of 1 / unit, and less than 2^5.
  float interpolated(const std::array<std::size_t, 3>& at) const {
    std::array<std::size_t, 3> order{0, 1, 2};  // the farthest axis first
    const auto put_in_order = [&](std::size_t i) {
      if (at[order[i]] < at[order[i + 1]]) std::swap(order[i], order[i + 1]);
    };
    put_in_order(0), put_in_order(1), put_in_order(0);
    std::size_t corner = 0, before = size_;
    float sum = 0;
    for (const std::size_t axis : order) {
      sum += float(before - at[axis]) * corners_[corner];
      before = at[axis];
      corner |= std::size_t{1} << axis;
    }
    return (sum + float(before) * corners_[7]) / float(size_);
  }

  std::vector<float>& values_;
  const float level_;
  const std::size_t size_;
  const std::array<std::size_t, 3> stride_;
  const float unit_;
  std::size_t first_ = 0;
  std::array<float, 8> corners_{};
};

}  // namespace

Cells::Cells(const Grid& grid, std::vector<float>& values, float level, float tolerance)
    : grid_(grid), sizes_(pairs(0) * pairs(1) * pairs(2), 1) {
  for (std::size_t size = kLargest; size > 1; size /= 2) {
    LargeCell cell(grid, values, level, size);
    for (std::size_t z = 0; z + size < grid.nodes(2); z += size)
      for (std::size_t y = 0; y + size < grid.nodes(1); y += size)
        for (std::size_t x = 0; x + size < grid.nodes(0); x += size) {
          if (size_at(x, y, z) > size) continue;
          cell.move_to(grid.node(x, y, z));
          const bool is_clear = cell.is_clear();
          if (!is_clear && !cell.is_linear(tolerance)) continue;
          if (!is_clear) cell.make_linear();
          set_size(x, y, z, size);
        }
  }
}

void Cells::set_size(std::size_t x, std::size_t y, std::size_t z, std::size_t size) {
  for (std::size_t k = 0; k < size; k += 2)
    for (std::size_t j = 0; j < size; j += 2) std::fill_n(&sizes_[pair(x, y + j, z + k)], size / 2, std::uint8_t(size));
}

}  // namespace prohull

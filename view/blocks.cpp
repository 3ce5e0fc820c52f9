#include "view/blocks.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "robot/json.h"

namespace prohull::view {
namespace {

/// 0, -1, 1, -2, 2 become 0, 1, 2, 3, 4. Differences are those of 32-bit arithmetic, which wraps around.
std::uint32_t zigzag(std::uint32_t difference) { return difference << 1 ^ (difference >> 31 ? 0xffffffffU : 0U); }

std::size_t bytes_of(std::uint32_t value) { return value >> 24 ? 4 : value >> 16 ? 3 : value >> 8 ? 2 : 1; }

}  // namespace

nlohmann::json Blocks::add(const char* coding, std::span<const std::uint32_t> values, std::size_t stride) {
  const std::uint32_t greatest = values.empty() ? 0 : *std::ranges::max_element(values);
  const std::size_t planes = bytes_of(greatest);
  nlohmann::json found = {
      {"at", bytes_.size()}, {"count", values.size()}, {"planes", planes}, {"coding", coding}, {"stride", stride}};
  for (std::size_t plane = 0; plane < planes; ++plane)
    for (const std::uint32_t value : values) bytes_ += static_cast<char>(value >> (8 * plane) & 0xff);
  return found;
}

nlohmann::json Blocks::plain(std::span<const std::uint32_t> values) { return add("plain", values, 1); }

nlohmann::json Blocks::differences(std::span<const std::int32_t> values) {
  std::vector<std::uint32_t> coded;
  coded.reserve(values.size());
  for (const std::int32_t value : values) coded.push_back(zigzag(static_cast<std::uint32_t>(value)));
  return add("differences", coded, 1);
}

nlohmann::json Blocks::running(std::span<const std::uint32_t> values, std::size_t stride) {
  std::vector<std::uint32_t> coded;
  coded.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    coded.push_back(zigzag(values[i] - (i < stride ? 0 : values[i - stride])));
  return add("running", coded, stride);
}

namespace {

constexpr double kSteps = (1 << 30) - 1;

}  // namespace

Grid::Grid(const Box& scene) : origin_(scene.min) {
  // Divided first: the difference of huge coordinates may overflow.
  double side = 0;
  for (int axis = 0; axis < 3; ++axis) side = std::max(side, scene.max[axis] / kSteps - scene.min[axis] / kSteps);
  step_ = side > 0 ? side : 1;
}

std::array<std::uint32_t, 3> Grid::operator()(const Vec3& point) const {
  std::array<std::uint32_t, 3> steps;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = std::round(point[axis] / step_ - origin_[axis] / step_);
    steps[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(std::clamp(at, 0.0, kSteps));
  }
  return steps;
}

nlohmann::json Grid::facts() const { return {{"origin", origin_}, {"step", step_}}; }

}  // namespace prohull::view

#include "view/grid.h"

#include <algorithm>
#include <cmath>

#include "robot/json.h"

namespace prohull::view {
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

#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "prohull/geometry.h"

namespace prohull::view {

/// Where a page has its points: on a grid of a billion steps along the longest side of the scene. Meshes of one scene
/// share the grid, so that equal points are at one place.
class Grid {
 public:
  explicit Grid(const Box& scene);

  /// The nearest point of the grid, for points of the scene.
  std::array<std::uint32_t, 3> operator()(const Vec3& point) const;
  double step() const { return step_; }  ///< in the unit of the meshes

  nlohmann::json facts() const;

 private:
  Vec3 origin_;
  double step_;
};

}  // namespace prohull::view

#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "prohull/geometry.h"

namespace prohull::view {

/// The numbers of a page: arrays of whole numbers, one after another in one string of bytes. web/src/data/blocks.js
/// reads them. The bytes of an array are stored by significance, the lowest of all numbers first: like bytes side by
/// side compress well.
class Blocks {
 public:
  /// Each returns what the page needs to find the array and to read it.
  nlohmann::json plain(std::span<const std::uint32_t> values);
  /// Small negative numbers are stored as short as small positive ones.
  nlohmann::json differences(std::span<const std::int32_t> values);
  /// For numbers that differ little from those `stride` places before them.
  nlohmann::json running(std::span<const std::uint32_t> values, std::size_t stride);

  const std::string& bytes() const { return bytes_; }

 private:
  nlohmann::json add(const char* coding, std::span<const std::uint32_t> values, std::size_t stride);
  std::string bytes_;
};

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

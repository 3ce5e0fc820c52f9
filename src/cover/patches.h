#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull::cover {

/// The part of what is to be covered that lies in one cube of a grid. A ball that holds all its points covers it,
/// because the part lies within the convex hull of its points, and balls are convex.
struct Patch {
  Vec3 middle = {};   ///< the mean of the points
  double radius = 0;  ///< of a ball around the middle that holds all points
  std::uint32_t begin = 0, end = 0;
};

struct Patches {
  std::vector<Vec3> points;
  std::vector<Patch> patches;

  std::size_t size() const { return patches.size(); }
  std::span<const Vec3> points_of(const Patch& p) const { return std::span(points).subspan(p.begin, p.end - p.begin); }
};

/// A point that is to be covered, and the cube in which it counts.
struct PointInCube {
  std::uint64_t cube;
  Vec3 point;
};

/// Cubes of a grid over a box, each with a number.
class CubeGrid {
 public:
  /// The spacing becomes larger where the box would be more than 2^20 cubes wide.
  CubeGrid(const Box& box, double spacing);

  double spacing() const { return spacing_; }
  double plane(int axis, std::int64_t i) const { return origin_[axis] + static_cast<double>(i) * spacing_; }
  std::int64_t cell(int axis, double x) const;
  static std::uint64_t number(const std::array<std::int64_t, 3>& cell);

 private:
  Vec3 origin_;
  double spacing_;
};

/// Cuts the triangles along the walls of the cubes.
std::vector<PointInCube> points_in_cubes(const TriangleMesh& triangles, const CubeGrid& grid);

/// Groups points by their cube; equal points count once.
Patches patches_of(std::vector<PointInCube> points);

}  // namespace prohull::cover

#include "cover/inside_cubes.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numbers>

namespace prohull::cover {
namespace {

using CubePlace = std::array<std::int64_t, 3>;

/// Walks down an octree of which the leaves are cubes of the grid.
class InsideCubes {
 public:
  InsideCubes(const CubeGrid& grid, const Depth& depth, const std::vector<std::uint64_t>& crossed)
      : grid_(grid), depth_(depth), crossed_(crossed) {}

  void visit(const CubePlace& cell, std::int64_t width) {
    const double size = static_cast<double>(width) * grid_.spacing();
    const double depth = depth_.in_solid(corner(cell, width, 0.5));
    if (depth < -size * std::numbers::sqrt3 / 2) return;
    constexpr double kSizePerDepth = 0.8;
    const bool is_far_inside = depth > size * std::numbers::sqrt3 / 2 && size < kSizePerDepth * depth;
    if (width == 1 || is_far_inside) return add(cell, width, depth > 0);
    const std::int64_t half = width / 2;
    for (int i = 0; i < 8; ++i)
      visit({cell[0] + (i & 1) * half, cell[1] + (i >> 1 & 1) * half, cell[2] + (i >> 2) * half}, half);
  }

  std::vector<PointInCube> take() { return std::move(points_); }

 private:
  Vec3 corner(const CubePlace& cell, std::int64_t width, double fraction) const {
    return corner(cell, width, {fraction, fraction, fraction});
  }
  Vec3 corner(const CubePlace& cell, std::int64_t width, const Vec3& fraction) const {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = grid_.plane(axis, cell[axis]) + fraction[axis] * static_cast<double>(width) * grid_.spacing();
    return p;
  }

  void add(const CubePlace& cell, std::int64_t width, bool is_middle_inside) {
    const std::uint64_t cube = CubeGrid::number(cell);
    const bool is_crossed = std::ranges::binary_search(crossed_, cube);
    if (!is_crossed && !is_middle_inside) return;
    for (int i = 0; i < 8; ++i) {
      const Vec3 p = corner(cell, width, Vec3{double(i & 1), double(i >> 1 & 1), double(i >> 2)});
      if (!is_crossed || depth_.in_solid(p) > 0) points_.push_back({cube, p});
    }
  }

  const CubeGrid& grid_;
  const Depth& depth_;
  const std::vector<std::uint64_t>& crossed_;
  std::vector<PointInCube> points_;
};

std::vector<std::uint64_t> cubes_of(const std::vector<PointInCube>& points) {
  std::vector<std::uint64_t> cubes;
  for (const PointInCube& p : points)
    if (cubes.empty() || cubes.back() != p.cube) cubes.push_back(p.cube);
  std::ranges::sort(cubes);
  cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
  return cubes;
}

}  // namespace

void add_inside(std::vector<PointInCube>& points, const CubeGrid& grid, const Box& box, const Depth& depth,
                ProgressMeter& meter) {
  constexpr std::int64_t kWidth = 16;  // of the octrees
  const std::vector<std::uint64_t> crossed = cubes_of(points);
  std::vector<CubePlace> roots;
  const auto last = [&](int axis) { return grid.cell(axis, box.max[axis]); };
  for (std::int64_t x = 0; x <= last(0); x += kWidth)
    for (std::int64_t y = 0; y <= last(1); y += kWidth)
      for (std::int64_t z = 0; z <= last(2); z += kWidth) roots.push_back({x, y, z});
  std::vector<std::vector<PointInCube>> found(roots.size());
  oneapi::tbb::parallel_for(std::size_t{0}, roots.size(), [&](std::size_t i) {
    meter.at(0);
    InsideCubes cubes(grid, depth, crossed);
    cubes.visit(roots[i], kWidth);
    found[i] = cubes.take();
  });
  for (const auto& part : found) points.insert(points.end(), part.begin(), part.end());
}

}  // namespace prohull::cover

#include "cover/patches.h"

#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace prohull::cover {
namespace {

using Polygon = std::vector<Vec3>;

struct Interval {
  double min, max;
};

Interval extent(const Polygon& polygon, int axis) {
  Interval found{polygon[0][axis], polygon[0][axis]};
  for (const Vec3& p : polygon) found.min = std::min(found.min, p[axis]), found.max = std::max(found.max, p[axis]);
  return found;
}

/// Splits a polygon in two at a plane across an axis. A corner on the plane belongs to both.
void split(const Polygon& polygon, int axis, double plane, Polygon& below, Polygon& above) {
  below.clear(), above.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (a[axis] <= plane) below.push_back(a);
    if (a[axis] >= plane) above.push_back(a);
    if ((a[axis] < plane) == (b[axis] < plane) || a[axis] == plane || b[axis] == plane) continue;
    Vec3 cut = a + (b - a) * ((plane - a[axis]) / (b[axis] - a[axis]));
    cut[axis] = plane;
    below.push_back(cut), above.push_back(cut);
  }
}

/// Cuts polygons along one axis after the other.
class PatchCutter {
 public:
  PatchCutter(const CubeGrid& grid, std::vector<PointInCube>& points) : grid_(grid), points_(points) {}

  void cut(Polygon polygon, int axis = 0) {
    if (axis == 3) return add(polygon);
    const auto [min, max] = extent(polygon, axis);
    const std::int64_t last = grid_.cell(axis, max);
    Polygon slice, rest;
    for (cell_[axis] = grid_.cell(axis, min); cell_[axis] < last; ++cell_[axis]) {
      split(polygon, axis, grid_.plane(axis, cell_[axis] + 1), slice, rest);
      const auto here = cell_;
      if (!slice.empty()) cut(slice, axis + 1);
      cell_ = here;
      if (rest.empty()) return;
      polygon.swap(rest);
    }
    cut(std::move(polygon), axis + 1);
  }

 private:
  void add(const Polygon& polygon) {
    const std::uint64_t cube = CubeGrid::number({cell_[0], cell_[1], cell_[2]});
    for (const Vec3& p : polygon) points_.push_back({cube, p});
  }

  const CubeGrid& grid_;
  std::vector<PointInCube>& points_;
  std::array<std::int64_t, 3> cell_{};
};

auto key_of(const PointInCube& p) { return std::tuple(p.cube, p.point.x, p.point.y, p.point.z); }

Patch patch_of(const std::vector<Vec3>& points, std::uint32_t begin) {
  Patch patch{.begin = begin, .end = static_cast<std::uint32_t>(points.size())};
  Vec3 sum;
  for (std::uint32_t i = begin; i < patch.end; ++i) sum += points[i] - points[begin];
  patch.middle = points[begin] + sum / static_cast<double>(patch.end - begin);
  for (std::uint32_t i = begin; i < patch.end; ++i)
    patch.radius = std::max(patch.radius, norm(points[i] - patch.middle));
  return patch;
}

}  // namespace

CubeGrid::CubeGrid(const Box& box, double spacing) : origin_(box.min) {
  constexpr double kMostCubes = 1 << 20;
  const Vec3 size = box.max - box.min;
  spacing_ = std::max({spacing, size.x / kMostCubes, size.y / kMostCubes, size.z / kMostCubes});
  origin_ = origin_ - Vec3{spacing_, spacing_, spacing_} * 0.25;  // flat sides of the box are not along walls
}

std::int64_t CubeGrid::cell(int axis, double x) const {
  return static_cast<std::int64_t>(std::floor((x - origin_[axis]) / spacing_));
}

std::uint64_t CubeGrid::number(const std::array<std::int64_t, 3>& cell) {
  const auto bits = [](std::int64_t i) { return static_cast<std::uint64_t>(i) & 0x1fffff; };
  return bits(cell[0]) << 42 | bits(cell[1]) << 21 | bits(cell[2]);
}

std::vector<PointInCube> points_in_cubes(const TriangleMesh& triangles, const CubeGrid& grid) {
  std::vector<PointInCube> points;
  PatchCutter cutter(grid, points);
  for (const FaceId f : triangles.triangles.ids()) {
    const Triangle t = triangles.triangle(f);
    cutter.cut({t.a, t.b, t.c});
  }
  return points;
}

Patches patches_of(std::vector<PointInCube> points) {
  oneapi::tbb::parallel_sort(points.begin(), points.end(),
                             [](const PointInCube& a, const PointInCube& b) { return key_of(a) < key_of(b); });
  points.erase(std::unique(points.begin(), points.end(),
                           [](const PointInCube& a, const PointInCube& b) { return key_of(a) == key_of(b); }),
               points.end());
  Patches result;
  result.points.reserve(points.size());
  for (std::size_t i = 0; i < points.size();) {
    const auto begin = static_cast<std::uint32_t>(result.points.size());
    for (const std::uint64_t cube = points[i].cube; i < points.size() && points[i].cube == cube; ++i)
      result.points.push_back(points[i].point);
    result.patches.push_back(patch_of(result.points, begin));
  }
  return result;
}

}  // namespace prohull::cover

#include "wrap/grid.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "geometry/bvh.h"
#include "geometry/closest_point.h"

namespace prohull {
namespace {

double beyond(double x, double least, double most) { return std::max({least - x, x - most, 0.0}); }

/// Of the nodes in the layers [from_z, to_z).
class Layers {
 public:
  Layers(const Grid& grid, std::vector<float>& distances, float band, std::size_t from_z, std::size_t to_z)
      : grid_(grid), distances_(distances), band_(band), from_z_(from_z), to_z_(to_z) {}

  void add(const Triangle& in_spacings);

 private:
  const Grid& grid_;
  std::vector<float>& distances_;
  const double band_;
  const std::size_t from_z_, to_z_;
};

void Layers::add(const Triangle& t) {
  const Box box = box_of(t);
  const auto first = [&](int axis) {
    return static_cast<std::size_t>(std::ceil(std::max(box.min[axis] - band_, 0.0)));
  };
  const auto last = [&](int axis) {
    return std::min(static_cast<std::size_t>(box.max[axis] + band_), grid_.nodes(axis) - 1);
  };
  Vec3 normal = cross(t.b - t.a, t.c - t.a);
  const double length = norm(normal);
  normal = length > 0 ? normal / length : Vec3{};
  const double offset = dot(normal, t.a);
  constexpr double kSteep = 1e-3;
  for (std::size_t z = std::max(first(2), from_z_); z < std::min(last(2) + 1, to_z_); ++z) {
    const double dz = beyond(double(z), box.min.z, box.max.z);
    for (std::size_t y = first(1); y <= last(1); ++y) {
      const double dy = beyond(double(y), box.min.y, box.max.y), squared = dz * dz + dy * dy;
      if (squared >= band_ * band_) continue;
      double from_x = std::max(box.min.x - band_, 0.0), to_x = std::min(box.max.x + band_, double(grid_.nodes(0) - 1));
      // Where the plane is near.
      const double height = normal.y * double(y) + normal.z * double(z) - offset;
      if (std::abs(normal.x) > kSteep) {
        const double a = (-band_ - height) / normal.x, b = (band_ - height) / normal.x;
        from_x = std::max(from_x, std::min(a, b)), to_x = std::min(to_x, std::max(a, b));
      } else if (std::abs(height) > band_ + kSteep * double(grid_.nodes(0))) {
        continue;
      }
      if (to_x < from_x) continue;
      float* const row = &distances_[grid_.node(0, y, z)];
      for (auto x = static_cast<std::size_t>(std::ceil(from_x)); double(x) <= to_x; ++x) {
        const double dx = beyond(double(x), box.min.x, box.max.x), known = row[x];
        if (squared + dx * dx >= known * known) continue;
        const Vec3 p{double(x), double(y), double(z)};
        const double found = squared_norm(p - closest_point(p, t));
        if (found < known * known) row[x] = static_cast<float>(std::sqrt(found));
      }
    }
  }
}

}  // namespace

Grid::Grid(const Box& box, double spacing, double margin)
    : spacing_(spacing),
      origin_(box.min - Vec3{1, 1, 1} * (margin * spacing)),
      beyond_(static_cast<std::size_t>(margin)) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = box.max[int(axis)] - box.min[int(axis)];
    nodes_[axis] = 1 + static_cast<std::size_t>(std::ceil(size / spacing + 2 * margin));
  }
}

Grid Grid::coarser(std::size_t times) const {
  Grid other = *this;
  other.spacing_ *= double(times);
  for (std::size_t& nodes : other.nodes_) nodes = (nodes - 1) / times + 1;
  other.beyond_ /= times;
  return other;
}

std::vector<float> distances(const Grid& grid, const TriangleMesh& triangles, float band, ProgressMeter& meter) {
  std::vector<float> result(grid.node_count(), band);
  constexpr std::size_t kLayers = 4;  // of nodes, for one task
  std::vector<std::vector<FaceId>> faces_of((grid.nodes(2) + kLayers - 1) / kLayers);
  const auto triangle = [&](FaceId f) {
    const Triangle t = triangles.triangle(f);
    return Triangle{grid.in_spacings(t.a), grid.in_spacings(t.b), grid.in_spacings(t.c)};
  };
  for (const FaceId f : triangles.triangles.ids()) {
    const Triangle t = triangle(f);
    const auto [least, most] = std::minmax({t.a.z, t.b.z, t.c.z});
    const auto last = std::min(static_cast<std::size_t>(most + band) / kLayers, faces_of.size() - 1);
    for (auto i = static_cast<std::size_t>(std::max(least - band, 0.0)) / kLayers; i <= last; ++i)
      faces_of[i].push_back(f);
  }
  std::atomic<std::size_t> done = 0;
  oneapi::tbb::parallel_for(std::size_t{0}, faces_of.size(), [&](std::size_t i) {
    Layers layers(grid, result, band, i * kLayers, std::min((i + 1) * kLayers, grid.nodes(2)));
    for (const FaceId f : faces_of[i]) layers.add(triangle(f));
    meter.at(++done, faces_of.size());
  });
  return result;
}

}  // namespace prohull

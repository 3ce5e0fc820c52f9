#include "cover/volume_estimate.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "geometry/bvh.h"

namespace prohull::cover {
namespace {

/// The time grows with the number of cells times that of polytopes, and the error about as 1 / cells.
constexpr std::size_t most_cells(std::size_t polytopes) {
  return std::clamp<std::size_t>(20'000'000 / polytopes, 4'000, 60'000);
}
constexpr int kMostHalvings = 120;
constexpr std::size_t kCellsOfASeed = 256;

enum class Place : std::uint8_t { Outside, Between, Inside };

class Polytope {
 public:
  explicit Polytope(const TriangleMesh& mesh) {
    for (const FaceId f : mesh.triangles.ids()) {
      const Triangle t = mesh.triangle(f);
      const Vec3 normal = cross(t.b - t.a, t.c - t.a);
      planes_.push_back({normal, {std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)}, t.a});
    }
  }

  /// Outside is known only of boxes that are beyond the plane of a face.
  Place place(const Box& box) const {
    const Vec3 center = box.min * 0.5 + box.max * 0.5, half = box.max * 0.5 - box.min * 0.5;
    Place found = Place::Inside;
    for (const auto& [normal, size, point] : planes_) {
      const double height = dot(normal, center - point), reach = dot(size, half);
      if (height > reach) return Place::Outside;
      if (height > -reach) found = Place::Between;
    }
    return found;
  }

 private:
  struct Plane {
    Vec3 normal, size;  ///< size: of each coordinate of the normal
    Vec3 point;
  };
  std::vector<Plane> planes_;
};

class Polytopes {
 public:
  explicit Polytopes(std::span<const TriangleMesh> meshes) : polytopes_(meshes.begin(), meshes.end()) {
    std::vector<Box> boxes;
    for (const TriangleMesh& mesh : meshes) {
      boxes.push_back(bounding_box(mesh));
      box_.extend(boxes.back().min), box_.extend(boxes.back().max);
    }
    tree_ = Bvh(std::move(boxes));
  }

  const Box& box() const { return box_; }

  /// In one polytope, off all, or else between.
  Place place(const Box& box) const {
    Place found = Place::Outside;
    tree_.visit([&](const Box& other) { return found != Place::Inside && other.overlaps(box); },
                [&](std::uint32_t i) { found = std::max(found, polytopes_[i].place(box)); });
    return found;
  }

 private:
  std::vector<Polytope> polytopes_;
  Box box_;
  Bvh tree_;
};

double volume_of(const Box& box) {
  const Vec3 size = box.max - box.min;
  return size.x * size.y * size.z;
}

std::vector<Box> halved(const std::vector<Box>& cells) {
  std::vector<Box> halves;
  for (const Box& cell : cells) {
    const Vec3 size = cell.max - cell.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    Box lower = cell, upper = cell;
    lower.max[axis] = upper.min[axis] = cell.min[axis] * 0.5 + cell.max[axis] * 0.5;
    halves.push_back(lower), halves.push_back(upper);
  }
  return halves;
}

/// Adds the cells inside to `volume`, and returns those between.
std::vector<Box> cells_between(const std::vector<Box>& cells, const Polytopes& polytopes, double& volume) {
  std::vector<Place> places(cells.size());
  oneapi::tbb::parallel_for(std::size_t{0}, cells.size(),
                            [&](std::size_t i) { places[i] = polytopes.place(cells[i]); });
  std::vector<Box> between;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (places[i] == Place::Inside) volume += volume_of(cells[i]);
    if (places[i] == Place::Between) between.push_back(cells[i]);
  }
  return between;
}

bool holds_random_point(const Polytopes& polytopes, const Box& cell, std::mt19937& random) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) {
    const double part = random() * 0x1p-32;
    p[axis] = cell.min[axis] * (1 - part) + cell.max[axis] * part;
  }
  return polytopes.place({p, p}) != Place::Outside;
}

/// How many of two points of each cell are in the union.
std::vector<std::uint8_t> points_inside(const std::vector<Box>& cells, const Polytopes& polytopes) {
  std::vector<std::uint8_t> inside(cells.size());
  const std::size_t parts = (cells.size() + kCellsOfASeed - 1) / kCellsOfASeed;
  oneapi::tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
    std::mt19937 random(static_cast<std::uint32_t>(part));
    const std::size_t end = std::min(cells.size(), (part + 1) * kCellsOfASeed);
    for (std::size_t i = part * kCellsOfASeed; i < end; ++i)
      for (int point = 0; point < 2; ++point) inside[i] += holds_random_point(polytopes, cells[i], random);
  });
  return inside;
}

}  // namespace

VolumeEstimate estimated_volume(std::span<const TriangleMesh> meshes) {
  if (meshes.size() == 1) return {signed_volume(meshes[0]), 0};
  const Polytopes polytopes(meshes);
  VolumeEstimate result;
  std::vector<Box> cells{polytopes.box()};
  for (int i = 0; i < kMostHalvings && 2 * cells.size() <= most_cells(meshes.size()); ++i)
    cells = cells_between(halved(cells), polytopes, result.volume);
  const std::vector<std::uint8_t> inside = points_inside(cells, polytopes);
  double variance = 0;  // in the volumes of the first box, whose square may be too large a number
  const double whole = volume_of(polytopes.box());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double volume = volume_of(cells[i]), share = volume / whole;
    result.volume += volume * inside[i] / 2;
    if (inside[i] == 1) variance += share * share / 4;
  }
  result.standard_error = whole * std::sqrt(variance);
  return result;
}

}  // namespace prohull::cover

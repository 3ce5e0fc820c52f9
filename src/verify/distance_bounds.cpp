#include "prohull/distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

#include "geometry/bvh.h"
#include "geometry/closest_point.h"
#include "geometry/largest_coordinate.h"
#include "parallel/progress_meter.h"
#include "prohull/error.h"
#include "verify/distance.h"

namespace prohull {
namespace {

constexpr std::uint32_t kUnknown = 0xffffffff;

/// Part of a face of `from`, and how far it is from `to` at most.
struct Cell {
  std::array<Vec3, 3> corners;
  std::array<std::uint32_t, 3> nearest;  ///< faces of `to`, to each corner
  double upper;
  bool operator<(const Cell& other) const { return upper < other.upper; }
};

class Search {
 public:
  Search(const TriangleMesh& from, const TriangleMesh& to, const DistanceOptions& options)
      : from_(from),
        to_(to),
        options_(options),
        counter_(options.progress, "measure", options.max_cells + from.face_count()) {
    std::vector<Box> boxes;
    boxes.reserve(to.face_count());
    double largest = 0;
    for (const FaceId f : to.triangles.ids()) boxes.push_back(box_of(to.triangle(f)));
    tree_ = Bvh(std::move(boxes));
    for (const TriangleMesh* mesh : {&from, &to})
      if (const Box box = bounding_box(*mesh); !box.is_empty()) largest = std::max(largest, largest_coordinate(box));
    // A closest point is computed from differences, within 16 eps of the largest coordinate for each of its own (a sum
    // of three with factors in [0, 1]); its distance to p, and cells cut at rounded midpoints, add as much again.
    rounding_ = 64 * 0x1p-53 * largest;
  }

  DistanceBounds run() {
    PerVertex<std::uint32_t> known(from_.vertex_count(), kUnknown);  // nearest faces
    const auto nearest_to = [&](VertexId v) {
      return known[v] != kUnknown ? known[v] : known[v] = nearest(from_.positions[v]);
    };
    for (const FaceId f : from_.triangles.ids()) {
      const Triangle t = from_.triangle(f);
      const auto& [a, b, c] = from_.triangles[f];
      push({t.a, t.b, t.c}, {nearest_to(a), nearest_to(b), nearest_to(c)});
    }
    while (cells_.top().upper > (1 + options_.relative_gap) * bounds_.lower && seen_ < options_.max_cells) cut();
    bounds_.upper = std::max(cells_.top().upper, bounds_.lower) + rounding_;
    return bounds_;
  }

 private:
  std::uint32_t nearest(const Vec3& p, double known = std::numeric_limits<double>::infinity(),
                        std::uint32_t guess = 0) {
    std::uint32_t best = guess;
    tree_.least([&](const Box& box) { return verify::distance(p, box); },
                [&](std::uint32_t f) {
                  const double d = distance(p, f);
                  if (d < known) known = d, best = f;
                  return d;
                },
                known);
    if (known > bounds_.lower) bounds_.lower = known, bounds_.farthest = p;
    return best;
  }

  double distance(const Vec3& p, std::uint32_t f) const { return norm(p - closest_point(p, to_.triangle(FaceId(f)))); }

  void push(const std::array<Vec3, 3>& corners, const std::array<std::uint32_t, 3>& near) {
    ++seen_;
    counter_.next();
    double upper = std::numeric_limits<double>::infinity();
    for (const std::uint32_t f : near) {
      double farthest = 0;
      for (const Vec3& p : corners) farthest = std::max(farthest, distance(p, f));
      upper = std::min(upper, farthest);
    }
    cells_.push({corners, near, upper});
  }

  // At the middle of the longest edge: cells stay as round as the face was.
  void cut() {
    const Cell cell = cells_.top();
    cells_.pop();
    int longest = 0;
    double length = -1;
    for (int i = 0; i < 3; ++i)
      if (const double l = squared_norm(cell.corners[(i + 1) % 3] - cell.corners[i]); l > length)
        length = l, longest = i;
    const int i = longest, j = (i + 1) % 3, k = (i + 2) % 3;
    const auto& c = cell.corners;
    const Vec3 middle = c[i] * 0.5 + c[j] * 0.5;
    const std::uint32_t near = nearest(middle, distance(middle, cell.nearest[i]), cell.nearest[i]);
    push({c[i], middle, c[k]}, {cell.nearest[i], near, cell.nearest[k]});
    push({middle, c[j], c[k]}, {near, cell.nearest[j], cell.nearest[k]});
  }

  const TriangleMesh &from_, &to_;
  const DistanceOptions& options_;
  Bvh tree_;
  double rounding_;
  std::priority_queue<Cell> cells_;
  std::size_t seen_ = 0;
  ProgressCounter counter_;
  DistanceBounds bounds_;
};

void check(const TriangleMesh& mesh) {
  if (mesh.face_count() == 0) throw InputError(Defect::EmptyMesh, "there is no distance without faces");
  for (const FaceId f : mesh.triangles.ids())
    for (const VertexId v : mesh.triangles[f])
      if (!is_finite(mesh.positions[v]))
        throw InputError(Defect::NonFiniteCoordinate, "there is no distance from coordinates that are not finite");
}

}  // namespace

DistanceBounds distance_bounds(const TriangleMesh& from, const TriangleMesh& to, const DistanceOptions& options) {
  check(from);
  check(to);
  return Search(from, to, options).run();
}

double HullBounds::excess(const TriangleMesh& hull, const TriangleMesh& original, double volume,
                          const Progress& progress) const {
  const double added = std::abs(signed_volume(hull) - volume);
  // A bound of 0 is kept by nothing but 0.
  const auto quotient = [](double value, double bound) {
    return value > bound ? value / bound : bound > 0 ? value / bound : 0;
  };
  double most = quotient(added, max_added_volume);
  if (std::isfinite(max_void_ratio)) most = std::max(most, quotient(added, max_void_ratio * volume));
  if (std::isfinite(max_distance))
    most = std::max(most, quotient(distance_bounds(hull, original, {.progress = progress}).upper, max_distance));
  return most;
}

}  // namespace prohull

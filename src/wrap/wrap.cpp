#include "prohull/wrap.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/bvh.h"
#include "geometry/largest_coordinate.h"
#include "prohull/error.h"
#include "wrap/inside.h"
#include "wrap/level_surface.h"

namespace prohull {
namespace {

constexpr float kClearance = 0.1F;  ///< how far it is from the points that were tried, at least
constexpr double kSampling = 0.1;   ///< distance between these points
constexpr float kRounding = 1e-5F;  ///< of values between nodes, at most

Grid grid_for(const TriangleMesh& triangles, const WrapOptions& options) {
  const double spacing = options.spacing;
  const double ball = std::max(options.closing, options.seal_holes / 2) / spacing;  // that goes around the triangles
  const double flat_margin = options.flatness > 0 ? double(Cells::kLargest) : 0;
  const double margin = std::max<double>(kInsideMargin, flat_margin) + (ball > kLeastSeal ? ball + 4 : 0);
  constexpr double kMostNodes = 0x1p28;
  if (!(spacing > 0))
    throw InputError(Defect::InvalidOption,
                     fmt::format("the spacing of the grid is {:g}; it must be greater than 0", spacing));
  constexpr double kFarthest = 2.7;  // of the distances that are known exactly
  if (!(options.padding >= 0 && options.offset + options.padding / spacing <= kFarthest))
    throw InputError(
        Defect::InvalidOption,
        fmt::format("an offset of {:g} spacings and a padding of {:g} with a spacing of {:g} are more than "
                    "{:g} spacings",
                    options.offset, options.padding, spacing, kFarthest));
  if (triangles.face_count() == 0) throw InputError(Defect::EmptyMesh, "the mesh has no faces: nothing to wrap");
  for (const auto& corners : triangles.triangles)
    if (!std::ranges::all_of(corners, [&](VertexId v) { return is_finite(triangles.positions[v]); }))
      throw InputError(Defect::NonFiniteCoordinate, "a vertex is not finite: nothing can be wrapped");
  const Box box = bounding_box(triangles);
  double nodes = 1;
  for (int axis = 0; axis < 3; ++axis) nodes *= (box.max[axis] - box.min[axis]) / spacing + 2 * margin + 2;
  if (!(nodes <= kMostNodes))
    throw InputError(
        Defect::InvalidOption,
        fmt::format("a grid with a spacing of {:g} would have {:.3g} nodes: use a greater one", spacing, nodes));
  // find_inside relies on the margin, but the origin of the grid is rounded.
  constexpr double kMostOff = 0.5;
  const Grid grid(box, spacing, margin);
  const Vec3 first = grid.in_spacings(box.min);
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(first[axis] - margin) <= kMostOff))
      throw InputError(
          Defect::NonFiniteCoordinate,
          fmt::format("the grid would be finer than numbers are at coordinates of up to {:.9g}: move the mesh to the "
                      "origin",
                      largest_coordinate(box)));
  return grid;
}

/// Calls use(node 0 to 3, weight 0 to 3) with the tetrahedron of the grid in which a point lies.
struct InTetrahedron {
  std::array<std::size_t, 4> nodes;
  std::array<float, 4> weights;

  InTetrahedron(const Grid& grid, const Vec3& p) {
    const std::array at{std::size_t(p.x), std::size_t(p.y), std::size_t(p.z)};
    const Vec3 rest{p.x - double(at[0]), p.y - double(at[1]), p.z - double(at[2])};
    std::array order{0, 1, 2};  // the greatest rest first
    const auto put_in_order = [&](std::size_t i) {
      if (rest[order[i]] < rest[order[i + 1]]) std::swap(order[i], order[i + 1]);
    };
    put_in_order(0), put_in_order(1), put_in_order(0);
    const std::array<std::size_t, 3> stride{1, grid.nodes(0), grid.nodes(0) * grid.nodes(1)};
    nodes[0] = grid.node(at[0], at[1], at[2]);
    double before = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      nodes[i + 1] = nodes[i] + stride[std::size_t(order[i])];
      weights[i] = float(before - rest[order[i]]);
      before = rest[order[i]];
    }
    weights[3] = float(before);
  }

  float value(const std::vector<float>& values) const {
    float sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += weights[i] * values[nodes[i]];
    return sum;
  }
};

/// Points of triangles, near each other.
class Samples {
 public:
  Samples(const Grid& grid, const TriangleMesh& triangles) : grid_(grid), triangles_(triangles) {
    for (const FaceId f : triangles.triangles.ids()) {
      const auto [a, u, v] = corner_of(f);
      total_ += double(steps(u)) * steps(v);
    }
  }

  /// Calls use(point), in spacings, for those of a triangle. Of a needle, both sides at the corner are long: where that
  /// makes too many of all, it is sampled in two right triangles.
  template <class Use>
  void of(FaceId f, Use use) const {
    constexpr double kMany = 0x1p25;
    const auto [a, u, v] = corner_of(f);
    if (total_ <= kMany) return of_corner(a, u, v, use);
    const std::array corners{a, a + u, a + v};
    int i = 0;  // from which the longest side goes to the next one
    for (int k = 1; k < 3; ++k)
      if (squared_norm(corners[(k + 1) % 3] - corners[k]) > squared_norm(corners[(i + 1) % 3] - corners[i])) i = k;
    const Vec3 &from = corners[i], &to = corners[(i + 1) % 3], &third = corners[(i + 2) % 3], side = to - from;
    const double length = squared_norm(side);
    const Vec3 foot = from + side * (length > 0 ? dot(third - from, side) / length : 0);
    of_corner(foot, to - foot, third - foot, use);
    of_corner(foot, from - foot, third - foot, use);
  }

  /// A triangle is passed over if all nodes of the box around it are left out: none of its points would matter.
  template <class Use, class IsLeftOut>
  void of_all(ProgressMeter& meter, IsLeftOut is_left_out, Use use) const {
    for (const FaceId f : triangles_.triangles.ids()) {
      if (index(f) % 1024 == 0) meter.at(0.5);
      if (!are_all_around(f, is_left_out)) of(f, use);
    }
  }

 private:
  struct CornerOf {
    Vec3 at, u, v;
  };

  CornerOf corner_of(FaceId f) const {
    const Triangle t = triangles_.triangle(f);
    const Vec3 a = grid_.in_spacings(t.a);
    return {a, grid_.in_spacings(t.b) - a, grid_.in_spacings(t.c) - a};
  }

  template <class IsLeftOut>
  bool are_all_around(FaceId f, IsLeftOut is_left_out) const {
    const Triangle t = triangles_.triangle(f);
    const Box box = box_of(Triangle{grid_.in_spacings(t.a), grid_.in_spacings(t.b), grid_.in_spacings(t.c)});
    const auto last = [&](int axis) {
      return std::min(std::size_t(box.max[axis]) + 1, grid_.nodes(std::size_t(axis)) - 1);
    };
    for (auto z = std::size_t(box.min.z); z <= last(2); ++z)
      for (auto y = std::size_t(box.min.y); y <= last(1); ++y)
        for (auto x = std::size_t(box.min.x); x <= last(0); ++x)
          if (!is_left_out(grid_.node(x, y, z))) return false;
    return true;
  }

  static int steps(const Vec3& side) { return 1 + int(norm(side) / kSampling); }

  template <class Use>
  static void of_corner(const Vec3& a, const Vec3& u, const Vec3& v, Use use) {
    const int steps_u = steps(u), steps_v = steps(v);
    for (int i = 0; i <= steps_u; ++i) {
      const double s = double(i) / steps_u;
      const int last = int(std::ceil((1 - s) * steps_v));
      for (int j = 0; j <= last; ++j) use(a + u * s + v * (last == 0 ? 0 : (1 - s) * j / last));
    }
  }

  const Grid& grid_;
  const TriangleMesh& triangles_;
  double total_ = 0;
};

/// At corners of large cells, distances that are greater than what find_inside knows.
void add_greater_distances(const Grid& grid, const TriangleMesh& triangles, std::vector<float>& values,
                           ProgressMeter& meter) {
  constexpr float kBand = 1.75;  // a surface in a cell is not farther from its corners, in its size
  constexpr float kKnown = kInsideMargin - 1;
  for (std::size_t size = 2; size <= Cells::kLargest; size *= 2) {
    const Grid corners = grid.coarser(size);
    const std::vector<float> found = distances(corners, triangles, kBand, meter);
    for (std::size_t z = 0; z < corners.nodes(2); ++z)
      for (std::size_t y = 0; y < corners.nodes(1); ++y)
        for (std::size_t x = 0; x < corners.nodes(0); ++x) {
          float& value = values[grid.node(x * size, y * size, z * size)];
          const float distance = found[corners.node(x, y, z)] * float(size);
          if (std::abs(value) >= kKnown) value = std::copysign(std::max(distance, kKnown), value);
        }
  }
}

void leave_out(const std::vector<char>& is_cavity, Inside& inside) {
  for (std::size_t n = 0; n < is_cavity.size(); ++n)
    if (is_cavity[n]) inside.signed_distances[n] = std::abs(inside.signed_distances[n]);
}

/// The triangles that have nodes outside near them. The others are not on the boundary of the inside: their distances
/// would cut into it.
TriangleMesh without_hidden(const Grid& grid, const TriangleMesh& triangles, const Inside& inside,
                            ProgressMeter& meter) {
  std::vector<char> is_near_outside(grid.node_count());
  for (std::size_t n = 0; n < grid.node_count(); ++n) {
    if (inside.signed_distances[n] < 0) continue;
    is_near_outside[n] = 1;
    grid.around(n, [&](std::size_t m) { is_near_outside[m] = 1; });
  }
  TriangleMesh rest{triangles.positions, {}};
  const Samples samples(grid, triangles);
  for (const FaceId f : triangles.triangles.ids()) {
    bool is_near = false;
    samples.of(f, [&](const Vec3& p) {
      for (const std::size_t n : InTetrahedron(grid, p).nodes) is_near = is_near || is_near_outside[n];
    });
    if (is_near) rest.triangles.push_back(triangles.triangles[f]);
    if (index(f) % 1024 == 0) meter.at(0.5);
  }
  return rest;
}

}  // namespace

Wrap wrap(const TriangleMesh& triangles, const WrapOptions& options) {
  const Grid grid = grid_for(triangles, options);
  ProgressMeter meter(options.progress, "wrap");
  const auto offset = static_cast<float>(options.offset);
  const float level = offset + static_cast<float>(options.padding / options.spacing);
  Inside inside = find_inside(grid, triangles,
                              {.seal = options.seal_holes / 2 / options.spacing,
                               .seal_rooms = options.seal_rooms,
                               .closing = options.closing / options.spacing},
                              meter);
  // The values are linear between the nodes, distances are not: where it matters, as along edges, they are lowered.
  std::vector<float>& values = inside.signed_distances;
  const float most = offset - kClearance;
  const auto is_low = [&](std::size_t n) { return values[n] <= most - kRounding; };
  for (const TriangleMesh* mesh : {&triangles, &std::as_const(inside.doors)})
    Samples(grid, *mesh).of_all(meter, is_low, [&](const Vec3& p) {
      const InTetrahedron at(grid, p);
      const float excess = at.value(values) - most;
      if (excess > 0)
        for (const std::size_t n : at.nodes) values[n] -= excess;
    });
  if (options.flatness > 0) add_greater_distances(grid, triangles, values, meter);
  const Cells cells = options.flatness > 0 ? Cells(grid, values, level, float(options.flatness)) : Cells(grid);
  const double spacing = options.spacing;
  return {level_surface(grid, cells, values, level), std::move(inside.doors), inside.largest_door * spacing,
          inside.volume * spacing * spacing * spacing};
}

double inside_volume(const TriangleMesh& triangles, const WrapOptions& options) {
  const Grid grid = grid_for(triangles, options);
  ProgressMeter meter(options.progress, "wrap");
  const double spacing = options.spacing;
  return find_inside(grid, triangles, {}, meter).volume * spacing * spacing * spacing;
}

TriangleMesh inner_wrap(const TriangleMesh& triangles, const WrapOptions& options) {
  const Grid grid = grid_for(triangles, options);
  ProgressMeter meter(options.progress, "wrap");
  const auto offset = static_cast<float>(options.offset);
  const float level = offset + static_cast<float>(options.padding / options.spacing);
  Inside inside = find_inside(grid, triangles, {}, meter);
  const std::vector<char> is_cavity = find_cavities(grid, triangles, inside);
  leave_out(is_cavity, inside);
  const TriangleMesh boundary = without_hidden(grid, triangles, inside, meter);
  if (boundary.face_count() == 0) return {};
  inside = find_inside(grid, boundary, {}, meter);
  leave_out(is_cavity, inside);
  std::vector<float>& values = inside.signed_distances;
  const float least = kClearance - offset;
  const auto is_high = [&](std::size_t n) { return values[n] >= least + kRounding; };
  Samples(grid, boundary).of_all(meter, is_high, [&](const Vec3& p) {
    const InTetrahedron at(grid, p);
    const float missing = least - at.value(values);
    if (missing > 0)
      for (const std::size_t n : at.nodes) values[n] += missing;
  });
  return level_surface(grid, Cells(grid), values, -level);
}

}  // namespace prohull

#include "collide/obb_tree.h"

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace prohull {
namespace {

using Axes = std::array<Vec3, 3>;

/// The eigenvectors of a symmetric matrix of 3 x 3, by Jacobi's rotations; square to each other but for rounding.
Axes eigenvectors(std::array<std::array<double, 3>, 3> m) {
  std::array<std::array<double, 3>, 3> v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr int kSweeps = 8;
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (const auto& [p, q] : {std::pair{0u, 1u}, {0u, 2u}, {1u, 2u}}) {
      if (!(std::abs(m[p][q]) > 1e-30)) continue;
      const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
      const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
      const double c = 1 / std::sqrt(t * t + 1), s = t * c;
      for (auto& row : m) {
        const double x = row[p], y = row[q];
        row[p] = c * x - s * y, row[q] = s * x + c * y;
      }
      for (unsigned k = 0; k < 3; ++k) {
        const double x = m[p][k], y = m[q][k];
        m[p][k] = c * x - s * y, m[q][k] = s * x + c * y;
      }
      for (auto& row : v) {
        const double x = row[p], y = row[q];
        row[p] = c * x - s * y, row[q] = s * x + c * y;
      }
    }
  return {Vec3{v[0][0], v[1][0], v[2][0]}, {v[0][1], v[1][1], v[2][1]}, {v[0][2], v[1][2], v[2][2]}};
}

/// With the first axis along the longest edge and the third one along the normal; nothing if the area vanishes.
std::optional<Axes> axes_of(const Triangle& t) {
  Vec3 longest = t.b - t.a;
  for (const Vec3& edge : {t.c - t.b, t.a - t.c})
    if (squared_norm(edge) > squared_norm(longest)) longest = edge;
  const Vec3 normal = cross(t.b - t.a, t.c - t.a);
  const double length = norm(longest), area = norm(normal);
  if (!(area > 1e-6 * length * length) || !(area > 1e-30)) return std::nullopt;
  const Vec3 u = longest / length;
  Vec3 w = normal / area;
  w = w - u * dot(u, w);
  w = w / norm(w);
  return Axes{u, cross(w, u), w};
}

/// Along three axes.
struct Extent {
  Box range;  ///< of the products with the axes
  double area() const {
    const Vec3 s = range.max - range.min;
    return s.x * s.y + s.y * s.z + s.z * s.x;
  }
};

}  // namespace

struct ObbTree::Builder {
  std::vector<Triangle> triangles;  // in the tree's coordinates
  std::vector<Vec3> centroids;
  std::vector<ObbNode>& boxes;
  std::vector<std::uint32_t>& items;

  std::span<std::uint32_t> range(std::size_t begin, std::size_t end) {
    return std::span(items).subspan(begin, end - begin);
  }

  /// Weighted by area, as if the triangles were sheets (Gottschalk, Lin and Manocha, "OBBTree", 1996, section 4).
  Axes principal_axes(std::span<const std::uint32_t> of) const {
    double weight = 0;
    Vec3 mean, square, mixed;
    for (const std::uint32_t i : of) {
      const Triangle& t = triangles[i];
      const Vec3& m = centroids[i];
      const double w = norm(cross(t.b - t.a, t.c - t.a)) + 1e-30;
      weight += w;
      mean += m * w;
      for (const auto& [p, share] : {std::pair{t.a, 1.0}, {t.b, 1.0}, {t.c, 1.0}, {m, 9.0}}) {
        const double f = w * share / 12;
        square += Vec3{p.x * p.x, p.y * p.y, p.z * p.z} * f;
        mixed += Vec3{p.y * p.z, p.z * p.x, p.x * p.y} * f;
      }
    }
    mean = mean / weight, square = square / weight, mixed = mixed / weight;
    const double yz = mixed.x - mean.y * mean.z, zx = mixed.y - mean.z * mean.x, xy = mixed.z - mean.x * mean.y;
    return eigenvectors({{{square.x - mean.x * mean.x, xy, zx},
                          {xy, square.y - mean.y * mean.y, yz},
                          {zx, yz, square.z - mean.z * mean.z}}});
  }

  Extent extent(std::span<const std::uint32_t> of, const Axes& axes) const {
    Extent extent;
    for (const std::uint32_t i : of)
      for (const Vec3& p : {triangles[i].a, triangles[i].b, triangles[i].c})
        extent.range.extend(Vec3{dot(axes[0], p), dot(axes[1], p), dot(axes[2], p)});
    return extent;
  }

  Axes best_axes(std::span<const std::uint32_t> of) const {
    constexpr std::size_t kFewTriangles = 2;
    Axes best{Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double least = extent(of, best).area();
    const auto consider = [&](const Axes& axes) {
      const double area = extent(of, axes).area();
      if (area < least) least = area, best = axes;
    };
    if (of.size() > 1) consider(principal_axes(of));
    if (of.size() <= kFewTriangles)
      for (const std::uint32_t i : of)
        if (const auto axes = axes_of(triangles[i])) consider(*axes);
    return best;
  }

  /// The axes lose 2^-24 of each entry by rounding, so products of two of them are off by less than 2^-22, and the
  /// products of a point with them differ by less than 2^-21 of its distance from the center from the point's x, y, z
  /// as ObbNode has them. The half sizes grow by 2^-19 of the box.
  ObbNode box_around(std::span<const std::uint32_t> of, const Axes& axes) const {
    const Extent extent = this->extent(of, axes);
    const Vec3 middle = extent.range.center();
    const Vec3 center = axes[0] * middle.x + axes[1] * middle.y + axes[2] * middle.z;
    ObbNode box{};
    for (int k = 0; k < 3; ++k) {
      box.center[k] = static_cast<float>(center[k]);
      for (unsigned i = 0; i < 3; ++i) box.axes[3 * k + static_cast<int>(i)] = static_cast<float>(axes[i][k]);
    }
    Vec3 half;
    const Vec3 rounded{box.center[0], box.center[1], box.center[2]};
    for (const std::uint32_t i : of)
      for (const Vec3& corner : {triangles[i].a, triangles[i].b, triangles[i].c}) {
        const Vec3 p = corner - rounded;
        for (int k = 0; k < 3; ++k)
          half[k] = std::max(half[k], std::abs(dot(Vec3{box.axes[k], box.axes[3 + k], box.axes[6 + k]}, p)));
      }
    const double slack = 0x1p-19 * norm(half) + 1e-30;
    for (int k = 0; k < 3; ++k) box.half[k] = static_cast<float>(half[k] + slack);
    return box;
  }

  static std::size_t leaves(std::size_t count) { return (count + kLeafSize - 1) / kLeafSize; }

  void build(std::size_t self, std::size_t begin, std::size_t end) {
    const auto of = range(begin, end);
    const Axes axes = best_axes(of);
    boxes[self] = box_around(of, axes);
    if (of.size() <= kLeafSize) {
      boxes[self].link = ObbNode::kLeaf + static_cast<std::uint32_t>(begin);
      std::ranges::sort(of);
      return;
    }
    const float* const half = boxes[self].half;
    const int longest = half[0] >= half[1] && half[0] >= half[2] ? 0 : half[1] >= half[2] ? 1 : 2;
    const Vec3 axis = axes[static_cast<unsigned>(longest)];
    const std::size_t left_leaves = leaves(of.size()) / 2, left = left_leaves * kLeafSize;
    std::ranges::nth_element(of, of.begin() + static_cast<std::ptrdiff_t>(left), [&](std::uint32_t i, std::uint32_t j) {
      const double a = dot(axis, centroids[i]), b = dot(axis, centroids[j]);
      return a != b ? a < b : i < j;
    });
    const std::size_t second = self + 2 * left_leaves;
    boxes[self].link = static_cast<std::uint32_t>(second);
    const auto first_half = [&] { build(self + 1, begin, begin + left); };
    const auto second_half = [&] { build(second, begin + left, end); };
    constexpr std::size_t kWorthAThread = 2000;
    if (of.size() > kWorthAThread) return oneapi::tbb::parallel_invoke(first_half, second_half);
    first_half(), second_half();
  }
};

ObbTree::ObbTree(std::span<const Triangle> triangles) : items_(triangles.size()) {
  Box box;
  for (const Triangle& t : triangles)
    for (const Vec3& p : {t.a, t.b, t.c}) box.extend(p), reach_ = std::max(reach_, norm(p));
  center_ = box.center();
  for (const Triangle& t : triangles)
    for (const Vec3& p : {t.a, t.b, t.c}) radius_ = std::max(radius_, norm(p - center_));
  radius_ = radius_ * (1 + 0x1p-40) + 0x1p-500;  // squares of less underflow
  // Without meshes smaller than 2^-500, which floats could not tell from points.
  unit_ = std::ldexp(1.0, -std::max(-500, std::ilogb(std::max(radius_, 0x1p-500)) + 1));
  std::iota(items_.begin(), items_.end(), 0u);
  boxes_.resize(2 * Builder::leaves(items_.size()) - 1);
  Builder builder{{}, {}, boxes_, items_};
  for (const Triangle& t : triangles) {
    const Triangle own{(t.a - center_) * unit_, (t.b - center_) * unit_, (t.c - center_) * unit_};
    builder.triangles.push_back(own);
    builder.centroids.push_back((own.a + own.b + own.c) / 3);
  }
  builder.build(0, 0, items_.size());
}

}  // namespace prohull

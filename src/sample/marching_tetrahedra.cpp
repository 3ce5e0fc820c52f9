#include "sample/marching_tetrahedra.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "sample/add_quad.h"
#include "sample/index_of_key.h"

namespace prohull {
namespace {

/// In half spacings: all even at the corners of cubes, all odd at their centres.
struct LatticePoint {
  std::int32_t x, y, z;

  std::int32_t& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
};
LatticePoint operator+(LatticePoint a, LatticePoint b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

LatticePoint step(int axis, std::int32_t length) {
  LatticePoint s{0, 0, 0};
  s[axis] = length;
  return s;
}

struct FieldSample {
  Vec3 position;
  double value;
};

class MarchingTetrahedra {
 public:
  MarchingTetrahedra(const DistanceBound& solid, double spacing) : solid_(solid), spacing_(spacing) {}

  TriangleMesh march(double extent) {
    std::int32_t cubes = 2;
    while (cubes * spacing_ < 2 * (extent + spacing_)) cubes *= 2;
    assert(cubes <= kMostCubes);
    visit({-cubes, -cubes, -cubes}, cubes);
    return std::move(mesh_);
  }

 private:
  // Lattice points near the surface are moved away from it, to at least this distance, so that no triangle is a sliver.
  // The least width of a tetrahedron is 1/2, between its two long edges: moves below 1/4 cannot turn it inside out.
  static constexpr double kClearance = 0.2;
  // A cube's tetrahedra reach half a cube beyond it along one axis, and their corners may be moved.
  static constexpr double kReach = 0.5 + kClearance;
  static constexpr std::int32_t kMostCubes = 1 << 19;

  Vec3 position(LatticePoint p) const { return 0.5 * spacing_ * Vec3{double(p.x), double(p.y), double(p.z)}; }

  /// The block of size^3 cubes from `corner` on, unless the surface is too far away to meet their tetrahedra.
  void visit(LatticePoint corner, std::int32_t size) {
    const double far = spacing_ * (size * std::numbers::sqrt3 / 2 + kReach);
    if (std::abs(solid_(position(corner + LatticePoint{size, size, size}))) > far) return;
    if (size == 1) return march_cube(corner + LatticePoint{1, 1, 1});
    for (int octant = 0; octant < 8; ++octant)
      visit(corner + LatticePoint{octant & 1 ? size : 0, octant & 2 ? size : 0, octant & 4 ? size : 0}, size / 2);
  }

  /// The four tetrahedra around each of the lines from this cube's centre to the next cubes'.
  void march_cube(LatticePoint center) {
    for (int axis = 0; axis < 3; ++axis) {
      const LatticePoint next = center + step(axis, 2), middle = center + step(axis, 1);
      const LatticePoint u = step((axis + 1) % 3, 1), v = step((axis + 2) % 3, 1);
      const LatticePoint minus_u = step((axis + 1) % 3, -1), minus_v = step((axis + 2) % 3, -1);
      const std::array corners{middle + u + v, middle + minus_u + v, middle + minus_u + minus_v, middle + u + minus_v};
      const std::uint32_t a = sample(center), b = sample(next);
      std::array<std::uint32_t, 4> around{};
      for (std::size_t k = 0; k < 4; ++k) around[k] = sample(corners[k]);
      for (std::size_t k = 0; k < 4; ++k) march_tetrahedron({a, b, around[k], around[(k + 1) % 4]});
    }
  }

  /// t[0] sees t[1], t[2], t[3] counter-clockwise: positively oriented.
  void march_tetrahedron(std::array<std::uint32_t, 4> t) {
    const auto inside = std::count_if(t.begin(), t.end(), [&](std::uint32_t p) { return is_inside(p); });
    if (inside == 0 || inside == 4) return;
    std::array<std::uint32_t, 4> sorted{};
    std::size_t next_inside = 0, next_outside = std::size_t(inside);
    for (const std::uint32_t p : t) sorted[is_inside(p) ? next_inside++ : next_outside++] = p;
    // An even permutation of t keeps its orientation.
    if (is_odd_partition(t)) inside >= 2 ? std::swap(sorted[0], sorted[1]) : std::swap(sorted[2], sorted[3]);

    const auto [a, b, c, d] = sorted;
    // Braces, as they are evaluated in order.
    if (inside == 1) return add_triangle({crossing(a, b), crossing(a, c), crossing(a, d)});
    if (inside == 3) return add_triangle({crossing(a, d), crossing(b, d), crossing(c, d)});
    const VertexId ac = crossing(a, c), ad = crossing(a, d), bd = crossing(b, d), bc = crossing(b, c);
    add_quad(mesh_, ac, ad, bd, bc);
  }

  bool is_inside(std::uint32_t p) const { return samples_[p].value < 0; }

  /// Whether moving those inside to the front takes an odd number of swaps.
  bool is_odd_partition(const std::array<std::uint32_t, 4>& t) const {
    bool odd = false, outside_odd = false;
    for (const std::uint32_t p : t) is_inside(p) ? odd ^= outside_odd : outside_odd ^= true;
    return odd;
  }

  void add_triangle(const std::array<VertexId, 3>& corners) { mesh_.triangles.push_back(corners); }

  /// Where the surface crosses the edge from p, inside, to q, outside.
  VertexId crossing(std::uint32_t p, std::uint32_t q) {
    const auto [index, is_new] = edges_.find_or_add(std::uint64_t(p) << 32 | q);
    if (is_new) {
      const FieldSample &inside = samples_[p], &outside = samples_[q];
      const auto at = [&](double fraction) {
        return inside.position + fraction * (outside.position - inside.position);
      };
      // Regula falsi: the second step has the curvature.
      double fraction = inside.value / (inside.value - outside.value);
      const double value = solid_(at(fraction));
      if (value < 0) fraction += (1 - fraction) * value / (value - outside.value);
      if (value > 0) fraction *= inside.value / (inside.value - value);
      // The clearance leaves more than this nearly always.
      mesh_.positions.push_back(at(std::clamp(fraction, 0.1, 0.9)));
    }
    return VertexId(index);
  }

  std::uint32_t sample(LatticePoint p) {
    const auto key = [](std::int32_t x) { return static_cast<std::uint64_t>(std::int64_t{x} + 2 * kMostCubes); };
    const auto [index, is_new] = points_.find_or_add(key(p.x) << 42 | key(p.y) << 21 | key(p.z));
    if (is_new) {
      const Vec3 at = position(p);
      samples_.push_back(moved_away({at, solid_(at)}));
    }
    return index;
  }

  FieldSample moved_away(const FieldSample& s) const {
    const double clearance = kClearance * spacing_;
    if (std::abs(s.value) >= clearance) return s;
    const double h = 1e-3 * spacing_;
    const Vec3 gradient =
        Vec3{solid_(s.position + Vec3{h, 0, 0}) - s.value, solid_(s.position + Vec3{0, h, 0}) - s.value,
             solid_(s.position + Vec3{0, 0, h}) - s.value} /
        h;
    const double slope = norm(gradient), missing = clearance - std::abs(s.value) / slope;
    if (!(missing > 0)) return s;  // a slope of zero ends here, too
    const Vec3 away = gradient * ((s.value < 0 ? -missing : missing) / slope);
    const FieldSample moved{s.position + away, solid_(s.position + away)};
    return (moved.value < 0) == (s.value < 0) && std::abs(moved.value) > std::abs(s.value) ? moved : s;
  }

  const DistanceBound& solid_;
  double spacing_;
  IndexOfKey points_, edges_;
  std::vector<FieldSample> samples_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh surface_of(const DistanceBound& solid, double extent, double spacing) {
  return MarchingTetrahedra(solid, spacing).march(extent);
}

}  // namespace prohull

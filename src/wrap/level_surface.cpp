#include "wrap/level_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/no_index.h"

namespace prohull {
namespace {

/// A corner of a cell: bit i is 1 at its far end along axis i. Tetrahedra go from corner 0 to corner 7, one axis after
/// the other; those of odd permutations are turned.
constexpr std::array<std::array<std::uint8_t, 4>, 6> kTetrahedra{
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 3, 2, 7}, {0, 6, 4, 7}, {0, 5, 1, 7}}};

class LevelSurface {
 public:
  LevelSurface(const Grid& grid, const std::vector<float>& values, float level)
      : grid_(grid), values_(values), level_(level) {
    for (auto& layer : crossings_) layer.assign(kEdges * grid.nodes(0) * grid.nodes(1), kNone);
  }

  TriangleMesh march() {
    for (std::size_t z = 0; z + 1 < grid_.nodes(2); ++z) {
      std::swap(crossings_[0], crossings_[1]);
      std::ranges::fill(crossings_[1], kNone);
      for (std::size_t y = 0; y + 1 < grid_.nodes(1); ++y)
        for (std::size_t x = 0; x + 1 < grid_.nodes(0); ++x) march_cell(x, y, z);
    }
    return std::move(mesh_);
  }

 private:
  static constexpr std::size_t kEdges = 7;  ///< that begin at a node: one for each other corner of its cell

  struct Cell {
    std::size_t x, y, z;
    std::array<float, 8> heights;  ///< of its corners above the level
  };

  void march_cell(std::size_t x, std::size_t y, std::size_t z) {
    Cell cell{x, y, z, {}};
    int above = 0;
    for (std::size_t c = 0; c < 8; ++c) {
      cell.heights[c] = height(grid_.node(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)));
      above += cell.heights[c] > 0;
    }
    if (above == 0 || above == 8) return;
    for (const auto& t : kTetrahedra) march_tetrahedron(cell, t);
  }

  float height(std::size_t node) const {
    constexpr float kApart = 0.01F;
    const float height = values_[node] - level_;
    return height > 0 ? std::max(height, kApart) : std::min(height, -kApart);
  }

  void march_tetrahedron(const Cell& cell, const std::array<std::uint8_t, 4>& t) {
    const auto is_below = [&](std::uint8_t c) { return cell.heights[c] < 0; };
    const auto below = std::ranges::count_if(t, is_below);
    if (below == 0 || below == 4) return;
    std::array<std::uint8_t, 4> sorted{};
    std::size_t next_below = 0, next_above = std::size_t(below);
    bool is_odd = false, odd_above = false;  // swaps that bring those below to the front
    for (const std::uint8_t c : t) {
      sorted[is_below(c) ? next_below++ : next_above++] = c;
      is_below(c) ? is_odd ^= odd_above : odd_above ^= true;
    }
    if (is_odd) below >= 2 ? std::swap(sorted[0], sorted[1]) : std::swap(sorted[2], sorted[3]);
    const auto [a, b, c, d] = sorted;
    const auto at = [&](std::uint8_t p, std::uint8_t q) { return crossing(cell, p, q); };
    const auto add = [&](VertexId p, VertexId q, VertexId r) { mesh_.triangles.push_back({p, q, r}); };
    if (below == 1) return add(at(a, b), at(a, c), at(a, d));
    if (below == 3) return add(at(a, d), at(b, d), at(c, d));
    const VertexId ac = at(a, c), ad = at(a, d), bd = at(b, d), bc = at(b, c);
    add(ac, ad, bd), add(ac, bd, bc);
  }

  /// On the edge between two corners of a cell, of which one is below.
  VertexId crossing(const Cell& cell, std::uint8_t p, std::uint8_t q) {
    const std::uint8_t from = std::min(p, q), to = std::max(p, q);  // all edges run upwards along their axes
    const std::size_t x = cell.x + (from & 1), y = cell.y + (from >> 1 & 1), layer = from >> 2;
    const std::size_t edge = std::size_t(from ^ to) - 1;
    std::uint32_t& known = crossings_[layer][kEdges * (y * grid_.nodes(0) + x) + edge];
    if (known == kNone) {
      const double fraction = cell.heights[from] / (double(cell.heights[from]) - cell.heights[to]);
      const auto along = [&](int axis) { return (from ^ to) >> axis & 1 ? fraction : 0.0; };
      known = index(mesh_.positions.push_back(
          grid_.position({double(x) + along(0), double(y) + along(1), double(cell.z + layer) + along(2)})));
    }
    return VertexId{known};
  }

  const Grid& grid_;
  const std::vector<float>& values_;
  const float level_;
  std::array<std::vector<std::uint32_t>, 2> crossings_;  ///< of the edges that begin in this layer, and in the next
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh level_surface(const Grid& grid, const std::vector<float>& values, float level) {
  return LevelSurface(grid, values, level).march();
}

}  // namespace prohull

#include "wrap/level_surface.h"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/no_index.h"

namespace prohull {
namespace {

/// A corner of a cell: bit i is 1 at its far end along axis i. Tetrahedra go from corner 0 to corner 7, one axis after
/// the other; those of odd permutations are turned.
constexpr std::array<std::array<std::uint8_t, 4>, 6> kTetrahedra{
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 3, 2, 7}, {0, 6, 4, 7}, {0, 5, 1, 7}}};

using Node = std::array<std::size_t, 3>;

Node middle(const Node& a, const Node& b) { return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}; }

class LevelSurface {
 public:
  LevelSurface(const Grid& grid, const Cells& cells, const std::vector<float>& values, float level)
      : grid_(grid), cells_(cells), values_(values), level_(level), crossings_(cells.largest() + 1) {
    for (auto& layer : crossings_) layer.assign(kEdges * grid.nodes(0) * grid.nodes(1), kNone);
  }

  TriangleMesh march() {
    for (std::size_t z = 0; z + 1 < grid_.nodes(2); ++z) {
      for (std::size_t y = 0; y + 1 < grid_.nodes(1); ++y)
        for (std::size_t x = 0, size = 0; x + 1 < grid_.nodes(0); x += size) {
          size = cells_.size_at(x, y, z);
          if (y % size == 0 && z % size == 0) march_cell({x, y, z}, size);
        }
      std::ranges::fill(crossings_[z % crossings_.size()], kNone);
    }
    return std::move(mesh_);
  }

 private:
  static constexpr std::size_t kEdges = 7;  ///< that begin at a node: one for each other corner of its cell

  struct Cell {
    Node first;
    std::size_t size;
    std::array<float, 8> heights;  ///< of its corners above the level

    Node corner(std::uint8_t c) const {
      return {first[0] + (c & 1) * size, first[1] + (c >> 1 & 1) * size, first[2] + (c >> 2) * size};
    }
  };

  void march_cell(const Node& first, std::size_t size) {
    Cell cell{first, size, {}};
    int above = 0;
    for (std::uint8_t c = 0; c < 8; ++c) {
      cell.heights[c] = height(cell.corner(c));
      above += cell.heights[c] > 0;
    }
    if (above == 0 || above == 8) return;
    for (const auto& t : kTetrahedra) march_tetrahedron(cell, t);
  }

  float height(const Node& n) const {
    constexpr float kApart = 0.01F;
    const float height = values_[grid_.node(n[0], n[1], n[2])] - level_;
    return height > 0 ? std::max(height, kApart) : std::min(height, -kApart);
  }

  bool is_below(const Node& n) const { return height(n) < 0; }

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
    polygon_.clear();
    // On each face of the tetrahedron, from the edge p q to the edge p r.
    if (below == 1) add_side(cell, a, b, c), add_side(cell, a, c, d), add_side(cell, a, d, b);
    if (below == 3) add_side(cell, d, a, b), add_side(cell, d, b, c), add_side(cell, d, c, a);
    if (below == 2) add_side(cell, a, c, d), add_side(cell, d, a, b), add_side(cell, b, d, c), add_side(cell, c, b, a);
    add_polygon(below == 2 ? 4 : 3);
  }

  /// With vertices of smaller cells on its sides, there is one in its middle.
  void add_polygon(std::size_t corners) {
    const auto add = [&](VertexId p, VertexId q, VertexId r) { mesh_.triangles.push_back({p, q, r}); };
    const auto& p = polygon_;
    if (p.size() == corners) {
      add(p[0], p[1], p[2]);
      if (corners == 4) add(p[0], p[2], p[3]);
      return;
    }
    Vec3 sum{};
    for (const VertexId v : p) sum = sum + mesh_.positions[v];
    const VertexId center = mesh_.positions.push_back(sum / double(p.size()));
    for (std::size_t i = 0; i < p.size(); ++i) add(p[i], p[(i + 1) % p.size()], center);
  }

  void add_side(const Cell& cell, std::uint8_t p, std::uint8_t q, std::uint8_t r) {
    polygon_.push_back(crossing(cell.corner(p), cell.corner(q)));
    const unsigned near = ~unsigned(p | q | r) & 7, far = p & q & r;  // axes across which its other side is
    if (cell.size == 1 || (near | far) == 0) return;
    Node across{};
    for (std::size_t axis = 0; axis < 3; ++axis) across[axis] = near >> axis & 1;
    add_smaller(cell.corner(p), cell.corner(q), cell.corner(r), across, cell.size);
  }

  /// The crossings between the edges p q and p r of a triangle: where cells on its other side are smaller.
  void add_smaller(const Node& p, const Node& q, const Node& r, const Node& across, std::size_t size) {
    Node beyond{};
    for (std::size_t axis = 0; axis < 3; ++axis) beyond[axis] = std::min({p[axis], q[axis], r[axis]}) - across[axis];
    if (size == 1 || cells_.size_at(beyond[0], beyond[1], beyond[2]) >= size) return;
    const Node pq = middle(p, q), pr = middle(p, r), qr = middle(q, r);
    const auto add = [&](const Node& a, const Node& b, const Node& c) { add_smaller(a, b, c, across, size / 2); };
    const auto cross = [&](const Node& a, const Node& b) { polygon_.push_back(crossing(a, b)); };
    const bool below = is_below(p), to_q = is_below(pq) != below, to_r = is_below(pr) != below;
    if (to_q && to_r) return add(p, pq, pr);
    to_q ? add(pq, p, pr) : (add(pq, q, qr), cross(pq, qr));
    if (!to_q && !to_r) add(qr, pq, pr);
    if (!to_q && to_r) add(pq, qr, pr);
    if (to_q && !to_r) cross(pq, pr), add(pr, pq, qr);
    to_r ? (cross(pq, pr), add(pr, pq, p)) : (cross(pr, qr), add(pr, qr, r));
  }

  /// On the edge between two corners of a cell, of which one is below: values are linear there, so that it is between
  /// two nodes next to each other.
  VertexId crossing(Node from, Node to) {
    if (to < from) std::swap(from, to);  // all edges run upwards along their axes
    for (bool is_from_below = is_below(from); middle(from, to) != from;) {
      const Node between = middle(from, to);
      (is_below(between) == is_from_below ? from : to) = between;
    }
    const std::array along{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    const std::size_t edge = along[0] + 2 * along[1] + 4 * along[2] - 1;
    auto& layer = crossings_[from[2] % crossings_.size()];
    std::uint32_t& known = layer[kEdges * (from[1] * grid_.nodes(0) + from[0]) + edge];
    if (known == kNone) {
      const float at_from = height(from), at_to = height(to);
      const double fraction = at_from / (double(at_from) - at_to);
      const auto at = [&](std::size_t axis) { return double(from[axis]) + (along[axis] != 0 ? fraction : 0.0); };
      known = index(mesh_.positions.push_back(grid_.position({at(0), at(1), at(2)})));
    }
    return VertexId{known};
  }

  const Grid& grid_;
  const Cells& cells_;
  const std::vector<float>& values_;
  const float level_;
  std::vector<std::vector<std::uint32_t>> crossings_;  ///< of the edges that begin in layers of nodes, taken in turns
  std::vector<VertexId> polygon_;                      ///< around a tetrahedron
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh level_surface(const Grid& grid, const Cells& cells, const std::vector<float>& values, float level) {
  return LevelSurface(grid, cells, values, level).march();
}

}  // namespace prohull

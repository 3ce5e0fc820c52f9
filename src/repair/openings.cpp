#include "prohull/detail/openings.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <functional>
#include <tuple>
#include <unordered_set>

#include "geometry/no_index.h"
#include "mesh/triangulate_polygon.h"
#include "prohull/detail/disjoint_sets.h"
#include "repair/steps.h"

namespace prohull {
namespace {

std::uint32_t next_corner(std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }

/// What find_openings looks at.
TriangleMesh welded(TriangleMesh mesh) {
  Repairs ignored;
  drop_non_finite_faces(mesh, ignored);
  weld(mesh, ignored);
  drop_duplicate_faces(mesh, ignored);
  return mesh;
}

/// The lines of edges that have an odd number of faces, which are the boundary modulo 2. Of such edges every vertex has
/// an even number, so that all lines close. An *end* is one of the two ends of such an edge: 2 edge at its tail and 2
/// edge + 1 at its tip, in the direction of its face, or of most of its faces.
class Boundary {
 public:
  explicit Boundary(const TriangleMesh& mesh) : mesh_(mesh), fans_(3 * mesh.face_count()) {
    find_edges();
    partner_.assign(2 * edges_.size(), kNone);
    join_within([&](std::uint32_t end) { return fans_.find(corner_at(end)); });
    // At an edge of three faces a sheet has no single continuation: what is left is joined where it ends.
    join_within([&](std::uint32_t end) { return index(vertex_at(end)); });
  }

  std::vector<Opening> cut_into_loops() {
    place_.assign(mesh_.vertex_count(), kNone);
    walked_.assign(edges_.size(), 0);
    for (std::uint32_t edge = 0; edge < edges_.size(); ++edge)
      if (!walked_[edge]) walk(2 * edge);
    std::ranges::stable_sort(openings_, std::greater(), &Opening::diameter);
    return std::move(openings_);
  }

 private:
  struct Edge {
    std::uint32_t corner;  ///< where the edge begins, of a face that has it
    bool is_open;          ///< no other face has it
  };
  struct Step {
    VertexId vertex;
    // Of the edge that leads here:
    bool with_face;  ///< it runs as its face does
    bool is_open;
  };

  VertexId vertex(std::uint32_t corner) const { return mesh_.triangles[FaceId(corner / 3)][corner % 3]; }
  std::uint32_t corner_at(std::uint32_t end) const {
    const std::uint32_t tail = edges_[end / 2].corner;
    return end % 2 == 0 ? tail : next_corner(tail);
  }
  VertexId vertex_at(std::uint32_t end) const { return vertex(corner_at(end)); }

  /// Also the fans of faces that edges with two faces connect.
  void find_edges() {
    struct Use {
      VertexId low, high;
      std::uint32_t corner;
    };
    std::vector<Use> uses;
    const auto corners = static_cast<std::uint32_t>(3 * mesh_.face_count());
    uses.reserve(corners);
    for (std::uint32_t c = 0; c < corners; ++c) {
      const VertexId a = vertex(c), b = vertex(next_corner(c));
      uses.push_back({std::min(a, b), std::max(a, b), c});
    }
    std::ranges::sort(uses, {}, [](const Use& use) { return std::tuple(use.low, use.high, use.corner); });
    for (auto i = uses.begin(), j = i; i != uses.end(); i = j) {
      while (j != uses.end() && j->low == i->low && j->high == i->high) ++j;
      if ((j - i) % 2 == 1) {
        // Of directions that are an odd number in all, the median is that of most.
        std::ranges::nth_element(i, i + (j - i) / 2, j, {},
                                 [&](const Use& use) { return std::pair(vertex(use.corner) == use.low, use.corner); });
        edges_.push_back({(i + (j - i) / 2)->corner, j - i == 1});
      }
      if (j - i == 2) {
        const std::uint32_t a = i->corner, b = (i + 1)->corner;
        const bool opposed = vertex(a) != vertex(b);
        fans_.join(a, opposed ? next_corner(b) : b);
        fans_.join(next_corner(a), opposed ? b : next_corner(b));
      }
    }
    std::ranges::sort(edges_, {}, &Edge::corner);
  }

  /// Joins ends of which `group` is the same, two by two, if they have no partner yet.
  template <class Group>
  void join_within(Group group) {
    struct Loose {
      std::uint32_t group, end;
    };
    std::vector<Loose> loose;
    for (std::uint32_t end = 0; end < partner_.size(); ++end)
      if (partner_[end] == kNone) loose.push_back({group(end), end});
    std::ranges::sort(loose, {}, [](const Loose& l) { return std::tuple(l.group, l.end % 2, l.end); });
    for (auto i = loose.begin(), j = i; i != loose.end(); i = j) {
      while (j != loose.end() && j->group == i->group) ++j;
      // Tails come before tips: a tail gets a tip as long as there are both.
      for (auto first = i, last = j - 1; first < last; ++first, --last) {
        partner_[first->end] = last->end;
        partner_[last->end] = first->end;
      }
    }
  }

  void walk(std::uint32_t end) {
    std::vector<Step> line{{vertex_at(end), false, false}};
    place_[line.back().vertex] = 0;
    for (; !walked_[end / 2]; end = partner_[end]) {
      walked_[end / 2] = 1;
      const bool with_face = end % 2 == 0;
      end ^= 1;
      add(line, {vertex_at(end), with_face, edges_[end / 2].is_open});
    }
    assert(line.size() == 1);
    place_[line.back().vertex] = kNone;
  }

  /// Goes a step further. Where the line has been before, what it went since then is a loop.
  void add(std::vector<Step>& line, const Step& step) {
    std::uint32_t& place = place_[step.vertex];
    if (place == kNone) {
      place = static_cast<std::uint32_t>(line.size());
      line.push_back(step);
      return;
    }
    std::vector<Step> loop(line.begin() + place + 1, line.end());
    for (const Step& left : loop) place_[left.vertex] = kNone;
    line.resize(place + 1);
    loop.push_back(step);
    if (std::ranges::any_of(loop, &Step::is_open)) add_opening(loop);
  }

  void add_opening(const std::vector<Step>& loop) {
    Opening opening;
    for (const Step& step : loop) opening.loop.push_back(step.vertex);
    const auto with_face = std::ranges::count(loop, true, &Step::with_face);
    if (2 * static_cast<std::size_t>(with_face) > loop.size()) std::ranges::reverse(opening.loop);
    opening.diameter = diameter(opening.loop);
    openings_.push_back(std::move(opening));
  }

  double diameter(const std::vector<VertexId>& loop) const {
    constexpr std::size_t kMostCompared = 1000;
    const std::size_t stride = (loop.size() + kMostCompared - 1) / kMostCompared;
    double largest = 0;
    for (std::size_t i = 0; i < loop.size(); i += stride)
      for (std::size_t j = 0; j < i; j += stride)
        largest = std::max(largest, norm(mesh_.positions[loop[i]] - mesh_.positions[loop[j]]));
    return largest;
  }

  const TriangleMesh& mesh_;
  DisjointSets fans_;  ///< of corners
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> partner_;  ///< of every end, the end that follows it
  std::vector<char> walked_;
  PerVertex<std::uint32_t> place_;  ///< in the line that is being walked
  std::vector<Opening> openings_;
};

using CornersOfFace = std::array<VertexId, 3>;

/// Edges between vertices of openings.
class Edges {
 public:
  Edges(const TriangleMesh& mesh, const std::vector<Opening>& openings) {
    PerVertex<char> on_loop(mesh.vertex_count(), 0);
    for (const Opening& opening : openings)
      for (const VertexId v : opening.loop) on_loop[v] = 1;
    for (const CornersOfFace& t : mesh.triangles)
      for (const auto& [v, w] : {std::pair(t[0], t[1]), {t[1], t[2]}, {t[2], t[0]}})
        if (on_loop[v] && on_loop[w]) add(v, w);
  }

  void add(VertexId v, VertexId w) { known_.insert(key(v, w)); }
  bool has(VertexId v, VertexId w) const { return known_.contains(key(v, w)); }

 private:
  static std::uint64_t key(VertexId v, VertexId w) {
    return std::uint64_t{index(std::min(v, w))} << 32 | index(std::max(v, w));
  }
  std::unordered_set<std::uint64_t> known_;
};

double area(const Vec3& a, const Vec3& b, const Vec3& c) { return norm(cross(b - a, c - a)) / 2; }

/// The triangulation of least weight of a closed polygon, by dynamic programming over all sub-polygons i, i + 1 ... k
/// (Barequet and Sharir 1995, section 4). There is no term for the angles between triangles, as in Liepa 2003: the rims
/// of machined parts are as sharp as can be, and the faces beside a rim may be turned.
class LeastArea {
 public:
  static std::uint64_t steps(std::uint64_t n) { return n * n * n / 6; }

  LeastArea(const std::vector<VertexId>& loop, const PerVertex<Vec3>& positions, const Edges& edges)
      : loop_(loop), edges_(edges), best_(loop.size() * loop.size()) {
    Box box;
    for (const VertexId v : loop) box.extend(positions[v]);
    const Vec3 center = box.center();
    const double unit = std::max({box.max.x - center.x, box.max.y - center.y, box.max.z - center.z});
    for (const VertexId v : loop) points_.push_back(unit > 0 ? (positions[v] - center) / unit : Vec3{});
    for (std::size_t length = 2; length < loop.size(); ++length)
      for (std::size_t i = 0; i + length < loop.size(); ++i) choose(i, i + length);
  }

  std::vector<CornersOfFace> triangles() const {
    std::vector<CornersOfFace> result;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, loop_.size() - 1}};
    while (!open.empty()) {
      const auto [i, k] = open.back();
      open.pop_back();
      if (k - i < 2) continue;
      const std::size_t m = at(i, k).apex;
      result.push_back({loop_[i], loop_[m], loop_[k]});
      open.push_back({i, m});
      open.push_back({m, k});
    }
    return result;
  }

 private:
  struct Best {
    std::uint32_t edges_of_mesh = 0;  ///< diagonals that are edges of the mesh, which would get three faces or more
    std::uint32_t apex = 0;
    double weight = 0;
  };

  const Best& at(std::size_t i, std::size_t k) const { return best_[i * loop_.size() + k]; }

  void choose(std::size_t i, std::size_t k) {
    Best best{kNone, 0, 0};
    for (std::size_t m = i + 1; m < k; ++m) {
      const Best &left = at(i, m), &right = at(m, k);
      const std::uint32_t edges_of_mesh = left.edges_of_mesh + right.edges_of_mesh;
      const double weight = left.weight + right.weight + area(points_[i], points_[m], points_[k]);
      if (std::tie(edges_of_mesh, weight) < std::tie(best.edges_of_mesh, best.weight))
        best = {edges_of_mesh, static_cast<std::uint32_t>(m), weight};
    }
    if (k - i < loop_.size() - 1) {
      // All triangulations of a flat polygon have the same area. This decides between them, and is too little to pay
      // for a fold that is worth mentioning.
      constexpr double kLengthWeight = 1e-6;
      best.weight += kLengthWeight * squared_norm(points_[k] - points_[i]);
      best.edges_of_mesh += edges_.has(loop_[i], loop_[k]);
    }
    best_[i * loop_.size() + k] = best;
  }

  const std::vector<VertexId>& loop_;
  const Edges& edges_;
  std::vector<Vec3> points_;
  std::vector<Best> best_;  ///< of the polygon i ... k, at i * n + k
};

class Capper {
 public:
  Capper(TriangleMesh mesh, const std::vector<Opening>& openings)
      : mesh_(std::move(mesh)), edges_(welded(mesh_), openings) {}

  void cap(const std::vector<VertexId>& loop) {
    constexpr std::size_t kMostVertices = 100;
    constexpr std::uint64_t kMostSteps = 100'000'000;  // about a second; of all loops together
    const std::uint64_t steps = LeastArea::steps(loop.size());
    if (loop.size() <= kMostVertices && steps_ + steps <= kMostSteps) {
      steps_ += steps;
      add(LeastArea(loop, mesh_.positions, edges_).triangles());
    } else {
      cap_long(loop);
    }
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  void add(const std::vector<CornersOfFace>& triangles) {
    for (const CornersOfFace& t : triangles) {
      mesh_.triangles.push_back(t);
      for (const auto& [v, w] : {std::pair(t[0], t[1]), {t[1], t[2]}, {t[2], t[0]}}) edges_.add(v, w);
    }
  }

  void cap_long(const std::vector<VertexId>& loop) {
    const Vec3 center = center_of(loop);
    double fan = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
      fan += area(mesh_.positions[loop[i]], mesh_.positions[loop[(i + 1) % loop.size()]], center);
    if (const auto flat = triangulate_polygon(loop, mesh_.positions)) {
      double flat_area = 0;
      for (const auto& [a, b, c] : *flat) flat_area += area(mesh_.positions[a], mesh_.positions[b], mesh_.positions[c]);
      constexpr double kClearlyLess = 0.9;  // a flat polygon has this area in any triangulation: no vertex for rounding
      if (!(fan < kClearlyLess * flat_area)) return add(*flat);
    }
    const VertexId apex = mesh_.positions.push_back(center);
    std::vector<CornersOfFace> triangles;
    for (std::size_t i = 0; i < loop.size(); ++i) triangles.push_back({loop[i], loop[(i + 1) % loop.size()], apex});
    add(triangles);
  }

  Vec3 center_of(const std::vector<VertexId>& loop) const {
    Vec3 center;
    for (const VertexId v : loop) center += mesh_.positions[v] / static_cast<double>(loop.size());
    return center;
  }

  TriangleMesh mesh_;
  Edges edges_;
  std::uint64_t steps_ = 0;
};

}  // namespace

std::vector<Opening> find_openings(const TriangleMesh& mesh) {
  const TriangleMesh joined = welded(mesh);
  return Boundary(joined).cut_into_loops();
}

TriangleMesh with_caps(TriangleMesh mesh, const std::vector<Opening>& openings) {
  Capper capper(std::move(mesh), openings);
  for (const Opening& opening : openings) capper.cap(opening.loop);
  return capper.take();
}

}  // namespace prohull

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "cover/extreme_points.h"
#include "cover/primitives.h"
#include "geometry/directions.h"
#include "geometry/select.h"

namespace prohull::cover {
namespace {

struct HullEdge {
  VertexId from, to;
  FaceId left, right;  ///< the left face has it from `from` to `to`
};

std::vector<HullEdge> edges_of(const TriangleMesh& hull) {
  std::vector<HullEdge> halves;
  for (const FaceId f : hull.triangles.ids())
    for (std::size_t i = 0; i < 3; ++i) halves.push_back({hull.triangles[f][i], hull.triangles[f][(i + 1) % 3], f, f});
  const auto key = [](const HullEdge& e) { return std::minmax(e.from, e.to); };
  std::ranges::stable_sort(halves, {}, [&](const HullEdge& e) { return std::pair<VertexId, VertexId>(key(e)); });
  std::vector<HullEdge> edges;
  for (std::size_t i = 0; i + 1 < halves.size(); i += 2)
    edges.push_back({halves[i].from, halves[i].to, halves[i].left, halves[i + 1].left});
  return edges;
}

struct Axes {
  Vec3 u, v, w;
  double volume = std::numeric_limits<double>::infinity();  ///< of the box along them
};

/// Looks for the box of least volume: along a direction u it is the least rectangle around the shadow that the polytope
/// casts along u, which is flush with an edge of the shadow. So only u is searched for.
class BoxSearch {
 public:
  explicit BoxSearch(const TriangleMesh& hull) : hull_(hull), edges_(edges_of(hull)), sees_(hull.face_count(), 0) {
    for (const FaceId f : hull.triangles.ids()) {
      const Triangle t = hull.triangle(f);
      normals_.push_back(cross(t.b - t.a, t.c - t.a));
    }
  }

  Axes run() {
    Axes best = along({0, 0, 1});
    // The box need not be flush with a face.
    constexpr std::size_t kDirections = 96;
    for (const std::vector<Vec3>& directions : {normals_of_large_faces(), spread_directions(kDirections)})
      for (const Axes& start : least_along(directions))
        if (const Axes refined = searched_around(turned(start)); refined.volume < best.volume) best = refined;
    return best;
  }

 private:
  std::vector<Vec3> normals_of_large_faces() const {
    constexpr std::size_t kMostFaces = 256;
    std::vector<Vec3> normals;
    for (const Vec3& n : normals_)
      if (squared_norm(n) > 0) normals.push_back(n);
    std::ranges::stable_sort(normals, std::greater{}, squared_norm);
    if (normals.size() > kMostFaces) normals.resize(kMostFaces);
    return normals;
  }

  std::vector<Axes> least_along(const std::vector<Vec3>& directions) {
    constexpr std::size_t kStarts = 3;
    std::vector<Axes> boxes;
    for (const Vec3& u : directions) boxes.push_back(along(u));
    std::ranges::stable_sort(boxes, {}, &Axes::volume);
    if (boxes.size() > kStarts) boxes.resize(kStarts);
    return boxes;
  }

  /// Turns the box about one of its axes after the other, as long as it becomes smaller.
  Axes turned(Axes axes) {
    constexpr int kMaxTurns = 20;
    for (int turn = 0; turn < kMaxTurns; ++turn) {
      const Axes by_v = along(axes.v), by_w = along(axes.w);
      const Axes& better = by_v.volume < by_w.volume ? by_v : by_w;
      if (!(better.volume < axes.volume * (1 - 1e-9))) break;
      axes = better;
    }
    return axes;
  }

  /// Tries directions around u, nearer and nearer; the pattern turns, because the volume has creases.
  Axes searched_around(Axes axes) {
    constexpr double kFirst = 0.2, kLast = 1e-5, kTurn = 0.7;
    double angle = 0;
    for (double step = kFirst; step > kLast; angle += kTurn) {
      const Vec3 v = any_normal(axes.u), w = cross(axes.u, v);
      Axes best = axes;
      for (int k = 0; k < 4; ++k) {
        const double a = angle + k * std::numbers::pi / 2;
        const Vec3 u = axes.u + v * (step * std::cos(a)) + w * (step * std::sin(a));
        if (const Axes tried = along(u); tried.volume < best.volume) best = tried;
      }
      if (!(best.volume < axes.volume)) step *= 0.6;
      axes = best;
    }
    return axes;
  }

  Axes along(const Vec3& direction) {
    const Vec3 u = direction / norm(direction);
    find_shadow(u);
    const Vec3 v = any_normal(u), w = cross(u, v);
    corners_.clear();
    sides_.clear();
    for (const HullEdge& e : shadow_) {
      const Vec3 d = at(e.to) - at(e.from);
      corners_.push_back({dot(at(e.from), v), dot(at(e.from), w), 0});
      sides_.push_back({dot(d, v), dot(d, w), 0});
    }
    keep_longest_sides();
    Axes best{u, v, w};
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& side : sides_) {
      const double length = norm(side);
      if (!(length > 0)) continue;
      const double x = side.x / length, y = side.y / length;
      if (const double area = rectangle(x, y); area < least) least = area, best.v = v * x + w * y;
    }
    best.w = cross(u, best.v);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& p : hull_.positions) low = std::min(low, dot(p, u)), high = std::max(high, dot(p, u));
    best.volume = least * (high - low);
    return best;
  }

  /// The edges between faces that look along u and others, in the direction of a closed line around the former.
  void find_shadow(const Vec3& u) {
    for (const FaceId f : hull_.triangles.ids()) sees_[f] = dot(normals_[f], u) > 0;
    shadow_.clear();
    for (const HullEdge& e : edges_)
      if (sees_[e.left] != sees_[e.right])
        shadow_.push_back(sees_[e.left] ? e : HullEdge{e.to, e.from, e.right, e.left});
  }

  /// Where a shadow has many sides, it is round, and the short ones matter little.
  void keep_longest_sides() {
    constexpr std::size_t kMostSides = 48;
    if (sides_.size() <= kMostSides) return;
    select_nth(sides_.begin(), sides_.begin() + kMostSides, sides_.end(),
               [](const Vec3& a, const Vec3& b) { return squared_norm(a) > squared_norm(b); });
    sides_.resize(kMostSides);
  }

  /// The area of the rectangle around the shadow whose one side has the direction (x, y).
  double rectangle(double x, double y) const {
    double low = std::numeric_limits<double>::infinity(), high = -low, left = low, right = high;
    for (const Vec3& p : corners_) {
      const double along_it = p.x * x + p.y * y, across = p.y * x - p.x * y;
      low = std::min(low, along_it), high = std::max(high, along_it);
      left = std::min(left, across), right = std::max(right, across);
    }
    return (high - low) * (right - left);
  }

  const Vec3& at(VertexId v) const { return hull_.positions[v]; }

  const TriangleMesh& hull_;
  std::vector<HullEdge> edges_;
  PerFace<Vec3> normals_;
  PerFace<char> sees_;
  std::vector<HullEdge> shadow_;
  std::vector<Vec3> corners_, sides_;  ///< of the shadow, in its plane
};

}  // namespace

OrientedBox box_around(const TriangleMesh& mesh) {
  const ExtremePoints extreme(mesh);
  const Axes axes = BoxSearch(extreme.hull).run();
  OrientedBox box;
  box.axes = {axes.u, axes.v, axes.w};
  Box range;
  for (const Vec3& p : extreme.hull.positions) range.extend(Vec3{dot(p, axes.u), dot(p, axes.v), dot(p, axes.w)});
  const Vec3 middle = range.center();
  box.center = extreme.to_world(axes.u * middle.x + axes.v * middle.y + axes.w * middle.z);
  for (const Vec3& p : extreme.world)
    for (int i = 0; i < 3; ++i)
      box.half_sizes[i] = std::max(box.half_sizes[i], std::abs(dot(p - box.center, box.axes[std::size_t(i)])));
  const double spare = extreme.spare();
  box.half_sizes += Vec3{spare, spare, spare};
  return box;
}

}  // namespace prohull::cover

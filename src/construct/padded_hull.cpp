#include "prohull/padded_hull.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "construct/closed_manifold.h"
#include "construct/collapse_away.h"
#include "construct/unfolded_padding.h"
#include "geometry/float32.h"
#include "geometry/linear_program.h"

namespace prohull {
namespace {

class Padder {
 public:
  Padder(const TriangleMesh& hull, double distance, bool float32_coordinates)
      : mesh_(hull),
        distance_(distance),
        float32_coordinates_(float32_coordinates),
        rounding_(storage_rounding(reach_of(hull, distance), float32_coordinates)) {}

  PaddedHull run() {
    remove_cramped();
    PaddedHull result;
    // All planes are those of the old faces, so that no vertex depends on another.
    const PerVertex<Vec3> old = mesh_.positions();
    std::vector<std::pair<VertexId, Vec3>> moved;
    for (const VertexId v : old.ids()) {
      if (!mesh_.has(v)) continue;
      const auto to = beyond_star(v);
      result.cramped_vertices += !to;
      moved.emplace_back(v, stored(to ? *to : mesh_.position(v) + mean_normal(v) * distance_));
    }
    for (const auto& [v, to] : moved) mesh_.move(v, to);
    result.mesh = mesh_.triangle_mesh();
    return result;
  }

  /// Before run(): faces in hollows turn over where all corners move farther than they are apart.
  void remove_folds() {
    constexpr int kPasses = 20;
    for (int pass = 0; pass < kPasses && remove_folds_once(); ++pass) {
    }
  }

 private:
  static constexpr double kFar = 16;  ///< the farthest that a vertex moves, in distances

  static Box reach_of(const TriangleMesh& hull, double distance) {
    Box box = bounding_box(hull);
    const Vec3 far{kFar * distance, kFar * distance, kFar * distance};
    return {box.min - far, box.max + far};
  }

  Vec3 stored(const Vec3& p) const { return float32_coordinates_ ? nearest_float32(p) : p; }

  bool collapse(VertexId v, Star& star) {
    return collapse_away(mesh_, v, star, 2 * rounding_, [&](const Vec3& p) { return stored(p); });
  }

  // A collapse changes the planes around it.
  void remove_cramped() {
    constexpr int kPasses = 4;
    Star star;
    for (int pass = 0; pass < kPasses; ++pass) {
      bool changed = false;
      for (std::uint32_t v = 0, count = std::uint32_t(mesh_.positions().size()); v < count; ++v)
        if (mesh_.has(VertexId{v}) && !beyond_star(VertexId{v})) changed |= collapse(VertexId{v}, star);
      if (!changed) break;
    }
  }

  // Whether there were any. A collapse changes where the vertices around it go: their faces wait for the next pass.
  bool remove_folds_once() {
    PerVertex<Vec3> to = mesh_.positions();
    for (const VertexId v : to.ids())
      if (const auto beyond = mesh_.has(v) ? beyond_star(v) : std::nullopt) to[v] = *beyond;
    PerVertex<char> is_known(to.size(), 1);
    bool any = false;
    Star star;
    for (std::uint32_t i = 0; i < mesh_.face_id_count(); ++i) {
      if (!mesh_.has(FaceId{i})) continue;
      const auto corners = mesh_.corners(FaceId{i});
      if (!std::ranges::all_of(corners, [&](VertexId v) { return is_known[v]; }) || !turns_over(corners, to)) continue;
      any |= std::ranges::any_of(corners, [&](VertexId v) {
        if (!collapse(v, star)) return false;
        is_known.resize(mesh_.positions().size(), 0);
        for (const HalfEdgeId h : mesh_.around(VertexId(is_known.size() - 1))) is_known[mesh_.tip(h)] = 0;
        return true;
      });
    }
    return any;
  }

  bool turns_over(const std::array<VertexId, 3>& c, const PerVertex<Vec3>& to) const {
    const Vec3 before = cross(mesh_.position(c[1]) - mesh_.position(c[0]), mesh_.position(c[2]) - mesh_.position(c[0]));
    return dot(before, cross(to[c[1]] - to[c[0]], to[c[2]] - to[c[0]])) <= 0;
  }

  // In units of the distance, from v: planes with unit normals, and the sum of the normals, weighted by area.
  Vec3 set_planes(VertexId v) {
    constexpr double kOfTheProgram = 1e-9;  // its rounding errors, in distances
    const double clearance = 1 + kOfTheProgram + 4 * rounding_ / distance_;
    planes_.clear();
    Vec3 sum;
    double size = 0;
    for (const HalfEdgeId h : mesh_.around(v))
      size = std::max(size, norm(mesh_.position(mesh_.tip(h)) - mesh_.position(v)));
    if (!(size > 0)) return sum;
    for (const HalfEdgeId h : mesh_.around(v)) {
      const Vec3 a = (mesh_.position(mesh_.tip(h)) - mesh_.position(v)) / size;
      const Vec3 b = (mesh_.position(mesh_.tail(mesh_.previous(h))) - mesh_.position(v)) / size;
      const Vec3 n = cross(a, b);
      const double length = norm(n);
      if (!(length > 0)) continue;
      planes_.push_back({n / length, clearance});
      sum += n;
    }
    return sum;
  }

  Vec3 mean_normal(VertexId v) {
    const Vec3 sum = set_planes(v);
    const double length = norm(sum);
    return length > 0 ? sum / length : sum;
  }

  // The nearest point, not the one that adds the least volume: that one lies far to the side where planes are nearly
  // parallel, and faces overlap. Robot links at 5 mm: 0.03 % more volume, 0 pairs of faces in place of 4 to 94.
  std::optional<Vec3> beyond_star(VertexId v) {
    set_planes(v);
    if (planes_.empty()) return std::nullopt;
    const auto step = nearest_feasible_point({}, planes_);
    if (!step || !(norm(*step) <= kFar)) return std::nullopt;
    const Vec3 to = mesh_.position(v) + *step * distance_;
    return is_finite(to) ? std::optional(to) : std::nullopt;
  }

  HalfEdgeMesh mesh_;
  const double distance_;
  const bool float32_coordinates_;
  const double rounding_;
  HalfSpaces planes_;
};

}  // namespace

PaddedHull padded_hull(const TriangleMesh& hull, double distance, bool float32_coordinates) {
  if (!(distance > 0 && std::isfinite(distance)))
    throw InputError(Defect::InvalidOption, fmt::format("the padding is {:g}; it must be greater than 0", distance));
  require_closed_manifold(hull);
  return Padder(hull, distance, float32_coordinates).run();
}

TriangleMesh padded_without_folds(const TriangleMesh& hull, double distance) {
  Padder padder(hull, distance, false);
  padder.remove_folds();
  return padder.run().mesh;
}

}  // namespace prohull

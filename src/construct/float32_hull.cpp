#include "prohull/detail/float32_hull.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "construct/collapse_away.h"
#include "construct/turned.h"
#include "geometry/float32.h"
#include "geometry/largest_coordinate.h"
#include "geometry/linear_program.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/detail/text.h"
#include "prohull/error.h"

namespace prohull {
namespace {

class VertexMover {
 public:
  VertexMover(const TriangleMesh& level, NoRoom no_room)
      : level_(level), no_room_(no_room), diagonal_(bounding_box(level).diagonal()), mesh_(level) {}

  Float32Hull run() {
    std::vector<VertexId> pending;
    for (const VertexId v : mesh_.positions().ids())
      if (mesh_.has(v) && !is_float32(mesh_.position(v))) pending.push_back(v);
    const std::size_t wanted = pending.size();
    // Around a saddle the planes may meet in the vertex alone. Neighbours that move out tilt them and make room; where
    // even that fails, the vertex goes, by an edge collapse.
    constexpr int kRounds = 24;
    for (int round = 0; !pending.empty(); ++round) {
      std::erase_if(pending, [&](VertexId v) { return move_nearby(v); });
      if (pending.empty()) break;
      if (round == kRounds) {
        std::erase_if(pending, [&](VertexId v) { return !mesh_.has(v) || move_nearby(v) || collapse_vertex_away(v); });
        if (!pending.empty() && no_room_ == NoRoom::Refuse) refuse(pending.front(), pending.size());
        for (const VertexId v : pending) mesh_.move(v, nearest_float32(mesh_.position(v)));
        break;
      }
      std::vector<VertexId> cramped;
      for (const auto& some : {pending, cramped_})
        for (const VertexId v : some) lift_neighbours(v, std::ldexp(1.0, round / 2 + 1), cramped);
      std::ranges::sort(cramped);
      cramped.erase(std::unique(cramped.begin(), cramped.end()), cramped.end());
      cramped_ = std::move(cramped);
    }
    Float32Hull result{mesh_.triangle_mesh(), 0};
    result.rounded_vertices = wanted + lifted_;
    return result;
  }

 private:
  [[noreturn]] void refuse(VertexId v, std::size_t count) const {
    const Vec3& p = mesh_.position(v);
    throw InputError(
        Defect::NoVolume,
        fmt::format("{}, the first at ({:.9g}, {:.9g}, {:.9g}), cannot be moved outwards to float32 coordinates; write "
                    "a .ply, .obj or .off file, which keep doubles",
                    counted(count, "vertex", "vertices"), p.x, p.y, p.z));
  }

  // Does use(corner after v, corner before v) for each face around v.
  template <class Use>
  void around(VertexId v, Use&& use) const {
    for (const HalfEdgeId h : mesh_.around(v)) use(mesh_.tip(h), mesh_.tail(mesh_.previous(h)));
  }

  // The spacing of float32 coordinates around v, at most.
  double spacing(VertexId v) const {
    const Vec3& p = mesh_.position(v);
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), 0x1p-120}) * 0x1p-23;
  }

  // How far v may move: neighbours that lift each other in turn would grow without end.
  double reach(VertexId v) const { return std::max(diagonal_ / 1000, 4096 * spacing(v)); }

  // The point that adds the least volume and is at least `clearance` outside of all planes around v, rounded; nothing
  // if there is none close by.
  std::optional<Vec3> lifted(VertexId v, double clearance) {
    const Vec3 origin = mesh_.position(v);
    constraints_.clear();
    Vec3 objective;
    around(v, [&](VertexId a, VertexId b) {
      // In units of the clearance, so that the optimum is about 1 away; areas relative to the longest edge.
      const Vec3 u = mesh_.position(a) - origin, w = mesh_.position(b) - origin;
      const double length = std::max(norm(u), norm(w));
      const Vec3 n = cross(u / length, w / length);
      const double area = norm(n);
      if (area == 0) return;
      constraints_.push_back({n / area, 1});
      objective += n * (length / spacing(v)) * length;
    });
    const double size = norm(objective);
    if (size == 0 || !std::isfinite(size)) return std::nullopt;
    const auto step = optimum_or_nearest(objective / size, constraints_);
    if (!step) return std::nullopt;
    const Vec3 p = nearest_float32(origin + *step * clearance);
    return is_finite(p) && norm(p - level_.positions[v]) <= reach(v) && is_outside(mesh_, v, p) ? std::optional(p)
                                                                                                : std::nullopt;
  }

  bool move_nearby(VertexId v) {
    const Vec3 p = mesh_.position(v);
    std::optional<Vec3> best = nearest_corner(v);
    for (double clearance = spacing(v); !best && clearance <= 64 * spacing(v); clearance *= 2)
      best = lifted(v, clearance);
    if (best) mesh_.move(v, *best);
    return best.has_value() || is_float32(p);
  }

  // Of the eight float32 points around v, the nearest that is outside.
  std::optional<Vec3> nearest_corner(VertexId v) const {
    const Vec3 p = mesh_.position(v);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    std::optional<Vec3> best;
    for (int i = 0; i < 8; ++i) {
      Vec3 q;
      for (int axis = 0; axis < 3; ++axis) {
        const float nearest = static_cast<float>(p[axis]);
        const float below = nearest <= p[axis] ? nearest : std::nextafter(nearest, -kInfinity);
        const float above = nearest >= p[axis] ? nearest : std::nextafter(nearest, kInfinity);
        q[axis] = i >> axis & 1 ? above : below;
      }
      if (best && squared_norm(q - p) >= squared_norm(*best - p)) continue;
      if (is_finite(q) && is_outside(mesh_, v, q)) best = q;
    }
    return best;
  }

  // Notes those that have no room themselves.
  void lift_neighbours(VertexId v, double spacings, std::vector<VertexId>& cramped) {
    std::vector<VertexId> neighbours;
    around(v, [&](VertexId a, VertexId) { neighbours.push_back(a); });
    for (const VertexId w : neighbours) {
      if (const auto p = lifted(w, spacings * spacing(w))) {
        lifted_ += is_float32(mesh_.position(w));
        mesh_.move(w, *p);
      } else {
        cramped.push_back(w);
      }
    }
  }

  bool collapse_vertex_away(VertexId v) {
    return collapse_away(mesh_, v, star_, 4 * spacing(v), [](const Vec3& p) { return nearest_float32(p); });
  }

  const TriangleMesh& level_;
  const NoRoom no_room_;
  const double diagonal_;
  HalfEdgeMesh mesh_;
  HalfSpaces constraints_;
  std::vector<VertexId> cramped_;  ///< neighbours that could not be lifted, for want of room: theirs are next
  std::size_t lifted_ = 0;
  Star star_;
};

}  // namespace

void check_float32_spacing(const TriangleMesh& mesh) {
  const Box box = finite_bounding_box(mesh);
  if (box.is_empty()) return;
  const double most = largest_coordinate(box);
  if (constexpr double kMost = std::numeric_limits<float>::max(); most > kMost)
    throw InputError(Defect::NonFiniteCoordinate,
                     fmt::format("coordinates beyond {:g} do not fit the float32 of the file; write a .ply, .obj or "
                                 ".off file, or scale the mesh",
                                 kMost));
  constexpr int kDigits = std::numeric_limits<float>::digits, kLeast = std::numeric_limits<float>::min_exponent;
  const double spacing = std::ldexp(1.0, std::max(std::ilogb(most) + 1, kLeast) - kDigits);
  const Vec3 extent = box.max - box.min;
  const double diagonal = std::hypot(extent.x, extent.y, extent.z);
  if (diagonal > 0 && spacing > kMaxFloat32Spacing * diagonal)
    throw InputError(Defect::NonFiniteCoordinate,
                     fmt::format("float32 numbers, which the file has, are {:.2g} apart at its coordinates of up to "
                                 "{:.9g}; that is too coarse for a mesh that is {:.3g} across; write a .ply, .obj "
                                 "or .off file, which keep doubles, or move the mesh to the origin, as `prohull build "
                                 "--recenter` does",
                                 spacing, most, diagonal));
}

Float32Hull with_float32_coordinates(const TriangleMesh& level, HullSide side, NoRoom no_room) {
  if (std::ranges::all_of(level.positions, is_float32)) return {level, 0};
  check_float32_spacing(level);
  // An inner hull is the outer hull of the mesh turned inside out.
  Float32Hull result = VertexMover(turned_if_inner(level, side), no_room).run();
  result.mesh = turned_if_inner(std::move(result.mesh), side);
  return result;
}

}  // namespace prohull

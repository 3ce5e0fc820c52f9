#include "construct/guard/fan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace prohull {
namespace {

Vec3 magnitudes(const Vec3& a) { return {std::abs(a.x), std::abs(a.y), std::abs(a.z)}; }

/// The cross product, all terms of it added.
Vec3 minors_of(const Vec3& a, const Vec3& b) {
  return {a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x};
}

double sum(const Vec3& a) { return a.x + a.y + a.z; }

Double2 along(const Vec3Pair& a, int axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }

}  // namespace

void Fan::set(const HalfEdgeMesh& mesh, const std::vector<VertexId>& link, const Vec3& apex) {
  assert(link.size() >= 3 && link.size() <= kMostFaces);
  count_ = link.size();
  ids_.assign((count_ + 3) / 4, {Truth4{-1, -1, -1, -1}});  // kNoVertex
  std::memcpy(ids_.data(), link.data(), count_ * sizeof(VertexId));
  apex_ = apex;
  vertices_.clear(), normals_.clear();
  const std::size_t n = link.size();
  const auto vertex = [&](std::size_t i) -> const Vec3& { return i < n ? mesh.position(link[i]) : apex; };
  for (std::size_t i = 0; i <= n; i += 2) vertices_.push_back(both(vertex(i), vertex(i + 1)));
  Vec3Pair low = vertices_.front(), high = low;
  for (const Vec3Pair& two : vertices_) {
    low = {min(low.x, two.x), min(low.y, two.y), min(low.z, two.z)};
    high = {max(high.x, two.x), max(high.y, two.y), max(high.z, two.z)};
  }
  box_ = {low[0], high[0]};
  box_.extend(Box{low[1], high[1]});
  const Vec3 extent = box_.max - box_.min;
  is_moderate_ = sum(extent) < kReach;
  size_ = std::max({extent.x, extent.y, extent.z});
  per_size_ = 1 / size_;
  Vec3 normal;
  const auto around = [&](std::size_t i) -> const Vec3& { return vertex(i < n ? i : i - n); };
  for (std::size_t i = 0; i < n; i += 2) {
    normals_.push_back(
        cross(both(around(i), around(i + 1)) - both(apex), both(around(i + 1), around(i + 2)) - both(apex)));
    normal += normals_.back()[0] + normals_.back()[1];
  }
  const Vec3 size = magnitudes(normal);
  const int axis = size.z >= size.x && size.z >= size.y ? 2 : size.y >= size.x ? 1 : 0;
  is_embedded_ = is_moderate_ && see_along(axis);
  if (is_embedded_) set_walls(mesh, link);
}

// If, seen along the axis, all faces turn the same way around the apex, and the link once, the fan is the graph of a
// function over the plane across.
bool Fan::see_along(int axis) {
  const Double2 bound = both(kBound * 2 * size_ * size_ + kTiny);
  const auto all_turn = [&](double sign) {
    return std::ranges::all_of(normals_,
                               [&](const Vec3Pair& normal) { return mask(sign * along(normal, axis) > bound) == 3; });
  };
  constexpr std::array kAxes{&Vec3::x, &Vec3::y, &Vec3::z};
  u_ = kAxes[(axis + 1) % 3], v_ = kAxes[(axis + 2) % 3];
  if (!all_turn(1)) {
    if (!all_turn(-1)) return false;
    std::swap(u_, v_);
  }
  const std::size_t n = count_;
  const auto vertex = [&](std::size_t i) { return vertices_[i / 2][static_cast<int>(i % 2)]; };
  int rises = 0;
  for (std::size_t i = 0; i < n; ++i)
    rises += vertex(i).*v_ < apex_.*v_ && vertex(i + 1 == n ? 0 : i + 1).*v_ >= apex_.*v_;
  return rises == 1;
}

void Fan::set_walls(const HalfEdgeMesh& mesh, const std::vector<VertexId>& link) {
  ++time_;
  known_.resize(mesh.positions().size());
  walls_.assign((count_ + 3) / 4, {});
  for (std::size_t i = 0; i < count_; ++i)
    add_wall(i, mesh.position(link[i]), mesh.position(link[i + 1 < count_ ? i + 1 : 0]));
  within_.clear();
  for (std::size_t i = 0; i < count_; ++i) {
    const std::uint64_t end_of = std::uint64_t{1} << i | previous(std::uint64_t{1} << i);
    std::uint64_t inside = end_of, outside = end_of;
    see_walls(mesh.position(link[i]), [&](std::size_t four, Float4 depth, Float4 bound) {
      inside |= std::uint64_t{mask(depth > bound)} << 4 * four;
      outside |= std::uint64_t{mask(depth < -bound)} << 4 * four;
    });
    within_.push_back(inside);
    known_[link[i]] = {outside, time_};
  }
  // The apex is within any wall.
  const std::uint64_t first = within_.front();
  all_within_ = all_faces();
  for (std::size_t i = 0; i < count_; ++i) all_within_ &= within_[i] &= i + 1 < count_ ? within_[i + 1] : first;
}

void Fan::add_wall(std::size_t i, const Vec3& from, const Vec3& to) {
  const double u = (from.*u_ - apex_.*u_) * per_size_, v = (from.*v_ - apex_.*v_) * per_size_,
               du = (to.*u_ - from.*u_) * per_size_, dv = (to.*v_ - from.*v_) * per_size_;
  FourWalls& four = walls_[i / 4];
  four.du[i % 4] = static_cast<float>(du), four.dv[i % 4] = static_cast<float>(dv);
  four.offset[i % 4] = static_cast<float>(du * v - dv * u);
  four.error[i % 4] = kFloatBound * static_cast<float>(std::abs(du) + std::abs(dv)) + kFloatTiny;
}

// How far a point is within four walls, times their lengths, and what that may be off by.
void Fan::see_walls(const Vec3& p, auto&& see) const {
  const auto u = static_cast<float>((p.*u_ - apex_.*u_) * per_size_),
             v = static_cast<float>((p.*v_ - apex_.*v_) * per_size_), reach = 1 + std::max(std::abs(u), std::abs(v));
  for (std::size_t four = 0; four < walls_.size(); ++four) {
    const FourWalls& walls = walls_[four];
    see(four, walls.du * v - walls.dv * u - walls.offset, walls.error * reach);
  }
}

std::uint64_t Fan::seen_outside(const Vec3& p) const {
  std::uint64_t outside = 0;
  see_walls(p, [&](std::size_t four, Float4 depth, Float4 bound) {
    outside |= std::uint64_t{mask(depth < -bound)} << 4 * four;
  });
  return outside;
}

/// The places of a vertex in the link: one or none.
std::uint64_t Fan::places(VertexId v) const {
  const auto id = static_cast<std::int32_t>(index(v));
  const Truth4 all{id, id, id, id};
  std::uint64_t places = 0;
  for (std::size_t i = 0; i < ids_.size(); ++i) places |= std::uint64_t{mask(ids_[i].four == all)} << 4 * i;
  return places;
}

std::uint64_t Fan::perhaps_met(const HalfEdgeMesh& mesh, const std::array<VertexId, 3>& corners,
                               std::uint64_t walls) const {
  const auto& [a, b, c] = corners;
  std::uint64_t met = all_faces();
  for (std::size_t i = 0; walls != 0 && i < count_; ++i)
    if ((walls & within_[i]) != 0) met &= ~(std::uint64_t{1} << i);
  if (met == 0) return 0;
  const Triangle t{mesh.position(a), mesh.position(b), mesh.position(c)};
  const Vec3 extent = magnitudes(t.b - t.a) + magnitudes(t.c - t.a) + magnitudes(box_.max - t.a);
  if (!is_moderate_ || !(sum(extent) < kReach)) return all_faces();
  const std::array<std::uint64_t, 3> at_corner{places(a), places(b), places(c)};
  if (is_beside(t, at_corner[0] | at_corner[1] | at_corner[2])) return 0;
  return met & ~faces_beside(t, at_corner);
}

/// Whether all of the fan but the `shared` vertices lies strictly on one side of the plane of t.
bool Fan::is_beside(const Triangle& t, std::uint64_t shared) const {
  const Vec3 u = t.b - t.a, v = t.c - t.a;
  const Vec3 low = magnitudes(box_.min - t.a), high = magnitudes(box_.max - t.a);
  const Vec3 reach{std::max(low.x, high.x), std::max(low.y, high.y), std::max(low.z, high.z)};
  const double bound = kBound * dot(minors_of(magnitudes(u), magnitudes(v)), reach) + kTiny;
  const Vec3Pair normal = both(cross(u, v)), origin = both(t.a);
  std::uint64_t above = shared, below = shared;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Double2 height = dot(normal, vertices_[i] - origin);
    above |= std::uint64_t{mask(height > bound)} << 2 * i;
    below |= std::uint64_t{mask(height < -bound)} << 2 * i;
  }
  const std::uint64_t all = 2 * all_faces() + 1;
  return (above & all) == all || (below & all) == all;
}

/// The faces of which the plane has t strictly on one side but for the corners that they share.
std::uint64_t Fan::faces_beside(const Triangle& t, const std::array<std::uint64_t, 3>& at_corner) const {
  const std::array<Vec3, 3> corners{t.a - apex_, t.b - apex_, t.c - apex_};
  std::array<std::uint64_t, 2> sides{~std::uint64_t{0}, ~std::uint64_t{0}};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3Pair p = both(corners[k]);
    const Double2 bound = both(kBound * 2 * size_ * size_ * sum(magnitudes(corners[k])) + kTiny);
    const std::uint64_t sharing = at_corner[k] | previous(at_corner[k]);
    std::uint64_t above = sharing, below = sharing;
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      const Double2 height = dot(normals_[i], p);
      above |= std::uint64_t{mask(height > bound)} << 2 * i;
      below |= std::uint64_t{mask(height < -bound)} << 2 * i;
    }
    sides[0] &= above, sides[1] &= below;
  }
  return sides[0] | sides[1];
}

}  // namespace prohull

#include "verify/winding.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "geometry/triangle_predicates.h"
#include "geometry/vector_of.h"

namespace prohull::verify {
namespace {

template <class Field>
Field turn_determinant(const Field& au, const Field& av, const Field& bu, const Field& bv, const Field& pu,
                       const Field& pv) {
  return (bu - au) * (pv - av) - (bv - av) * (pu - au);
}

/// Positive if p lies outside of the plane of h.
template <class Field>
Field side_determinant(const Triangle& h, const std::array<Field, 3>& p) {
  const VectorOf<Field> a{Field(h.a.x), Field(h.a.y), Field(h.a.z)};
  return dot(cross(between<Field>(h.a, h.b), between<Field>(h.a, h.c)), p - a);
}

std::array<Number, 3> random_point(const Triangle& t, int axis, const Cell& cell, std::mt19937& random) {
  Number total(0);
  PlanePoint sum{0, 0};
  for (const PlanePoint& corner : cell) {
    const Number weight(random_number(random, 1 << 8, 1 << 16));
    sum.u += weight * corner.u;
    sum.v += weight * corner.v;
    total += weight;
  }
  return lifted(t, axis, {sum.u / total, sum.v / total});
}

}  // namespace

ExactPoint::ExactPoint(std::array<Number, 3> coordinates) : exact_(std::move(coordinates)) {}

ExactPoint::ExactPoint(const Vec3& p) : ExactPoint({Number(p.x), Number(p.y), Number(p.z)}) {}

std::array<int, 3> ExactPoint::turns(int axis, const Triangle& h) const {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const std::array<Vec3, 3> corner{h.a, h.b, h.c};
  std::array<int, 3> result;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = corner[i], &b = corner[(i + 1) % 3];
    const auto certain =
        certain_sign(turn_determinant<Interval>(a[u], a[v], b[u], b[v], exact_[u].approx(), exact_[v].approx()));
    result[i] = certain ? *certain : sign(turn_determinant<Number>(a[u], a[v], b[u], b[v], exact_[u], exact_[v]));
  }
  return result;
}

Side ExactPoint::side(const Triangle& h) const {
  const std::array<Interval, 3> rough{exact_[0].approx(), exact_[1].approx(), exact_[2].approx()};
  if (const auto certain = certain_sign(side_determinant(h, rough))) return Side(*certain);
  return Side(sign(side_determinant(h, exact_)));
}

int winding_at(const Surface& surface, const ExactPoint& p) {
  // A ray from p, moved by (eps, eps^2), towards +z.
  const auto on_the_way = [&](const Box& box) {  // true for unbounded approximations
    return !(box.min.x > p.upper(0) || box.max.x < p.lower(0) || box.min.y > p.upper(1) || box.max.y < p.lower(1) ||
             box.max.z < p.lower(2));
  };
  int winding = 0;
  surface.bvh.visit(on_the_way, [&](FaceIndex f) {
    const Triangle& h = surface.faces[f];
    auto [first, second, third] = p.turns(2, h);
    if (first == 0) first = turn_of_moved(h.a, h.b);
    if (second == 0) second = turn_of_moved(h.b, h.c);
    if (third == 0) third = turn_of_moved(h.c, h.a);
    if (first == 0 || second != first || third != first) return;
    const bool is_beyond = std::min({h.a.z, h.b.z, h.c.z}) > p.upper(2) || (p.side(h) == Side::Inside) == (first > 0);
    if (is_beyond) winding += first;
  });
  return winding;
}

SurfacePoint::SurfacePoint(const Triangle& t, int axis, const Cell& cell, std::mt19937& random)
    : support_(t), axis_(axis), point_(random_point(t, axis, cell, random)) {}

Side SurfacePoint::side(const Triangle& h) const { return coplanar(support_, h) ? Side::On : point_.side(h); }

std::optional<WindingBeside> winding_beside(const Surface& surface, const SurfacePoint& p) {
  const int axis = p.axis(), u = (axis + 1) % 3, v = (axis + 2) % 3;
  int beyond = 0, at = 0;  // faces crossed by the ray after p, and at p: +1 if they face along the ray
  bool covered = false, ambiguous = false;
  const auto on_the_way = [&](const Box& box) {  // true for unbounded approximations
    return !(box.min[u] > p.upper(u) || box.max[u] < p.lower(u) || box.min[v] > p.upper(v) || box.max[v] < p.lower(v) ||
             box.max[axis] < p.lower(axis));
  };
  surface.bvh.visit(on_the_way, [&](FaceIndex f) {
    const Triangle& h = surface.faces[f];
    const auto [first, second, third] = p.turns(h);
    if (first * second < 0 || first * third < 0 || second * third < 0) return;
    if (first == 0 || second == 0 || third == 0) {
      ambiguous = true;
      return;
    }
    if (std::min({h.a[axis], h.b[axis], h.c[axis]}) > p.upper(axis)) {
      beyond += first;
      return;
    }
    const Side side = p.side(h);
    if (side == Side::On) {
      if (!coplanar(p.support(), h)) ambiguous = true;
      at += first;
      covered = true;
    } else if ((side == Side::Inside) == (first > 0)) {
      beyond += first;
    }
  });
  if (ambiguous) return std::nullopt;
  const bool faces_along = turn(axis, p.support().a, p.support().b, p.support().c) > 0;
  const int above = beyond, below = beyond + at;
  return WindingBeside{faces_along ? above : below, faces_along ? below : above, covered};
}

WindingBeside winding_beside(const Surface& surface, SurfacePoint& p, const Cell& cell, std::mt19937& random) {
  constexpr int kTries = 1000;  // a random ray meets an edge almost never, so that two tries are rare
  for (int i = 0; i < kTries; ++i) {
    if (const auto w = winding_beside(surface, p)) return *w;
    p = SurfacePoint(p.support(), p.axis(), cell, random);
  }
  throw std::logic_error("winding_beside: no ray misses the edges");
}

}  // namespace prohull::verify

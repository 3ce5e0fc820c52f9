#include "geometry/cones.h"

#include <array>
#include <cmath>
#include <limits>

namespace prohull {
namespace {

/// How far the box reaches along the normal, seen from the point. Not less than exact: three differences, products and
/// sums round by less than 9 units of the last place of the terms, and products that underflow by less than the least
/// number.
double reach(const Box& box, const Vec3& from, const Vec3& normal) {
  constexpr double kRoundingOfReach = 9 * std::numeric_limits<double>::epsilon() / 2;
  double sum = 0, terms = 0;
  for (int i = 0; i < 3; ++i) {
    const double term = normal[i] * ((normal[i] > 0 ? box.max[i] : box.min[i]) - from[i]);
    sum += term;
    terms += std::abs(term);
  }
  return sum + kRoundingOfReach * terms + std::numeric_limits<double>::min();
}

/// From there, the box of the two other corners is as small as can be.
Vec3 opposite_to_shortest(const Triangle& t) {
  const double a = squared_norm(t.c - t.b), b = squared_norm(t.a - t.c), c = squared_norm(t.b - t.a);
  if (a <= b && a <= c) return t.a;
  return b <= c ? t.b : t.c;
}

Vec3 unit(const Vec3& v) { return v / norm(v); }

/// Whether a lies below the plane through its apex, and b above a parallel one through its own, which is no lower.
/// What is not finite compares as false.
bool separates(const Vec3& normal, const Cone& a, const Cone& b) {
  if (!(reach(a.rim, a.apex, normal) < 0 && reach(b.rim, b.apex, -normal) < 0)) return false;
  Box apex;
  apex.extend(b.apex);
  return a.apex == b.apex || reach(apex, a.apex, -normal) < 0;
}

}  // namespace

bool are_apart(const Cone& a, const Cone& b) {
  const Vec3 between = unit(b.rim.center() - b.apex) - unit(a.rim.center() - a.apex);
  if (a.apex == b.apex) return separates(between, a, b);
  // Cones on both sides of a common rim, as those of a double cone, are divided by planes that nearly hold both apexes.
  const Vec3 axis = unit(b.apex - a.apex);
  const Vec3 across = between - axis * dot(between, axis);
  const double room = -std::max(reach(a.rim, a.apex, across), reach(b.rim, b.apex, -across));
  const double tilt = std::max(reach(a.rim, a.apex, axis), reach(b.rim, b.apex, -axis));
  return separates(tilt > 0 ? across + axis * std::min(1.0, room / (2 * tilt)) : across + axis, a, b);
}

bool are_apart(const Triangle& t, const Cone& cone) {
  const auto has_apex = [&](const Vec3& p) { return p == cone.apex; };
  const std::array corners{t.a, t.b, t.c};
  const auto shared = std::ranges::find_if(corners, has_apex);
  Cone own{shared == corners.end() ? opposite_to_shortest(t) : *shared, {}};
  own.extend(t);
  return are_apart(own, cone);
}

void Cones::place(std::uint32_t slot, const Triangle& t) {
  std::uint32_t node = slot;
  for (std::vector<std::uint32_t>& level : at_) {
    node /= kWidth;
    if (level[node] == kNone) continue;
    Cone& cone = cones_[level[node]];
    if (t.a == cone.apex || t.b == cone.apex || t.c == cone.apex)
      cone.extend(t);
    else
      level[node] = kNone;
  }
}

void Cones::join_upwards() {
  while (at_.back().size() > 1) {
    const std::vector<std::uint32_t>& below = at_.back();
    std::vector<std::uint32_t> level(nodes_of(static_cast<std::uint32_t>(below.size())), kNone);
    for (std::uint32_t i = 0; i < level.size(); ++i) {
      const auto begin = below.begin() + kWidth * i;
      const auto end = below.begin() + std::min<std::ptrdiff_t>(kWidth * (i + 1), std::ssize(below));
      if (*begin == kNone) continue;
      Cone cone = cones_[*begin];
      const auto is_part = [&](std::uint32_t child) { return child != kNone && cones_[child].apex == cone.apex; };
      if (!std::all_of(begin, end, is_part)) continue;
      for (auto child = begin; child != end; ++child) cone.rim.extend(cones_[*child].rim);
      level[i] = static_cast<std::uint32_t>(cones_.size());
      cones_.push_back(cone);
    }
    at_.push_back(std::move(level));
  }
}

}  // namespace prohull

#include "geometry/closest_point.h"

#include <limits>

#include "geometry/largest_coordinate.h"

namespace prohull {
namespace {

/// Keeps the nearest of the points that it is shown.
class NearestFoot {
 public:
  void consider(const Foot& foot, const Vec3& away) {
    const double d = squared_norm(away);
    if (d < squared_distance_) foot_ = foot, squared_distance_ = d;
  }

  void consider_edge(int from, int to, const Vec3& away, const Vec3& side) {
    const double length = squared_norm(side), along = dot(side, away);
    if (!(along > 0))
      consider({Foot::On::Corner, from}, away);
    else if (along >= length)
      consider({Foot::On::Corner, to}, away - side);
    else
      consider({Foot::On::Edge, from, to, along / length}, away - side * (along / length));
  }

  const Foot& foot() const { return foot_; }

 private:
  Foot foot_{Foot::On::Corner};
  double squared_distance_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Foot foot_on_thin_triangle(const Vec3& away_a, const Vec3& away_b, const Vec3& away_c, const Vec3& ab, const Vec3& ac) {
  Box box;
  for (const Vec3& p : {away_a, away_b, away_c, ab, ac}) box.extend(p);
  const double unit = std::ldexp(1.0, std::min(-std::ilogb(largest_coordinate(box)), 1000));
  const Vec3 a = away_a * unit, b = away_b * unit, u = ab * unit, v = ac * unit, n = cross(u, v);
  NearestFoot nearest;
  nearest.consider_edge(0, 1, a, u);
  nearest.consider_edge(0, 2, a, v);
  nearest.consider_edge(1, 2, b, v - u);
  // Of where the foot is on the face, products with the normal itself keep more than those of products.
  const double all = squared_norm(n), along_u = dot(cross(a, v), n) / all, along_v = dot(cross(u, a), n) / all;
  if (along_u >= 0 && along_v >= 0 && along_u + along_v <= 1)
    nearest.consider({Foot::On::Face, 0, 0, along_u, std::min(along_v, 1 - along_u)}, a - u * along_u - v * along_v);
  return nearest.foot();
}

}  // namespace prohull

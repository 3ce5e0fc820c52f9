#include "geometry/winding_number.h"

#include <utility>

#include "geometry/triangle_predicates.h"

namespace prohull {

// All points are in the plane of a triangle without area, which winds around none. Its points are on edges of others.
WindingNumber::WindingNumber(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  std::erase_if(triangles_, [](const Triangle& t) { return !projection_axis(t); });
  bvh_ = Bvh(triangles_);
}

std::optional<int> WindingNumber::at(const Vec3& p) const {
  int winding = 0;
  bool undecided = false;
  const auto met_by_ray = [&](const Box& box) {
    return box.min.x <= p.x && p.x <= box.max.x && box.min.y <= p.y && p.y <= box.max.y && box.max.z >= p.z;
  };
  bvh_.visit(met_by_ray, [&](std::uint32_t i) {
    const Triangle& t = triangles_[i];
    const Side s = side(t.a, t.b, t.c, p);
    if (s == Side::On && box_of(t).contains(p)) undecided = true;
    const int turns = turn_around_moved(t, p);
    if (turns == 0) return;
    // The ray leaves through a triangle that it sees from inside: counter-clockwise seen from +z, p below.
    undecided |= s == Side::On;
    winding += turns > 0 && s == Side::Inside;
    winding -= turns < 0 && s == Side::Outside;
  });
  if (undecided) return std::nullopt;
  return winding;
}

}  // namespace prohull

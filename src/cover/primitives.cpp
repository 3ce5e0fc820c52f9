#include "cover/primitives.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "cover/polytope.h"
#include "geometry/float32.h"

namespace prohull::cover {

double volume(const OrientedBox& box) { return 8 * box.half_sizes.x * box.half_sizes.y * box.half_sizes.z; }
double volume(const Capsule& capsule) {
  const double r = capsule.radius;
  return std::numbers::pi * r * r * (norm(capsule.b - capsule.a) + 4 * r / 3);
}
double volume(const Ball& ball) { return 4 * std::numbers::pi * ball.radius * ball.radius * ball.radius / 3; }

TriangleMesh mesh_of(const OrientedBox& box, bool float32_coordinates) {
  // A box larger by `margin` each way has every corner at least that far outside of every plane that supports this box,
  // so the convex hull of its corners still encloses this box when each has moved by at most `margin`.
  const double reach = box.half_sizes.x + box.half_sizes.y + box.half_sizes.z;
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(box.center[axis]) + reach);
  const double margin =
      float32_coordinates ? std::max(largest * 0x1p-23, 0x1p-148) : std::max(largest * 0x1p-49, 0x1p-1070);
  const Vec3 half = box.half_sizes + Vec3{margin, margin, margin};
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    const Vec3 p = box.center + box.axes[0] * (i & 1 ? half.x : -half.x) + box.axes[1] * (i & 2 ? half.y : -half.y) +
                   box.axes[2] * (i & 4 ? half.z : -half.z);
    corners.push_back(float32_coordinates ? nearest_float32(p) : p);
  }
  return convex_hull_of(std::move(corners));
}

}  // namespace prohull::cover

#include "cover/local_frame.h"

#include <algorithm>
#include <cmath>

#include "geometry/directions.h"

namespace prohull::cover {
namespace {

/// The difference that measures most, of length 1; `otherwise` if all measure 0.
template <class Measure>
Vec3 farthest_direction(const PerVertex<Vec3>& positions, const Vec3& from, double unit, Measure&& measure,
                        const Vec3& otherwise) {
  Vec3 best;
  double most = 0;
  for (const Vec3& p : positions) {
    const Vec3 d = measure((p - from) / unit);
    if (const double size = squared_norm(d); size > most) most = size, best = d;
  }
  return most > 0 ? best / std::sqrt(most) : otherwise;
}

/// Of the solid inside of a closed mesh.
Vec3 centroid(const TriangleMesh& mesh) {
  const Vec3 from = mesh.positions[VertexId{0}];
  Vec3 sum;
  double volume = 0;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    const Vec3 a = t.a - from, b = t.b - from, c = t.c - from;
    const double six_fold = dot(a, cross(b, c));
    sum += (a + b + c) * six_fold;
    volume += six_fold;
  }
  return volume > 0 ? from + sum / (4 * volume) : from;
}

}  // namespace

LocalFrame::LocalFrame(const TriangleMesh& polytope, double rounding) {
  const Box box = bounding_box(polytope);
  const Vec3 half = box.max * 0.5 - box.min * 0.5;
  const double unit = std::max({half.x, half.y, half.z, rounding});
  const Vec3 start = polytope.positions[VertexId{0}];
  const auto whole = [](const Vec3& d) { return d; };
  const Vec3 u = farthest_direction(polytope.positions, start, unit, whole, {1, 0, 0});
  const auto beside_u = [&](const Vec3& d) { return d - u * dot(d, u); };
  Vec3 v = farthest_direction(polytope.positions, start, unit, beside_u, any_normal(u));
  v = beside_u(v);
  v = v / norm(v);
  axes_ = {u, v, cross(u, v)};
  Box range;
  for (const Vec3& p : polytope.positions) {
    const Vec3 d = p - start;
    range.extend(Vec3{dot(d, axes_[0]), dot(d, axes_[1]), dot(d, axes_[2])});
  }
  origin_ = start;
  sizes_ = (range.max - range.min) * 0.5 + Vec3{rounding, rounding, rounding};
  TriangleMesh local = polytope;
  for (Vec3& p : local.positions) p = to_local(p);
  origin_ = to_world(centroid(local));
}

}  // namespace prohull::cover

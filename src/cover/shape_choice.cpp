#include "cover/shape_choice.h"

#include <algorithm>

#include "cover/polytope.h"
#include "cover/primitives.h"
#include "geometry/directions.h"

namespace prohull::cover {
namespace {

TriangleMesh hull_of_spheres(const Capsule& capsule, double radius) {
  static const std::vector<Vec3> directions = spread_directions(256);
  std::vector<Vec3> points;
  for (const Vec3& center : {capsule.a, capsule.b})
    for (const Vec3& d : directions) points.push_back(center + d * radius);
  return convex_hull_of(std::move(points));
}

TriangleMesh mesh_around(const Capsule& capsule) {
  const TriangleMesh inscribed = hull_of_spheres(capsule, capsule.radius);
  const double ratio = std::min(depth(capsule.a, inscribed), depth(capsule.b, inscribed)) / capsule.radius;
  return hull_of_spheres(capsule, capsule.radius / ratio * (1 + 1e-6));
}

}  // namespace

void take_shape(ConvexPiece& piece, PieceShape shape, bool float32_coordinates) {
  if (shape == PieceShape::Capsule) piece.primitive = capsule_around(piece.mesh);
  if (shape == PieceShape::Ball) piece.primitive = ball_around(piece.mesh);
  if (shape != PieceShape::Box) return;
  const OrientedBox box = box_around(piece.mesh);
  piece.primitive = box;
  piece.mesh = mesh_of(box, float32_coordinates);
}

TriangleMesh mesh_around(const ConvexPiece& piece) {
  if (const auto* const capsule = std::get_if<Capsule>(&piece.primitive)) return mesh_around(*capsule);
  if (const auto* const ball = std::get_if<Ball>(&piece.primitive))
    return mesh_around(Capsule{ball->center, ball->center, ball->radius});
  return piece.mesh;
}

}  // namespace prohull::cover

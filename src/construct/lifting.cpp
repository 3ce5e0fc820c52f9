#include "construct/lifting.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "construct/placement.h"
#include "geometry/bvh.h"
#include "geometry/closest_point.h"
#include "geometry/float32.h"
#include "geometry/linear_program.h"
#include "mesh/half_edge_mesh.h"

namespace prohull {
namespace {

/// The point that adds the least volume and lies `clearance` outside of all planes around v.
std::optional<Vec3> lifted(const HalfEdgeMesh& mesh, VertexId v, double clearance) {
  const Vec3 origin = mesh.position(v);
  double size = 0;
  for (const HalfEdgeId h : mesh.around(v)) size = std::max(size, norm(mesh.position(mesh.tip(h)) - origin));
  if (!(size > 0)) return std::nullopt;
  HalfSpaces constraints;
  Vec3 objective;
  for (const HalfEdgeId h : mesh.around(v)) {
    const Vec3 a = (mesh.position(mesh.tip(h)) - origin) / size;
    const Vec3 b = (mesh.position(mesh.tail(mesh.previous(h))) - origin) / size;
    const Vec3 n = cross(a, b);
    const double area = norm(n);
    if (area == 0) continue;
    constraints.push_back({n / area, clearance / size});
    objective += n;
  }
  constexpr double kReach = 2;  // of the star
  const auto step = optimum_or_nearest(objective, constraints, kReach);
  if (!step) return std::nullopt;
  return origin + *step * size;
}

}  // namespace

TriangleMesh lifted_over(const TriangleMesh& hull, std::span<const Protrusion> protrusions,
                         const LiftOptions& options) {
  constexpr double kLittleMore = 1.1;
  const double rounding = storage_rounding(bounding_box(hull), options.float32_coordinates);
  HalfEdgeMesh mesh(hull);
  const Bvh tree(hull);
  PerVertex<double> clearances(hull.vertex_count(), 0.0);
  for (const Protrusion& protrusion : protrusions) {
    const Vec3& point = protrusion.point;
    double least = std::numeric_limits<double>::infinity();
    FaceId nearest{0};
    const auto away = [&](std::uint32_t f) {
      const double d = squared_norm(point - closest_point(point, hull.triangle(FaceId{f})));
      if (d < least) least = d, nearest = FaceId{f};
      return d;
    };
    tree.least([&](const Box& box) { return squared_norm(point - closest_point(point, box)); }, away);
    for (const VertexId v : hull.triangles[nearest])
      clearances[v] = std::max({clearances[v], kLittleMore * protrusion.distance + 8 * rounding, options.least});
  }
  for (int ring = 0; ring < options.rings; ++ring) {
    const PerVertex<double> before = clearances;
    for (const auto& corners : hull.triangles)
      for (const VertexId v : corners)
        for (const VertexId w : corners) clearances[v] = std::max(clearances[v], before[w]);
  }
  for (const VertexId v : hull.positions.ids()) {
    if (clearances[v] == 0) continue;
    auto to = lifted(mesh, v, clearances[v]);
    if (to && options.float32_coordinates) to = nearest_float32(*to);
    if (to && is_finite(*to) && is_outside(mesh, v, *to)) mesh.move(v, *to);
  }
  return mesh.triangle_mesh();
}

}  // namespace prohull

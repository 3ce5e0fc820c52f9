#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <cstddef>
#include <vector>

#include "prohull/error.h"
#include "prohull/wrap.h"
#include "wrap/surface_mesh.h"

namespace prohull {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;

/// CGAL's wrapping tells it of every facet that it looks at.
class CancellingVisitor : public CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor {
 public:
  explicit CancellingVisitor(const std::function<bool()>& progress) : progress_(&progress) {}

  template <class Wrapper, class Gate>
  void before_facet_treatment(const Wrapper&, const Gate&) {
    constexpr std::size_t kInterval = 256;
    if (*progress_ && ++facets_ % kInterval == 0 && !(*progress_)()) throw Cancelled();
  }

 private:
  const std::function<bool()>* progress_;
  std::size_t facets_ = 0;
};

}  // namespace

TriangleMesh alpha_wrap(const TriangleMesh& triangles, double alpha, double offset,
                        const std::function<bool()>& progress) {
  std::vector<Point> points;
  points.reserve(triangles.vertex_count());
  for (const Vec3& p : triangles.positions) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::array<std::size_t, 3>> faces;
  faces.reserve(triangles.face_count());
  for (const auto& t : triangles.triangles) faces.push_back({index(t[0]), index(t[1]), index(t[2])});
  SurfaceMesh surface;
  CancellingVisitor visitor(progress);
  CGAL::alpha_wrap_3(points, faces, alpha, offset, surface, CGAL::parameters::default_values(),
                     CGAL::parameters::visitor(visitor));
  return triangle_mesh(surface);
}

}  // namespace prohull

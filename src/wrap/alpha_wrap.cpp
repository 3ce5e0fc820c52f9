#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "parallel/progress_meter.h"
#include "prohull/wrap.h"
#include "wrap/surface_mesh.h"

namespace prohull {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;

/// CGAL's wrapping tells it of every facet that it looks at. How many there will be is not known, but about.
class Visitor : public CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor {
 public:
  Visitor(ProgressMeter& meter, double expected_facets) : meter_(&meter), expected_(expected_facets) {}

  template <class Wrapper, class Gate>
  void before_facet_treatment(const Wrapper&, const Gate&) {
    constexpr std::size_t kInterval = 64;
    if (++facets_ % kInterval == 0) meter_->at(1 - std::exp(-static_cast<double>(facets_) / expected_));
  }

 private:
  ProgressMeter* meter_;
  double expected_;
  std::size_t facets_ = 0;
};

}  // namespace

TriangleMesh alpha_wrap(const TriangleMesh& triangles, double alpha, double offset, const Progress& progress) {
  std::vector<Point> points;
  points.reserve(triangles.vertex_count());
  for (const Vec3& p : triangles.positions) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::array<std::size_t, 3>> faces;
  faces.reserve(triangles.face_count());
  for (const auto& t : triangles.triangles) faces.push_back({index(t[0]), index(t[1]), index(t[2])});
  SurfaceMesh surface;
  ProgressMeter meter(progress, "wrap");
  constexpr double kFacetsPerSquare = 10;  // measured: within a factor of three
  const double across = bounding_box(triangles).diagonal() / alpha;
  Visitor visitor(meter, kFacetsPerSquare * across * across);
  CGAL::alpha_wrap_3(points, faces, alpha, offset, surface, CGAL::parameters::default_values(),
                     CGAL::parameters::visitor(visitor));
  return triangle_mesh(surface);
}

}  // namespace prohull

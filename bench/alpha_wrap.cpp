#include "alpha_wrap.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <cstddef>
#include <vector>

#include "surface_mesh.h"

namespace prohull::bench {
namespace {

struct TookTooLong {};

/// CGAL's wrapping tells it of every facet that it looks at.
class Limit : public CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor {
 public:
  explicit Limit(std::chrono::seconds limit) : limit_(limit) {}

  template <class Wrapper, class Gate>
  void before_facet_treatment(const Wrapper&, const Gate&) const {
    if (std::chrono::steady_clock::now() - start_ > limit_) throw TookTooLong();
  }

 private:
  std::chrono::seconds limit_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

std::optional<TriangleMesh> alpha_wrap(const TriangleMesh& triangles, double alpha, double offset,
                                       std::chrono::seconds limit) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> points;
  points.reserve(triangles.vertex_count());
  for (const Vec3& p : triangles.positions) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::array<std::size_t, 3>> faces;
  faces.reserve(triangles.face_count());
  for (const auto& t : triangles.triangles) faces.push_back({index(t[0]), index(t[1]), index(t[2])});
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  Limit visitor(limit);
  try {
    CGAL::alpha_wrap_3(points, faces, alpha, offset, surface, CGAL::parameters::default_values(),
                       CGAL::parameters::visitor(visitor));
  } catch (const TookTooLong&) {
    return std::nullopt;
  }
  return triangle_mesh(surface);
}

}  // namespace prohull::bench

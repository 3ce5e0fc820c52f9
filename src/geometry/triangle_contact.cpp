#include "geometry/triangle_contact.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <variant>

namespace prohull {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Shape = std::variant<Kernel::Point_3, Kernel::Segment_3, Kernel::Triangle_3>;

Shape shape_of(const Triangle& t) {
  const Kernel::Point_3 a(t.a.x, t.a.y, t.a.z), b(t.b.x, t.b.y, t.b.z), c(t.c.x, t.c.y, t.c.z);
  if (!CGAL::collinear(a, b, c)) return Kernel::Triangle_3(a, b, c);
  const auto [least, greatest] = std::minmax({a, b, c});  // by coordinates: the ends of a line
  if (least == greatest) return a;
  return Kernel::Segment_3(least, greatest);
}

}  // namespace

bool triangles_touch(const Triangle& s, const Triangle& t) {
  return std::visit([](const auto& one, const auto& other) { return CGAL::do_intersect(one, other); }, shape_of(s),
                    shape_of(t));
}

}  // namespace prohull

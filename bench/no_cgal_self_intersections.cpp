#include "cgal_self_intersections.h"

namespace prohull::bench {

std::optional<std::size_t> cgal_self_intersections(const TriangleMesh&) { return std::nullopt; }

}  // namespace prohull::bench

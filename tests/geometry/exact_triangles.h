#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include "prohull/geometry.h"

namespace prohull {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

inline Exact::Point_3 exact(const Vec3& v) { return {v.x, v.y, v.z}; }

inline bool has_area(const Triangle& t) { return !CGAL::collinear(exact(t.a), exact(t.b), exact(t.c)); }

inline const Triangle kFloor{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

}  // namespace prohull

#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <array>

#include "prohull/geometry.h"

namespace prohull::verify {

using Number =
    CGAL::Exact_predicates_exact_constructions_kernel::FT;  ///< rational; an interval until its sign is in doubt
using Interval = CGAL::Interval_nt_advanced;                ///< needs CGAL::Protect_FPU_rounding

inline Vec3 rounded(const std::array<Number, 3>& p) {
  return {CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2])};
}

}  // namespace prohull::verify

#pragma once

#include <CGAL/Lazy_exact_nt.h>
#include <CGAL/gmpxx.h>

#include <array>

#include "prohull/geometry.h"

namespace prohull::verify {

using Number = CGAL::Lazy_exact_nt<mpq_class>;  ///< rational; an interval until its sign is in doubt
using Interval = CGAL::Interval_nt_advanced;    ///< needs CGAL::Protect_FPU_rounding

inline Vec3 rounded(const std::array<Number, 3>& p) {
  return {CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2])};
}

}  // namespace prohull::verify

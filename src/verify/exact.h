#pragma once

#include <CGAL/Lazy_exact_nt.h>
#include <CGAL/gmpxx.h>

#include <array>
#include <optional>

#include "prohull/geometry.h"

namespace prohull::verify {

using Number = CGAL::Lazy_exact_nt<mpq_class>;  ///< rational; an interval until its sign is in doubt
using Interval = CGAL::Interval_nt_advanced;    ///< needs CGAL::Protect_FPU_rounding

/// Nothing if the interval holds both signs, or 0.
inline std::optional<int> certain_sign(const Interval& x) {
  if (x.inf() > 0) return 1;
  if (x.sup() < 0) return -1;
  return std::nullopt;
}

inline Vec3 rounded(const std::array<Number, 3>& p) {
  return {CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2])};
}

}  // namespace prohull::verify

#pragma once

#include <algorithm>

namespace prohull::render {

/// From 0 at `from` to 1 at `to`, level at both.
inline double smooth_step(double from, double to, double value) {
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace prohull::render

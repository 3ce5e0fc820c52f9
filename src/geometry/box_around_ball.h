#pragma once

#include <cmath>
#include <limits>

#include "prohull/detail/shapes.h"

namespace prohull {

/// Never smaller than the ball.
inline Box box_around(const Ball& ball) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box;
  for (int i = 0; i < 3; ++i) {
    box.min[i] = std::nextafter(ball.center[i] - ball.radius, -kInfinity);
    box.max[i] = std::nextafter(ball.center[i] + ball.radius, kInfinity);
  }
  return box;
}

}  // namespace prohull

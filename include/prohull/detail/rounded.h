#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace prohull {

inline double nearest_of_digits(double number, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, number);
  return std::strtod(text, nullptr);
}

/// To so many significant digits, and not below `number`: an upper bound that is printed stays one.
inline double rounded_up(double number, int digits) {
  if (number == 0 || !std::isfinite(number)) return number;
  const double nearest = nearest_of_digits(number, digits);
  if (nearest >= number) return nearest;
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(number)))) - (digits - 1);
  return nearest_of_digits(nearest + std::strtod(("1e" + std::to_string(exponent)).c_str(), nullptr), digits);
}

/// Not above `number`, as a lower bound needs it.
inline double rounded_down(double number, int digits) { return -rounded_up(-number, digits); }

}  // namespace prohull

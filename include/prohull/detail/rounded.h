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

/// So few significant digits, but at least `fewest`, that the two numbers look different, if they are.
inline int digits_apart(double a, double b, int fewest) {
  constexpr int kMost = 17;
  while (fewest < kMost && nearest_of_digits(a, fewest) == nearest_of_digits(b, fewest)) ++fewest;
  return fewest;
}

constexpr double kGreatestRatio = 1e4;  ///< that is written with its digits

/// In per cent: 0.5 -> "50.0 %", and 1e9 -> "more than 1000000 %".
inline std::string percent_text(double ratio, int decimals) {
  char text[64];
  if (ratio > kGreatestRatio)
    std::snprintf(text, sizeof text, "more than %.0f %%", 100 * kGreatestRatio);
  else
    std::snprintf(text, sizeof text, "%.*f %%", decimals, 100 * ratio);
  return *text == '-' && std::strtod(text, nullptr) == 0 ? text + 1 : text;
}

/// 1.234 -> "1.23", and 1e9 -> "> 10000".
inline std::string times_text(double ratio) {
  char text[64];
  if (ratio > kGreatestRatio)
    std::snprintf(text, sizeof text, "> %.0f", kGreatestRatio);
  else
    std::snprintf(text, sizeof text, "%.2f", ratio);
  return text;
}

/// Not above `number`, as a lower bound needs it.
inline double rounded_down(double number, int digits) { return -rounded_up(-number, digits); }

}  // namespace prohull

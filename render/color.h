#pragma once

#include <optional>
#include <string_view>

namespace prohull::render {

/// Linear light.
struct Rgb {
  float r = 0, g = 0, b = 0;
};

inline Rgb operator+(const Rgb& a, const Rgb& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
inline Rgb operator*(const Rgb& a, const Rgb& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
inline Rgb operator*(const Rgb& a, float s) { return {a.r * s, a.g * s, a.b * s}; }
inline Rgb mix(const Rgb& a, const Rgb& b, float share_of_b) { return a * (1 - share_of_b) + b * share_of_b; }

/// Linear light, multiplied by alpha.
struct Rgba {
  Rgb color;
  float alpha = 0;

  Rgba& operator+=(const Rgba& o) {
    color = color + o.color, alpha += o.alpha;
    return *this;
  }
};

inline Rgba operator*(const Rgba& a, float s) { return {a.color * s, a.alpha * s}; }

/// What is seen of both with `front` before `back`.
inline Rgba over(Rgba front, const Rgba& back) { return front += back * (1 - front.alpha); }

float linear_of_srgb(float encoded);  ///< both in [0, 1]
float srgb_of_linear(float linear);

/// "#7db4ea", or one of color_names().
std::optional<Rgb> parse_color(std::string_view text);
std::string_view color_names();  ///< for messages: "blue, clay, ..."

}  // namespace prohull::render

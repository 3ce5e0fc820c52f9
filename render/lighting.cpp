#include "render/lighting.h"

#include <cmath>

#include "render/normals.h"

namespace prohull::render {
namespace {

// Linear light; a white surface that faces the sun under an open sky comes out just below white.
constexpr Rgb kSun{0.60f, 0.585f, 0.56f}, kSkyAbove{0.42f, 0.435f, 0.46f}, kSkyBelow{0.22f, 0.21f, 0.20f};
constexpr float kLamp = 0.16f;       // beside the eye, so that nothing that is seen is black
constexpr double kSunRadius = 0.10;  // tangent of half its angle: large, for soft shadows
constexpr float kGloss = 0.07f;
constexpr double kGlossSharpness = 30;

Vec3 unit(const Vec3& v) { return v / norm(v); }

/// Maps the unit square to the unit disk; areas keep their ratios.
Point2 on_disk(const Point2& at) {
  const double radius = std::sqrt(at.x), angle = 2 * std::numbers::pi * at.y;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

Lighting::Lighting(const ViewAxes& axes)
    : vertical_(axes.vertical), sun_(unit(-0.55 * axes.right + 0.85 * axes.vertical + 0.55 * axes.front)) {}

Rgb Lighting::sky(const Vec3& normal) const {
  return mix(kSkyBelow, kSkyAbove, static_cast<float>(0.5 + 0.5 * dot(normal, vertical_)));
}

float Lighting::gloss(const Vec3& normal, const Vec3& to_eye) const {
  const double cosine = std::max(0.0, dot(normal, unit(sun_ + to_eye)));
  return kGloss * static_cast<float>(std::pow(cosine, kGlossSharpness));
}

Rgb Lighting::shaded(const Rgb& color, const Vec3& normal, const Vec3& to_eye, const Visibility& visible) const {
  const float facing = static_cast<float>(std::max(0.0, dot(normal, sun_)));
  const float lamp = kLamp * static_cast<float>(std::max(0.0, dot(normal, to_eye)));
  const Rgb light = sky(normal) * visible.sky + Rgb{lamp, lamp, lamp} + kSun * (facing * visible.sun);
  const float highlight = facing > 0 ? gloss(normal, to_eye) * visible.sun : 0;
  return color * light + Rgb{highlight, highlight, highlight};
}

Rgba Lighting::ground_shadow(const Visibility& visible) const {
  constexpr float kSkyShadow = 0.5f, kSunShadow = 0.3f;
  return {{}, kSkyShadow * (1 - visible.sky) + kSunShadow * (1 - visible.sun)};
}

Rgba Lighting::glazed(const Rgb& color, double opacity, const Vec3& normal, const Vec3& to_eye) const {
  const double grazing = 1 - std::abs(dot(normal, to_eye));
  const float alpha = static_cast<float>(opacity + (1 - opacity) * 0.6 * grazing * grazing * grazing);
  const float facing = static_cast<float>(std::max(0.0, dot(normal, sun_)));
  const float highlight = gloss(normal, to_eye);
  return {(color * (sky(normal) + kSun * facing) + Rgb{highlight, highlight, highlight}) * alpha, alpha};
}

Vec3 Lighting::sun_direction(const Point2& at) const {
  const auto [first, second] = tangents(sun_);
  const Point2 offset = on_disk(at);
  return sun_ + kSunRadius * (offset.x * first + offset.y * second);
}

Vec3 Lighting::sky_direction(const Vec3& normal, const Point2& at) {
  const auto [first, second] = tangents(normal);
  const Point2 offset = on_disk(at);
  return offset.x * first + offset.y * second + std::sqrt(1 - at.x) * normal;
}

}  // namespace prohull::render

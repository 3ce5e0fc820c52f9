#pragma once

#include "render/camera.h"
#include "render/color.h"

namespace prohull::render {

/// How much of the light arrives: of the sky's, and of the sun's.
struct Visibility {
  float sky = 1, sun = 1;
};

/// A sun up to the viewer's left, and a sky that is brighter above than below. Whatever the view, what is seen is lit.
class Lighting {
 public:
  explicit Lighting(const ViewAxes& axes);

  /// The colour of a matt surface with a little gloss. All directions are of length 1, `to_eye` on the side of the
  /// normal.
  Rgb shaded(const Rgb& color, const Vec3& normal, const Vec3& to_eye, const Visibility& visible) const;
  /// The shadow on a ground that is not seen itself.
  Rgba ground_shadow(const Visibility& visible) const;
  /// The colour and opacity of a translucent surface.
  Rgba glazed(const Rgb& color, double opacity, const Vec3& normal, const Vec3& to_eye) const;

  const Vec3& sun() const { return sun_; }
  /// `at` in [0, 1) x [0, 1) spreads over the disk of the sun.
  Vec3 sun_direction(const Point2& at) const;
  /// `at` in [0, 1) x [0, 1) spreads over the hemisphere around a normal, by cosine.
  static Vec3 sky_direction(const Vec3& normal, const Point2& at);

 private:
  Rgb sky(const Vec3& normal) const;
  float gloss(const Vec3& normal, const Vec3& to_eye) const;

  Vec3 vertical_, sun_;
};

}  // namespace prohull::render

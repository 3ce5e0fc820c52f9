#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/image.h"
#include "render/lighting.h"
#include "render/pattern.h"
#include "render/scene.h"

namespace prohull::render {

/// A part of the picture, in pixels; `right` and `bottom` are outside.
struct Rectangle {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// One scene from one viewpoint, in its place of the picture.
struct Panel {
  Scene scene;
  Camera camera;
  Rectangle place;
};

/// Draws parts of a panel. Keeps scratch memory; use one per thread.
///
/// A ray per sample finds what is seen, another one whether the sky, and a third whether the sun is seen from there.
/// The latter two are averaged over a block of pixels around, as far as these show the same surface: see Pattern.
class TileRenderer {
 public:
  /// `panel` must outlive it.
  TileRenderer(const Panel& panel, const Pattern& pattern);

  /// `tile` is a part of the panel's place; what is not covered shows the background, if there is one.
  void draw(const Rectangle& tile, const std::optional<Rgb>& background, Image& image);

 private:
  enum class Seen { Nothing, Ground, Face };

  struct Sample {
    Rgba veil;  // what is translucent and in front
    Seen seen = Seen::Nothing;
    Vec3 position, normal, to_eye;
    Rgb color;
    double pixel_size = 0;  // there
    Visibility visible;     // each 0 or 1

    bool is_like(const Sample& other) const;
  };

  void trace(const Rectangle& tile);
  Sample sample(int x, int y, int i);
  Rgba veil(double t, const Ray& ray, double column, const Point2& at);
  Visibility visible_from(const Vec3& lifted, const Vec3& normal, double column, const Point2& at);
  float line_at(const Meeting& meeting, const Point2& at) const;

  float ground_fade(int x, int y) const;
  Rgba resolved(int x, int y) const;
  Rgba shaded(const Sample& sample, const Visibility& visible) const;
  Visibility visibility_around(int x, int y, const Sample& center) const;
  std::span<const Sample> samples_of(int x, int y) const;

  const Panel& panel_;
  Pattern pattern_;
  Lighting lighting_;
  Tracer tracer_;
  Rectangle traced_;
  std::vector<Sample> samples_;  // of traced_, row by row, those of a pixel together
};

}  // namespace prohull::render

#include "render/tile.h"

#include <cmath>
#include <limits>

#include "render/wire.h"

namespace prohull::render {
namespace {

constexpr int kReach = Pattern::kBlock / 2;  // pixels to each side that a pixel is averaged with

constexpr float kNearLine = 0.8f, kFarLine = 0.25f;  // of a translucent surface: in front, and seen through it
Rgb line_color(const Rgb& surface) { return surface * 0.1f; }

// In scene sizes. Positions of hits are rounded to some 2^-50, and pixels of the whole scene are wider than 2^-15: far
// from both.
constexpr double kLift = 0x1p-20;
constexpr double kSkyReach = 0.35;  // what is farther away does not darken
constexpr double kSunReach = 4;     // beyond the scene

Rectangle grown(const Rectangle& r, int by) { return {r.left - by, r.top - by, r.right + by, r.bottom + by}; }

struct Normals {
  Vec3 face, shading;
};

/// Both towards the eye.
Normals normals_at(const Surface& surface, FaceId face, const Vec3& position, const Vec3& to_eye) {
  const Body& body = *surface.body;
  const Triangle triangle = body.mesh.triangle(face);
  const Vec3 normal = face_normal(triangle);
  const Vec3 shading = body.normals.empty() ? normal : interpolated_normal(triangle, body.normals[face], position);
  return dot(normal, to_eye) < 0 ? Normals{-normal, -shading} : Normals{normal, shading};
}

}  // namespace

TileRenderer::TileRenderer(const Panel& panel, const Pattern& pattern)
    : panel_(panel),
      pattern_(pattern),
      lighting_(panel.camera.axes()),
      tracer_(panel.scene, panel.camera.axes().vertical) {}

void TileRenderer::draw(const Rectangle& tile, const std::optional<Rgb>& background, Image& image) {
  trace(grown(tile, kReach));
  for (int y = tile.top; y < tile.bottom; ++y)
    for (int x = tile.left; x < tile.right; ++x) {
      const Rgba color = resolved(x, y);
      image.set(x, y, background ? over(color, {*background, 1}) : color);
    }
}

void TileRenderer::trace(const Rectangle& tile) {
  traced_ = tile;
  samples_.clear();
  for (int y = tile.top; y < tile.bottom; ++y)
    for (int x = tile.left; x < tile.right; ++x)
      for (int i = 0; i < pattern_.samples(); ++i) samples_.push_back(sample(x, y, i));
}

TileRenderer::Sample TileRenderer::sample(int x, int y, int i) {
  const Rectangle& place = panel_.place;
  const Point2 in_pixel = pattern_.in_pixel(i);
  const Point2 at{x - place.left + in_pixel.x, y - place.top + in_pixel.y};
  const double column = std::clamp(at.x / (place.right - place.left), 0.0, std::nextafter(1.0, 0.0));
  const Ray ray = panel_.camera.ray(at);
  const auto meeting = tracer_.first_opaque(ray, column);

  Sample sample;
  sample.veil =
      veil(meeting && meeting->surface ? meeting->t : std::numeric_limits<double>::infinity(), ray, column, at);
  if (!meeting) return sample;
  sample.position = meeting->position;
  sample.to_eye = -1 / norm(ray.direction) * ray.direction;
  sample.pixel_size = panel_.camera.pixel_size(meeting->t);
  const Vec3& vertical = panel_.camera.axes().vertical;
  Normals normals{vertical, vertical};
  if (const Surface* surface = meeting->surface) {
    sample.seen = Seen::Face;
    normals = normals_at(*surface, meeting->face, sample.position, sample.to_eye);
    const Rgb& color = surface->color(meeting->face);
    sample.color = mix(color, line_color(color), line_at(*meeting, at));
  } else {
    sample.seen = Seen::Ground;
  }
  sample.normal = normals.shading;
  sample.visible =
      visible_from(sample.position + kLift * normals.face, normals.face, column, pattern_.in_block(x, y, i));
  return sample;
}

Rgba TileRenderer::veil(double t, const Ray& ray, double column, const Point2& at) {
  Rgba seen;
  for (const Meeting& meeting : tracer_.translucent_before(t, ray, column)) {
    const Vec3 to_eye = -1 / norm(ray.direction) * ray.direction;
    const Material& material = meeting.surface->material;
    const Vec3 normal = normals_at(*meeting.surface, meeting.face, meeting.position, to_eye).shading;
    const float line = line_at(meeting, at) * (seen.alpha > 0 ? kFarLine : kNearLine);
    const Rgb& color = meeting.surface->color(meeting.face);
    const Rgba glass = lighting_.glazed(color, material.opacity, normal, to_eye);
    seen = over(seen, over({line_color(color) * line, line}, glass));
  }
  if (const auto mark = tracer_.shining_through(t, ray, column)) {
    const float share = static_cast<float>(mark->surface->material.through);
    seen = over(seen, {mark->surface->material.color * share, share});
  }
  return seen;
}

Visibility TileRenderer::visible_from(const Vec3& lifted, const Vec3& normal, double column, const Point2& at) {
  const Vec3 sky = lighting_.sky_direction(normal, at), sun = lighting_.sun_direction(at);
  Visibility visible;
  if (tracer_.blocked({lifted, lifted + kSkyReach * sky}, column)) visible.sky = 0;
  // Where the surface turns away from the sun, its shading says so.
  if (dot(normal, sun) > 0 && tracer_.blocked({lifted, lifted + kSunReach * sun}, column)) visible.sun = 0;
  return visible;
}

float TileRenderer::line_at(const Meeting& meeting, const Point2& at) const {
  const double width = meeting.surface->material.line_width;
  if (width == 0) return 0;
  const Body& body = *meeting.surface->body;
  const Triangle t = body.mesh.triangle(meeting.face);
  const Camera& camera = panel_.camera;
  const std::array corners{camera.project(t.a), camera.project(t.b), camera.project(t.c)};
  const double mean_side = body.mean_side / camera.pixel_size(meeting.t);
  // A few faces may be smaller than if all were.
  const double visible = line_visibility(mean_side, width) * line_visibility(2 * side_of(corners), width);
  return static_cast<float>(visible * line_coverage(corners, at, width));
}

/// Shadows on the ground end softly before the border of the panel.
float TileRenderer::ground_fade(int x, int y) const {
  constexpr double kBand = 0.15;  // of the panel's shorter side
  const Rectangle& place = panel_.place;
  const int to_border = std::min({x - place.left, place.right - 1 - x, y - place.top, place.bottom - 1 - y});
  const double shorter = std::min(place.right - place.left, place.bottom - place.top);
  return static_cast<float>(smooth_step(0, kBand * shorter, to_border));
}

Rgba TileRenderer::resolved(int x, int y) const {
  Rgba sum;
  const Sample* last = nullptr;
  Visibility visible;
  for (const Sample& sample : samples_of(x, y)) {
    if (sample.seen != Seen::Nothing && !(last && last->is_like(sample))) {
      visible = visibility_around(x, y, sample);
      last = &sample;
    }
    sum += over(sample.veil, shaded(sample, visible) * (sample.seen == Seen::Ground ? ground_fade(x, y) : 1));
  }
  return sum * (1 / static_cast<float>(pattern_.samples()));
}

Rgba TileRenderer::shaded(const Sample& sample, const Visibility& visible) const {
  if (sample.seen == Seen::Nothing) return {};
  if (sample.seen == Seen::Ground) return lighting_.ground_shadow(visible);
  return {lighting_.shaded(sample.color, sample.normal, sample.to_eye, visible), 1};
}

Visibility TileRenderer::visibility_around(int x, int y, const Sample& center) const {
  float sky = 0, sun = 0, weights = 0;
  for (int dy = -kReach; dy <= kReach; ++dy)
    for (int dx = -kReach; dx <= kReach; ++dx) {
      // The outermost rows, and columns, are one row of the block together.
      const float weight = (std::abs(dx) == kReach ? 0.5f : 1.f) * (std::abs(dy) == kReach ? 0.5f : 1.f);
      for (const Sample& sample : samples_of(x + dx, y + dy)) {
        if (!center.is_like(sample)) continue;
        sky += weight * sample.visible.sky, sun += weight * sample.visible.sun, weights += weight;
      }
    }
  return {sky / weights, sun / weights};
}

std::span<const TileRenderer::Sample> TileRenderer::samples_of(int x, int y) const {
  const std::size_t count = static_cast<std::size_t>(pattern_.samples());
  const int pixel = (y - traced_.top) * (traced_.right - traced_.left) + (x - traced_.left);
  return {samples_.data() + static_cast<std::size_t>(pixel) * count, count};
}

/// Whether what is seen from there also holds here.
bool TileRenderer::Sample::is_like(const Sample& other) const {
  constexpr double kLeastCosine = 0.8, kFarthest = 1.5 * kReach;  // pixels from the plane
  return seen == other.seen && dot(normal, other.normal) >= kLeastCosine &&
         std::abs(dot(other.position - position, normal)) <= kFarthest * pixel_size;
}

}  // namespace prohull::render

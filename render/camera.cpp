#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace prohull::render {
namespace {

Vec3 axis(int i) { return {i == 0 ? 1. : 0., i == 1 ? 1. : 0., i == 2 ? 1. : 0.}; }

/// The front of things, for someone who calls `up` up: y is seen from z, z from -y.
Vec3 front_of(int up) { return up == 0 ? -axis(2) : up == 1 ? axis(2) : -axis(1); }

/// Where an eye looking along the depth may be that sees all points between two lines of slope `slope` through it: in
/// the middle between the points, as near as possible.
class Wedge {
 public:
  explicit Wedge(double slope) : slope_(slope) {}
  void extend(double across, double depth) {
    right_ = std::max(right_, across - slope_ * depth);
    left_ = std::max(left_, -across - slope_ * depth);
  }
  double depth() const { return -(left_ + right_) / (2 * slope_); }
  double across() const { return (right_ - left_) / 2; }

 private:
  double slope_;
  double left_ = -std::numeric_limits<double>::infinity(), right_ = left_;
};

}  // namespace

ViewAxes::ViewAxes(const View& view) : vertical(axis(view.up)) {
  const Vec3 ahead = front_of(view.up), side = cross(vertical, ahead);
  front = std::cos(view.azimuth) * ahead + std::sin(view.azimuth) * side;
  right = cross(vertical, front);
  back = std::cos(view.elevation) * front + std::sin(view.elevation) * vertical;
  up = cross(back, right);
}

Camera::Camera(const View& view, std::span<const Vec3> points, int width, int height)
    : axes_(view), center_{0.5 * width, 0.5 * height} {
  constexpr double kMargin = 0.94;  // the part of the picture that is filled
  const double focal = 0.5 * std::min(width, height) / std::tan(0.5 * view.field_of_view);
  Wedge horizontal(kMargin * center_.x / focal), vertical(kMargin * center_.y / focal);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) {
    const double depth = -dot(p, axes_.back);
    horizontal.extend(dot(p, axes_.right), depth);
    vertical.extend(dot(p, axes_.up), depth);
    nearest = std::min(nearest, depth);
  }
  constexpr double kClearance = 0.01;  // of points that lie in a line with the eye, in scene sizes
  const double depth = std::min({horizontal.depth(), vertical.depth(), nearest - kClearance});
  eye_ = horizontal.across() * axes_.right + vertical.across() * axes_.up - depth * axes_.back;
  focal_ = focal * view.zoom;
  if (view.center) {
    // The picture is moved, not the eye: things keep their sides.
    const Point2 target = project(*view.center);
    center_ = {width - target.x, height - target.y};
  }
}

Ray Camera::ray(const Point2& pixel) const {
  return {eye_,
          ((pixel.x - center_.x) / focal_) * axes_.right + ((center_.y - pixel.y) / focal_) * axes_.up - axes_.back};
}

Point2 Camera::project(const Vec3& point) const {
  const Vec3 p = point - eye_;
  const double scale = focal_ / -dot(p, axes_.back);
  return {center_.x + scale * dot(p, axes_.right), center_.y - scale * dot(p, axes_.up)};
}

}  // namespace prohull::render

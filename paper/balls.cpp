#include "paper/balls.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace prohull {
namespace {

constexpr double kSingle = 0x1p-24;  // relative error of rounding to float

// Restrict, so that the loops below are vectorised.
using Floats = const float* __restrict;

struct FloatLine {
  float x, y, z;     // of a point
  float ux, uy, uz;  // direction, of length 1 within 2^-22
  float widening;    // of the balls
};

// Of m = ball - point, m cross u is compared with the radius. As m has a relative error of kSingle, each product
// another, and so has the difference, the vector m cross u is off by at most 4.4 kSingle |m| |u|, for which
// widening stands; its square is off by 3 kSingle of itself, |u| by 2 kSingle, and radius + widening and its square by
// as much again: together less than 2^-19 of the square.
void mark_near(const FloatLine& line, Floats x, Floats y, Floats z, Floats radius, std::size_t count,
               std::uint8_t* __restrict may_meet) {
  constexpr float kSlack = 1 + 0x1p-19f;
  for (std::size_t i = 0; i < count; ++i) {
    const float mx = x[i] - line.x, my = y[i] - line.y, mz = z[i] - line.z;
    const float cx = my * line.uz - mz * line.uy, cy = mz * line.ux - mx * line.uz, cz = mx * line.uy - my * line.ux;
    const float reach = radius[i] + line.widening;
    may_meet[i] = !(cx * cx + cy * cy + cz * cz > reach * reach * kSlack);
  }
}

struct BallBox {
  float min_x, min_y, min_z, max_x, max_y, max_z;
};

void mark_overlapping(const BallBox& box, Floats x, Floats y, Floats z, Floats radius, std::size_t count,
                      std::uint8_t* __restrict may_meet) {
  for (std::size_t i = 0; i < count; ++i) {
    const float r = radius[i];
    may_meet[i] = !((x[i] + r < box.min_x) | (x[i] - r > box.max_x) | (y[i] + r < box.min_y) | (y[i] - r > box.max_y) |
                    (z[i] + r < box.min_z) | (z[i] - r > box.max_z));
  }
}

double distance_from_line(const Vec3& p, const Vec3& point, const Vec3& direction) {
  return norm(cross(p - point, direction)) / norm(direction);
}

Vec3 rounded(const Vec3& p) { return {double(float(p.x)), double(float(p.y)), double(float(p.z))}; }

}  // namespace

Balls::Balls(const Box& frame) : center_(frame.is_empty() ? Vec3{} : frame.center()) {
  const Vec3 above = frame.max - center_, below = center_ - frame.min;
  const double largest = std::max(line_filter::largest_entry(above), line_filter::largest_entry(below));
  int exponent = 0;
  std::frexp(largest, &exponent);
  scale_ = std::abs(exponent) < 500 ? std::ldexp(1.0, -exponent) : std::numeric_limits<double>::quiet_NaN();
}

void Balls::add(std::span<const Vec3> points) {
  Box box;
  for (const Vec3& p : points) box.extend(p);
  const Vec3 center = rounded(in_frame(box.center()));
  double radius = 0;
  for (const Vec3& p : points) radius = std::max(radius, norm(in_frame(p) - center));
  x_.push_back(static_cast<float>(center.x));
  y_.push_back(static_cast<float>(center.y));
  z_.push_back(static_cast<float>(center.z));
  radius_.push_back(static_cast<float>(radius * (1 + 4 * kSingle) + 0x1p-40));
}

void Balls::mark(const DirectedLine& line, std::span<std::uint8_t> may_meet) const {
  const Vec3 start = in_frame(line.origin);
  const Vec3 along =
      line.is_ray() ? line.direction / line_filter::largest_entry(line.direction) : in_frame(line.end) - start;
  const Vec3 direction = along / norm(along);
  // A ray is of interest as far as the frame, which ends less than 2 from its centre.
  const Vec3 end = line.is_ray() ? start + (norm(start) + 4) * direction : in_frame(line.end);
  const Vec3 u = rounded(direction), point = rounded(start - dot(start, direction) * direction);
  // Whatever was rounded so far, the line between start and end is no farther from the one tested than these are.
  const double spread = norm(start) + norm(end) + norm(point) + 1;
  const double off =
      std::max(distance_from_line(start, point, u), distance_from_line(end, point, u)) + 0x1p-48 * spread;
  const double widening = off + 5 * kSingle * (norm(point) + 2);
  if (!(widening < 1)) {
    std::ranges::fill(may_meet, std::uint8_t{1});
    return;
  }
  const FloatLine single{static_cast<float>(point.x),
                         static_cast<float>(point.y),
                         static_cast<float>(point.z),
                         static_cast<float>(u.x),
                         static_cast<float>(u.y),
                         static_cast<float>(u.z),
                         static_cast<float>(widening * (1 + 4 * kSingle))};
  mark_near(single, x_.data(), y_.data(), z_.data(), radius_.data(), radius_.size(), may_meet.data());
}

void Balls::mark(const Box& box, std::span<std::uint8_t> may_meet) const {
  if (std::isnan(scale_)) {
    std::ranges::fill(may_meet, std::uint8_t{1});
    return;
  }
  // Clamped, for nothing is so far out; 2^-20 is more than what rounding to float does to sums below 8.
  const auto lower = [](double x) { return static_cast<float>(std::clamp(x, -4.0, 4.0) - 0x1p-20); };
  const auto upper = [](double x) { return static_cast<float>(std::clamp(x, -4.0, 4.0) + 0x1p-20); };
  const Vec3 min = in_frame(box.min), max = in_frame(box.max);
  const BallBox single{lower(min.x), lower(min.y), lower(min.z), upper(max.x), upper(max.y), upper(max.z)};
  mark_overlapping(single, x_.data(), y_.data(), z_.data(), radius_.data(), size(), may_meet.data());
}

}  // namespace prohull

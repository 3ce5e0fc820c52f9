#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "sample/generators.h"
#include "sample/marching_tetrahedra.h"

namespace prohull {
namespace {

/// The smaller of both, rounded off where they differ by less than `width`; no steeper than they are.
double smooth_min(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0);
  return std::min(a, b) - h * h / (4 * width);
}
double smooth_max(double a, double b, double width) { return -smooth_min(-a, -b, width); }

double gyroid_ball(const Vec3& p) {
  constexpr double kFrequency = 5.9, kHalfWall = 0.8, kRounding = 0.06, kRadius = 1;
  constexpr double kSteepest = kFrequency * std::numbers::sqrt3;  // each partial derivative is at most 1
  const Vec3 q = kFrequency * p;
  const double gyroid = std::sin(q.x) * std::cos(q.y) + std::sin(q.y) * std::cos(q.z) + std::sin(q.z) * std::cos(q.x);
  const double walls = (std::abs(gyroid) - kHalfWall) / kSteepest;
  return smooth_max(walls, norm(p) - kRadius, kRounding);
}

/// The convex hull of two balls.
class Limb {
 public:
  Limb(const Vec3& a, double a_radius, const Vec3& b, double b_radius)
      : a_(a),
        b_(b),
        a_radius_(a_radius),
        b_radius_(b_radius),
        length_(norm(b - a)),
        axis_((b - a) / length_),
        sine_((a_radius - b_radius) / length_),
        cosine_(std::sqrt(1 - sine_ * sine_)) {}

  double distance_to(const Vec3& p) const {
    // In the plane through the axis and p: x away from the axis, y along it from a.
    const double y = dot(p - a_, axis_), x = std::sqrt(std::max(squared_norm(p - a_) - y * y, 0.0));
    const double foot = y * cosine_ - x * sine_;  // of the cone's normal through p, on the axis
    if (foot <= 0) return norm(p - a_) - a_radius_;
    if (foot >= length_ * cosine_) return norm(p - b_) - b_radius_;
    return x * cosine_ + y * sine_ - a_radius_;
  }

 private:
  Vec3 a_, b_;
  double a_radius_, b_radius_, length_;
  Vec3 axis_;
  double sine_, cosine_;
};

// x ahead, y to the left, z up.
const std::array kTrunk{
    Limb({-0.42, 0, 0.10}, 0.30, {0.05, 0, 0.06}, 0.265),  // hindquarters
    Limb({0.05, 0, 0.06}, 0.265, {0.42, 0, 0.10}, 0.28),   // chest
    Limb({0.48, 0, 0.20}, 0.22, {0.78, 0, 0.72}, 0.13),    // neck
    Limb({0.80, 0, 0.74}, 0.14, {1.12, 0, 0.50}, 0.085),   // head
    Limb({-0.62, 0, 0.26}, 0.08, {-0.90, 0, 0.20}, 0.085),
    Limb({-0.90, 0, 0.20}, 0.085, {-1.02, 0, -0.36}, 0.06),  // tail
};
const std::array kLeftLimbs{
    Limb({0.76, 0.07, 0.82}, 0.065, {0.77, 0.11, 0.97}, 0.04),   // ear
    Limb({0.40, 0.16, 0.00}, 0.14, {0.44, 0.18, -0.38}, 0.078),  // fore leg
    Limb({0.44, 0.18, -0.38}, 0.078, {0.42, 0.18, -0.78}, 0.062),
    Limb({0.42, 0.18, -0.80}, 0.065, {0.455, 0.18, -0.90}, 0.085),
    Limb({-0.48, 0.18, 0.05}, 0.18, {-0.46, 0.19, -0.34}, 0.09),  // hind leg
    Limb({-0.46, 0.19, -0.34}, 0.09, {-0.60, 0.19, -0.50}, 0.072),
    Limb({-0.60, 0.19, -0.50}, 0.072, {-0.56, 0.19, -0.80}, 0.062),
    Limb({-0.56, 0.19, -0.80}, 0.065, {-0.525, 0.19, -0.90}, 0.085),
};

double pony(const Vec3& p) {
  constexpr double kRounding = 0.07, kFar = std::numeric_limits<double>::infinity();
  double trunk = kFar, left = kFar, right = kFar;
  for (const Limb& limb : kTrunk) trunk = smooth_min(trunk, limb.distance_to(p), kRounding);
  for (const Limb& limb : kLeftLimbs) {
    left = smooth_min(left, limb.distance_to(p), kRounding);
    right = smooth_min(right, limb.distance_to({p.x, -p.y, p.z}), kRounding);
  }
  return smooth_min(trunk, smooth_min(left, right, kRounding), kRounding);
}

/// The solid's surface has the given area; with a larger spacing than `coarsest` it would lose limbs or close holes.
TriangleMesh mesh_of(const DistanceBound& solid, double extent, double area, double coarsest, std::size_t faces) {
  return surface_of(solid, extent, std::min(coarsest, std::sqrt(13 * area / double(faces))));
}

}  // namespace

TriangleMesh make_gyroid(std::size_t faces) { return mesh_of(gyroid_ball, 1, 25.6, 0.12, faces); }

TriangleMesh make_pony(std::size_t faces) { return mesh_of(pony, 1.6, 5.5, 0.12, faces); }

}  // namespace prohull

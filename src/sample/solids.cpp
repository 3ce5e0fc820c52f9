#include <algorithm>
#include <array>
#include <cmath>

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
  constexpr double kFrequency = 4.5, kHalfWall = 0.55, kRounding = 0.08, kRadius = 1;
  constexpr double kSteepest = kFrequency * 1.7320508075688772;  // sqrt(3): each partial derivative is at most 1
  const Vec3 q = kFrequency * p;
  const double gyroid = std::sin(q.x) * std::cos(q.y) + std::sin(q.y) * std::cos(q.z) + std::sin(q.z) * std::cos(q.x);
  const double walls = (std::abs(gyroid) - kHalfWall) / kSteepest;
  return smooth_max(walls, norm(p) - kRadius, kRounding);
}

/// The convex hull of two balls.
struct Limb {
  Vec3 a;
  double a_radius;
  Vec3 b;
  double b_radius;
};

double distance_to(const Limb& limb, const Vec3& p) {
  // In the plane through the axis and p: x away from the axis, y along it from a.
  const Vec3 axis = limb.b - limb.a;
  const double length = norm(axis), sine = (limb.a_radius - limb.b_radius) / length;
  const double y = dot(p - limb.a, axis) / length;
  const double x = std::sqrt(std::max(squared_norm(p - limb.a) - y * y, 0.0)), cosine = std::sqrt(1 - sine * sine);
  const double foot = y - x * sine / cosine;  // of the cone's normal through p, on the axis
  if (foot <= 0) return norm(p - limb.a) - limb.a_radius;
  if (foot >= length) return norm(p - limb.b) - limb.b_radius;
  return x * cosine + y * sine - limb.a_radius;
}

/// x ahead, y to its left, z up.
constexpr std::array kMiddle{
    Limb{{-0.42, 0, 0.10}, 0.30, {0.05, 0, 0.06}, 0.265},   // hindquarters, belly
    Limb{{0.05, 0, 0.06}, 0.265, {0.42, 0, 0.10}, 0.28},    // belly, chest
    Limb{{0.50, 0, 0.18}, 0.22, {0.80, 0, 0.70}, 0.125},    // neck
    Limb{{0.80, 0, 0.74}, 0.135, {1.12, 0, 0.50}, 0.075},   // head
    Limb{{-0.66, 0, 0.24}, 0.06, {-0.86, 0, 0.10}, 0.075},  // tail
    Limb{{-0.86, 0, 0.10}, 0.075, {-0.92, 0, -0.40}, 0.03},
};
constexpr std::array kLeft{
    Limb{{0.77, 0.07, 0.84}, 0.045, {0.76, 0.10, 0.98}, 0.015},  // ear
    Limb{{0.40, 0.15, 0.00}, 0.15, {0.44, 0.17, -0.38}, 0.072},  // fore leg
    Limb{{0.44, 0.17, -0.38}, 0.072, {0.42, 0.17, -0.78}, 0.052},
    Limb{{0.42, 0.17, -0.80}, 0.058, {0.455, 0.17, -0.90}, 0.082},  // hoof
    Limb{{-0.48, 0.16, 0.05}, 0.20, {-0.46, 0.18, -0.34}, 0.085},   // hind leg
    Limb{{-0.46, 0.18, -0.34}, 0.085, {-0.60, 0.18, -0.50}, 0.065},
    Limb{{-0.60, 0.18, -0.50}, 0.065, {-0.56, 0.18, -0.80}, 0.054},
    Limb{{-0.56, 0.18, -0.80}, 0.058, {-0.525, 0.18, -0.90}, 0.082},
};

double pony(const Vec3& p) {
  constexpr double kRounding = 0.07;
  const Vec3 left{p.x, std::abs(p.y), p.z};
  double body = distance_to(kMiddle[0], p);
  for (std::size_t i = 1; i < kMiddle.size(); ++i) body = smooth_min(body, distance_to(kMiddle[i], p), kRounding);
  for (const Limb& limb : kLeft) body = smooth_min(body, distance_to(limb, left), kRounding);
  return body;
}

/// `faces_per` is faces times spacing squared; above the largest spacing the shape would lose or close holes.
TriangleMesh mesh_of(const DistanceBound& solid, double extent, std::size_t faces, double faces_per, double largest) {
  return surface_of(solid, extent, std::min(largest, std::sqrt(faces_per / double(faces))));
}

}  // namespace

TriangleMesh make_gyroid(std::size_t faces) { return mesh_of(gyroid_ball, 1, faces, 450, 0.1); }

TriangleMesh make_pony(std::size_t faces) { return mesh_of(pony, 1.6, faces, 80, 0.1); }

}  // namespace prohull

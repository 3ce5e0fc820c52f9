#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sample/generators.h"
#include "sample/geodesic_sphere.h"
#include "sample/noise.h"

namespace prohull {
namespace {

struct Crater {
  Vec3 center;    // on the unit sphere
  double radius;  // as a chord
};

constexpr std::uint64_t kAsteroidSeed = 433;  // Eros
constexpr int kCraters = 40;

std::array<Crater, kCraters> asteroid_craters() {
  std::array<Crater, kCraters> craters;
  for (int i = 0; i < kCraters; ++i) {
    const std::uint64_t seed = scramble(kAsteroidSeed) + std::uint64_t(3 * i);
    const double angle = 2 * std::numbers::pi * unit_random(seed), z = 2 * unit_random(seed + 1) - 1;
    const double ring = std::sqrt(1 - z * z);
    // Many small ones, few big ones.
    const double radius = std::min(0.55, 0.12 / std::sqrt(unit_random(seed + 2) + 0.02));
    craters[std::size_t(i)] = {{ring * std::cos(angle), ring * std::sin(angle), z}, radius};
  }
  return craters;
}

/// A bowl with a raised rim; zero and flat from 1.6 radii on.
double crater_height(double distance) {
  constexpr double kEnd = 1.6, kRim = 0.12;
  if (distance >= kEnd) return 0;
  const double bowl = distance * distance - 1;
  const double fall = (kEnd - distance) / (kEnd - 1);
  return distance < 1 ? 0.35 * bowl + kRim : kRim * fall * fall;
}

/// Its distance from the centre in direction u.
double asteroid_radius(const Vec3& u, const std::array<Crater, kCraters>& craters) {
  double height = 1;
  double amplitude = 0.32, frequency = 1.1;
  for (std::uint64_t octave = 0; octave < 8; ++octave) {
    height += amplitude * gradient_noise(u * frequency, kAsteroidSeed + octave);
    amplitude *= 0.4, frequency *= 2.1;
  }
  for (const Crater& c : craters) height += 1.1 * c.radius * crater_height(norm(u - c.center) / c.radius);
  return std::max(height, 0.3);
}

}  // namespace

TriangleMesh make_sphere(std::size_t faces) { return geodesic_sphere(faces); }

/// Star-shaped about its centre as every displacement is radial, hence free of self-intersection.
TriangleMesh make_asteroid(std::size_t faces) {
  TriangleMesh mesh = geodesic_sphere(faces);
  const auto craters = asteroid_craters();
  for (Vec3& p : mesh.positions) {
    const Vec3 rock = p * asteroid_radius(p, craters);
    p = {1.3 * rock.x, rock.y, 0.85 * rock.z};
  }
  return mesh;
}

}  // namespace prohull

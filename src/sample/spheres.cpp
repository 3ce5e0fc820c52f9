#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "prohull/detail/scramble.h"
#include "sample/generators.h"

namespace prohull {
namespace {

//  N         Panel p, unrolled: n x 2n quads between the poles N and S. U is the upper ring of the base polyhedron,
//  | \       L the lower one. A panel owns its vertices with i < n and j > 0; the others are the next panel's, the
//  U---U'    poles nobody's:
//  | \ | \       (i, 0)                  is N for i = 0, else  (0, i)      of panel p + 1
//  L'--L--   (n, j), j <= n          is  (0, n + j)  of panel p + 1
//    \ |     (n, j), n < j < 2n      is  (j - n, 2n) of panel p + 1
//      S     (n, 2n)                 is S
class GeodesicGrid {
 public:
  GeodesicGrid(std::uint32_t panels, std::uint32_t frequency) : panels_(panels), n_(frequency) {}

  TriangleMesh sphere() const {
    TriangleMesh mesh;
    mesh.positions.reserve(2 + std::size_t(2) * panels_ * n_ * n_);
    mesh.triangles.reserve(std::size_t(4) * panels_ * n_ * n_);
    mesh.positions.push_back(pole(1));
    mesh.positions.push_back(pole(-1));
    for (std::uint32_t p = 0; p < panels_; ++p)
      for (std::uint32_t j = 1; j <= 2 * n_; ++j)
        for (std::uint32_t i = 0; i < n_; ++i) {
          const Vec3 flat = position(p, i, j);
          mesh.positions.push_back(flat / norm(flat));
        }
    for (std::uint32_t p = 0; p < panels_; ++p)
      for (std::uint32_t j = 0; j < 2 * n_; ++j)
        for (std::uint32_t i = 0; i < n_; ++i) {
          const VertexId right = vertex(p, i + 1, j), left = vertex(p, i, j + 1);
          mesh.triangles.push_back({vertex(p, i, j), left, right});
          mesh.triangles.push_back({right, left, vertex(p, i + 1, j + 1)});
        }
    return mesh;
  }

 private:
  VertexId vertex(std::uint32_t p, std::uint32_t i, std::uint32_t j) const {
    if (j == 0) return i == 0 ? VertexId(0) : vertex(p + 1, 0, i);
    if (i == n_ && j == 2 * n_) return VertexId(1);
    if (i == n_) return j <= n_ ? vertex(p + 1, 0, n_ + j) : vertex(p + 1, j - n_, 2 * n_);
    return VertexId(2 + ((p % panels_) * 2 * n_ + j - 1) * n_ + i);
  }

  /// On the flat base polyhedron; for the vertices that panel p owns.
  Vec3 position(std::uint32_t p, std::uint32_t i, std::uint32_t j) const {
    const bool upper = j <= n_;
    const Vec3 top = upper ? pole(1) : ring(p, 0, 1), right = upper ? ring(p, 1, 1) : ring(p, 0.5, -1);
    const Vec3 left = upper ? ring(p, 0, 1) : ring(p, -0.5, -1), bottom = upper ? ring(p, 0.5, -1) : pole(-1);
    const double u = double(i) / n_, v = double(upper ? j : j - n_) / n_;
    return u + v <= 1 ? top * (1 - u - v) + right * u + left * v
                      : bottom * (u + v - 1) + left * (1 - u) + right * (1 - v);
  }

  static Vec3 pole(double side) { return {0, 0, side}; }
  /// Where the icosahedron has it.
  Vec3 ring(std::uint32_t p, double shift, double side) const {
    const double angle = 2 * std::numbers::pi * (p + shift) / panels_, radius = 2 / std::sqrt(5.0);
    return {radius * std::cos(angle), radius * std::sin(angle), side / std::sqrt(5.0)};
  }

  std::uint32_t panels_, n_;
};

/// The unit sphere as a subdivided icosahedron of 20 n^2 faces. So that few faces can be had in fine steps too, the
/// icosahedron's five panels may be any number from three to ten.
TriangleMesh geodesic_sphere(std::size_t faces) {
  const double frequency = std::max(1.0, std::round(std::sqrt(double(faces) / 20)));
  const double panels = std::clamp(std::round(double(faces) / (4 * frequency * frequency)), 3.0, 10.0);
  return GeodesicGrid(std::uint32_t(panels), std::uint32_t(frequency)).sphere();
}

/// The scalar product of d with one of the twelve directions to the edges of a cube.
double gradient_along(std::uint64_t hash, const Vec3& d) {
  const int axis = int((hash >> 32) % 3);
  const double a = d[(axis + 1) % 3], b = d[(axis + 2) % 3];
  return ((hash & 1) ? a : -a) + ((hash & 2) ? b : -b);
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// Perlin's gradient noise: smooth, about in [-1, 1], features of size 1.
double gradient_noise(const Vec3& p, std::uint64_t seed) {
  const Vec3 cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const Vec3 d = p - cell;
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 offset{double(corner & 1), double(corner >> 1 & 1), double(corner >> 2)};
    const Vec3 q = cell + offset, to = d - offset;
    std::uint64_t hash = seed;
    for (int axis = 0; axis < 3; ++axis) hash = scramble(hash ^ std::uint64_t(std::int64_t(q[axis])));
    const double weight = fade(1 - std::abs(to.x)) * fade(1 - std::abs(to.y)) * fade(1 - std::abs(to.z));
    sum += weight * gradient_along(hash, to);
  }
  return sum;
}

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

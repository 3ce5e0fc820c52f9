#include "sample/geodesic_sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

}  // namespace

TriangleMesh geodesic_sphere(std::size_t faces) {
  const double frequency = std::max(1.0, std::round(std::sqrt(double(faces) / 20)));
  const double panels = std::clamp(std::round(double(faces) / (4 * frequency * frequency)), 3.0, 10.0);
  return GeodesicGrid(std::uint32_t(panels), std::uint32_t(frequency)).sphere();
}

}  // namespace prohull

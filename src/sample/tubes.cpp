#include <algorithm>
#include <cmath>
#include <numbers>

#include "sample/add_quad.h"
#include "sample/generators.h"

namespace prohull {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// Across a curve: `first` x `second` points back along it.
struct Section {
  Vec3 center, first, second;
};

/// A tube around a closed curve, section_at(u) with u in [0, 1), of the given length: a grid closed in both directions.
template <class SectionAt>
TriangleMesh tube(std::size_t faces, double length, double radius, std::uint32_t fewest_sections,
                  SectionAt section_at) {
  const double quads = double(faces) / 2;
  const auto sides = std::uint32_t(std::max(3.0, std::round(std::sqrt(quads * kTurn * radius / length))));
  const auto sections = std::max(fewest_sections, std::uint32_t(std::round(quads / sides)));

  TriangleMesh mesh;
  mesh.positions.reserve(std::size_t(sections) * sides);
  mesh.triangles.reserve(std::size_t(sections) * sides * 2);
  for (std::uint32_t s = 0; s < sections; ++s) {
    const Section section = section_at(double(s) / sections);
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double angle = kTurn * k / sides;
      mesh.positions.push_back(section.center +
                               radius * (std::cos(angle) * section.first + std::sin(angle) * section.second));
    }
  }
  const auto vertex = [&](std::uint32_t s, std::uint32_t k) { return VertexId(s % sections * sides + k % sides); };
  for (std::uint32_t s = 0; s < sections; ++s)
    for (std::uint32_t k = 0; k < sides; ++k)
      add_quad(mesh, vertex(s, k), vertex(s + 1, k), vertex(s + 1, k + 1), vertex(s, k + 1));
  return mesh;
}

}  // namespace

TriangleMesh make_torus(std::size_t faces) {
  return tube(faces, kTurn, 0.35, 3, [](double u) -> Section {
    const Vec3 outwards{std::cos(kTurn * u), std::sin(kTurn * u), 0};
    return {outwards, outwards, {0, 0, 1}};
  });
}

/// On a torus, twice around it and three times through its hole; that torus' normal is the first axis of each section.
TriangleMesh make_knot(std::size_t faces) {
  constexpr double kSmall = 0.45, kRadius = 0.25, kLength = 15.34;
  return tube(faces, kLength, kRadius, 24, [](double u) -> Section {
    const double around = 2 * kTurn * u, through = 3 * kTurn * u;
    const Vec3 outwards{std::cos(around), std::sin(around), 0}, along{-outwards.y, outwards.x, 0};
    const Vec3 normal = std::cos(through) * outwards + std::sin(through) * Vec3{0, 0, 1};
    const Vec3 across = std::cos(through) * Vec3{0, 0, 1} - std::sin(through) * outwards;
    const double out = 1 + kSmall * std::cos(through);
    const Vec3 tangent = 2 * out * along + 3 * kSmall * across;
    return {outwards * out + Vec3{0, 0, kSmall * std::sin(through)}, normal, cross(normal, tangent / norm(tangent))};
  });
}

}  // namespace prohull

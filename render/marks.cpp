#include "render/marks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prohull/sample.h"
#include "render/normals.h"

namespace prohull::render {

TriangleMesh rod(const Segment& segment, double radius) {
  constexpr std::uint32_t kSides = 24;
  const Vec3 along = segment.b - segment.a;
  if (along == Vec3{}) return {};
  const auto [first, second] = tangents(along / norm(along));
  TriangleMesh mesh;
  for (std::uint32_t k = 0; k < kSides; ++k) {
    const double angle = 2 * std::numbers::pi * k / kSides;
    const Vec3 out = radius * (std::cos(angle) * first + std::sin(angle) * second);
    mesh.positions.push_back(segment.a + out);
    mesh.positions.push_back(segment.b + out);
  }
  const VertexId a = mesh.positions.push_back(segment.a), b = mesh.positions.push_back(segment.b);
  for (std::uint32_t k = 0; k < kSides; ++k) {
    const std::uint32_t next = (k + 1) % kSides;
    const VertexId a0{2 * k}, b0{2 * k + 1}, a1{2 * next}, b1{2 * next + 1};
    for (const auto& triangle : {std::array{a0, a1, b1}, {a0, b1, b0}, {a, a1, a0}, {b, b0, b1}})
      mesh.triangles.push_back(triangle);
  }
  return mesh;
}

TriangleMesh dashes(const Segment& segment, double radius, double period) {
  const Vec3 along = segment.b - segment.a;
  const int count = std::max(1, static_cast<int>(std::lround(norm(along) / period)));
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i)
    append(mesh, rod({segment.a + (i + 0.25) / count * along, segment.a + (i + 0.75) / count * along}, radius));
  return mesh;
}

TriangleMesh ball(const Vec3& center, double radius) {
  const Ball ball{center, radius};
  return spheres({&ball, 1});
}

TriangleMesh spheres(std::span<const Ball> balls) {
  constexpr std::size_t kFaces = 2000, kFewestFaces = 80, kAllFaces = 1'000'000;
  TriangleMesh mesh;
  if (balls.empty()) return mesh;
  const TriangleMesh unit = make_sample("sphere", std::clamp(kAllFaces / balls.size(), kFewestFaces, kFaces));
  for (const Ball& ball : balls) {
    TriangleMesh sphere = unit;
    for (Vec3& p : sphere.positions) p = ball.center + ball.radius / norm(p) * p;
    append(mesh, sphere);
  }
  return mesh;
}

}  // namespace prohull::render

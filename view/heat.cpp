#include "view/heat.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace prohull::view {
namespace {

constexpr std::size_t kPoints = 200'000;
constexpr double kMostParts = 64;  // of an edge

double longest_edge(const Triangle& t) { return std::max({norm(t.b - t.a), norm(t.c - t.b), norm(t.a - t.c)}); }

std::size_t points_of(std::size_t parts) { return (parts + 1) * (parts + 2) / 2; }

/// Into how many parts the edges of each face are cut, where a part is no longer than `length`.
std::vector<std::uint32_t> parts_of_faces(const TriangleMesh& mesh, double length) {
  std::vector<std::uint32_t> parts;
  for (const FaceId f : mesh.triangles.ids()) {
    const double wanted = std::ceil(longest_edge(mesh.triangle(f)) / length);  // NaN where both are 0 or overflow
    parts.push_back(wanted > 1 ? static_cast<std::uint32_t>(std::min(wanted, kMostParts)) : 1);
  }
  return parts;
}

std::size_t points_in(const std::vector<std::uint32_t>& parts) {
  std::size_t points = 0;
  for (const std::uint32_t n : parts) points += points_of(n);
  return points;
}

std::vector<std::uint32_t> enough_parts(const TriangleMesh& mesh) {
  double length = bounding_box(mesh).diagonal() / 200;
  std::vector<std::uint32_t> parts = parts_of_faces(mesh, length);
  while (points_in(parts) > kPoints && std::ranges::max(parts) > 1) parts = parts_of_faces(mesh, length *= 1.25);
  return parts;
}

/// Row by row, from the edge a-b to c.
std::vector<Vec3> points_on(const TriangleMesh& mesh, const std::vector<std::uint32_t>& parts) {
  std::vector<Vec3> points;
  points.reserve(points_in(parts));
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    const std::uint32_t n = parts[index(f)];
    for (std::uint32_t row = 0; row <= n; ++row)
      for (std::uint32_t i = 0; i + row <= n; ++i) points.push_back((t.a * (n - row - i) + t.b * i + t.c * row) / n);
  }
  return points;
}

std::vector<double> distances_of(const std::vector<Vec3>& points, const QueryIndex& original, bool outside_only,
                                 const BatchOptions& batch) {
  std::vector<double> distances;
  distances.reserve(points.size());
  if (outside_only)
    for (const ClosestPoint& closest : signed_distances(original, points, batch))
      distances.push_back(std::max(closest.distance, 0.0));
  else
    for (const auto& closest : closest_points(original, points, std::numeric_limits<double>::infinity(), batch))
      distances.push_back(closest->distance);  // the original has faces
  return distances;
}

}  // namespace

std::uint32_t scaled(double distance, double greatest) {
  if (!(greatest > 0 && std::isfinite(greatest))) return 0;
  return static_cast<std::uint32_t>(std::lround(distance / greatest * 65535));
}

nlohmann::json heat_facts(const TriangleMesh& mesh, const QueryIndex& original, bool outside_only,
                          const BatchOptions& batch, Blocks& blocks) {
  const std::vector<std::uint32_t> parts = enough_parts(mesh);
  const std::vector<double> distances = distances_of(points_on(mesh, parts), original, outside_only, batch);
  const double greatest = std::ranges::max(distances);
  std::vector<std::uint32_t> values;
  for (const double distance : distances) values.push_back(scaled(distance, greatest));
  return {{"parts", blocks.plain(parts)}, {"values", blocks.running(values, 1)}, {"max", greatest}};
}

}  // namespace prohull::view

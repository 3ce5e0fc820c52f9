#pragma once

#include <random>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// Segments that meet features: from, to, through and along the mesh's corners, edges and faces, and at random.
inline std::vector<Segment> awkward_segments(const TriangleMesh& mesh, std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  const Box around = bounding_box(mesh);
  const auto any_point = [&] {
    std::uniform_real_distribution<double> unit(-0.5, 1.5);
    return Vec3{around.min.x + unit(random) * (around.max.x - around.min.x),
                around.min.y + unit(random) * (around.max.y - around.min.y),
                around.min.z + unit(random) * (around.max.z - around.min.z)};
  };
  const auto any_triangle = [&] {
    return mesh.triangle(FaceId(
        std::uniform_int_distribution<std::uint32_t>(0, static_cast<std::uint32_t>(mesh.face_count()) - 1)(random)));
  };
  std::vector<Segment> segments;
  while (segments.size() < count) {
    const Triangle s = any_triangle(), t = any_triangle();
    const Vec3 p = any_point();
    segments.push_back({p, any_point()});
    segments.push_back({p, s.a});                        // ends at a corner
    segments.push_back({s.a, t.b});                      // from corner to corner
    segments.push_back({p, 2 * s.a - p});                // through a corner, as nearly as doubles can
    segments.push_back({2 * s.a - s.b, 2 * s.b - s.a});  // along an edge
    segments.push_back({p, (s.a + s.b) * 0.5});          // to an edge
    segments.push_back({s.a, (s.b + s.c) * 0.5});        // within a face
    segments.push_back({{p.x, s.a.y, s.a.z}, {around.min.x, s.a.y, s.a.z}});  // axis-parallel, through a corner
    segments.push_back({s.a, s.a});                                           // a point
  }
  segments.resize(count);
  return segments;
}

inline std::vector<Ray> rays_along(const std::vector<Segment>& segments) {
  std::vector<Ray> rays;
  for (const Segment& s : segments) rays.push_back({s.a, s.b - s.a});
  return rays;
}

}  // namespace prohull

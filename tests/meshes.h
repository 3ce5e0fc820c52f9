#pragma once

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull::meshes {

inline TriangleMesh make(std::vector<Vec3> positions, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  TriangleMesh mesh;
  mesh.positions = PerVertex<Vec3>(std::move(positions));
  for (const auto& [a, b, c] : triangles) mesh.triangles.push_back({VertexId(a), VertexId(b), VertexId(c)});
  return mesh;
}

/// Turned outwards if a, b, c are counter-clockwise seen from the far side of d.
inline TriangleMesh tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return make({a, b, c, d}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

inline TriangleMesh tetrahedron() { return tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}); }

inline TriangleMesh octahedron() {
  return make({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
              {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

inline TriangleMesh box(const Vec3& min, const Vec3& max) {
  const auto x = [&](int i) { return i ? max : min; };
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({x(i & 1).x, x(i >> 1 & 1).y, x(i >> 2).z});
  return make(corners, {{0, 2, 3},
                        {0, 3, 1},
                        {4, 5, 7},
                        {4, 7, 6},
                        {0, 1, 5},
                        {0, 5, 4},
                        {2, 6, 7},
                        {2, 7, 3},
                        {0, 4, 6},
                        {0, 6, 2},
                        {1, 3, 7},
                        {1, 7, 5}});
}

/// Every triangle in four, at the middles of its edges.
inline TriangleMesh subdivided(const TriangleMesh& mesh) {
  TriangleMesh result;
  result.positions = mesh.positions;
  std::map<std::pair<VertexId, VertexId>, VertexId> middles;
  const auto middle = [&](VertexId v, VertexId w) {
    const auto [entry, is_new] = middles.try_emplace(std::minmax(v, w));
    if (is_new) entry->second = result.positions.push_back((mesh.positions[v] + mesh.positions[w]) * 0.5);
    return entry->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const VertexId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& t : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) result.triangles.push_back(t);
  }
  return result;
}

/// 8 * 4^levels faces, vertices on the unit sphere.
inline TriangleMesh sphere(int levels) {
  TriangleMesh mesh = octahedron();
  for (int i = 0; i < levels; ++i) {
    mesh = subdivided(mesh);
    for (Vec3& p : mesh.positions) p = p / norm(p);
  }
  return mesh;
}

/// 2 * rings * sides faces; radii 1 and 0.4.
inline TriangleMesh torus(std::uint32_t rings, std::uint32_t sides) {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const double turn = 2 * std::numbers::pi;
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j < sides; ++j) {
      const double u = turn * i / rings, v = turn * j / sides, r = 1 + 0.4 * std::cos(v);
      positions.push_back({r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)});
      const std::uint32_t next = (i + 1) % rings, up = (j + 1) % sides;
      triangles.push_back({i * sides + j, next * sides + j, next * sides + up});
      triangles.push_back({i * sides + j, next * sides + up, i * sides + up});
    }
  return make(positions, triangles);
}

/// Two tips, each with as many faces as the rim has vertices.
inline TriangleMesh bipyramid(std::uint32_t rim) {
  std::vector<Vec3> positions{{0, 0, -0.5}, {0, 0, 0.5}};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < rim; ++i) {
    const double angle = 2 * std::numbers::pi * i / rim;
    positions.push_back({std::cos(angle), std::sin(angle), 0});
    const std::uint32_t a = 2 + i, b = 2 + (i + 1) % rim;
    triangles.push_back({0, b, a});
    triangles.push_back({1, a, b});
  }
  return make(std::move(positions), triangles);
}

inline TriangleMesh inside_out(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline TriangleMesh scaled(TriangleMesh mesh, double factor) {
  for (Vec3& p : mesh.positions) p = p * factor;
  return mesh;
}

inline TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& p : mesh.positions) p += by;
  return mesh;
}

/// Both, unconnected.
inline TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const auto offset = static_cast<std::uint32_t>(a.vertex_count());
  for (const Vec3& p : b.positions) a.positions.push_back(p);
  for (const auto& [i, j, k] : b.triangles)
    a.triangles.push_back({VertexId(index(i) + offset), VertexId(index(j) + offset), VertexId(index(k) + offset)});
  return a;
}

/// The walls of a cube of side 1, of six plates that cross each other, around a chamber.
inline TriangleMesh walls(double thickness) {
  TriangleMesh all;
  for (int axis = 0; axis < 3; ++axis)
    for (const double at : {0.0, 1 - thickness}) {
      Vec3 min{}, max{1, 1, 1};
      min[axis] = at, max[axis] = at + thickness;
      all = together(std::move(all), box(min, max));
    }
  return all;
}

/// The same surface with three vertices of its own for every face.
inline TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    result.triangles.push_back(
        {result.positions.push_back(t.a), result.positions.push_back(t.b), result.positions.push_back(t.c)});
  }
  return result;
}

}  // namespace prohull::meshes

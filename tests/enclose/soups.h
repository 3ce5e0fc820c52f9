#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "meshes.h"

namespace prohull::meshes {

/// Nasty small input: parts that cross, double, hold, touch or miss each other, as in exports of assemblies, some of
/// them inside out or open; folds, sheets, slivers, triangles that are points or segments or not finite; at any scale
/// and place.
struct Soup {
  TriangleMesh mesh;
  std::vector<TriangleMesh> parts;  ///< what the mesh is made of
  double scale = 1;

  double size() const { return 2 * scale; }  ///< of a part, about
};

class SoupMaker {
 public:
  using result_type = std::mt19937::result_type;

  explicit SoupMaker(unsigned seed) : random_(seed) {}

  int uniform(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }
  bool one_in(int count) { return uniform(1, count) == 1; }
  double real(double least, double most) { return std::uniform_real_distribution<double>(least, most)(random_); }

  // As a generator of the standard library.
  static constexpr result_type min() { return std::mt19937::min(); }
  static constexpr result_type max() { return std::mt19937::max(); }
  result_type operator()() { return random_(); }

  Soup soup() {
    Soup made;
    if (one_in(2)) made.scale = std::pow(10.0, one_in(6) ? uniform(-160, 98) : uniform(-30, 30));
    const double far = one_in(3) ? std::pow(10.0, uniform(1, 9)) : 0;
    const Vec3 place = Vec3{real(-1, 1), real(-1, 1), real(-1, 1)} * (far * made.scale);
    if (one_in(3)) {
      for (int count = uniform(1, 3); count > 0; --count)
        for (TriangleMesh& part : nasty_parts()) made.parts.push_back(placed(std::move(part), made.scale, place));
    } else {
      for (int count = uniform(1, 6); count > 0; --count) add_part(made, place);
    }
    for (const TriangleMesh& part : made.parts) made.mesh = together(std::move(made.mesh), part);
    if (one_in(12)) repeat_faces(made);
    if (one_in(16)) spoil(made);
    if (one_in(4)) made.mesh = meshes::soup(made.mesh);
    return made;
  }

 private:
  Vec3 point() {
    // On a coarse grid, corners and faces touch.
    if (one_in(2)) return {uniform(-2, 2) / 2.0, uniform(-2, 2) / 2.0, uniform(-2, 2) / 2.0};
    return {real(-1, 1), real(-1, 1), real(-1, 1)};
  }

  static TriangleMesh placed(TriangleMesh mesh, double scale, const Vec3& place) {
    for (Vec3& p : mesh.positions) p = p * scale + place;
    return mesh;
  }

  /// May be flat.
  TriangleMesh any_tetrahedron() {
    TriangleMesh corners = tetrahedron(point(), point(), point(), point());
    return signed_volume(corners) < 0 ? inside_out(std::move(corners)) : corners;
  }

  TriangleMesh shape() {
    switch (uniform(0, 5)) {
      case 0:
        return sphere(uniform(1, 2));
      case 1:
        return octahedron();
      case 2:
        return box({-1, -1, -1}, {1, 1, 1});
      case 3:
        return folded();
      default:
        return any_tetrahedron();
    }
  }

  /// A ball, some of whose vertices went astray.
  TriangleMesh folded() {
    TriangleMesh mesh = one_in(2) ? sphere(1) : subdivided(box({-1, -1, -1}, {1, 1, 1}));
    for (int count = uniform(1, 4); count > 0; --count)
      mesh.positions[VertexId(static_cast<std::uint32_t>(uniform(0, int(mesh.vertex_count()) - 1)))] = point() * 1.5;
    return mesh;
  }

  void add_triangle(TriangleMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c) {
    mesh.triangles.push_back({mesh.positions.push_back(a), mesh.positions.push_back(b), mesh.positions.push_back(c)});
  }

  template <class Corners>
  TriangleMesh triangles(int most, const Corners& corners) {
    TriangleMesh mesh;
    for (int count = uniform(1, most); count > 0; --count) {
      const auto [a, b, c] = corners();
      add_triangle(mesh, a, b, c);
    }
    return mesh;
  }

  std::vector<TriangleMesh> nasty_parts() {
    using Corners = std::array<Vec3, 3>;
    switch (uniform(0, 8)) {
      case 0:
        return {triangles(12, [&] { return Corners{point(), point(), point()}; })};
      case 1: {  // tetrahedra
        std::vector<TriangleMesh> parts;
        for (int count = uniform(2, 12); count > 0; --count) parts.push_back(any_tetrahedron());
        return parts;
      }
      case 2:  // slivers
        return {triangles(8, [&] {
          const Vec3 a = point(), b = point(), hair = point() * std::pow(10.0, uniform(-18, -3));
          return Corners{a, b, a + (b - a) * real(0, 1) + hair};
        })};
      case 3: {  // sheets in one plane, with numbers that it rounds, or not
        const Vec3 u = point(), v = point();
        return {triangles(10, [&] {
          const auto in_plane = [&] { return u * (uniform(-4, 4) / 4.0) + v * (uniform(-4, 4) / 4.0); };
          return Corners{in_plane(), in_plane(), in_plane()};
        })};
      }
      case 4: {  // a box without some of its sides
        TriangleMesh open = box({-1, -1, -1}, {1, real(-1, 1), 1});
        for (int count = uniform(1, 6); count > 0; --count) open.triangles.pop_back();
        return {open};
      }
      case 5: {  // many faces at an edge
        const Vec3 a = point(), b = point();
        return {triangles(6, [&] { return Corners{a, b, point()}; })};
      }
      case 6:  // points and segments
        return {triangles(4, [&] {
          const Vec3 a = point(), b = one_in(2) ? a : point();
          return Corners{a, b, one_in(2) ? a : b};
        })};
      case 7: {  // a needle, or a plate
        const Vec3 size{1, std::pow(10.0, uniform(-9, 0)), std::pow(10.0, uniform(-9, 0))};
        return {box(-size, size)};
      }
      default: {  // tetrahedra around an edge
        const Vec3 a = point(), b = point();
        std::vector<TriangleMesh> parts;
        for (int count = uniform(2, 4); count > 0; --count) {
          TriangleMesh part = tetrahedron(a, b, point(), point());
          parts.push_back(signed_volume(part) < 0 ? inside_out(std::move(part)) : part);
        }
        return parts;
      }
    }
  }

  void add_part(Soup& made, const Vec3& place) {
    TriangleMesh part;
    if (!made.parts.empty() && one_in(4)) {
      // The last part again, or a smaller one that lies within it where that is convex.
      part = made.parts.back();
      if (one_in(2)) {
        const Vec3 middle = bounding_box(part).center();
        for (Vec3& p : part.positions) p = middle + (p - middle) * 0.5;
      }
    } else {
      part = shape();
      const double size = one_in(3) ? 1 : real(0.1, 1);
      const Vec3 by = point();
      for (Vec3& p : part.positions) p = (p * size + by) * made.scale + place;
    }
    if (one_in(4)) part = inside_out(std::move(part));
    if (one_in(8)) part.triangles.pop_back();
    made.parts.push_back(std::move(part));
  }

  FaceId any_face(const TriangleMesh& mesh) {
    return FaceId(static_cast<std::uint32_t>(uniform(0, int(mesh.face_count()) - 1)));
  }

  void repeat_faces(Soup& made) {
    for (int count = uniform(1, 5); count > 0; --count) {
      auto again = made.mesh.triangles[any_face(made.mesh)];
      if (one_in(2)) std::swap(again[0], again[1]);
      made.mesh.triangles.push_back(again);
    }
  }

  void spoil(Soup& made) {
    const auto corner = made.mesh.triangles[any_face(made.mesh)][0];
    made.mesh.positions[corner][uniform(0, 2)] =
        one_in(2) ? std::numeric_limits<double>::quiet_NaN() : std::numeric_limits<double>::infinity();
  }

  std::mt19937 random_;
};

}  // namespace prohull::meshes

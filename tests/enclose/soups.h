#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "meshes.h"

namespace prohull::meshes {

/// Small parts that cross, double, hold, touch or miss each other, as in exports of assemblies; some are inside out or
/// open. Scale and place are any.
struct Soup {
  TriangleMesh mesh;
  std::vector<TriangleMesh> parts;  ///< what the mesh is made of
  bool is_closed = true;            ///< each part is
  double scale = 1;

  double size() const { return 2 * scale; }  ///< of a part, about
};

class SoupMaker {
 public:
  explicit SoupMaker(unsigned seed) : random_(seed) {}

  int uniform(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }
  bool one_in(int count) { return uniform(1, count) == 1; }
  double real(double least, double most) { return std::uniform_real_distribution<double>(least, most)(random_); }

  Soup soup() {
    Soup made;
    made.scale = one_in(2) ? 1 : std::pow(10.0, uniform(-30, 30));
    const double far = one_in(3) ? std::pow(10.0, uniform(1, 9)) : 0;
    const Vec3 place = Vec3{real(-1, 1), real(-1, 1), real(-1, 1)} * (far * made.scale);
    for (int count = uniform(1, 6); count > 0; --count) add_part(made, place);
    for (const TriangleMesh& part : made.parts) made.mesh = together(std::move(made.mesh), part);
    if (one_in(4)) made.mesh = meshes::soup(made.mesh);
    return made;
  }

 private:
  Vec3 point() {
    // On a coarse grid, corners and faces touch.
    if (one_in(2)) return {uniform(-2, 2) / 2.0, uniform(-2, 2) / 2.0, uniform(-2, 2) / 2.0};
    return {real(-1, 1), real(-1, 1), real(-1, 1)};
  }

  /// A tetrahedron may be flat.
  TriangleMesh shape() {
    switch (uniform(0, 4)) {
      case 0:
        return sphere(uniform(1, 2));
      case 1:
        return octahedron();
      case 2:
        return box({-1, -1, -1}, {1, 1, 1});
      default: {
        TriangleMesh corners = tetrahedron(point(), point(), point(), point());
        return signed_volume(corners) < 0 ? inside_out(std::move(corners)) : corners;
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
    if (one_in(8)) {
      part.triangles.pop_back();
      made.is_closed = false;
    }
    made.parts.push_back(std::move(part));
  }

  std::mt19937 random_;
};

}  // namespace prohull::meshes

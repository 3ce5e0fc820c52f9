#pragma once

#include <cmath>
#include <random>

#include "geometry/triangle_predicates.h"
#include "meshes.h"

namespace prohull {

/// Closed chains of triangles with corners on a small integer grid, where contacts of every kind are frequent.
class RandomChains {
 public:
  explicit RandomChains(unsigned seed) : random_(seed) {}

  int uniform(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }
  Vec3 corner() { return {double(uniform(0, 3)), double(uniform(0, 3)), double(uniform(0, 3))}; }

  void add_tetrahedron(TriangleMesh& mesh) {
    const Vec3 a = corner(), b = corner(), c = corner(), d = corner();
    const TriangleMesh t = meshes::tetrahedron(a, b, c, d);
    const Side s = side(a, b, c, d);
    if (s != Side::On) mesh = meshes::together(mesh, s == Side::Outside ? t : meshes::inside_out(t));
  }

  /// Puts three faces in the place of one, around a new vertex. Outwards, the chain grows; else it may get a dent.
  void split_face(TriangleMesh& mesh, bool outwards) {
    const FaceId f = FaceId(uniform(0, int(mesh.face_count()) - 1));
    Vec3 p = corner();
    if (uniform(0, 3) == 0) {  // a hair's breadth
      double& x = p[uniform(0, 2)];
      x = std::nextafter(x, uniform(-9, 9));
    }
    const Triangle t = mesh.triangle(f);
    if (outwards && side(t.a, t.b, t.c, p) == Side::Inside) return;
    const VertexId v = mesh.positions.push_back(p);
    const auto [a, b, c] = mesh.triangles[f];
    mesh.triangles[f] = {a, b, v};
    mesh.triangles.push_back({b, c, v});
    mesh.triangles.push_back({c, a, v});
  }

 private:
  std::mt19937 random_;
};

}  // namespace prohull

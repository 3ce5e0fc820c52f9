// The verifier on hulls as they are built: it accepts every level, and no mutant that loses an original vertex.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "effort.h"
#include "geometry/winding_number.h"
#include "prohull/enclosure.h"
#include "prohull/hull_builder.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

std::vector<Triangle> triangles(const TriangleMesh& mesh) {
  std::vector<Triangle> all;
  for (const FaceId f : mesh.triangles.ids()) all.push_back(mesh.triangle(f));
  return all;
}

// Not at all inside: the verifier must not accept the hull. Independent of its subdivision and its rays.
bool loses_a_vertex(const TriangleMesh& original, const TriangleMesh& hull) {
  const WindingNumber winding(triangles(hull));
  return std::any_of(original.positions.begin(), original.positions.end(), [&](const Vec3& p) {
    const auto w = winding.at(p);
    return w && *w < 1;
  });
}

// Moves a vertex against the mean normal of its faces, by `step`, or by one ulp of a coordinate if that is 0.
void dent(TriangleMesh& hull, VertexId v, double step) {
  Vec3 normal;
  for (const FaceId f : hull.triangles.ids()) {
    const auto& t = hull.triangles[f];
    if (t[0] != v && t[1] != v && t[2] != v) continue;
    const Triangle face = hull.triangle(f);
    normal += cross(face.b - face.a, face.c - face.a);
  }
  Vec3& p = hull.positions[v];
  if (step > 0) {
    p = p - normal * (step / norm(normal));
  } else {
    const int axis = std::abs(normal.x) >= std::abs(normal.y) && std::abs(normal.x) >= std::abs(normal.z) ? 0
                     : std::abs(normal.y) >= std::abs(normal.z)                                           ? 1
                                                                                                          : 2;
    p[axis] = std::nextafter(p[axis], normal[axis] > 0 ? -INFINITY : INFINITY);
  }
}

TEST(BuiltHulls, AreAcceptedAndTheirMutantsAreNot) {
  std::mt19937 random(test_seed());
  std::size_t lost = 0, kept = 0;
  for (const char* name : {"asteroid", "knot", "bracket", "box", "torus", "pony"}) {
    const TriangleMesh original = make_sample(name, effort(3000, 1000));
    const ProgressiveHull hull = build_hull(original, {.target_faces = 100}).hull;
    const double diagonal = bounding_box(original).diagonal();
    for (const std::size_t faces :
         {hull.base_face_count(), std::size_t{400}, original.face_count() / 2, original.face_count() - 2}) {
      const TriangleMesh level = hull.level(faces);
      ASSERT_TRUE(verify_enclosure(original, level).encloses) << name << " " << faces;
      for (int i = 0; i < effort(8, 3); ++i) {
        TriangleMesh mutant = level;
        std::uniform_int_distribution<std::uint32_t> any(0, static_cast<std::uint32_t>(level.vertex_count() - 1));
        const VertexId v{any(random)};
        const double exponent = std::uniform_real_distribution<double>(-16, -2)(random);
        dent(mutant, v, i % 3 == 0 ? 0 : diagonal * std::pow(10, exponent));
        const bool loses = loses_a_vertex(original, mutant);
        (loses ? lost : kept) += 1;
        if (loses) {
          ASSERT_FALSE(verify_enclosure(original, mutant).encloses) << name << " " << faces << " mutant " << i;
        }
      }
    }
  }
  std::cout << lost << " mutants lose a vertex, " << kept << " may enclose\n";
  EXPECT_GT(lost, (lost + kept) / 10);
}

}  // namespace
}  // namespace prohull

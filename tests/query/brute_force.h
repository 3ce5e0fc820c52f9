#pragma once

#include <gtest/gtest.h>

#include "effort.h"
#include "meshes.h"
#include "prohull/mesh_query.h"
#include "prohull/sample.h"
#include "query/awkward_segments.h"
#include "random.h"

namespace prohull {

inline TriangleMesh two_spheres_and_a_box() {
  using namespace meshes;
  return together(together(sphere(2), moved(sphere(2), {3, 0, 0})), box({-1, 2, -1}, {1, 4, 1}));
}

/// Asks the indices that make_index(mesh) makes what brute force is asked, and expects the same answers.
template <class MakeIndex>
void expect_answers_of_brute_force(MakeIndex make_index) {
  for (const TriangleMesh& mesh : {meshes::octahedron(), two_spheres_and_a_box(), meshes::soup(meshes::torus(8, 6)),
                                   make_sample("asteroid", 1000)}) {
    MeshQuery truth{QueryIndex(mesh, Engine::Brute)}, query{make_index(mesh)};
    const auto segments = awkward_segments(mesh, rounds(250), test_seed());
    for (const Segment& s : segments) {
      ASSERT_EQ(query.all_hits(s), truth.all_hits(s));
      ASSERT_EQ(query.first_hit(s), truth.first_hit(s));
      ASSERT_EQ(query.any_hit(s).has_value(), truth.any_hit(s).has_value());
    }
    for (const Ray& r : rays_along(segments)) {
      ASSERT_EQ(query.all_hits(r), truth.all_hits(r));
      ASSERT_EQ(query.first_hit(r), truth.first_hit(r));
      ASSERT_EQ(query.any_hit(r).has_value(), truth.any_hit(r).has_value());
    }
    for (std::size_t i = 0; i + 2 < segments.size(); i += 20) {
      const Triangle t{segments[i].a, segments[i + 1].b, segments[i + 2].b};
      ASSERT_EQ(query.faces_met(t), truth.faces_met(t));
      ASSERT_EQ(query.meets(t), truth.meets(t));
    }
  }
}

/// Of an engine, for names of tests.
inline std::string identifier(std::string_view name) {
  std::string letters(name);
  std::erase(letters, '-');
  return letters;
}

}  // namespace prohull

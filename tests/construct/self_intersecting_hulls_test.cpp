#include <gtest/gtest.h>

#include "effort.h"
#include "meshes.h"
#include "prohull/enclosure.h"
#include "prohull/sample.h"
#include "prohull/tight_hull.h"

namespace prohull {
namespace {

using namespace meshes;

TriangleMesh turned_about_x(TriangleMesh mesh) {
  for (Vec3& p : mesh.positions) p = {p.x, -p.z, p.y};
  return mesh;
}

struct NarrowMesh {
  const char* name;
  TriangleMesh mesh;
};

/// Parts of them nearly touch, so that a hull that does not look would run into itself.
std::vector<NarrowMesh> narrow_meshes() {
  const TriangleMesh ring = torus(30, 16), ball = sphere(3);
  return {{"near_balls", together(together(ball, moved(ball, {2.002, 0, 0})), moved(ball, {1.001, 1.735, 0}))},
          {"chain", together(ring, moved(turned_about_x(ring), {1.15, 0, 0}))},
          {"knot", make_sample("knot", 2000)}};
}

class NarrowMeshes : public testing::TestWithParam<NarrowMesh> {};

TEST_P(NarrowMeshes, AddNoPairsOfIntersectingFacesToTheirHulls) {
  const TriangleMesh& mesh = GetParam().mesh;
  ASSERT_EQ(count_self_intersections(mesh), 0u);
  for (const Strategy papers : {Strategy::Paper1, Strategy::Paper2}) {
    const HullOptions options{
        .target_faces = 100, .strategy = papers, .self_intersections = SelfIntersections::Refused};
    EXPECT_EQ(count_self_intersections(build_hull(mesh, options).hull.base()), 0u) << "strategy " << int(papers);
  }
  for (const std::size_t faces : effort<std::vector<std::size_t>>({500, 200, 100}, {100})) {
    EXPECT_EQ(count_self_intersections(build_hull(mesh, {.target_faces = faces}).hull.base()), 0u) << faces;
    EXPECT_EQ(count_self_intersections(build_tight_hull(mesh, {.target_faces = faces}).mesh), 0u) << faces;
  }
}

TEST_P(NarrowMeshes, HaveHullsThatIntersectThemselvesWhereAllowed) {
  const HullOptions options{.target_faces = 100, .self_intersections = SelfIntersections::Allowed};
  EXPECT_GT(count_self_intersections(build_hull(GetParam().mesh, options).hull.base()), 0u) << "nothing to refuse";
}

INSTANTIATE_TEST_SUITE_P(Meshes, NarrowMeshes, testing::ValuesIn(narrow_meshes()),
                         [](const auto& mesh) { return std::string(mesh.param.name); });

}  // namespace
}  // namespace prohull

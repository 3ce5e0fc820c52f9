#include "construct/progressive/collapse_loop.h"

#include <gtest/gtest.h>

#include <limits>

#include "construct/progressive/cells.h"
#include "effort.h"
#include "meshes.h"

namespace prohull {
namespace {

using namespace meshes;

// Each collapse changes the stars of all edges at the tips: work counted, and not timed, must not go with their number.
TEST(CollapseLoop, TakesNotTheSquareOfTheFacesAroundAHub) {
  const TriangleMesh mesh = bipyramid(effort(16000, 4000));
  const HullOptions options{.target_faces = 100, .self_intersections = SelfIntersections::Allowed};
  const Box box = bounding_box(mesh);
  const UnitCube cube(box);
  const CollapseRules rules{options, cube, box, 0, [](std::size_t) {}};
  Patch patch{.mesh = HalfEdgeMesh(mesh),
              .edges = {},
              .vertices = PerVertex<VertexFacts>(mesh.vertex_count()),
              .inside = everywhere(),
              .target_faces = options.target_faces,
              .max_priority = std::numeric_limits<double>::infinity(),
              .time = 1,
              .seed = 0};
  patch.edges.resize(patch.mesh.edge_id_count());
  estimate_priorities(patch, rules);
  run_collapse_loop(patch, rules);
  EXPECT_EQ(patch.mesh.face_count(), options.target_faces);
  EXPECT_EQ(first_defect(patch.mesh), std::nullopt);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < kRefusalKinds; ++i) refused += patch.refusals[static_cast<Refusal>(i)];
  EXPECT_LT(patch.visited_faces, 30 * mesh.face_count());
  EXPECT_LT(refused, 30 * mesh.face_count());
  EXPECT_LT(patch.linear_programs, 30 * mesh.face_count());
}

}  // namespace
}  // namespace prohull

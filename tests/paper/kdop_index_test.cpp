#include "paper/kdop_index.h"

#include "prohull/error.h"
#include "query/brute_force.h"

namespace prohull {
namespace {

class KDopTrees : public testing::TestWithParam<std::string_view> {};

TEST_P(KDopTrees, AnswerAsBruteForceDoes) {
  expect_answers_of_brute_force([](const TriangleMesh& mesh) { return kdop_index(mesh, GetParam()); });
}

INSTANTIATE_TEST_SUITE_P(KDop, KDopTrees, testing::ValuesIn(kdop_names().begin(), kdop_names().end()),
                         [](const auto& parameter) { return identifier(parameter.param); });

TEST(KDopIndex, IsCalledAsItsTrees) {
  EXPECT_EQ(kdop_index(meshes::octahedron(), "kdop26-overlap").engine_name(), "kdop26-overlap");
  EXPECT_THROW(kdop_index(meshes::octahedron(), "kdop10"), InputError);
  EXPECT_THROW(kdop_index(meshes::octahedron(), "bvh"), InputError);
}

TEST(KDopIndex, OfAnEmptyMeshFindsNothing) {
  for (const std::string_view name : kdop_names())
    EXPECT_FALSE(MeshQuery(kdop_index(TriangleMesh{}, name)).first_hit(Segment{{0, 0, 0}, {1, 1, 1}}));
}

}  // namespace
}  // namespace prohull

#include "prohull/progressive_hull.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>
#include <string>

#include "effort.h"
#include "hull/parts.h"
#include "mesh/half_edge_mesh.h"
#include "meshes.h"
#include "prohull/hull_builder.h"
#include "prohull/mesh_report.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

const ProgressiveHull& small_hull() {
  static const ProgressiveHull hull = build_hull(sphere(2), {.target_faces = 40}).hull;
  return hull;
}

TEST(ProgressiveHull, HasLevelsTwoFacesApart) {
  const ProgressiveHull& hull = small_hull();
  EXPECT_EQ(hull.original_face_count(), 128u);
  EXPECT_EQ(hull.base_face_count(), 40u);
  EXPECT_EQ(hull.splits().size(), 44u);
  for (std::size_t faces = 40; faces <= 128; ++faces) {
    const TriangleMesh level = hull.level(faces);
    EXPECT_EQ(level.face_count(), faces / 2 * 2);
    const MeshReport report = inspect(level);
    EXPECT_TRUE(report.is_closed_manifold());
    EXPECT_EQ(report.euler_characteristic, 2);
    EXPECT_EQ(report.unused_vertices, 0u);
  }
  EXPECT_EQ(hull.level(0), hull.base());
  EXPECT_EQ(hull.level(1000), hull.original());
  EXPECT_EQ(hull.original(), sphere(2));
}

TEST(ProgressiveHull, OfAMeshThatIsNotSimplifiedIsThatMesh) {
  const TriangleMesh mesh = octahedron();
  const ProgressiveHull hull = parts_of(mesh).joined();
  EXPECT_EQ(first_defect(hull), std::nullopt);
  EXPECT_EQ(hull.base(), mesh);
  EXPECT_EQ(hull.original(), mesh);
}

TEST(ProgressiveHull, MadeVerticesAreNumberedInTheOrderOfTheCollapses) {
  const ProgressiveHull& hull = small_hull();
  EXPECT_EQ(hull.made_vertex(0), VertexId{66});
  EXPECT_EQ(hull.positions().size(), 66u + 44);
}

TEST(ProgressiveHull, CanStartFromAnyOfItsLevels) {
  const ProgressiveHull& hull = small_hull();
  for (const std::size_t faces : {0u, 40u, 41u, 60u, 126u, 128u, 1000u}) {
    const ProgressiveHull finer = hull.with_base(faces);
    EXPECT_EQ(first_defect(finer), std::nullopt);
    EXPECT_EQ(finer.base(), hull.level(faces));
    EXPECT_EQ(finer.level(100), hull.level(std::max<std::size_t>(faces, 100)));
    EXPECT_EQ(finer.original(), hull.original());
  }
  EXPECT_EQ(hull.with_base(0), hull);
  EXPECT_EQ(hull.with_base(100).with_base(50), hull.with_base(100));
}

TEST(FirstDefect, NamesWhatIsWrongWithTheBase) {
  const auto defect = [](const std::function<void(HullParts&)>& change) {
    HullParts parts = parts_of(small_hull());
    change(parts);
    return first_defect(parts.joined()).value_or("none");
  };
  EXPECT_EQ(defect([](HullParts&) {}), "none");
  EXPECT_EQ(defect([](HullParts& p) { p.corners.pop_back(); }), "the base mesh ends within a face");
  EXPECT_EQ(defect([](HullParts& p) { p.positions.pop_back(); }),
            "109 positions for 66 original vertices and 44 splits");
  EXPECT_EQ(defect([](HullParts& p) { ++p.original_vertices; }),
            "110 positions for 67 original vertices and 44 splits");
  EXPECT_EQ(defect([](HullParts& p) { p.positions[VertexId{7}].y = std::numeric_limits<double>::quiet_NaN(); }),
            "vertex 7 has a coordinate that is not finite");
  EXPECT_EQ(defect([](HullParts& p) { p.corners.insert(p.corners.end(), 3, ProgressiveHull::kAbsent); }),
            "a base mesh of 40 faces and 44 splits cannot make 129 faces");
  const auto first_present = [](HullParts& p) -> VertexId& {
    return *std::ranges::find_if(p.corners, [](VertexId v) { return v != ProgressiveHull::kAbsent; });
  };
  EXPECT_TRUE(
      defect([&](HullParts& p) { first_present(p) = VertexId{110}; }).ends_with("a vertex that does not exist"));
  EXPECT_TRUE(defect([&](HullParts& p) {
                first_present(p) = ProgressiveHull::kAbsent;
              }).ends_with("a vertex that does not exist"));
  EXPECT_TRUE(defect([&](HullParts& p) {
                std::swap((&first_present(p))[0], (&first_present(p))[1]);
              }).starts_with("base mesh: edge "));
  EXPECT_TRUE(
      defect([&](HullParts& p) { (&first_present(p))[0] = (&first_present(p))[1]; }).starts_with("base mesh: "));
}

TEST(FirstDefect, NamesASplitThatCannotBeMade) {
  // The split that is made first, on the base mesh itself.
  const std::size_t last = small_hull().splits().size() - 1;
  const auto defect = [&](const std::function<void(VertexSplit&)>& change) {
    HullParts parts = parts_of(small_hull());
    change(parts.splits[last]);
    return first_defect(parts.joined()).value_or("none");
  };
  const VertexId made = small_hull().made_vertex(last);
  const VertexId in_base = *std::ranges::find_if(
      small_hull().base_corners(), [&](VertexId v) { return v != ProgressiveHull::kAbsent && v != made; });
  const std::string refused = "split 43 does not fit the mesh it refines";
  EXPECT_EQ(defect([](VertexSplit& s) { s.d = s.o; }), refused) << "both ends are one";
  EXPECT_EQ(defect([](VertexSplit& s) { s.r = s.l; }), refused) << "both sides are one";
  EXPECT_EQ(defect([&](VertexSplit& s) { s.o = made; }), refused) << "an end is the vertex that is split";
  EXPECT_EQ(defect([&](VertexSplit& s) { s.o = in_base; }), refused) << "an end exists already";
  EXPECT_EQ(defect([&](VertexSplit& s) { s.d = in_base; }), refused);
  EXPECT_EQ(defect([](VertexSplit& s) { s.o = VertexId{110}; }), refused) << "there are 110 vertices";
  EXPECT_EQ(defect([](VertexSplit& s) { s.l = s.o; }), refused) << "not beside the vertex";
  EXPECT_EQ(defect([](VertexSplit& s) { s.r = VertexId{0xffffffff}; }), refused);
  EXPECT_EQ(defect([](VertexSplit& s) { s.do_ = s.od; }), refused) << "both faces are one";
  EXPECT_EQ(defect([](VertexSplit& s) { s.od = 3 * 128; }), refused) << "there are 128 faces";
  EXPECT_EQ(defect([](VertexSplit& s) { s.do_ = 0xffffffff; }), refused);
  const auto& corners = small_hull().base_corners();
  const auto present = std::ranges::find_if(corners, [](VertexId v) { return v != ProgressiveHull::kAbsent; });
  EXPECT_EQ(defect([&](VertexSplit& s) { s.od = static_cast<std::uint32_t>(present - corners.begin()); }), refused)
      << "the face exists already";
}

TEST(FirstDefect, RefusesSplitsOfAHub) {
  const auto defect = [](std::uint32_t rim) {
    HalfEdgeMesh mesh(meshes::bipyramid(rim));
    const HalfEdgeId at_hub = mesh.valence(mesh.tail(HalfEdgeId{0})) == rim ? HalfEdgeId{0} : HalfEdgeId{2};
    HullParts parts = parts_of(meshes::bipyramid(rim));
    parts.splits = {mesh.collapse(at_hub, {})};
    parts.positions = mesh.positions();
    parts.corners.clear();
    for (std::uint32_t f = 0; f < mesh.face_id_count(); ++f)
      for (const VertexId v : mesh.corners(FaceId{f})) parts.corners.push_back(v);
    return first_defect(parts.joined());
  };
  EXPECT_EQ(defect(1024), std::nullopt);
  EXPECT_EQ(defect(1025), "split 0 replaces a vertex of 1025 faces, and may only replace one of at most 1024");
}

// Whatever the record: either it is refused, or all its levels are closed manifolds.
TEST(FirstDefect, LetsNothingPassThatIsNotAClosedManifoldOnEveryLevel) {
  std::mt19937 random(test_seed());
  int refused = 0, accepted = 0;
  for (int i = 0; i < rounds(4000); ++i) {
    HullParts parts = parts_of(small_hull());
    for (int changes = 1 + static_cast<int>(random() % 2); changes > 0; --changes) {
      VertexSplit& split = parts.splits[random() % parts.splits.size()];
      VertexSplit& other = parts.splits[random() % parts.splits.size()];
      const VertexId v{static_cast<std::uint32_t>(random() % 111)};
      switch (random() % 10) {
        case 0:
          split.o = v;
          break;
        case 1:
          split.d = v;
          break;
        case 2:
          split.l = v;
          break;
        case 3:
          split.r = v;
          break;
        case 4:
          split.od = static_cast<std::uint32_t>(random() % 385);
          break;
        case 5:
          split.do_ = static_cast<std::uint32_t>(random() % 385);
          break;
        case 6:
          std::swap(split.l, split.r);
          break;
        case 7:
          std::swap(split.od, other.od);
          break;
        case 8:
          std::swap(split, other);
          break;
        default:
          parts.corners[random() % parts.corners.size()] = v;
          break;
      }
    }
    const ProgressiveHull hull = parts.joined();
    if (first_defect(hull)) {
      ++refused;
      continue;
    }
    ++accepted;
    for (const std::size_t faces : {40u, 60u, 80u, 100u, 128u}) {
      const TriangleMesh level = hull.level(faces);
      ASSERT_EQ(level.face_count(), faces);
      const MeshReport report = inspect(level);
      ASSERT_TRUE(report.is_closed_manifold()) << report.first_defect;
    }
  }
  EXPECT_GT(refused, rounds(2000));
  EXPECT_GT(accepted, rounds(50)) << "unchanged in effect, or another sound mesh";
}

}  // namespace
}  // namespace prohull

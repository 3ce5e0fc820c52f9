#include <gtest/gtest.h>

#include <algorithm>

#include "effort.h"
#include "meshes.h"
#include "prohull/detail/mesh_quality.h"
#include "prohull/enclosure.h"
#include "prohull/sample.h"
#include "prohull/tight_hull.h"

namespace prohull {
namespace {

using namespace meshes;

// Flat faces and sharp edges cost nothing: a part comes down to its corners without any void.

struct Part {
  const char* name;
  TriangleMesh coarse, fine;
};

using Outline = std::vector<std::array<double, 2>>;

/// From z = 0 up, over a convex outline that is counter-clockwise seen from above.
TriangleMesh prism(const Outline& outline, double height) {
  const auto n = static_cast<std::uint32_t>(outline.size());
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const double z : {0.0, height})
    for (const auto& [x, y] : outline) positions.push_back({x, y, z});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    triangles.push_back({i, j, n + j});
    triangles.push_back({i, n + j, n + i});
    if (i > 0 && j > 0) triangles.push_back({0, j, i}), triangles.push_back({n, n + i, n + j});
  }
  return make(positions, triangles);
}

/// From z = 0 up, between an outline and another inside of it with as many corners, both counter-clockwise.
TriangleMesh pierced(const Outline& outer, const Outline& inner, double height) {
  const auto n = static_cast<std::uint32_t>(outer.size());
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const double z : {0.0, height})
    for (const Outline& outline : {outer, inner})
      for (const auto& [x, y] : outline) positions.push_back({x, y, z});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
      triangles.push_back({a, b, c}), triangles.push_back({a, c, d});
    };
    quad(i, j, 2 * n + j, 2 * n + i);                  // outside
    quad(n + j, n + i, 3 * n + i, 3 * n + j);          // in the hole
    quad(j, i, n + i, n + j);                          // below
    quad(2 * n + i, 2 * n + j, 3 * n + j, 3 * n + i);  // above
  }
  return make(positions, triangles);
}

const Outline kOctagon{{3, 1}, {1, 3}, {-1, 3}, {-3, 1}, {-3, -1}, {-1, -3}, {1, -3}, {3, -1}};

Outline square(double half_side) {
  return {{half_side, half_side}, {-half_side, half_side}, {-half_side, -half_side}, {half_side, -half_side}};
}

Part finer(const char* name, const TriangleMesh& coarse) {
  TriangleMesh fine = subdivided(subdivided(coarse));
  return {name, coarse, kTestsAreSlow ? fine : subdivided(fine)};
}

// Coordinates are dyadic: all that is flat is exactly flat. At their least, parts have no faces so thin that the guards
// of shape refuse them.
std::vector<Part> parts() {
  Outline small = kOctagon;
  for (auto& [x, y] : small) x /= 2, y /= 2;
  std::vector<Part> all{finer("box", box({0, 0, 0}, {1, 2, 3})), finer("prism", prism(kOctagon, 2)),
                        finer("block_with_a_hole", pierced(square(4), square(1), 6))};
  if (!kTestsAreSlow) all.push_back(finer("nut", pierced(kOctagon, small, 1.5)));  // it takes all three subdivisions
  return all;
}

bool are_equal_solids(const TriangleMesh& a, const TriangleMesh& b) {
  return verify_enclosure(a, b).encloses && verify_enclosure(b, a).encloses;
}

class MachinedParts : public testing::TestWithParam<Part> {
 protected:
  void expect_only_its_corners(const TriangleMesh& hull) {
    const auto& [name, coarse, fine] = GetParam();
    EXPECT_EQ(hull.face_count(), coarse.face_count());
    EXPECT_TRUE(are_equal_solids(hull, fine)) << "void or less";
    for (const Vec3& p : hull.positions)
      EXPECT_EQ(std::ranges::count(coarse.positions, p), 1) << "no corner of the part";
    EXPECT_EQ(count_self_intersections(hull), 0u);
    EXPECT_NEAR(mesh_quality(hull).dihedral_angle.worst, mesh_quality(coarse).dihedral_angle.worst, 1e-15);
  }
};

TEST_P(MachinedParts, ComeDownToTheirCornersExactly) {
  const auto& [name, coarse, fine] = GetParam();
  for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
    for (const auto intersections : {SelfIntersections::Allowed, SelfIntersections::Refused}) {
      if (side == HullSide::Inner && intersections == SelfIntersections::Allowed) continue;  // refused as an option
      SCOPED_TRACE(testing::Message() << "side " << int(side) << ", self-intersections " << int(intersections));
      const HullOptions options{.target_faces = coarse.face_count(), .side = side, .self_intersections = intersections};
      expect_only_its_corners(build_hull(fine, options).hull.base());
    }
    SCOPED_TRACE(testing::Message() << "tight, side " << int(side));
    expect_only_its_corners(build_tight_hull(fine, {.target_faces = coarse.face_count(), .side = side}).mesh);
  }
}

INSTANTIATE_TEST_SUITE_P(Parts, MachinedParts, testing::ValuesIn(parts()),
                         [](const auto& part) { return std::string(part.param.name); });

// At its 32 faces the narrow sides would have a compactness down to 0.03: less than the guards let pass.
TEST(ThinPlate, KeepsMoreFacesRatherThanSliversAndHasNoVoid) {
  for (const double height : effort<std::vector<double>>({2.0, 0.25}, {0.25})) {
    const Part plate = finer("", pierced(square(8), square(2), height));
    const TriangleMesh hull = build_hull(plate.fine, {.target_faces = 32}).hull.base();
    EXPECT_TRUE(are_equal_solids(hull, plate.fine)) << height;
    const TriangleMesh tight = build_tight_hull(plate.fine, {.target_faces = 32}).mesh;
    EXPECT_TRUE(are_equal_solids(tight, plate.fine)) << "tight, " << height;
    for (const std::size_t faces : {hull.face_count(), tight.face_count()})
      EXPECT_LE(faces, height >= 1 ? 40u : 128u) << height << ", of " << plate.fine.face_count();
  }
}

TEST(BoxSample, KeepsItsPlanesAndItsHole) {
  const TriangleMesh mesh = make_sample("box", effort(3000, 600));
  for (const std::size_t faces : {500u, 100u, 32u}) {
    const HullResult result = build_hull(mesh, {.target_faces = faces});
    EXPECT_EQ(result.hull.base_face_count(), faces);
    EXPECT_TRUE(are_equal_solids(result.hull.base(), mesh)) << faces;
  }
  const TightHull tight = build_tight_hull(mesh, {.target_faces = 32});
  EXPECT_EQ(tight.mesh.face_count(), 32u);
  EXPECT_TRUE(are_equal_solids(tight.mesh, mesh)) << "tight";
}

}  // namespace
}  // namespace prohull

#include "hull/void_complex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "hull/parts.h"
#include "meshes.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;
using Kind = VoidComplex::Neighbour::Kind;

ProgressiveHull hull_of(const TriangleMesh& mesh, std::size_t faces, HullSide side = HullSide::Outer) {
  return build_hull(mesh, {.target_faces = faces, .side = side}).hull;
}

/// Curved, with flat parts, of several components, with unused vertices, not simplified; outer and inner.
const std::vector<ProgressiveHull>& hulls() {
  static const std::vector<ProgressiveHull> all = [] {
    std::vector<ProgressiveHull> made{hull_of(octahedron(), 100)};
    for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
      made.push_back(hull_of(make_sample("asteroid", 1000), 100, side));
      made.push_back(hull_of(torus(24, 16), 40, side));
      made.push_back(hull_of(subdivided(subdivided(box({0, 0, 0}, {1, 2, 3}))), 12, side));
      made.push_back(hull_of(together(sphere(2), moved(sphere(2), {3, 0, 0})), 60, side));
    }
    return made;
  }();
  return all;
}

double volume(const VoidComplex& complex, const VoidComplex::Tetrahedron& tetrahedron) {
  const auto at = [&](std::size_t i) { return complex.position(tetrahedron.corners[i]); };
  return dot(at(0) - at(1), cross(at(2) - at(1), at(3) - at(1))) / 6;
}

using Corners = std::array<std::array<double, 3>, 3>;

/// The positions of the corners of a face, in ascending order.
template <class PositionOf>
Corners sorted_corners(PositionOf position_of) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 p = position_of(k);
    corners[k] = {p.x, p.y, p.z};
  }
  std::ranges::sort(corners);
  return corners;
}

Corners face_opposite(const VoidComplex& complex, const VoidComplex::Tetrahedron& tetrahedron, std::size_t i) {
  return sorted_corners([&](std::size_t k) { return complex.position(tetrahedron.corners[k < i ? k : k + 1]); });
}

Corners corners_of(const TriangleMesh& mesh, FaceId f) {
  return sorted_corners([&](std::size_t k) { return mesh.positions[mesh.triangles[f][k]]; });
}

TEST(VoidComplex, HasTheVolumeOfTheVoid) {
  for (const ProgressiveHull& hull : hulls()) {
    const VoidComplex complex(hull);
    double sum = 0;
    for (std::uint32_t t = 0; t < complex.size(); ++t) {
      const double v = volume(complex, complex[complex.tetrahedron(t)]);
      ASSERT_GE(hull.side() == HullSide::Outer ? v : -v, complex.is_flat(t) ? -1e-15 : 0);
      sum += v;
    }
    EXPECT_NEAR(sum, signed_volume(hull.base()) - signed_volume(hull.original()), 1e-9);
  }
}

TEST(VoidComplex, EveryFaceOfATetrahedronBelongsToOneOtherOrToABorder) {
  for (const ProgressiveHull& hull : hulls()) {
    const VoidComplex complex(hull);
    const TriangleMesh original = hull.original(), base = hull.base();
    std::set<std::uint32_t> original_faces, base_faces;
    for (std::uint32_t t = 0; t < complex.size(); ++t) {
      const VoidComplex::Neighbour here = complex.tetrahedron(t);
      const auto tetrahedron = complex[here];
      for (std::size_t i = 0; i < 4; ++i) {
        const VoidComplex::Neighbour& there = tetrahedron.beyond[i];
        const auto face = face_opposite(complex, tetrahedron, i);
        if (there.kind == Kind::Tetrahedron) {
          const auto other = complex[there];
          const auto back = std::ranges::find(other.beyond, here);
          ASSERT_NE(back, other.beyond.end());
          ASSERT_EQ(face_opposite(complex, other, static_cast<std::size_t>(back - other.beyond.begin())), face);
        } else if (there.kind == Kind::OriginalFace) {
          ASSERT_EQ(face, corners_of(original, FaceId(there.id)));
          ASSERT_EQ(complex.beyond_original(FaceId(there.id)), here);
          ASSERT_TRUE(original_faces.insert(there.id).second);
        } else {
          const auto at = static_cast<std::size_t>(std::ranges::find(complex.base_faces(), FaceId(there.id)) -
                                                   complex.base_faces().begin());
          ASSERT_EQ(face, corners_of(base, FaceId(static_cast<std::uint32_t>(at))));
          ASSERT_EQ(complex.beyond_base(at), here);
          ASSERT_TRUE(base_faces.insert(there.id).second);
        }
      }
    }
    // The others are faces of both meshes.
    for (const FaceId f : original.triangles.ids())
      if (!original_faces.contains(index(f))) {
        ASSERT_EQ(complex.beyond_original(f), (VoidComplex::Neighbour{Kind::BaseFace, index(f), 0}));
      }
    for (std::size_t i = 0; i < complex.base_faces().size(); ++i)
      if (const std::uint32_t f = index(complex.base_faces()[i]); !base_faces.contains(f)) {
        ASSERT_EQ(complex.beyond_base(i), (VoidComplex::Neighbour{Kind::OriginalFace, f, 0}));
      }
  }
}

TEST(VoidComplex, HasTheFacesOfTheBaseMeshInItsOrder) {
  for (const ProgressiveHull& hull : hulls()) {
    const VoidComplex complex(hull);
    const TriangleMesh base = hull.base();
    ASSERT_EQ(complex.base_faces().size(), base.face_count());
    for (const FaceId f : base.triangles.ids())
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(complex.position(complex.base_corners()[index(f)][c]), base.positions[base.triangles[f][c]]);
  }
}

TEST(VoidComplex, TakesLittleMemory) {
  const ProgressiveHull hull = hull_of(make_sample("asteroid", 5000), 100);
  EXPECT_LE(VoidComplex(hull).memory_bytes(), 170 * hull.original_face_count());
}

TEST(VoidComplex, RefusesARecordThatEnclosesNothing) {
  HullParts parts = parts_of(hull_of(sphere(2), 20));
  for (Vec3& p : std::span(parts.positions.data(), parts.positions.size()).last(5)) p = p * 0.5;
  EXPECT_THROW(VoidComplex{parts.joined()}, InputError);
}

TEST(SheetsWithoutThickness, AreFoundAndNothingElse) {
  for (const ProgressiveHull& hull : hulls()) EXPECT_TRUE(sheets_without_thickness(VoidComplex(hull)).empty());
}

}  // namespace
}  // namespace prohull

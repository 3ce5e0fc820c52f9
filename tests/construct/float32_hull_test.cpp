#include "prohull/detail/float32_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "geometry/float32.h"
#include "input_error.h"
#include "meshes.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/mesh_report.h"
#include "prohull/sample.h"

namespace prohull {
namespace {

using namespace meshes;

void check(const TriangleMesh& level, HullSide side) {
  const Float32Hull rounded = with_float32_coordinates(level, side);
  EXPECT_TRUE(std::ranges::all_of(rounded.mesh.positions, [](const Vec3& p) { return is_float32(p); }));
  ASSERT_EQ(rounded.mesh.triangles, level.triangles) << "only vertices move";
  EXPECT_GT(rounded.rounded_vertices, 0u);
  EXPECT_TRUE(side == HullSide::Outer ? verify_enclosure(level, rounded.mesh).encloses
                                      : verify_enclosure(rounded.mesh, level).encloses);
  double farthest = 0;
  for (const VertexId v : level.positions.ids())
    farthest = std::max(farthest, norm(rounded.mesh.positions[v] - level.positions[v]));
  EXPECT_LE(farthest, 1e-3 * bounding_box(level).diagonal()) << "neighbours have lifted each other without end";
}

TEST(Float32Hull, OfLevelsStillEncloses) {
  for (const char* name : {"asteroid", "bracket"})
    for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
      SCOPED_TRACE(testing::Message() << name << ", side " << int(side));
      const TriangleMesh mesh = make_sample(name, 1000);
      check(build_hull(mesh, {.target_faces = 300, .side = side}).hull.base(), side);
    }
}

// At a saddle there may be no room; then it says so. What it returns always encloses.
TEST(Float32Hull, OfThinLimbsStillEnclosesOrIsRefused) {
  int enclosed = 0, refused = 0;
  for (const char* name : {"knot", "pony", "torus"})
    for (const HullSide side : {HullSide::Outer, HullSide::Inner})
      for (const std::size_t faces : {50u, 200u, 400u, 800u}) {
        SCOPED_TRACE(testing::Message() << name << ", side " << int(side) << ", " << faces << " faces");
        const TriangleMesh level =
            build_hull(make_sample(name, 1000), {.target_faces = faces, .side = side}).hull.base();
        try {
          check(level, side);
          ++enclosed;
        } catch (const InputError& error) {
          EXPECT_EQ(error.defect(), Defect::NoVolume) << error.what();
          ++refused;
        }
      }
  EXPECT_GT(enclosed, refused);
}

// What has no room in the hull mostly has some above the mesh.
TEST(Float32Hull, IsRoundedToNearestWhereThereIsNoRoom) {
  int refused = 0, enclosing = 0;
  for (const char* name : {"knot", "pony", "torus"})
    for (const std::size_t faces : {50u, 200u, 400u, 800u}) {
      SCOPED_TRACE(testing::Message() << name << ", " << faces << " faces");
      const TriangleMesh mesh = make_sample(name, 1000), level = build_hull(mesh, {.target_faces = faces}).hull.base();
      const Float32Hull rounded = with_float32_coordinates(level, HullSide::Outer, NoRoom::Round);
      EXPECT_TRUE(std::ranges::all_of(rounded.mesh.positions, [](const Vec3& p) { return is_float32(p); }));
      try {
        EXPECT_EQ(rounded.mesh, with_float32_coordinates(level, HullSide::Outer).mesh) << "as long as there is room";
      } catch (const InputError&) {
        ++refused;
        enclosing += verify_enclosure(mesh, rounded.mesh).encloses;
      }
    }
  EXPECT_GT(refused, 0);
  EXPECT_GT(2 * enclosing, refused);
}

TEST(Float32Hull, OfConvexAndSaddleShapedMeshes) {
  for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
    SCOPED_TRACE(testing::Message() << "side " << int(side));
    check(sphere(3), side);
    check(moved(sphere(2), {0.1, 0.2, 0.3}), side);
    check(scaled(torus(16, 8), 0.7), side);
    check(scaled(box({0, 0, 0}, {1, 1, 1}), 0.1), side);
  }
}

TEST(Float32Hull, IsTheMeshItselfWhereThatHasSuchCoordinates) {
  const TriangleMesh mesh = box({0, 0, 0}, {1, 2, 0.1f});
  const Float32Hull same = with_float32_coordinates(mesh, HullSide::Outer);
  EXPECT_EQ(same.mesh, mesh);
  EXPECT_EQ(same.rounded_vertices, 0u);
}

TEST(Float32Hull, OfHullsBuiltOnFloat32CoordinatesNeedsNothing) {
  TriangleMesh mesh = make_sample("asteroid", 1000);
  for (Vec3& p : mesh.positions) p = nearest_float32(p);
  ASSERT_TRUE(inspect(mesh).is_closed_manifold());
  const TriangleMesh base = build_hull(mesh, {.target_faces = 200, .float32_coordinates = true}).hull.base();
  EXPECT_EQ(with_float32_coordinates(base, HullSide::Outer).rounded_vertices, 0u);
}

// Map coordinates: beyond 2^22 a float32 has steps of 0.5.
TEST(Float32Hull, RefusesWhatIsTooFarFromTheOriginForItsSize) {
  const auto refusal_of = [](double size, const Vec3& place) -> std::string {
    try {
      check_float32_spacing(moved(scaled(octahedron(), size), place));
    } catch (const InputError& error) {
      EXPECT_EQ(error.defect(), Defect::NonFiniteCoordinate);
      return error.what();
    }
    return "";
  };
  const Vec3 utm{500000, 5400000, 30};
  EXPECT_EQ(
      refusal_of(10, utm),
      "float32 numbers, which the file has, are 0.5 apart at its coordinates of up to 5400010; that is too coarse "
      "for a mesh that is 34.6 across; write a .ply, .obj or .off file, which keep doubles, or move the mesh to the "
      "origin, as `prohull build --recenter` does");
  for (const double size : {0.1, 1.0, 100.0}) EXPECT_NE(refusal_of(size, utm), "") << size;
  EXPECT_EQ(refusal_of(0.5001 / kMaxFloat32Spacing, utm), "");
  for (const double size : {1e-30, 1.0, 1e30}) EXPECT_EQ(refusal_of(size, {}), "") << size;
  EXPECT_NE(refusal_of(1e-42, {}), "") << "nearly below all float32 numbers";
  EXPECT_NE(refusal_of(1e-200, {}), "");
  TriangleMesh partly_finite = octahedron();
  partly_finite.triangles.push_back(
      {VertexId(0), VertexId(2), partly_finite.positions.push_back({1, INFINITY, 1e300})});
  EXPECT_NO_THROW(check_float32_spacing(partly_finite));
  TriangleMesh far = moved(octahedron(), utm + Vec3{0.1, 0.1, 0.1});
  EXPECT_THROW(with_float32_coordinates(far, HullSide::Outer), InputError);
  for (Vec3& p : far.positions) p = nearest_float32(p);
  EXPECT_EQ(with_float32_coordinates(far, HullSide::Outer).mesh, far) << "nothing has to move";
}

TEST(Float32Hull, RefusesWhatAFloat32CannotHold) {
  const double largest = std::numeric_limits<float>::max();
  const auto defect_of = [](const TriangleMesh& mesh) {
    return error_of([&] { with_float32_coordinates(mesh, HullSide::Outer); }).defect();
  };
  EXPECT_EQ(defect_of(scaled(octahedron(), 1e39)), Defect::NonFiniteCoordinate);
  EXPECT_EQ(defect_of(scaled(octahedron(), std::nextafter(largest, INFINITY))), Defect::NonFiniteCoordinate);
  EXPECT_EQ(with_float32_coordinates(scaled(octahedron(), largest), HullSide::Outer).rounded_vertices, 0u);
}

}  // namespace
}  // namespace prohull

#include "prohull/enclosure.h"

#include <gtest/gtest.h>

#include <limits>

#include "input_error.h"
#include "meshes.h"
#include "prohull/error.h"

namespace prohull {
namespace {

using namespace meshes;

bool encloses(const TriangleMesh& outer, const TriangleMesh& inner) { return verify_enclosure(inner, outer).encloses; }

const TriangleMesh kUnitBox = box({0, 0, 0}, {1, 1, 1});
const double kAboveOne = std::nextafter(1.0, 2.0), kBelowOne = std::nextafter(1.0, 0.0);

TEST(Enclosure, EveryMeshEnclosesItself) {
  for (const TriangleMesh& mesh :
       {tetrahedron(), octahedron(), kUnitBox, sphere(3), torus(20, 10), scaled(torus(7, 5), 0.1)}) {
    const EnclosureReport report = verify_enclosure(mesh, mesh);
    EXPECT_TRUE(report.encloses);
    EXPECT_EQ(report.self_intersections, 0u);
    EXPECT_EQ(report.void_ratio, 0);
    EXPECT_TRUE(encloses(soup(mesh), mesh));
    EXPECT_TRUE(encloses(mesh, soup(mesh)));
  }
}

TEST(Enclosure, OfNestedBoxes) {
  const TriangleMesh outer = box({-1, -1, -1}, {2, 2, 2});
  const EnclosureReport report = verify_enclosure(kUnitBox, outer);
  EXPECT_TRUE(report.encloses);
  EXPECT_DOUBLE_EQ(report.inner_volume, 1);
  EXPECT_DOUBLE_EQ(report.outer_volume, 27);
  EXPECT_DOUBLE_EQ(report.void_ratio, 26);
  const EnclosureReport reverse = verify_enclosure(outer, kUnitBox);
  EXPECT_FALSE(reverse.encloses);
  EXPECT_EQ(reverse.faces_outside, 12u);
}

TEST(Enclosure, OfMeshesThatTouchInAVertexAnEdgeOrAFace) {
  EXPECT_TRUE(encloses(box({0, -1, -1}, {2, 2, 2}), kUnitBox));
  EXPECT_TRUE(encloses(box({0, 0, -1}, {2, 2, 2}), kUnitBox));
  EXPECT_TRUE(encloses(box({0, 0, 0}, {2, 2, 2}), kUnitBox));
  EXPECT_TRUE(encloses(box({0, 0, 0}, {1, 1, 2}), kUnitBox));
  EXPECT_TRUE(encloses(box({-1, -1, -1}, {1, 1, 1}), scaled(octahedron(), 1)));
  EXPECT_TRUE(encloses(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), scaled(octahedron(), 0.5)));
  EXPECT_FALSE(encloses(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), octahedron()));
  EXPECT_FALSE(encloses(box({1, 0, 0}, {2, 1, 1}), kUnitBox)) << "beside each other, one face in common";
}

TEST(Enclosure, OfCoplanarFacesThatOverlapInPart) {
  EXPECT_TRUE(encloses(kUnitBox, box({0.3, 0.2, 0}, {0.7, 0.6, 1})));
  EXPECT_TRUE(encloses(kUnitBox, box({0, 0.2, 0}, {0.7, 0.6, 0.3})));
  EXPECT_TRUE(encloses(kUnitBox, subdivided(subdivided(kUnitBox))));
  EXPECT_TRUE(encloses(subdivided(subdivided(kUnitBox)), kUnitBox));
  EXPECT_FALSE(encloses(box({0.3, 0.2, 0}, {0.7, 0.6, 1}), kUnitBox));
  EXPECT_FALSE(encloses(kUnitBox, box({0.3, 0.2, 0}, {0.7, 1.6, 1})));
}

TEST(Enclosure, TellsOneUlpApart) {
  EXPECT_TRUE(encloses(kUnitBox, box({0, 0, 0}, {1, 1, kBelowOne})));
  const EnclosureReport report = verify_enclosure(box({0, 0, 0}, {1, 1, kAboveOne}), kUnitBox);
  EXPECT_FALSE(report.encloses);
  EXPECT_EQ(report.faces_outside, 10u) << "all but the bottom";
  ASSERT_EQ(report.worst.size(), 5u);
  EXPECT_EQ(report.worst[0].distance, kAboveOne - 1);
  EXPECT_FALSE(encloses(kUnitBox, box({0.25, 0.25, 0.25}, {0.5, 0.5, kAboveOne})));
  EXPECT_FALSE(
      encloses(kUnitBox, moved(scaled(kUnitBox, 0.5), {0.25, 0.25, -std::numeric_limits<double>::denorm_min()})));
}

TEST(Enclosure, SeesAnEdgePiercedBetweenVerticesThatAreAllInside) {
  // The hull dips, above the middle of an edge of the original, from 2 to just below 1.
  const TriangleMesh inner = box({-1, -1, -1}, {1, 1, 1});
  for (const double height : {1.0, kBelowOne}) {
    TriangleMesh outer = subdivided(box({-2, -1, -2}, {2, 2, 2}));
    for (Vec3& p : outer.positions)
      if (p == Vec3{0, -1, 2}) p = {0, -1, height};
    EXPECT_EQ(encloses(outer, inner), height == 1.0);
  }
}

TEST(Enclosure, SeesSurfacesThatCrossInVerticesAndEdgesAlone) {
  // The cube has its corners where the octahedron has face centres and the reverse: only edges cross.
  const TriangleMesh cube = box({-1, -1, -1}, {1, 1, 1});
  EXPECT_FALSE(encloses(scaled(octahedron(), 2), cube));
  EXPECT_FALSE(encloses(cube, scaled(octahedron(), 2)));
  EXPECT_TRUE(encloses(scaled(octahedron(), 3), cube)) << "corners touch faces";
  EXPECT_FALSE(encloses(scaled(octahedron(), std::nextafter(3, 0)), cube));
}

TEST(Enclosure, TurnsMeshesOutwards) {
  const TriangleMesh outer = box({-1, -1, -1}, {2, 2, 2});
  EXPECT_TRUE(encloses(inside_out(outer), kUnitBox));
  EXPECT_TRUE(encloses(outer, inside_out(kUnitBox)));
  EXPECT_FALSE(encloses(inside_out(kUnitBox), outer));
  EXPECT_DOUBLE_EQ(verify_enclosure(inside_out(kUnitBox), inside_out(outer)).void_ratio, 26);
}

TEST(Enclosure, OfSeveralComponents) {
  const TriangleMesh two = together(kUnitBox, moved(kUnitBox, {3, 0, 0}));
  EXPECT_TRUE(encloses(box({0, 0, 0}, {4, 1, 1}), two));
  EXPECT_TRUE(encloses(two, two));
  EXPECT_FALSE(encloses(kUnitBox, two));
  EXPECT_TRUE(encloses(two, kUnitBox));
  EXPECT_FALSE(encloses(two, box({0, 0, 0}, {4, 1, 1}))) << "every corner is in a component, the middle is not";
  const TriangleMesh halves = together(box({0, 0, 0}, {0.5, 1, 1}), box({0.5, 0, 0}, {1, 1, 1}));
  EXPECT_TRUE(encloses(halves, kUnitBox)) << "a wall inside is no hole";
  EXPECT_TRUE(encloses(kUnitBox, halves));
  EXPECT_FALSE(encloses(together(box({0, 0, 0}, {kBelowOne - 0.5, 1, 1}), box({0.5, 0, 0}, {1, 1, 1})), kUnitBox));
}

TEST(Enclosure, SeesACavityOfTheHullInTheMidstOfTheOriginal) {
  const TriangleMesh outer = box({-1, -1, -1}, {2, 2, 2});
  const TriangleMesh bubble = inside_out(box({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}));
  const EnclosureReport report = verify_enclosure(kUnitBox, together(outer, bubble));
  EXPECT_FALSE(report.encloses);
  EXPECT_EQ(report.faces_outside, 0u);
  EXPECT_EQ(report.cavities, 1u);
  EXPECT_EQ(verify_enclosure(kUnitBox, together(together(outer, bubble), moved(bubble, {0.3, 0.3, 0.3}))).cavities, 2u);
  EXPECT_TRUE(encloses(together(outer, moved(bubble, {-1, 0, 0})), kUnitBox)) << "beside the original";
  EXPECT_TRUE(encloses(together(outer, moved(bubble, {-0.6, 0, 0})), box({0.25, 0, 0}, {1, 1, 1})));
  EXPECT_TRUE(encloses(together(outer, bubble), together(kUnitBox, bubble))) << "the original has the same cavity";
  EXPECT_FALSE(
      encloses(together(outer, inside_out(box({0.3, 0.3, 0.3}, {0.6, 0.6, 0.6}))), together(kUnitBox, bubble)));
}

TEST(Enclosure, FacesOnTheHullDoNotLieOutsideEvenIfTheSolidGoesOnBeyondThem) {
  for (const Vec3& by : {Vec3{0.5, 0.5, 0.5}, Vec3{0.5, 0.5, 0}, Vec3{0.3, 0.2, 0.1}}) {
    const EnclosureReport report = verify_enclosure(together(kUnitBox, moved(kUnitBox, by)), kUnitBox);
    EXPECT_FALSE(report.encloses);
    EXPECT_EQ(report.faces_outside, 12u);
    for (const Offender& o : report.worst) EXPECT_GT(o.distance, 0);
  }
}

TEST(Enclosure, SeesACavityWhoseWallsAreFacesOfTheOriginal) {
  const TriangleMesh core = box({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6});
  for (const TriangleMesh& walls : {core, subdivided(core)}) {
    const EnclosureReport report = verify_enclosure(together(kUnitBox, walls), together(kUnitBox, inside_out(core)));
    EXPECT_FALSE(report.encloses);
    EXPECT_EQ(report.faces_outside, 0u);
    EXPECT_EQ(report.cavities, 1u);
  }
}

TEST(Enclosure, CountsNoCavityOfAHullInTheMidstOfTheOriginal) {
  const EnclosureReport report = verify_enclosure(kUnitBox, box({0.2, 0.2, 0.2}, {0.7, 0.7, 0.7}));
  EXPECT_EQ(report.faces_outside, 12u);
  EXPECT_EQ(report.cavities, 0u);
}

TEST(Enclosure, OfAHullThatIntersectsItselfButCoversTwice) {
  const TriangleMesh outer = together(box({-1, -1, -1}, {0.6, 2, 2}), box({0.4, -1, -1}, {2, 2, 2}));
  const EnclosureReport report = verify_enclosure(kUnitBox, outer);
  EXPECT_TRUE(report.encloses);
  EXPECT_GT(report.self_intersections, 0u);
  const TriangleMesh bubble = inside_out(box({0.45, 0.4, 0.4}, {0.55, 0.6, 0.6}));
  EXPECT_TRUE(encloses(together(outer, bubble), kUnitBox)) << "the cavity is still wound around once";
  EXPECT_FALSE(encloses(together(together(outer, bubble), bubble), kUnitBox));
  EXPECT_EQ(verify_enclosure(kUnitBox, together(together(outer, bubble), moved(bubble, {0.1, 0, 0}))).cavities, 2u)
      << "the second bubble is a hole where the hull covers once: five of its faces, and the wall of the hull";
}

TEST(Enclosure, ExcusesFoldedPartsOfTheOriginalThatItDoesNotWindAround) {
  // A small box facing inwards sticks out of the original: wound around -1 times there.
  const TriangleMesh pocket = inside_out(box({0.8, 0.4, 0.4}, {1.5, 0.6, 0.6}));
  EXPECT_TRUE(encloses(kUnitBox, together(kUnitBox, pocket)));
  EXPECT_FALSE(encloses(kUnitBox, together(kUnitBox, inside_out(pocket))));
  // The hull has the pocket: it loses the part inside the original.
  EXPECT_FALSE(encloses(together(kUnitBox, pocket), kUnitBox));
  EXPECT_TRUE(encloses(together(kUnitBox, pocket), together(kUnitBox, pocket)));
}

TEST(Enclosure, IgnoresFacesWithoutArea) {
  TriangleMesh sliver =
      kUnitBox;  // edge 0-1 of the bottom is split on one side only, closed by a triangle without area
  const VertexId middle = sliver.positions.push_back({0.5, 0, 0});
  sliver.triangles[FaceId(1)] = {VertexId(0), VertexId(3), middle};
  sliver.triangles.push_back({middle, VertexId(3), VertexId(1)});
  sliver.triangles.push_back({VertexId(0), middle, VertexId(1)});
  sliver.triangles.push_back({middle, middle, middle});
  EXPECT_TRUE(encloses(sliver, kUnitBox));
  EXPECT_TRUE(encloses(kUnitBox, sliver));
  EXPECT_EQ(verify_enclosure(kUnitBox, sliver).self_intersections, 2u) << "the halves on the other face";
}

TEST(Enclosure, TakesMinusZeroForZero) {
  TriangleMesh minus = soup(kUnitBox);
  for (std::uint32_t v = 0; v < minus.vertex_count(); v += 2)
    for (int i = 0; i < 3; ++i)
      if (minus.positions[VertexId(v)][i] == 0) minus.positions[VertexId(v)][i] = -0.0;
  EXPECT_TRUE(encloses(minus, kUnitBox));
  EXPECT_TRUE(encloses(kUnitBox, minus));
}

TEST(Enclosure, HoldsForHugeAndTinyCoordinates) {
  for (const double scale : {0x1p-1060, 0x1p-600, 0x1p600, 1e300}) {
    const TriangleMesh inner = scaled(octahedron(), scale);
    EXPECT_TRUE(encloses(scaled(box({-1, -1, -1}, {1, 1, 1}), scale), inner)) << scale;
    EXPECT_TRUE(encloses(inner, inner)) << scale;
    EXPECT_FALSE(encloses(scaled(box({-1, -1, -1}, {1, 1, 0.75}), scale), inner)) << scale;
    EXPECT_TRUE(encloses(scaled(subdivided(octahedron()), scale), inner)) << scale;
  }
}

TEST(Enclosure, RefusesWhatIsNotClosed) {
  TriangleMesh open = kUnitBox;
  open.triangles.pop_back();
  TriangleMesh twisted = kUnitBox;
  std::swap(twisted.triangles.back()[0], twisted.triangles.back()[1]);
  TriangleMesh bad = kUnitBox;
  bad.positions[VertexId(3)].y = std::numeric_limits<double>::quiet_NaN();
  const auto defect_of = [](const TriangleMesh& mesh) {
    const InputError error = error_of([&] { verify_enclosure(mesh, kUnitBox); });
    EXPECT_NE(std::string(error.what()).find("inner"), std::string::npos) << error.what();
    return error.defect();
  };
  EXPECT_EQ(defect_of(open), Defect::OpenEdge);
  EXPECT_EQ(defect_of(twisted), Defect::InconsistentOrientation);
  EXPECT_EQ(defect_of(bad), Defect::NonFiniteCoordinate);
  EXPECT_EQ(defect_of({}), Defect::EmptyMesh);
  EXPECT_THROW(verify_enclosure(kUnitBox, open), InputError);
}

TEST(Enclosure, CanBeCancelled) {
  EXPECT_THROW(verify_enclosure(kUnitBox, kUnitBox, {.progress = [](std::string_view, double) { return false; }}),
               Cancelled);
  double last = 0;
  verify_enclosure(kUnitBox, kUnitBox,
                   {.progress = [&](std::string_view, double fraction) { return last = fraction, true; }});
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace prohull

#include <gtest/gtest.h>

#include <limits>

#include "input_error.h"
#include "meshes.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"

namespace prohull {
namespace {

using namespace meshes;

const TriangleMesh kUnitBox = box({0, 0, 0}, {1, 1, 1});
const double kAboveOne = std::nextafter(1.0, 2.0), kBelowOne = std::nextafter(1.0, 0.0);
const double kBelowZero = -std::numeric_limits<double>::denorm_min();

TriangleMesh triangle(const Vec3& a, const Vec3& b, const Vec3& c) { return make({a, b, c}, {{0, 1, 2}}); }
TriangleMesh segment(const Vec3& a, const Vec3& b) { return triangle(a, b, a * 0.5 + b * 0.5); }
TriangleMesh point(const Vec3& p) { return triangle(p, p, p); }

bool covers(const TriangleMesh& outer, const TriangleMesh& triangles) {
  return verify_cover(triangles, outer).encloses;
}

TEST(Cover, OfTrianglesInsideOutsideAndAcross) {
  EXPECT_TRUE(covers(kUnitBox, triangle({0.1, 0.1, 0.1}, {0.9, 0.2, 0.3}, {0.4, 0.8, 0.7})));
  EXPECT_FALSE(covers(kUnitBox, triangle({2, 0, 0}, {3, 0, 0}, {2, 1, 0})));
  EXPECT_FALSE(covers(kUnitBox, triangle({0.5, 0.5, 0.5}, {2, 0.5, 0.5}, {0.5, 0.6, 0.5}))) << "a corner sticks out";
  EXPECT_FALSE(covers(kUnitBox, triangle({-9, -9, 0.5}, {9, -9, 0.5}, {0, 9, 0.5}))) << "the box pierces the triangle";
  EXPECT_FALSE(covers(octahedron(), triangle({0.7, 0.1, 0.1}, {-0.6, 0.3, 0}, {0.7, 0.4, 0})));
}

TEST(Cover, OfTrianglesThatTouchFacesEdgesAndVerticesFromInside) {
  EXPECT_TRUE(covers(kUnitBox, triangle({0.5, 0.5, 0}, {0.5, 0.6, 0.5}, {0.6, 0.5, 0.5}))) << "a corner on a face";
  EXPECT_TRUE(covers(kUnitBox, triangle({0.5, 0, 0}, {0.5, 0.6, 0.5}, {0.6, 0.5, 0.5}))) << "a corner on an edge";
  EXPECT_TRUE(covers(kUnitBox, triangle({0, 0, 0}, {0.5, 0.6, 0.5}, {0.6, 0.5, 0.5}))) << "a corner on a vertex";
  EXPECT_TRUE(covers(kUnitBox, triangle({0.2, 0.3, 0}, {0.7, 0.1, 0}, {0.6, 0.5, 0.5}))) << "an edge in a face";
  EXPECT_TRUE(covers(kUnitBox, triangle({0.2, 0, 0}, {0.7, 0, 0}, {0.6, 0.5, 0.5}))) << "an edge on an edge";
  EXPECT_TRUE(covers(kUnitBox, triangle({0, 0, 0}, {1, 0, 0}, {0.6, 0.5, 0.5}))) << "the same edge";
  EXPECT_TRUE(covers(kUnitBox, triangle({0, 0, 0}, {1, 1, 0}, {1, 1, 1}))) << "from edge to edge";
  EXPECT_TRUE(covers(kUnitBox, triangle({0, 0.2, 0}, {1, 0.2, 0}, {0.5, 0.2, 1})));
  EXPECT_TRUE(covers(octahedron(), triangle({1, 0, 0}, {0, 0, 1}, {-1, 0, 0})))
      << "along four edges, through its middle";
}

TEST(Cover, OfTrianglesThatTouchFromOutside) {
  EXPECT_FALSE(covers(kUnitBox, triangle({0.5, 0.5, 0}, {0.5, 0.6, -0.5}, {0.6, 0.5, -0.5})));
  EXPECT_FALSE(covers(kUnitBox, triangle({0.5, 0, 0}, {0.5, -0.6, 0.5}, {0.6, -0.5, 0.5})));
  EXPECT_FALSE(covers(kUnitBox, triangle({0, 0, 0}, {1, 0, 0}, {0.5, -1, -1}))) << "the same edge";
  EXPECT_FALSE(covers(octahedron(), triangle({0.5, 0.5, 1}, {-0.5, 0.5, 1}, {0, -1, 1})))
      << "a vertex touches its inside";
  EXPECT_FALSE(covers(octahedron(), triangle({1, -1, 1}, {-1, -1, 1}, {0, 0.5, 1}))) << "and here near the border";
  EXPECT_FALSE(covers(kUnitBox, triangle({-1, 0, -1}, {2, 0, 2}, {0, -3, 0}))) << "a segment of an edge on its face";
}

TEST(Cover, SeesCrossingsThroughEdgesAndVerticesAlone) {
  // In the plane of a face diagonal each: leaves exactly through an edge, or a vertex, of the box.
  EXPECT_FALSE(covers(kUnitBox, triangle({0.5, 0.5, 0.5}, {1.5, 1.5, 0.5}, {0.5, 0.5, 0.6})));
  EXPECT_FALSE(covers(kUnitBox, triangle({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}, {0.4, 0.4, 0.5})));
  EXPECT_FALSE(covers(octahedron(), triangle({0, 0, 0}, {2, 0, 0}, {0, 0.25, 0})));
  // Two boxes that meet in an edge, or a vertex, and a triangle from one to the other.
  const TriangleMesh edge = together(kUnitBox, box({1, 1, 0}, {2, 2, 1}));
  EXPECT_TRUE(covers(edge, segment({0.5, 0.5, 0.5}, {1.5, 1.5, 0.5})));
  EXPECT_FALSE(covers(edge, triangle({0.5, 0.5, 0.5}, {1.5, 1.5, 0.5}, {1.5, 1.4, 0.5})));
  EXPECT_TRUE(covers(edge, triangle({0.5, 0.5, 0.5}, {1.5, 1.5, 0.5}, {1.5, 1.5, 0.7})));
  const TriangleMesh vertex = together(kUnitBox, box({1, 1, 1}, {2, 2, 2}));
  EXPECT_TRUE(covers(vertex, segment({0, 0, 0}, {2, 2, 2})));
  EXPECT_FALSE(covers(vertex, triangle({0, 0, 0}, {2, 2, 2}, {1, 1, 2})));
}

TEST(Cover, OfTrianglesInThePlaneOfFaces) {
  for (const TriangleMesh& outer : {kUnitBox, subdivided(kUnitBox), soup(subdivided(kUnitBox))}) {
    EXPECT_TRUE(covers(outer, triangle({0, 0, 1}, {1, 0, 1}, {1, 1, 1})));
    EXPECT_TRUE(covers(outer, triangle({0, 0, 1}, {1, 0, 1}, {0, 1, 1}))) << "across a diagonal";
    EXPECT_TRUE(covers(outer, triangle({0.1, 0.2, 1}, {0.9, 0.3, 1}, {0.6, 0.8, 1})));
    EXPECT_FALSE(covers(outer, triangle({0, 0, 1}, {kAboveOne, 0, 1}, {0, 1, 1})));
    EXPECT_FALSE(covers(outer, triangle({0.1, 0.2, 1}, {0.9, 0.3, 1}, {0.6, kAboveOne, 1})));
    EXPECT_FALSE(covers(outer, triangle({-1, -1, 1}, {3, -1, 1}, {-1, 3, 1}))) << "holds the face";
    EXPECT_FALSE(covers(outer, triangle({0, 0, 1}, {1, 0, 1}, {0, 1, kAboveOne})));
  }
  // A frame: four plates around a hole that only the triangle spans.
  const TriangleMesh frame = together(together(box({0, 0, 0}, {3, 1, 1}), box({0, 2, 0}, {3, 3, 1})),
                                      together(box({0, 1, 0}, {1, 2, 1}), box({2, 1, 0}, {3, 2, 1})));
  EXPECT_FALSE(covers(frame, triangle({0.5, 0.5, 1}, {2.5, 0.5, 1}, {1.5, 2.5, 1})));
  EXPECT_TRUE(covers(frame, triangle({0, 0, 1}, {3, 0, 1}, {0, 1, 1})));
  EXPECT_TRUE(covers(frame, triangle({0, 0, 1}, {1, 0, 1}, {0, 3, 1}))) << "held by three plates";
}

TEST(Cover, OfPointsAndSegments) {
  for (const Vec3& p : {Vec3{0.5, 0.5, 0.5}, {0.5, 0.5, 1}, {0.5, 1, 1}, {1, 1, 1}, {0, 0, 0}})
    EXPECT_TRUE(covers(kUnitBox, point(p)));
  for (const Vec3& p :
       {Vec3{0.5, 0.5, kAboveOne}, {0.5, kAboveOne, 1}, {1, 1, kAboveOne}, {0, kBelowZero, 0}, {5, 5, 5}})
    EXPECT_FALSE(covers(kUnitBox, point(p)));
  EXPECT_TRUE(covers(kUnitBox, segment({0.1, 0.1, 0.1}, {0.9, 0.9, 0.9})));
  EXPECT_TRUE(covers(kUnitBox, segment({0, 0, 0}, {1, 1, 1}))) << "from vertex to vertex";
  EXPECT_TRUE(covers(kUnitBox, segment({0, 0, 0}, {1, 1, 0}))) << "on an edge inside a flat part";
  EXPECT_TRUE(covers(kUnitBox, segment({1, 0, 0}, {0, 1, 0}))) << "across one";
  EXPECT_TRUE(covers(kUnitBox, segment({0, 0, 0}, {1, 0, 0})));
  EXPECT_TRUE(covers(kUnitBox, segment({0.25, 0, 0}, {0.75, 0, 0})));
  EXPECT_FALSE(covers(kUnitBox, segment({0, 0, 0}, {kAboveOne, 0, 0})));
  EXPECT_FALSE(covers(kUnitBox, segment({0.5, 0.5, 0.5}, {0.5, 0.5, kAboveOne})));
  EXPECT_FALSE(covers(kUnitBox, segment({-1, -1, 0.5}, {2, 2, 0.5}))) << "out, in, and out";
  EXPECT_FALSE(covers(kUnitBox, segment({-1, 1, 0.5}, {1, -1, 0.5}))) << "touches an edge from outside";
  EXPECT_TRUE(covers(octahedron(), segment({-1, 0, 0}, {1, 0, 0})));
  EXPECT_FALSE(covers(octahedron(), segment({1, -1, 0}, {1, 1, 0}))) << "touches a vertex from outside";
}

TEST(Cover, OfHullsThatIntersectThemselves) {
  const TriangleMesh both = together(box({-1, -1, -1}, {0.6, 2, 2}), box({0.4, -1, -1}, {2, 2, 2}));
  EXPECT_TRUE(covers(both, triangle({-1, -1, -1}, {2, -1, -1}, {2, 2, 2})));
  EXPECT_TRUE(covers(both, segment({-1, -1, -1}, {2, -1, -1}))) << "an edge of one, in part of both";
  const TriangleMesh crossed = together(both, inside_out(box({0.5, 0, 0}, {1, 1, 1})));
  EXPECT_GT(verify_cover(kUnitBox, crossed).self_intersections, 0u);
  // The cavity is one only where the boxes do not overlap: beyond 0.6.
  EXPECT_TRUE(covers(crossed, triangle({0.5, 0.2, 0.2}, {0.6, 0.2, 0.2}, {0.55, 0.5, 0.5})));
  EXPECT_TRUE(covers(crossed, triangle({0.6, 0.2, 0.2}, {0.6, 0.8, 0.2}, {0.6, 0.5, 0.5}))) << "on the wall between";
  EXPECT_FALSE(covers(crossed, triangle({0.7, 0.2, 0.2}, {0.8, 0.2, 0.2}, {0.75, 0.5, 0.5})));
  EXPECT_TRUE(covers(crossed, triangle({1, 0.2, 0.2}, {1, 0.8, 0.2}, {1, 0.5, 0.5})))
      << "on the far side of the cavity";
  // Faces that bound nothing on either side, where an inside-out box undoes another.
  const TriangleMesh undone = together(kUnitBox, inside_out(box({0, 0, 0}, {1, 1, 0.5})));
  EXPECT_FALSE(covers(undone, triangle({0.2, 0.2, 0}, {0.8, 0.2, 0}, {0.5, 0.8, 0})));
  EXPECT_FALSE(covers(undone, triangle({0, 0.2, 0.1}, {0, 0.8, 0.1}, {0, 0.5, 0.4})));
  EXPECT_FALSE(covers(undone, segment({0, 0.2, 0.1}, {0, 0.5, 0.4})));
  EXPECT_FALSE(covers(undone, point({0, 0, 0})));
  EXPECT_TRUE(covers(undone, triangle({0.2, 0.2, 0.5}, {0.8, 0.2, 0.5}, {0.5, 0.8, 0.5})));
  EXPECT_TRUE(covers(undone, segment({0, 0, 0.5}, {0, 0, 1})));
  EXPECT_FALSE(covers(undone, segment({0, 0, 0.25}, {0, 0, 1})));
}

TEST(Cover, OfTrianglesAcrossFacesOfOnePlaneOfWhichSomeBoundNothing) {
  const TriangleMesh half = together(subdivided(kUnitBox), inside_out(box({0, 0, 0}, {0.5, 1, 1})));
  EXPECT_TRUE(covers(half, triangle({0.5, 0.1, 0}, {0.9, 0.2, 0}, {0.6, 0.7, 0})));
  EXPECT_FALSE(covers(half, triangle({0.3, 0.2, 0}, {0.7, 0.2, 0}, {0.5, 0.3, 0})));
  EXPECT_FALSE(covers(half, triangle({0.1, 0.2, 0}, {0.4, 0.1, 0}, {0.3, 0.8, 0})));
}

TEST(Cover, OfTrianglesAcrossTheFoldOfASlit) {
  const TriangleMesh slit =
      tetrahedron({1, 1, 2}, {2, 1, 2}, {2, 2, 2}, {1, 2, 2});  // flat: folded along all four sides
  const TriangleMesh outer = together(box({0, 0, 0}, {4, 4, 4}), slit);
  EXPECT_TRUE(covers(outer, triangle({1.2, 1.5, 2}, {3, 1.5, 2}, {1.2, 1.8, 2})));
  EXPECT_FALSE(covers(outer, triangle({1.2, 1.5, 2}, {9, 1.5, 2}, {1.2, 1.8, 2})));
}

TEST(Cover, OfWhatAHullHasOfCavities) {
  const TriangleMesh shell = together(box({-1, -1, -1}, {2, 2, 2}), inside_out(box({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8})));
  EXPECT_TRUE(covers(shell, kUnitBox)) << "all triangles, though not all of the solid";
  EXPECT_FALSE(verify_enclosure(kUnitBox, shell).encloses);
  EXPECT_FALSE(covers(shell, triangle({0.3, 0.3, 0.3}, {0.5, 0.3, 0.3}, {0.4, 0.5, 0.3})));
  EXPECT_FALSE(covers(shell, point({0.5, 0.5, 0.5})));
  EXPECT_TRUE(covers(shell, box({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}))) << "the wall of the cavity itself";
}

TEST(Cover, OfPartsThatEnclosureExcuses) {
  const TriangleMesh pocket = inside_out(box({0.8, 0.4, 0.4}, {1.5, 0.6, 0.6}));
  EXPECT_TRUE(verify_enclosure(together(kUnitBox, pocket), kUnitBox).encloses) << "wound around -1 times";
  EXPECT_FALSE(covers(kUnitBox, together(kUnitBox, pocket)));
}

TEST(Cover, CountsTrianglesOutsideAndNamesTheFarthest) {
  TriangleMesh soup = triangle({0.1, 0.1, 0.1}, {0.9, 0.2, 0.3}, {0.4, 0.8, 0.7});
  for (const double z : {2.0, 4.0, 3.0, 2.0})
    soup = together(soup, triangle({0.5, 0.5, z}, {0.5, 0.5, 0.5}, {0.4, 0.4, z}));
  soup = together(soup, together(point({0.5, 0.5, 11}), segment({0.5, 0.5, 0}, {0.5, 0.5, -20})));
  const EnclosureReport report = verify_cover(soup, kUnitBox, {.max_offenders = 3});
  EXPECT_EQ(report.faces_outside, 6u);
  ASSERT_EQ(report.worst.size(), 3u);
  EXPECT_EQ(report.worst[0].face, FaceId(6));
  EXPECT_EQ(report.worst[0].distance, 20);
  EXPECT_EQ(report.worst[0].point, (Vec3{0.5, 0.5, -20}));
  EXPECT_EQ(report.worst[1].face, FaceId(5));
  EXPECT_EQ(report.worst[1].distance, 10);
  EXPECT_EQ(report.worst[2].face, FaceId(2));
  EXPECT_EQ(report.worst[2].distance, 3);
  EXPECT_EQ(report.outer_volume, 1);
  EXPECT_EQ(report.void_ratio, 0);
  const EnclosureReport first = verify_cover(soup, kUnitBox, {.most_outside = 1});
  EXPECT_FALSE(first.encloses);
  EXPECT_EQ(first.faces_outside, 2u) << "more were not looked for";
}

TEST(Cover, OfATriangleOutsideThatIsConnectedToOneInside) {
  // Both touch the hull in the corner that they share, and nothing else connects them.
  const TriangleMesh fan =
      make({{1, 0.5, 0.5}, {0.5, 0.2, 0.5}, {0.5, 0.8, 0.5}, {1.5, 0.2, 0.5}, {1.5, 0.8, 0.5}}, {{0, 1, 2}, {0, 3, 4}});
  EXPECT_EQ(verify_cover(fan, kUnitBox).faces_outside, 1u);
  // A strip that leaves through an edge of the hull that is an edge of the strip.
  const TriangleMesh strip = make({{1, 1, 0}, {1, 1, 1}, {0.5, 0.5, 0.5}, {1.5, 1.5, 0.5}}, {{0, 1, 2}, {1, 0, 3}});
  const EnclosureReport report = verify_cover(strip, kUnitBox);
  EXPECT_EQ(report.faces_outside, 1u);
  EXPECT_EQ(report.worst[0].face, FaceId(1));
}

TEST(Cover, TurnsTheHullOutwards) {
  EXPECT_TRUE(covers(inside_out(kUnitBox), kUnitBox));
  EXPECT_TRUE(covers(inside_out(kUnitBox), inside_out(kUnitBox)));
}

TEST(Cover, HoldsForHugeAndTinyCoordinates) {
  for (const double scale : {0x1p-1060, 0x1p-600, 0x1p600, 1e300}) {
    const TriangleMesh outer = scaled(octahedron(), scale);
    EXPECT_TRUE(covers(outer, scaled(subdivided(octahedron()), scale))) << scale;
    EXPECT_TRUE(covers(outer, scaled(segment({0.5, 0.5, 0}, {0, 0, 1}), scale))) << scale;
    EXPECT_FALSE(covers(outer, scaled(segment({0.75, 0.5, 0}, {0, 0, 1}), scale))) << scale;
    EXPECT_FALSE(covers(outer, scaled(triangle({0.75, 0.5, 0}, {0, 0, 1}, {0, 0, 0}), scale))) << scale;
  }
}

TEST(Cover, RefusesWhatItCannotDecide) {
  const auto defect_of = [](const TriangleMesh& triangles, const TriangleMesh& outer) {
    return error_of([&] { verify_cover(triangles, outer); }).defect();
  };
  TriangleMesh open = kUnitBox;
  open.triangles.pop_back();
  EXPECT_EQ(defect_of(kUnitBox, open), Defect::OpenEdge);
  EXPECT_NO_THROW(verify_cover(open, kUnitBox));
  EXPECT_EQ(defect_of({}, kUnitBox), Defect::EmptyMesh);
  EXPECT_EQ(defect_of(kUnitBox, {}), Defect::EmptyMesh);
  EXPECT_EQ(defect_of(point({0, 0, std::numeric_limits<double>::quiet_NaN()}), kUnitBox), Defect::NonFiniteCoordinate);
  EXPECT_EQ(defect_of(point({0, 0, std::numeric_limits<double>::infinity()}), kUnitBox), Defect::NonFiniteCoordinate);
  EXPECT_FALSE(is_closed(open));
  EXPECT_TRUE(is_closed(soup(kUnitBox)));
  EXPECT_TRUE(is_closed(inside_out(kUnitBox)));
}

TEST(Cover, ByAHullWithoutVolumeIsNone) {
  const TriangleMesh flat =
      together(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), triangle({0, 0, 0}, {0, 1, 0}, {1, 0, 0}));
  EXPECT_FALSE(covers(flat, triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})));
  EXPECT_FALSE(covers(flat, point({0, 0, 0})));
  EXPECT_FALSE(covers(point({0, 0, 0}), point({0, 0, 0}))) << "no face with an area at all";
}

TEST(Cover, CanBeCancelled) {
  EXPECT_THROW(verify_cover(kUnitBox, kUnitBox, {.progress = [](std::string_view, double) { return false; }}),
               Cancelled);
  double last = 0;
  verify_cover(kUnitBox, kUnitBox,
               {.progress = [&](std::string_view, double fraction) { return last = fraction, true; }});
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace prohull

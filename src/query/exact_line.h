#pragma once

#include "query/line.h"

namespace prohull {

// The exact answers behind the filters of line.cpp: slow, for all finite coordinates.

/// The sign of dot(direction, (p - o) cross (q - o)), the line not moved: 0 if it meets the line of the edge.
int exact_edge_sign(const DirectedLine& line, const Vec3& p, const Vec3& q);

/// The side of the point, not moved: 1 inside of the plane of the face, -1 outside.
int exact_point_sign(const Vec3& point, const Triangle& face);

/// The sign of component `axis` of (b - a) cross (d - c).
int exact_minor_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int axis);

/// The order in which the line, moved by (e, e^2, e^3), crosses the planes of two faces, to neither of which it is
/// parallel: -1 if the first comes first, 0 if they are one plane.
int exact_order(const DirectedLine& line, const Triangle& first, const Triangle& second);

/// Where the line, unmoved, crosses the plane of the face, to which it is not parallel; rounded.
double exact_parameter(const DirectedLine& line, const Triangle& face);

/// The point there, rounded.
Vec3 exact_crossing_point(const DirectedLine& line, const Triangle& face);

}  // namespace prohull

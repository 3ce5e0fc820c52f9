#pragma once

#include "query/line.h"

namespace prohull {

// The exact answers behind the filters of line.cpp: slow, for all finite coordinates, the line moved by (e, e^2, e^3).

/// The sign of dot(direction, p cross q), both seen from the moved origin: on which side the line passes the edge from
/// p to q. 0 only if the line is parallel to the edge.
int exact_edge_sign(const DirectedLine& line, const Vec3& p, const Vec3& q);

/// The side of the moved point: 1 inside of the plane of the face, -1 outside; 0 only if the face has no area.
int exact_point_sign(const Vec3& point, const Triangle& face);

/// The order in which the line crosses the planes of two faces, to neither of which it is parallel: -1 if the first
/// comes first, 0 if they are one plane.
int exact_order(const DirectedLine& line, const Triangle& first, const Triangle& second);

/// Where the line, unmoved, crosses the plane of the face, to which it is not parallel; rounded.
double exact_parameter(const DirectedLine& line, const Triangle& face);

}  // namespace prohull

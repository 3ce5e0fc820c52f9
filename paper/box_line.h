#pragma once

#include <cmath>
#include <limits>

#include "query/line.h"

namespace prohull {

/// A line as boxes see it (slab test), conservative: false only if the line, unmoved, certainly misses the box up to
/// some t. Slabs are given by their near and far planes along each axis.
///
/// (plane - origin) * inverse has a relative error of at most 3 eps + O(eps^2): of the difference, of 1 / direction,
/// and of the product, which may also underflow. It keeps its sign, so the far value, widened by 8 eps and a few of the
/// least doubles, against the near one is safe. Axes along which this does not hold, for the direction is not 0 but not
/// of a size whose inverse is a normal number, are left out: their origin is NaN, and NaN is never chosen below.
struct BoxLine {
  explicit BoxLine(const DirectedLine& line) {
    for (int axis = 0; axis < 3; ++axis) {
      const double d = line.direction[axis];
      origin[axis] = is_usable(d) ? line.origin[axis] : std::numeric_limits<double>::quiet_NaN();
      inverse[axis] = d == 0 ? std::numeric_limits<double>::infinity() : 1 / d;
      backwards[axis] = d < 0;
    }
  }

  static bool is_usable(double d) { return d == 0 || (std::abs(d) >= 0x1p-900 && std::abs(d) <= 0x1p1000); }
  static double widened(double far) { return far * (1 + 8 * line_filter::kEpsilon) + 0x1p-1070; }

  double origin[3], inverse[3];
  bool backwards[3];  ///< the near plane is that of the greater coordinate
};

/// The line is in the box only from t = from to t = to, and not at all if from > to. Certain: `to` is rounded up by
/// more than `from` may be too great.
struct Passage {
  bool is_empty() const { return from > to; }
  double from, to;
};

inline Passage passage(const BoxLine& line, const Box& box, double t_end) {
  double from = 0, to = t_end;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min[axis], high = box.max[axis];
    const double near = ((line.backwards[axis] ? high : low) - line.origin[axis]) * line.inverse[axis];
    const double far = ((line.backwards[axis] ? low : high) - line.origin[axis]) * line.inverse[axis];
    from = near > from ? near : from;
    to = far < to ? far : to;
  }
  return {from, BoxLine::widened(to)};
}

inline bool may_meet(const BoxLine& line, const Box& box, double t_end) {
  return !passage(line, box, t_end).is_empty();
}

/// False only if the line, unmoved, certainly has no point in common with the face, its corners and edges included.
inline bool may_meet(const DirectedLine& line, const Triangle& face) {
  using namespace line_filter;
  const FaceFromLine seen(line, face);
  if (seen.certainly_passed()) return false;
  // The origin certainly on one side of the plane, and the rest of the line too.
  const double start = seen.side();
  if (std::abs(start) <= seen.side_error()) return true;
  if (line.is_ray()) return !((start > 0 ? -seen.leaving() : seen.leaving()) > seen.leaving_error());
  const FaceFromPoint from_end(line.end, face);
  return !((start > 0 ? from_end.side() : -from_end.side()) > from_end.side_error());
}

}  // namespace prohull

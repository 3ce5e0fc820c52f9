#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <set>
#include <vector>

#include "prohull/geometry.h"

namespace prohull::oracle {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Exact::Point_3;

inline Point exact(const Vec3& v) { return {v.x, v.y, v.z}; }

/// One into each of the cones that planes through a point leave, by the normals of the planes, which are not parallel.
/// Each cone holds the sum of three of its edges, on which two of the planes meet.
inline std::vector<Exact::Vector_3> directions_between(const std::vector<Exact::Vector_3>& normals) {
  using Vector = Exact::Vector_3;
  std::vector<Vector> frame = normals;  // and planes more, so that all cones are pointed
  for (const Vector& axis : {Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)}) frame.push_back(axis);
  std::vector<Vector> edges, directions;
  for (std::size_t i = 0; i < frame.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const Vector e = CGAL::cross_product(frame[i], frame[j]); e != CGAL::NULL_VECTOR) {
        edges.push_back(e);
        edges.push_back(-e);
      }
  std::set<std::vector<int>> seen;
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const Vector d = edges[i] + edges[j] + edges[k];
        std::vector<int> sides;
        for (const Vector& n : normals) sides.push_back(CGAL::sign(n * d));
        if (std::find(sides.begin(), sides.end(), 0) == sides.end() && seen.insert(sides).second)
          directions.push_back(d);
      }
  return directions;
}

}  // namespace prohull::oracle

#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull::oracle {

// Decides enclosure by brute force and by other means than src/verify: solids are cut into tetrahedra by all planes
// around, and the winding number of a point is the signed count of the cones from an apex over all faces that hold it.

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Exact::Point_3;
using Tetrahedron = std::array<Point, 4>;

inline Point exact(const Vec3& v) { return {v.x, v.y, v.z}; }

struct Chain {
  std::vector<std::array<Point, 3>> faces;
  std::vector<CGAL::Bbox_3> boxes;

  explicit Chain(const TriangleMesh& mesh) {
    for (const FaceId f : mesh.triangles.ids()) {
      const Triangle t = mesh.triangle(f);
      faces.push_back({exact(t.a), exact(t.b), exact(t.c)});
      boxes.push_back(faces.back()[0].bbox() + faces.back()[1].bbox() + faces.back()[2].bbox());
    }
  }
};

/// None if x lies on the boundary of a cone.
inline std::optional<int> winding(const Chain& chain, const Point& apex, const Point& x) {
  int sum = 0;
  for (std::size_t f = 0; f < chain.faces.size(); ++f) {
    if (!CGAL::do_overlap(chain.boxes[f] + apex.bbox(), x.bbox())) continue;
    const auto& [a, b, c] = chain.faces[f];
    const int s = CGAL::orientation(apex, a, b, x), t = CGAL::orientation(apex, b, c, x);
    if (s * t < 0) continue;
    const int u = CGAL::orientation(apex, c, a, x);
    if (s * u < 0 || t * u < 0) continue;
    const int cone = CGAL::orientation(a, b, c, apex), base = CGAL::orientation(a, b, c, x);
    if (cone == 0 || cone == -base) continue;
    if (s == cone || t == cone || u == cone) continue;  // in the mirrored cone, behind the apex
    if (s == 0 || t == 0 || u == 0 || base == 0) return std::nullopt;
    sum -= cone;  // an apex inside sees the face clockwise: negative
  }
  return sum;
}

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

/// Cuts the tetrahedron by the plane: no piece has corners strictly on both sides.
inline void cut(const Tetrahedron& t, const std::array<Point, 3>& plane, std::vector<Tetrahedron>& pieces) {
  std::array<int, 4> side;
  for (int i = 0; i < 4; ++i) side[i] = CGAL::orientation(plane[0], plane[1], plane[2], t[i]);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j)
      if (side[i] * side[j] < 0) {
        const auto height = [&](const Point& p) {
          return CGAL::determinant(plane[1] - plane[0], plane[2] - plane[0], p - plane[0]);
        };
        const auto hi = height(t[i]), hj = height(t[j]);
        const Point x = t[i] + (t[j] - t[i]) * (hi / (hi - hj));
        for (const int replaced : {i, j}) {
          Tetrahedron half = t;
          half[replaced] = x;
          cut(half, plane, pieces);
        }
        return;
      }
  pieces.push_back(t);
}

inline Point random_point_in(const Tetrahedron& t, std::mt19937& random) {
  std::uniform_int_distribution<int> weight(100, 1000);
  const int w[] = {weight(random), weight(random), weight(random), weight(random)};
  return CGAL::barycenter(t[0], w[0], t[1], w[1], t[2], w[2], t[3], w[3]);
}

/// Cuts the pieces by the planes of the chain's faces, where those are near.
inline std::vector<Tetrahedron> cut(std::vector<Tetrahedron> pieces, const Chain& chain) {
  for (std::size_t f = 0; f < chain.faces.size(); ++f) {
    const auto& plane = chain.faces[f];
    if (CGAL::collinear(plane[0], plane[1], plane[2])) continue;
    std::vector<Tetrahedron> smaller;
    for (const Tetrahedron& t : pieces) {
      const CGAL::Bbox_3 box = t[0].bbox() + t[1].bbox() + t[2].bbox() + t[3].bbox();
      if (CGAL::do_overlap(box, chain.boxes[f]))
        cut(t, plane, smaller);
      else
        smaller.push_back(t);
    }
    pieces = std::move(smaller);
  }
  std::erase_if(pieces, [](const Tetrahedron& t) { return CGAL::coplanar(t[0], t[1], t[2], t[3]); });
  return pieces;
}

/// At any point inside a piece that the chain does not cut.
inline int winding(const Chain& chain, const Tetrahedron& piece, std::mt19937& random) {
  std::uniform_int_distribution<int> aside(-1000, 1000);
  for (;;) {
    // Far along an axis and only a little aside, so that few cones are near the point.
    const Point apex = piece[0] + Exact::Vector_3(1e-5 * aside(random), 1e-5 * aside(random), 1e4);
    if (const auto w = winding(chain, apex, random_point_in(piece, random))) return *w;
  }
}

/// Whether w_outer >= 1 wherever w_inner >= 1 inside the given tetrahedra.
inline bool encloses_within(const std::vector<Tetrahedron>& domain, const Chain& inner, const Chain& outer,
                            std::mt19937& random) {
  std::vector<Tetrahedron> solid = cut(domain, inner);
  std::erase_if(solid, [&](const Tetrahedron& t) { return winding(inner, t, random) < 1; });
  const std::vector<Tetrahedron> pieces = cut(solid, outer);
  return std::none_of(pieces.begin(), pieces.end(),
                      [&](const Tetrahedron& t) { return winding(outer, t, random) < 1; });
}

/// Turns neither mesh.
inline bool encloses(const TriangleMesh& inner, const TriangleMesh& outer, std::mt19937& random) {
  std::vector<Tetrahedron> cones;
  const Chain inner_chain(inner), outer_chain(outer);
  const Point apex = inner_chain.faces[0][0];
  for (const auto& [a, b, c] : inner_chain.faces)
    if (!CGAL::coplanar(a, b, c, apex)) cones.push_back({a, b, c, apex});
  return encloses_within(cones, inner_chain, outer_chain, random);
}

}  // namespace prohull::oracle

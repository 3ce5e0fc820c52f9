#include "construct/star.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/simd.h"

namespace prohull {

void gather_star(const HalfEdgeMesh& mesh, EdgeId edge, Star& star) {
  const HalfEdgeId h = mesh.half_edge(edge), g = mesh.twin(h);
  star.edge = h;
  star.o = mesh.tail(h), star.d = mesh.tail(g);
  star.link.clear();
  // Around o from l to the one before r, then around d from r to the one before l.
  for (HalfEdgeId a = mesh.rotated(h), end = mesh.next(g); a != end; a = mesh.rotated(a))
    star.link.push_back(mesh.tip(a));
  star.o_faces = star.link.size();
  for (HalfEdgeId a = mesh.rotated(g), end = mesh.next(h); a != end; a = mesh.rotated(a))
    star.link.push_back(mesh.tip(a));
}

bool satisfies_link_condition(const Star& star) {
  // Neighbours of one end are distinct already: only a neighbour of o may come again around d.
  const auto around_d = star.link.begin() + static_cast<std::ptrdiff_t>(star.o_faces);
  for (auto a = star.link.begin(); a != around_d; ++a)
    if (std::find(around_d, star.link.end(), *a) != star.link.end()) return false;
  return star.link.size() >= 3;
}

namespace {

// Of two faces (a, b, c), one in each lane, for places i and j.
void set_planes(Star& star, std::size_t i, std::size_t j, const Vec3Pair& a, const Vec3Pair& b, const Vec3Pair& c) {
  const Vec3Pair n = cross(b - a, c - a);
  const Double2 length = sqrt(dot(n, n));
  const Vec3Pair unit = n * (1 / length);
  const Double2 offset = dot(unit, a);
  const auto set = [&](std::size_t face, int lane) {
    star.double_areas[face] = length[lane];
    star.planes[face] = length[lane] > 0 ? HalfSpace{unit[lane], offset[lane]} : HalfSpace{{}, 0};
  };
  set(i, 0), set(j, 1);
}

}  // namespace

void measure_star(const HalfEdgeMesh& mesh, Star& star) {
  const Vec3 o = mesh.position(star.o), d = mesh.position(star.d);
  star.origin = o * 0.5 + d * 0.5;
  star.local.resize(star.link.size());
  double extent = 0;
  const auto reach = [&](const Vec3& p) { extent = std::max({extent, std::abs(p.x), std::abs(p.y), std::abs(p.z)}); };
  reach(o - star.origin);
  for (std::size_t i = 0; i < star.link.size(); ++i) reach(star.local[i] = mesh.position(star.link[i]) - star.origin);
  star.scale = extent > 0 ? std::max(extent, std::numeric_limits<double>::min()) : 1;
  const double inverse_scale = 1 / star.scale;
  for (Vec3& p : star.local) p = p * inverse_scale;
  star.local_o = (o - star.origin) * inverse_scale, star.local_d = (d - star.origin) * inverse_scale;

  const std::size_t n = star.link.size();
  star.planes.resize(n + 2), star.double_areas.resize(n + 2);
  for (std::size_t i = 0; i < n; i += 2) {
    const std::size_t j = i + 1 == n ? i : i + 1;
    set_planes(star, i, j, both(star.local_apex(i), star.local_apex(j)), both(star.local[i], star.local[j]),
               both(star.local[star.after(i)], star.local[star.after(j)]));
  }
  set_planes(star, n, n + 1, both(star.local_o, star.local_d), both(star.local_d, star.local_o),
             both(star.local[0], star.local[star.o_faces]));
}

}  // namespace prohull

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
  const auto go_around = [&](HalfEdgeId from, HalfEdgeId end) {
    while (true) {
      const HalfEdgeId before = mesh.previous(from);
      from = mesh.twin(before);
      if (from == end) return;
      star.link.push_back(mesh.tail(before));
    }
  };
  go_around(h, mesh.next(g));
  star.o_faces = star.link.size();
  go_around(g, mesh.next(h));
}

bool satisfies_link_condition(const Star& star) {
  // Neighbours of one end are distinct already: only a neighbour of o may come again around d.
  const auto around_d = star.link.begin() + static_cast<std::ptrdiff_t>(star.o_faces);
  for (auto a = star.link.begin(); a != around_d; ++a)
    if (std::find(around_d, star.link.end(), *a) != star.link.end()) return false;
  return star.link.size() >= 3;
}

namespace {

// Of faces i and i + 1, (a, b, c) in each lane; i is even.
void set_planes(Star& star, std::size_t i, const Vec3Pair& a, const Vec3Pair& b, const Vec3Pair& c) {
  const Vec3Pair n = cross(b - a, c - a);
  const Double2 length = sqrt(dot(n, n));
  const Vec3Pair unit = n * (1 / length);
  const Truth2 has_area = length > 0;
  const auto of_area = [&](Double2 x, double otherwise) { return select(has_area, x, both(otherwise)); };
  star.planes.pairs()[i / 2] = {{of_area(unit.x, 0), of_area(unit.y, 0), of_area(unit.z, 0)},
                                of_area(dot(unit, a), std::numeric_limits<double>::lowest())};
  star.double_areas[i] = length[0], star.double_areas[i + 1] = length[1];
}

}  // namespace

void measure_star(const HalfEdgeMesh& mesh, Star& star) {
  const Vec3 o = mesh.position(star.o), d = mesh.position(star.d);
  star.origin = o * 0.5 + d * 0.5;
  star.local.resize(star.link.size());
  const Vec3Pair origin = both(star.origin);
  Double2 reach = both(0);
  const auto reach_to = [&](const Vec3Pair& p) { reach = max(max(abs(p.x), abs(p.y)), max(abs(p.z), reach)); };
  reach_to(both(o) - origin);
  for (std::size_t i = 0; i < star.link.size(); i += 2) {
    const std::size_t j = std::min(i + 1, star.link.size() - 1);
    const Vec3Pair p = both(mesh.position(star.link[i]), mesh.position(star.link[j])) - origin;
    star.local[i] = p[0], star.local[j] = p[1];
    reach_to(p);
  }
  const double extent = std::max(reach[0], reach[1]);
  star.scale = extent > 0 ? std::max(extent, std::numeric_limits<double>::min()) : 1;
  const double inverse_scale = 1 / star.scale;
  for (Vec3& p : star.local) p = p * inverse_scale;
  star.local_o = (o - star.origin) * inverse_scale, star.local_d = (d - star.origin) * inverse_scale;

  const std::size_t n = star.link.size();
  star.planes.resize(n + 2), star.double_areas.resize((n + 3) / 2 * 2);
  const Vec3 &local_o = star.local_o, &local_d = star.local_d, &l = star.local[0], &r = star.local[star.o_faces];
  for (std::size_t i = 0; i + 1 < n; i += 2)
    set_planes(star, i, both(star.local_apex(i), star.local_apex(i + 1)), both(star.local[i], star.local[i + 1]),
               both(star.local[i + 1], star.local[star.after(i + 1)]));
  if (n % 2 == 0) {
    set_planes(star, n, both(local_o, local_d), both(local_d, local_o), both(l, r));
  } else {
    set_planes(star, n - 1, both(star.local_apex(n - 1), local_o), both(star.local[n - 1], local_d), both(l));
    set_planes(star, n + 1, both(local_d), both(local_o), both(r));
    star.double_areas.back() = 0;
  }
}

}  // namespace prohull

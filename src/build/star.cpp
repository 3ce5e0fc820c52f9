#include "build/star.h"

#include <algorithm>
#include <cmath>

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

void add_plane(Star& star, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(b - a, c - a);
  const double length = norm(n);
  const Vec3 unit = length > 0 ? n / length : Vec3{};
  star.planes.push_back({unit, dot(unit, a)});
  star.double_areas.push_back(length);
}

}  // namespace

void measure_star(const HalfEdgeMesh& mesh, Star& star) {
  const Vec3 o = mesh.position(star.o), d = mesh.position(star.d);
  star.origin = o * 0.5 + d * 0.5;
  star.local.clear();
  double extent = 0;
  const auto reach = [&](const Vec3& p) { extent = std::max({extent, std::abs(p.x), std::abs(p.y), std::abs(p.z)}); };
  reach(o - star.origin);
  for (const VertexId v : star.link) {
    star.local.push_back(mesh.position(v) - star.origin);
    reach(star.local.back());
  }
  star.scale = extent > 0 ? extent : 1;
  for (Vec3& p : star.local) p = p / star.scale;
  star.local_o = (o - star.origin) / star.scale, star.local_d = (d - star.origin) / star.scale;

  star.planes.clear(), star.double_areas.clear();
  for (std::size_t i = 0; i < star.link.size(); ++i)
    add_plane(star, star.local_apex(i), star.local[i], star.local[star.after(i)]);
  add_plane(star, star.local_o, star.local_d, star.local[0]);
  add_plane(star, star.local_d, star.local_o, star.local[star.o_faces]);
}

}  // namespace prohull

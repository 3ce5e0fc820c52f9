#pragma once

#include <vector>

#include "geometry/linear_program.h"
#include "mesh/half_edge_mesh.h"

namespace prohull {

/// The star of an edge o-d, in a frame of its own: origin at the edge's midpoint, about 1 in size, so that thresholds
/// are relative and no product overflows.
struct Star {
  HalfEdgeId edge;
  VertexId o, d;
  /// Counter-clockwise, from l. Face i < o_faces is (o, link[i], link[i+1]), the others are (d, link[i], link[i+1]).
  std::vector<VertexId> link;
  std::size_t o_faces;

  Vec3 origin;
  double scale;             ///< input unit = local unit * scale
  std::vector<Vec3> local;  ///< of link
  Vec3 local_o, local_d;

  /// The supporting planes of the faces, unit normals outwards; those along the link, then (o, d, l) and (d, o, r).
  /// A face without area has a zero normal, and an offset with which it constrains nothing.
  HalfSpaces planes;
  std::vector<double> double_areas;  ///< of an even number: where the faces are odd, a last one is 0

  std::size_t valence() const { return link.size(); }
  VertexId apex(std::size_t i) const { return i < o_faces ? o : d; }
  const Vec3& local_apex(std::size_t i) const { return i < o_faces ? local_o : local_d; }
  std::size_t after(std::size_t i) const { return i + 1 == link.size() ? 0 : i + 1; }
  Vec3 to_input(const Vec3& p) const { return origin + p * scale; }
  Vec3 to_local(const Vec3& p) const { return (p - origin) * (1 / scale); }
};

/// Vertices only; the rest is as it was.
void gather_star(const HalfEdgeMesh& mesh, EdgeId edge, Star& star);

/// Dey, Edelsbrunner, Guha, Nekhayev 1999: o and d have no common neighbour but l and r. Requires gather_star.
bool satisfies_link_condition(const Star& star);

/// Coordinates, planes and areas. Requires gather_star.
void measure_star(const HalfEdgeMesh& mesh, Star& star);

/// P&T Figure 3: visits the edges whose star has a face around s, which are those with an end on s or its link. Some
/// are visited twice.
template <class Visit>
void visit_edges_around(const HalfEdgeMesh& mesh, VertexId s, Visit visit) {
  for (const HalfEdgeId h : mesh.around(s)) {
    const HalfEdgeId back = mesh.twin(h);
    visit(mesh.edge(h));
    // Edges between two link vertices are met from both: the one beside s is left to its own tail.
    HalfEdgeId g = mesh.rotated(back);
    visit(mesh.edge(g));
    for (g = mesh.rotated(g); mesh.rotated(g) != back; g = mesh.rotated(g)) visit(mesh.edge(g));
  }
}

}  // namespace prohull

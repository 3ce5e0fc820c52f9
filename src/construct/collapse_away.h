#pragma once

#include <optional>
#include <utility>

#include "construct/placement.h"
#include "construct/shape_guards.h"
#include "construct/star.h"
#include "mesh/half_edge_mesh.h"

namespace prohull {

/// Removes v by the collapse of an edge of v that adds the least volume, its shape within the guards if any is. Storing
/// a vertex, by stored(position), moves its coordinates by up to `rounding`. Whether there was such a collapse: the new
/// vertex is outside of or on the planes of all faces that it replaces. `star` is scratch.
template <class Stored>
bool collapse_away(HalfEdgeMesh& mesh, VertexId v, Star& star, double rounding, Stored stored) {
  struct Choice {
    bool misshapen;
    double added_volume;
    HalfEdgeId edge;
    Vec3 apex;
  };
  std::optional<Choice> best;
  const auto rank = [](const Choice& c) { return std::pair(c.misshapen, c.added_volume); };
  for (const HalfEdgeId h : mesh.around(v)) {
    gather_star(mesh, mesh.edge(h), star);
    if (!satisfies_link_condition(star)) continue;
    measure_star(mesh, star);
    const auto placement = place_outside(star, placement_margin(star, rounding));
    if (!placement) continue;
    const Choice choice{refused_shape(star, placement->local, {}).has_value(), placement->added_volume, star.edge,
                        stored(star.to_input(placement->local))};
    if (is_outside(mesh, star, choice.apex) && (!best || rank(choice) < rank(*best))) best = choice;
  }
  if (best) mesh.collapse(best->edge, best->apex);
  return best.has_value();
}

}  // namespace prohull

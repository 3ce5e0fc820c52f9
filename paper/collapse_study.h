#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "prohull/hull_builder.h"
#include "prohull/progressive_hull.h"

namespace prohull {

// For study: what the construction of an outer hull saw at each of its collapses. Collapse i of a hull is the one that
// made made_vertex(i), and its mesh is the level that it changed.

/// A collapse, its linear program, and what another place of the new vertex would do (P&T Figures 1 and 2).
struct StudiedCollapse {
  TriangleMesh star;      ///< of the edge; vertices: o, d and the link, counter-clockwise from l
  Vec3 made;              ///< where the collapse put the new vertex
  Vec3 optimum;           ///< of the linear program
  double optimal_volume;  ///< what the optimum adds
  Vec3 steepest;          ///< the direction in which the added volume grows most, of length 1
  /// Of each face of the star, exactly: 1 if the asked place is outside of its plane, 0 if it is on it, -1 if it is
  /// inside.
  std::vector<std::int8_t> sides;
  double added_volume;  ///< by the asked place (formula 3); not a volume where it is inside of a plane
};

/// `place` is the asked place; nothing: that of the collapse. Throws InputError(InvalidOption) for a collapse that the
/// hull does not have, an inner hull, and a place that is not finite; InputError(NoCertificate) if the program has no
/// answer, as of no hull that build_hull makes.
StudiedCollapse study_collapse(const ProgressiveHull& hull, std::size_t i, const std::optional<Vec3>& place = {});

/// An edge in the priority queue (P&T 3.1.3).
struct QueuedEdge {
  std::array<VertexId, 2> ends;    ///< of ProgressiveHull::positions()
  double priority;                 ///< of no meaning if the edge is refused
  std::optional<Refusal> refusal;  ///< why it cannot be collapsed: its topology, its program, or the shape (3.1.4)
  bool is_renewed;                 ///< the collapse before changed its star (P&T Figure 3)
};

/// All edges of the mesh of collapse i, or of the base mesh, those that can be collapsed first, the least priority
/// first. `options` has the strategy, one of the paper's two, and the guards. Throws as study_collapse does.
std::vector<QueuedEdge> queue_before(const ProgressiveHull& hull, std::size_t i, const HullOptions& options);

}  // namespace prohull

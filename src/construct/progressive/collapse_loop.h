#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "construct/growth.h"
#include "construct/guard/tolerance_guard.h"
#include "geometry/mirror_plane.h"
#include "geometry/unit_cube.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/hull_builder.h"

namespace prohull {

/// What is known of an edge between its visits. Times order changes, from 1 on.
struct EdgeFacts {
  double priority = kUnknown;
  std::uint32_t evaluated = 0;  ///< when the priority was that of the star, or the edge was refused
  Refusal last_refusal = Refusal::LinkCondition;
  bool is_refused = false;  ///< not to be tried again before its star changes

  static constexpr double kUnknown = -1;
};

struct VertexFacts {
  std::uint32_t changed = 1;  ///< when a face around it last did
  bool is_free = true;        ///< strictly inside of the patch
  bool has_refused = false;   ///< an edge that ends here may be refused
  bool is_kept = false;       ///< a corner of a face that stays as it is

  bool may_go() const { return is_free && !is_kept; }
};

/// A part of a surface, or all of it, to be simplified on its own: only stars that lie strictly inside of a box, before
/// and after. The faces that reach into the box from outside belong to the mesh too, but stay as they are.
struct Patch {
  HalfEdgeMesh mesh;  ///< faces that lie together in space should have numbers near each other
  PerEdge<EdgeFacts> edges;
  PerVertex<VertexFacts> vertices;
  FloatBox inside;  ///< in the coordinates of CollapseRules::unit_cube
  std::size_t target_faces;
  double max_priority;  ///< edges of greater priorities are left
  std::uint32_t time;   ///< of the next collapse
  std::uint64_t seed;   ///< of the noise in the priorities; 0: none
  Tolerances tolerances = {};
  PerHalfEdge<HalfEdgeId> images = {};  ///< mirrored; empty unless CollapseRules::mirror

  // What the loop brings forth.
  std::vector<VertexSplit> record = {};
  std::vector<double> priorities = {};  ///< of each collapse, the greatest until then
  RefusalCounts refusals = {};
  std::size_t linear_programs = 0;
  std::size_t visited_faces = 0;  ///< of the stars that were looked at: where the time goes if there are hubs
};

/// What all patches of a construction share.
struct CollapseRules {
  const HullOptions& options;
  const UnitCube& unit_cube;
  const Box& box;   ///< of the mesh: what the overhang is measured from
  double rounding;  ///< the most by which storing moves a coordinate, with some room
  std::function<void(std::size_t removed_faces)> tell;  ///< called now and then, from any thread; may throw Cancelled
  std::optional<MirrorPlane> mirror = {};               ///< keep the mesh its own image; a patch is all of it then
  MayReach may_reach = {};
};

/// Estimates the priorities that are not yet known.
void estimate_priorities(Patch& patch, const CollapseRules& rules);

/// Collapses edges, the least priority first, until the target is reached or no edge up to max_priority is left that
/// may be collapsed. Requires that priorities are known.
void run_collapse_loop(Patch& patch, const CollapseRules& rules);

}  // namespace prohull

#pragma once

#include <span>
#include <string_view>

#include "prohull/mesh_query.h"

namespace prohull {

// Engines by name: those of the library, and those that only the paper's study needs (docs/queries.md).
// refinement: P&T 3.2.1 with bounds, for a hull: splits every vertex with something below it that the query may meet.
//
// paper-refinement: P&T 3.2.1 as published, for a hull: splits the corners of the hull faces that the query meets. Of a
// segment or ray that starts outside of an outer base hull it finds the first crossing into the solid always. It may
// miss crossings further in, where the query passes below the hull (P&T Figure 5), and sheets without thickness. Hulls
// that are kept from query to query are finer, and may miss less. It cannot tell what is inside, and refuses that.
//
// walk: follows the line through the void between base hull and mesh, tetrahedron by tetrahedron, of an outer hull, or
// of an outer and an inner one. With both it finds every crossing. With the outer hull alone it finds those from which
// the line comes to the base mesh without crossing the mesh again. These include the first hit of every segment or ray
// that starts outside of the bounding box of the base mesh, if the mesh winds around no point a negative number of
// times.
//
// kdop6, kdop6-overlap, ...: trees of k-DOPs over the mesh (kdop_index.h).

/// What becomes of the refined hull between one query and the next (P&T 3.2.2).
enum class BetweenQueries {
  RollBack,  ///< after every `queries_per_roll_back` queries it goes back to the base hull
  Coarsen,   ///< it is kept, and coarsened where the query no longer meets it
};

/// Of the two engines that refine.
struct RefinementOptions {
  BetweenQueries between = BetweenQueries::RollBack;
  unsigned queries_per_roll_back = 1;  ///< at least 1
};

/// Those of the library, then those for hulls.
std::span<const std::string_view> hull_engine_names();
/// Those, and the trees of k-DOPs.
std::span<const std::string_view> all_engine_names();
/// Whether the engine may miss hits of segments and rays, as written above. `with_inner`: it has an inner hull, too.
bool may_miss_hits(std::string_view engine, bool with_inner = false);

// An index that asks the engine with one of these names. They throw as the constructors of QueryIndex do:
// InputError(InvalidOption) for a name or an option that is none of these, and for an engine that needs a hull, another
// one or two; and `walk` InputError(NoCertificate) if a record is not one of a hull (verify_replay).
QueryIndex index_called(std::string_view engine, TriangleMesh mesh);
QueryIndex index_called(std::string_view engine, const ProgressiveHull& hull, const RefinementOptions& options = {});
/// The engines that refine use the outer hull; the trees, the mesh.
QueryIndex index_called(std::string_view engine, const ProgressiveHull& outer, const ProgressiveHull& inner);

}  // namespace prohull

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/detail/names.h"
#include "prohull/triangle_mesh.h"

namespace prohull::cli {

/// What an engine takes as convex pieces, by its documentation; engine_rules.cpp says where each rule stands.
struct EngineRules {
  std::vector<std::string> suffixes = {};     ///< of files that it reads; empty: any, as pieces reach it by code
  std::size_t vertices = 0, polygons = 0;     ///< the most that a piece may have; 0: no limit is known
  std::string_view prefix = {}, suffix = {};  ///< around the names of pieces, by which the engine knows them
  bool named_as_mesh = false;                 ///< pieces have the name of the mesh file, not of the output
};

/// The largest numbers of vertices and polygons of a piece. Each triangle counts as a polygon, so that an engine that
/// joins coplanar ones has no more.
struct PieceSize {
  std::size_t vertices = 0, polygons = 0;
};

/// By the names that --for takes.
Names<const EngineRules*> engine_names();

/// The sizes of pieces whose triangles follow each other in `mesh`: `faces` says how many each has.
PieceSize largest_piece(const TriangleMesh& mesh, const std::vector<std::size_t>& faces);

/// The largest number of vertices with which every convex piece is within the limits.
std::size_t most_vertices(const EngineRules& rules);

bool is_within(const PieceSize& size, const EngineRules& rules);

}  // namespace prohull::cli

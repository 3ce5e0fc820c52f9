#pragma once

#include <cstddef>
#include <memory>

#include "prohull/progressive_hull.h"
#include "query/engine.h"

namespace prohull {

/// Levels of two hulls decide what they can, and a tree over the mesh the rest; see Engine::Filter. `mesh` is the
/// original mesh of both hulls. Throws as VoidComplex does.
std::unique_ptr<QueryEngine> make_filter_engine(const TriangleMesh& mesh, const ProgressiveHull& outer,
                                                const ProgressiveHull& inner);

/// Whether Engine::Auto takes the filter for two hulls of a mesh of so many faces; docs/queries.md has what was
/// measured.
bool filter_pays(std::size_t faces);

}  // namespace prohull

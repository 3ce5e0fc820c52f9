#pragma once

#include <cstddef>

#include "construct/tight/original.h"
#include "prohull/hull_builder.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// Up to so many faces a tight hull is searched on from.
constexpr std::size_t kFewFaces = 200;

/// Searches on from a tight hull of few faces, by trials. The result has at most as many faces, at most as much volume
/// and at most as many pairs of intersecting faces as `hull`. It encloses the original too, and keeps the guards of
/// shape. HullOptions::seed decides what is tried, and HullOptions::tight_trials how often. Inner hulls and their
/// original are turned inside out.
///
/// A trial puts new vertices on some edges, moves them towards the original, and collapses those edges that add least,
/// until the hull has as few faces as before. So faces go to where they are worth more. The hull that comes of it is
/// kept if it has less volume, or at first hardly more: some of these are on the way to better ones.
TriangleMesh with_less_volume(const TriangleMesh& hull, const Original& original, const HullOptions& options);

}  // namespace prohull

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull::bench {

/// A kind of segments to ask a mesh with. The same arguments give the same bits everywhere.
struct SegmentSet {
  std::string_view name;
  std::string_view what;
  /// About `count` segments, all of some length. Requires a mesh whose faces have areas that are normal doubles.
  std::vector<Segment> (*make)(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed);
  bool is_coherent = false;  ///< neighbours in the list take nearly the same way
};

/// Segments at random, at the surface, of a camera and for ambient occlusion.
std::span<const SegmentSet> common_sets();

/// Segments that pass exactly, or nearly, through vertices and edges.
std::span<const SegmentSet> aimed_sets();

}  // namespace prohull::bench

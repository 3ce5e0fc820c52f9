#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "prohull/detail/shapes.h"
#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"
#include "prohull/verdict.h"

namespace prohull {

/// More balls of a cover are refused: time and memory grow with their number.
inline constexpr std::size_t kMostCoverBalls = 100'000;

struct SphereCoverOptions {
  std::size_t max_balls = 64;  ///< at least 1, at most kMostCoverBalls
  /// How far the balls may reach (Verdict::distance), in the input's unit. With it the cover has as few balls as keep
  /// it, at most max_balls.
  double max_distance = std::numeric_limits<double>::infinity();
  bool fill = false;       ///< cover the inside too, not only the surface
  unsigned threads = 0;    ///< 0: one for each core; the cover is the same for any number
  Progress progress = {};  ///< stages of enclosing_hulls, then "spheres" and "verify"
};

struct SphereCover {
  /// Their numbers have the 24 bits of float32, as planners on GPUs read them, unless the mesh is so far from the
  /// origin that these would be too coarse.
  std::vector<Ball> balls;
  /// By verify_union. Where the input is not closed, but can be (repaired_mesh), its solid is the closed mesh. If it
  /// cannot, Verdict::distance_to_solid is from a wrap and its inside; `encloses_solid` is never about a wrap.
  Verdict verdict;
  bool is_of_wrap = false;         ///< the input bounds no solid, and a wrap counts as one in distances
  bool fills_wrap = false;         ///< the inside of the wrap is covered, as SphereCoverOptions::fill asks
  double volume = 0;               ///< of the union; overlaps count once
  double original_volume = 0;      ///< as EnclosingHulls::volume; 0 if the triangles bound nothing
  bool is_estimated = false;       ///< `original_volume` is an estimate
  bool within_bounds = true;       ///< max_distance is kept
  std::vector<std::string> notes;  ///< sentences for the user
  double seconds = 0, verify_seconds = 0;
};

/// Covers triangles by balls, so that the balls reach out as little as possible. Guaranteed: `verdict` is decided
/// exactly, on the doubles returned, by code that shares nothing with the search.
///
/// Throws InputError if no triangle is finite, and for options outside of their range; Cancelled.
///
///     const SphereCover cover = sphere_cover(read_mesh("link.stl"), {.max_balls = 64});
SphereCover sphere_cover(TriangleMesh triangles, const SphereCoverOptions& options = {});

}  // namespace prohull

#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "prohull/detail/shapes.h"
#include "prohull/distance.h"
#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

struct SphereCoverOptions {
  std::size_t max_balls = 64;  ///< at least 1
  /// How far the balls may reach (SphereCover::reach), in the input's unit. With it the cover has as few balls as keep
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
  bool certified = false;      ///< the balls cover, proven exactly (verify_union)
  bool covers_inside = false;  ///< what was proven: also the inside
  /// How far the balls reach out of the solid, or of a wrap if there is none. What closes openings of the input belongs
  /// to the solid, and the inside of a wrap does.
  DistanceBounds reach;
  DistanceBounds reach_from_triangles;  ///< the same from the triangles alone
  bool original_closed = false;         ///< the input bounds a solid by itself: `covers_inside` is about that
  bool has_openings = false;            ///< the input has openings that count as closed: the two may differ
  bool is_of_wrap = false;              ///< the input bounds no solid, and a wrap counts as one: the two may differ
  std::size_t non_finite_faces = 0;     ///< faces of the input that were left out: a corner is not finite
  double volume = 0;                    ///< of the union; overlaps count once
  double original_volume = 0;           ///< as EnclosingHulls::volume; 0 if the triangles bound nothing
  bool is_estimated = false;            ///< `original_volume` is an estimate, from a wrap
  bool within_bounds = true;            ///< max_distance is kept
  std::vector<std::string> notes;       ///< sentences for the user
  double seconds = 0, verify_seconds = 0;
};

/// Covers triangles by balls, so that the balls reach out as little as possible. Guaranteed: `certified` is decided
/// exactly, on the doubles returned, by code that shares nothing with the search.
///
/// Throws InputError if no triangle is finite, and for options outside of their range; Cancelled.
///
///     const SphereCover cover = sphere_cover(read_mesh("link.stl"), {.max_balls = 64});
SphereCover sphere_cover(TriangleMesh triangles, const SphereCoverOptions& options = {});

}  // namespace prohull

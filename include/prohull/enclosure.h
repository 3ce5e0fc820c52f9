#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// A triangle of the inner mesh of which a part lies outside of the outer mesh.
struct Offender {
  FaceId face;         ///< of the inner mesh
  Vec3 point;          ///< a point of it outside of the outer mesh, rounded to double
  double distance = 0; ///< from there to the outer mesh, in the input's unit, rounded
};

struct EnclosureReport {
  bool encloses = false;               ///< the verdict, exact
  std::size_t faces_outside = 0;       ///< triangles of the inner mesh of which a part lies outside
  std::vector<Offender> worst;         ///< the farthest of them, farthest first
  std::size_t cavities = 0;            ///< connected parts of the outer mesh that lie inside the inner solid: holes in the cover
  std::size_t self_intersections = 0;  ///< pairs of faces of the outer mesh that meet beyond shared corners and edges; exact
  double inner_volume = 0, outer_volume = 0;
  double void_ratio = 0;               ///< (volume of outer - volume of inner) / volume of inner
};

struct EnclosureOptions {
  std::size_t max_offenders = 5;
  bool count_self_intersections = true;
  std::function<bool(double fraction)> progress;  ///< called now and then with [0, 1]; false cancels
};

/// Decides by exact predicates whether `outer` encloses `inner`, both closed and oriented either way (see docs/theory):
/// whether every point that `inner` winds around at least once is wound around at least once by `outer`. Meshes may touch,
/// share faces, self-intersect, have several components and cavities. No tolerance anywhere.
/// Shares nothing with the construction of hulls but geometry/.
/// Throws InputError if a mesh is empty, not closed (edges are matched by position) or has a non-finite coordinate.
EnclosureReport verify_enclosure(const TriangleMesh& inner, const TriangleMesh& outer,
                                 const EnclosureOptions& options = {});

}  // namespace prohull

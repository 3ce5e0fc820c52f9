#pragma once

#include <cstddef>
#include <vector>

#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// A triangle of the inner mesh of which a part lies outside of the outer mesh.
struct Offender {
  FaceId face;          ///< of the inner mesh
  Vec3 point;           ///< a point of it outside of the outer mesh, rounded to double
  double distance = 0;  ///< from there to the outer mesh, in the input's unit, rounded
};

struct EnclosureReport {
  bool encloses = false;          ///< the verdict, exact
  std::size_t faces_outside = 0;  ///< triangles of the inner mesh of which a part lies outside; exact
  std::vector<Offender> worst;    ///< the farthest of them, farthest first
  std::size_t cavities = 0;       ///< connected parts of the outer mesh that leave a hole in the cover by themselves
  /// Pairs of faces of the outer mesh that meet beyond shared corners and edges; exact. Faces without area do not
  /// count.
  std::size_t self_intersections = 0;
  double inner_volume = 0, outer_volume = 0;
  double void_ratio = 0;  ///< (volume of outer - volume of inner) / volume of inner; 0 if inner has none
};

struct EnclosureOptions {
  std::size_t max_offenders = 5;
  Progress progress = {};  ///< stage "verify"
};

/// Decides whether `outer` encloses `inner`: whether every point, off both surfaces, that `inner` winds around at least
/// once is wound around at least once by `outer`. Guaranteed: the answer is exact for all finite coordinates, by exact
/// predicates and constructions, without any tolerance. It shares nothing with the construction of hulls but geometry/.
///
/// Required: two closed meshes (along every edge, matched by position, faces run as often one way as the other). They
/// may touch, share vertices, edges and faces, overlap in a plane, intersect themselves, have faces without area,
/// several components and cavities. A mesh with a negative volume is turned first, as a whole: single components that
/// face inwards are cavities (turned_outwards turns those that cannot be). Parts of a self-intersecting `inner` that it
/// winds around zero or fewer times need no cover.
///
/// Throws InputError if a mesh is empty, not closed or has a non-finite coordinate; Cancelled.
///
///     const EnclosureReport report = verify_enclosure(original, hull);
///     if (!report.encloses && !report.worst.empty()) show(report.worst[0].face, report.worst[0].point);
EnclosureReport verify_enclosure(const TriangleMesh& inner, const TriangleMesh& outer,
                                 const EnclosureOptions& options = {});

/// Whether a mesh is closed as verify_enclosure requires it: along every edge, matched by position, faces run as often
/// one way as the other. Throws InputError if the mesh is empty or not finite.
bool is_closed(const TriangleMesh& mesh);

/// Decides whether `outer` covers every one of the triangles: whether each of their points lies in the solid that
/// `outer` bounds, the closure of what it winds around at least once off its surface. Guaranteed: the answer is exact
/// for all finite coordinates, without any tolerance; no triangle is left out. It shares nothing with the construction
/// of hulls but geometry/. The time is nearly linear in the faces of `outer` plus the triangles: a few triangles are
/// quickly compared with a big hull.
///
/// Required: `outer` closed, as for verify_enclosure, and turned like there. The triangles may be any: open,
/// non-manifold, not oriented, repeated, intersecting each other, in several parts; those without area count as the
/// segments and points that they are. What they bound together is nothing to this function: a closed mesh is covered,
/// but not enclosed, by a thick shell around it; verify_enclosure tells.
///
/// In the report `faces_outside` and `worst` are about the triangles; cavities, inner_volume and void_ratio are 0.
/// Throws InputError if there is no triangle or a coordinate is not finite (drop such triangles first, and say so), or
/// if `outer` is empty or not closed; Cancelled.
///
///     const bool proven = is_closed(original) ? verify_enclosure(original, hull).encloses
///                                             : verify_cover(original, hull).encloses;
EnclosureReport verify_cover(const TriangleMesh& triangles, const TriangleMesh& outer,
                             const EnclosureOptions& options = {});

/// The mesh turned as a whole if its volume is negative, then each component, connected by edges, whose volume is
/// negative although it lies outside of the others, where it cannot be a cavity. What is verified against an original
/// mesh is verified against this, as hulls are built from it. Exact. Throws InputError if the mesh is empty or not
/// finite.
TriangleMesh turned_outwards(TriangleMesh mesh);

/// Pairs of faces of any triangles that meet beyond shared corners and edges, which are matched by position; faces
/// without area do not count. Exact. Throws InputError if the mesh is empty or not finite.
std::size_t count_self_intersections(const TriangleMesh& mesh);

}  // namespace prohull

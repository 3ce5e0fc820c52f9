#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// A triangle of the inner mesh that lies, in part, outside of the outer mesh.
struct Offender {
  FaceId face;          ///< its number in the inner mesh
  Vec3 point;           ///< a point of the triangle outside of the outer mesh, rounded to double
  double distance = 0;  ///< from that point to the outer mesh, in the input's unit, rounded
};

struct EnclosureReport {
  bool encloses = false;  ///< the verdict, exact
  /// How many triangles of the inner mesh lie outside, at least in part; exact. Those on the surface of the outer mesh
  /// do not, even if the solid that they bound goes on beyond it.
  std::size_t faces_outside = 0;
  std::vector<Offender> worst;  ///< those that reach farthest outside, the farthest first
  /// Faces, of either mesh, that EnclosureOptions::max_steps left undecided. If there are any, `encloses` is false, and
  /// there may be more faces outside and more cavities.
  std::size_t faces_undecided = 0;
  /// Connected parts of the outer mesh that leave a hole in the solid it bounds; exact. They are looked for only if
  /// faces_outside is 0.
  std::size_t cavities = 0;
  /// Pairs of faces of the outer mesh that meet beyond shared corners and edges; exact. Faces without area do not
  /// count.
  std::size_t self_intersections = 0;
  double inner_volume = 0, outer_volume = 0;
  double void_ratio = 0;  ///< (volume of outer - volume of inner) / volume of inner; 0 if inner has none
};

struct EnclosureOptions {
  std::size_t max_offenders = 5;
  /// Ends the search once more faces than so many are known to lie outside: the answer is no, and `faces_outside` and
  /// `worst` are those found until then.
  std::size_t most_outside = std::numeric_limits<std::size_t>::max();
  Progress progress = {};  ///< stage "verify"
  /// Ends the search where faces meet very many others: a step looks at a pair of segments in which others meet a face,
  /// in about 0.1 microseconds. Faces that would take more are undecided. The same number decides the same faces
  /// on every machine.
  std::size_t max_steps = std::numeric_limits<std::size_t>::max();
};

/// Decides whether `outer` encloses `inner`: whether `outer` winds at least once around every point, off both surfaces,
/// that `inner` winds around at least once.
/// Guaranteed: the answer is exact for all finite coordinates, unless the report says that faces are undecided. It
/// comes from exact predicates and constructions, without any tolerance. The code shares nothing with the construction
/// of hulls but exact geometry.
///
/// Required: both meshes are closed (is_closed in triangle_mesh.h). They may touch, share vertices, edges and faces,
/// overlap in a plane, intersect themselves, and have faces without area, several components and cavities.
///
/// A mesh of negative volume counts as turned, as a whole. A single component that faces inwards counts as a cavity;
/// turned_outwards turns those that cannot be one. Where `inner` intersects itself, the parts that it winds around zero
/// or fewer times need not be enclosed; verify_cover asks for every triangle.
///
/// Throws InputError if a mesh is empty, not closed or has a non-finite coordinate; Cancelled.
///
///     const EnclosureReport report = verify_enclosure(original, hull);
///     if (!report.encloses && !report.worst.empty()) show(report.worst[0].face, report.worst[0].point);
EnclosureReport verify_enclosure(const TriangleMesh& inner, const TriangleMesh& outer,
                                 const EnclosureOptions& options = {});

/// Decides whether `outer` covers every triangle: whether each point of the triangles lies in the solid that `outer`
/// bounds. That solid is the closure of all points, off the surface, that `outer` winds around at least once.
/// Guaranteed: the answer is exact for all finite coordinates, without any tolerance, and no triangle is left out. The
/// code shares nothing with the construction of hulls but exact geometry.
/// Not decided: whether the space between the triangles is covered. A thick shell around a closed mesh covers it, but
/// does not enclose it; verify_enclosure tells these apart.
///
/// Required: `outer` is closed; it counts as turned where its volume is negative. The triangles may be open,
/// non-manifold, not oriented, repeated, and may intersect each other. A triangle without area counts as the segment or
/// point that it is.
///
/// In the report `faces_outside` and `worst` describe the triangles; cavities, inner_volume and void_ratio are 0. The
/// time is nearly linear in the number of faces of both, and in the number of crossings of the segments in which faces
/// of `outer` meet each other, or a triangle. Throws InputError if there is no triangle, if a coordinate is
/// not finite (drop such triangles first, and say so), or if `outer` is empty or not closed; Cancelled.
///
///     const bool proven = verify_cover(triangles, hull).encloses &&
///                         (!is_closed(triangles) || verify_enclosure(triangles, hull).encloses);  // as verify_hull
EnclosureReport verify_cover(const TriangleMesh& triangles, const TriangleMesh& outer,
                             const EnclosureOptions& options = {});

/// Turns a mesh outwards: as a whole if its volume is negative, and then each component of negative volume that lies
/// outside of all components that face outwards and crosses none of them; it may touch them. One that lies inside is a
/// cavity, and one that crosses cuts a hole; both stay. Components are connected by edges. Hulls are built from meshes
/// that are turned like this, and verified against them. Exact. Throws InputError if the mesh is empty or
/// not finite.
TriangleMesh turned_outwards(TriangleMesh mesh);

/// The volume of all points that a closed mesh winds around at least once: parts that overlap count once, and folds
/// that are inside out not at all. Which pieces of the surface bound it is decided exactly; their sum is rounded.
/// nullopt where faces intersect so often that it would take long, in 100,000 pieces. Throws InputError if the mesh is
/// empty, not closed or not finite; Cancelled.
std::optional<double> solid_volume(const TriangleMesh& mesh, const Progress& progress = {});

/// The number of pairs of faces that meet in more than the corners and edges that they share. Corners are matched by
/// position. Faces without area do not count. Exact. Throws InputError if the mesh is empty or not finite.
std::size_t count_self_intersections(const TriangleMesh& mesh);

}  // namespace prohull

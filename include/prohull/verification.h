#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "prohull/enclosure.h"
#include "prohull/progress.h"
#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"
#include "prohull/verdict.h"

namespace prohull {

struct VerificationOptions {
  /// Only the solid must be enclosed that a closed original bounds; of an inner hull, only the solid that the hull
  /// bounds. Triangles of folds and of parts that are inside out bound no part of the solid. By default they must be
  /// covered too; with this option they may stick out.
  bool solid_only = false;
  /// The distance that every point of the hull must keep from every triangle of the original, at least, in the input's
  /// unit. Not for a progressive hull: its levels touch.
  double gap = 0;
  /// Faces of the original that are not finite are left out and counted. By default the answer is no if there are any.
  bool finite_only = false;
  /// For an original that is not closed: a closed mesh that stands for it, as RepairedMesh::closed does. Its faces are
  /// triangles of the original, in either orientation, and caps on openings. The hull must then enclose its solid, too;
  /// an inner hull must be enclosed by its solid. It is not looked at if the original is closed.
  const TriangleMesh* closed = nullptr;
  std::size_t max_offenders = 5;
  /// EnclosureOptions::most_outside. If it is given, a hull that does not enclose is not measured: its
  /// self_intersections are 0, and volumes NaN.
  std::size_t most_outside = std::numeric_limits<std::size_t>::max();
  /// The most steps of each search for parts that lie outside, for holes, and for faces nearer than the gap; what is
  /// left then is undecided, the same on every machine. 0: two billion and 2,000 for each face of the original, which
  /// take some minutes.
  std::size_t max_steps = 0;
  Progress progress = {};  ///< stage "verify"
};

/// A face of a hull that is nearer to the original than VerificationOptions::gap.
struct NearFace {
  FaceId face;           ///< its number in the hull
  FaceId original_face;  ///< the nearest face of the original
  Vec3 point;            ///< a point of the hull's face that is so near, rounded
  double distance = 0;   ///< between the two faces, in the input's unit, rounded; 0 only if they meet
};

/// What verify_hull has found. Volumes and distances are in the input's unit.
struct Verification : Verdict {
  bool encloses = false;  ///< `certified` but for the gap: exact; of an inner hull, whether the original encloses it

  std::size_t splits = 0;  ///< vertex splits replayed
  std::size_t signs = 0;   ///< signs of orient3d that the replay decided exactly

  bool keeps_gap = true;           ///< the hull keeps VerificationOptions::gap; exact, unless is_gap_undecided()
  std::size_t faces_too_near = 0;  ///< faces of the hull that do not; exact
  std::vector<NearFace> nearest;   ///< the nearest of these, nearest first; max_offenders at most
  /// No more than this lies between hull and original; rounded up, but to the gap if it is not kept. NaN without a gap,
  /// and where the search ended before.
  double least_distance = std::numeric_limits<double>::quiet_NaN();

  std::size_t faces_outside = 0;  ///< faces of the inner mesh of which a part lies outside of the outer one; exact
  /// The farthest of these, farthest first. Caps are numbered behind the faces of the original.
  std::vector<Offender> worst;
  std::size_t cavities = 0;  ///< as in EnclosureReport
  /// Faces that were left undecided, because meshes intersect themselves or each other so often, or are about as near
  /// as the gap in so many places, that they would take minutes. If there are any, `certified` is false.
  std::size_t faces_undecided = 0;
  /// Faces of the inner mesh that bound no part of its solid, as in folds. Of a progressive hull only the base mesh is
  /// known to cover them; of an original without a solid, they are those that the finest level does not cover.
  std::size_t faces_beside_solid = 0;
  std::size_t self_intersections = 0;     ///< pairs of faces of the hull that intersect; of a progressive hull its base
  std::size_t inverted_hull_faces = 0;    ///< faces of the hull, or of components of it, that is inside out
  std::size_t turned_original_faces = 0;  ///< faces of the original that count as turned
  /// Of the solid that the hull bounds: parts that overlap count once. Its boundary is decided exactly, the sum is
  /// rounded. NaN if a replay fails, and where faces intersect so often that it would take long.
  double hull_volume = std::numeric_limits<double>::quiet_NaN();
  /// The same of the original, or of VerificationOptions::closed. NaN also if there is no solid.
  double original_volume = std::numeric_limits<double>::quiet_NaN();
  double void_ratio = std::numeric_limits<double>::quiet_NaN();  ///< hull_volume / original_volume - 1; NaN if unknown
  /// Sentences for the user: what was left out of the original, and units that seem to differ.
  std::vector<std::string> notes;

  bool is_gap_undecided() const { return !keeps_gap && faces_too_near == 0; }
};

/// Decides whether `hull` encloses `original` (HullSide::Inner: whether `original` encloses `hull`). Guaranteed: a yes
/// is exact, and a no as well unless `faces_undecided` says that the work was ended before. What it means:
///
///   closed original   the hull encloses its solid (verify_enclosure) and covers every triangle of it (verify_cover)
///   any other one     the hull covers every triangle of it; with options.closed it encloses that solid, too
///   inner hull        the original encloses the solid of the hull, and its solid covers every triangle of the hull
///
/// With options.gap it is also decided whether the hull keeps that distance from all finite triangles of the original,
/// caps on its openings not included; `certified` says whether both is so. Distances are not measured.
///
/// If faces of the original are not finite, the verdict is no; with options.finite_only they are left out. Components
/// of a closed original that are inside out count as turned (turned_outwards); `notes` tell of both, and of meshes
/// whose sizes differ as if their units did. A hull that is inside out, as a whole or in such a component, is refused:
/// the verdict is no.
///
/// Throws InputError if a mesh is empty, if the hull is not closed or not finite, if a coordinate is larger than 1e100,
/// if the gap is not a finite number of at least 0, and for an inner hull if the original is not closed; Cancelled.
///
///     const Verification found = verify_hull(read_mesh("hull.stl"), read_mesh("part.stl"));
///     if (!found.encloses && !found.worst.empty()) show(found.worst[0].point);
Verification verify_hull(const TriangleMesh& hull, const TriangleMesh& original, HullSide side = HullSide::Outer,
                         const VerificationOptions& options = {});

/// The same for a progressive hull, which is its own proof (verify_replay): every level encloses the solid of the
/// original, which must be the finest level. If the hull says that its finest level is not the input (FinestLevel),
/// that level must enclose the solid of the original instead. Every triangle is asked of the base mesh; `notes` tell if
/// the finest level itself leaves some of them uncovered. If the original is not closed, the finest level must cover
/// its triangles; then every level does. Throws InputError(InvalidOption) if options.gap is not 0.
Verification verify_hull(const ProgressiveHull& hull, const TriangleMesh& original,
                         const VerificationOptions& options = {});

}  // namespace prohull

#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/enclosure.h"
#include "prohull/progress.h"
#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

struct VerificationOptions {
  /// A closed original bounds a solid, which the hull must enclose. With this option the hull must also cover every
  /// single triangle, even those of folds and of inside-out parts, which bound no part of the solid. Outer hulls only.
  bool every_triangle = false;
  std::size_t max_offenders = 5;
  Progress progress = {};  ///< stage "verify"
};

/// What verify_hull has found. Volumes and distances are in the input's unit.
struct Verification {
  bool encloses = false;  ///< the verdict, exact; of an inner hull: whether the original encloses it
  /// How it was decided: "replay" of the vertex splits of a progressive hull, "enclosure" of one closed mesh by
  /// another, or "coverage" of every triangle of an original that is not closed.
  std::string_view proof;
  HullSide side = HullSide::Outer;
  bool original_closed = false;
  bool every_triangle = false;  ///< every triangle had to be covered: it was asked for, or the original is not closed

  std::string why_not;     ///< the first step of a replay that fails; empty if it holds
  std::size_t splits = 0;  ///< vertex splits replayed
  std::size_t signs = 0;   ///< signs of orient3d that the replay decided exactly

  std::size_t faces_outside = 0;       ///< faces of the inner mesh of which a part lies outside of the outer one; exact
  std::vector<Offender> worst;         ///< the farthest of these, farthest first
  std::size_t cavities = 0;            ///< as in EnclosureReport
  std::size_t self_intersections = 0;  ///< pairs of faces of the hull that intersect; of a progressive hull its base
  std::size_t turned_hull_faces = 0, turned_original_faces = 0;  ///< faces that face inwards and count as turned
  double hull_volume = 0;
  double original_volume = std::numeric_limits<double>::quiet_NaN();  ///< NaN if the original is not closed
  double void_ratio = std::numeric_limits<double>::quiet_NaN();       ///< hull_volume / original_volume - 1
  /// Sentences for the user: what was left out of the original, and units that seem to differ.
  std::vector<std::string> notes;
};

/// Decides whether `hull` encloses `original` (HullSide::Inner: whether `original` encloses `hull`), by the proof that
/// fits: of a closed original the solid must be enclosed (verify_enclosure), of any other one every triangle must be
/// covered (verify_cover). Faces of the original that are not finite are left out; components of closed meshes that are
/// inside out count as turned (turned_outwards). `notes` tell of both, and of meshes whose sizes differ as if their
/// units did. Guaranteed: the verdict is exact, as that of the functions named.
///
/// Throws InputError if a mesh is empty, if the hull is not closed or not finite, and for an inner hull if the original
/// is not closed or `every_triangle` is asked for; Cancelled.
///
///     const Verification found = verify_hull(read_mesh("hull.stl"), read_mesh("part.stl"));
///     if (!found.encloses && !found.worst.empty()) show(found.worst[0].point);
Verification verify_hull(const TriangleMesh& hull, TriangleMesh original, HullSide side = HullSide::Outer,
                         const VerificationOptions& options = {});

/// The same for every level of a progressive hull, which is its own proof (verify_replay): its finest level must be the
/// original, or, if that is not closed, cover its triangles. Of an original that is not closed the finest level is what
/// covers the triangles.
Verification verify_hull(const ProgressiveHull& hull, TriangleMesh original, const VerificationOptions& options = {});

}  // namespace prohull

#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "prohull/detail/progress_meter.h"
#include "prohull/enclosure.h"
#include "prohull/verification.h"
#include "verify/cell.h"
#include "verify/self_intersection.h"
#include "verify/surface.h"

namespace prohull::verify {

/// verify_enclosure of two meshes.
EnclosureReport verify_enclosure(const Surface& inner, const Surface& outer, const EnclosureOptions& options);

/// How many steps a search may take, against an original with so many faces (EnclosureOptions::max_steps).
constexpr std::size_t most_steps(const VerificationOptions& options, std::size_t faces) {
  return options.max_steps > 0 ? options.max_steps : 2'000'000'000 + 2'000 * faces;
}

/// What a search has found.
inline Answer answer_of(const EnclosureReport& report) {
  if (report.encloses) return Answer::Yes;
  return report.faces_outside > 0 || report.cavities > 0 ? Answer::No : Answer::Undecided;
}

/// Why a verdict is no that leaves faces undecided, and knows of no part outside.
std::string undecided(std::size_t faces);

/// What `outer` leaves open in the midst of `inner`.
struct Holes {
  std::size_t count = 0;      ///< connected parts of `outer` that bound holes
  std::size_t undecided = 0;  ///< faces of `outer` that may bound others
  Vec3 point;                 ///< beside one, rounded
};

/// For a face of the outer surface, cells of it, one at least within each connected part beside which `outer` winds
/// less than once; nothing if that is not known.
using OpenCells = std::function<std::optional<std::vector<Cell>>(FaceIndex)>;

/// If `outer` covers every triangle of `inner` (verify_cover), it encloses `inner` if and only if there are no holes.
/// Exact: no triangle of `inner` reaches the open space around which `outer` winds less than once, so that the winding
/// of `inner` is the same all over each connected part of that space, and each is bounded by faces of `outer` alone.
Holes find_holes(const Surface& inner, const Surface& outer, const OpenCells& open_cells,
                 const EnclosureOptions& options);

/// The faces of a mesh that lie, in part, outside of the closure of what it winds around at least once: those of folds
/// and of components that are inside out; and those without area. Whatever encloses the mesh covers all others
/// (verify_enclosure, verify_cover). Exact; but where more than 1,000 pairs of faces intersect, all of these are there.
/// `pairs` are the self_intersections of the surface, which is that of the mesh.
std::vector<FaceId> faces_beside_the_solid(const Surface& surface, const TriangleMesh& mesh, const FacePairs& pairs,
                                           const Progress& progress);

/// Whether a closed mesh winds around some point a negative number of times, as in a lobe that is inside out. Exact, or
/// undecided where that would take more steps (EnclosureOptions::max_steps).
Answer winds_negatively(TriangleMesh mesh, std::size_t most_steps, const Progress& progress);

/// Whether the mesh is a surface in one piece, with two faces along every edge and with an area of every face, that
/// looks outwards. Without self-intersections all of its faces then bound the solid. Much faster to find out, and in
/// less memory, than faces_beside_the_solid, which knows of any mesh. Exact.
bool is_outward_sheet(const TriangleMesh& mesh);

}  // namespace prohull::verify

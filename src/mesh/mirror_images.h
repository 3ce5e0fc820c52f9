#pragma once

#include <optional>

#include "geometry/mirror_plane.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/detail/symmetry.h"

namespace prohull {

/// The plane through the middle of the box, if its coordinate has no rounding error.
std::optional<MirrorPlane> mirror_plane_of(const Box& box, Axis axis);

/// Which half-edge is the mirror image of which. The images of two neighbours are neighbours:
///
///     images[images[h]] == h,  images[next(h)] == previous(images[h]),  images[twin(h)] == twin(images[h])
///
/// and tail(images[h]) is where the plane mirrors tip(h) to. Nothing if the mesh is not symmetric. Collapses of
/// mirrored edges keep these laws, so that the images of the half-edges that are left stay what they are.
std::optional<PerHalfEdge<HalfEdgeId>> mirror_images(const HalfEdgeMesh& mesh, const MirrorPlane& plane);

}  // namespace prohull

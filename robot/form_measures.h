#pragma once

#include <cstddef>
#include <span>

#include "prohull/closed_solid.h"
#include "prohull/detail/solid_pieces.h"
#include "prohull/distance.h"
#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull::robot {

// Curved forms are measured by meshes that stand for them, and bounds hold for the forms themselves.

/// Corners around the axis of the meshes that stand for curved forms where they are shown and their volume is measured:
/// many forms need fewer each.
std::size_t shown_segments(std::size_t forms);

/// The mesh, and those that stand for the forms.
TriangleMesh with_forms(TriangleMesh mesh, std::span<const CurvedForm> forms, Curved curved, std::size_t segments);

/// The triangles of the pieces, and meshes with the volumes of their curved forms.
TriangleMesh with_same_volume(const SolidPieces& all);

/// The volume inside of the triangles and of the curved forms. For forms alone it is exact if they are balls, or one
/// form. Curved forms that overlap other pieces count as meshes with their volume. Throws as volume_inside does.
InsideVolume volume_of(const SolidPieces& all, const Progress& progress = {});

/// How far the mesh reaches out of the form at most. Of a mesh, the corner that is farthest from a convex form is the
/// farthest point.
double reach_at_most(const TriangleMesh& mesh, const CurvedForm& form);

DistanceBounds widened(const DistanceBounds& bounds, double above, double below);

/// Bounds of a distance from curved forms, where `bounds` are from meshes around them that reach out by `around` at
/// most. Points outside of a mesh are as far from the form or farther; points inside may be closer to its surface, and
/// count unless `only_outside`.
DistanceBounds from_forms(const DistanceBounds& bounds, double around, bool only_outside);

}  // namespace prohull::robot

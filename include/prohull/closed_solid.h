#pragma once

#include "prohull/enclosing_hull.h"
#include "prohull/progress.h"
#include "prohull/repair.h"
#include "prohull/triangle_mesh.h"
#include "prohull/verification.h"

namespace prohull {

struct ClosedSolidOptions {
  RepairOptions repair{.keep_cavities = true, .fill_crossing = true};
  /// Of the wrap that is made where repairs do not do, in the input's unit; 0: 1/256 of the diagonal of the input's
  /// box.
  double spacing = 0;
  /// Vertices of the repaired mesh move outwards to coordinates that STL and GLB files keep (with_float32_coordinates),
  /// those of a wrap to the nearest ones.
  bool float32_coordinates = false;
  Progress progress = {};  ///< stages "wrap" and "verify"
};

/// What counts as the solid of a mesh.
struct ClosedSolid {
  TriangleMesh mesh;                 ///< a closed 2-manifold, oriented outwards
  Source source = Source::Mesh;      ///< the repaired mesh, or a wrap of it, which is another solid
  double wrap_spacing = 0;           ///< of a wrap
  std::size_t rounded_vertices = 0;  ///< of the repaired mesh, how many were moved to float32 coordinates
  Folds folds = {};                  ///< of the repaired mesh, if `mesh` was changed around them so that it covers them
  RepairedMesh input;                ///< `repairs` has the openings that were closed, `obstacle` why repairs do not do
  Verification verdict;  ///< of `mesh` as an outer hull of the input; if it is `certified`, every triangle is covered
};

/// Makes a closed solid of any triangles, as enclosing_hulls does before it builds hulls: repaired_mesh, and a wrap
/// where that gives no closed mesh, or none that covers all triangles. Where only folds stick out of it, inside out,
/// the faces around them are replaced, and all others stay. Guaranteed: what `verdict` says of `mesh`, exactly. Throws
/// InputError as repaired_mesh and wrap do, and for a wrap that is no closed 2-manifold; Cancelled.
///
///     const ClosedSolid solid = closed_solid(read_mesh("scan.stl"));
///     if (solid.verdict.certified) write_mesh("scan.ply", solid.mesh);
ClosedSolid closed_solid(TriangleMesh triangles, const ClosedSolidOptions& options = {});

/// Of all points that a closed mesh winds around at least once, in cubic units.
struct InsideVolume {
  double volume = 0;
  bool is_estimated = false;  ///< by a wrap: nothing is closed, or faces intersect too often for solid_volume
};

/// The stage of progress is "wrap". Throws InputError if the mesh is empty, not closed or not finite; Cancelled.
InsideVolume volume_inside(const TriangleMesh& closed, const Progress& progress = {});

/// Of the original if it is closed as it is, with its cavities; else of the closed mesh; or, where repairs do not do,
/// of the triangles with caps on all openings. 0 of a single point.
InsideVolume volume_inside(const RepairedMesh& repaired, const Progress& progress = {});

}  // namespace prohull

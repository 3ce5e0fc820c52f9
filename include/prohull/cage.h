#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "prohull/detail/mesh_quality.h"
#include "prohull/enclosing_hull.h"
#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// CageOptions::gap, if none is given, relative to the diagonal of the mesh's bounding box.
inline constexpr double kCageGap = 0.001;

/// What CageOptions::even aims at: the compactness (mesh_quality.h) of the thinnest face. A triangle of this
/// compactness has no angle below 17 degrees.
inline constexpr double kEvenCompactness = 0.5;

struct CageOptions {
  std::size_t outer_faces = 400;  ///< at most, if possible; at least 4
  std::size_t inner_faces = 0;    ///< 0: no inner hull; otherwise at least 4
  double gap = 0;      ///< least distance of both hulls from the mesh, in the input's unit; 0: kCageGap of the diagonal
  bool even = false;   ///< no thin triangles: compactness of at least kEvenCompactness where that is possible
  bool tight = false;  ///< start from tight hulls (tight_hull.h)
  bool float32_coordinates = false;  ///< as in HullOptions
  unsigned threads = 0;              ///< as in HullOptions
  Progress progress = {};            ///< the stages of EnclosingOptions; "even"
};

/// One hull of a cage.
struct CageHull {
  EnclosingHulls made;       ///< one hull: `hull()`. The rest tells what it was built from.
  bool keeps_gap = false;    ///< hull().padding, the proven least distance from the mesh, is at least the gap
  bool is_disjoint = false;  ///< no face of it touches the mesh, the other hull, or itself; exact
  MeshQuality quality = {};

  const EnclosingHull& hull() const { return made.hulls.front(); }
};

struct Cage {
  CageHull outer;
  std::optional<CageHull> inner;
  double gap = 0;                  ///< what was asked for, in the input's unit
  std::vector<std::string> notes;  ///< sentences for the user
};

/// Builds a cage: an outer hull of a mesh that keeps a gap from it, and on demand an inner hull that does. The space
/// between hull and mesh can be filled with tetrahedra.
///
/// Guaranteed, where EnclosingHull::certified and CageHull::is_disjoint are set, for the coordinates returned: the
/// outer hull encloses the mesh, as enclosing_hulls says; the mesh encloses the inner hull; no face of one of the three
/// has a point in common with a face of another. Exact predicates decide all this. The outer hull always keeps the gap;
/// `keeps_gap` says whether the inner one does.
/// Not guaranteed: that the mesh does not intersect itself. A hull of such a mesh may intersect itself, too.
///
/// Takes any triangles for an outer hull. Throws InputError as enclosing_hulls does; if an inner hull is asked for and
/// the mesh is not closed; and if no inner hull lies strictly inside. Throws Cancelled.
///
///   const Cage cage = build_cage(read_mesh("horse.ply"), {.outer_faces = 400, .inner_faces = 400});
///   write_mesh("outer.obj", cage.outer.hull().mesh);
Cage build_cage(TriangleMesh triangles, const CageOptions& options = {});

}  // namespace prohull

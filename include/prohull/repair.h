#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "prohull/mesh_report.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// What was done to a mesh to make it closed, manifold and oriented outwards.
struct Repairs {
  std::size_t dropped_non_finite_faces = 0;  ///< that had a corner with NaN or infinity
  std::size_t welded_vertices = 0;           ///< that had the position of another one
  std::size_t dropped_faces = 0;             ///< that had the same vertex twice, after welding
  std::size_t dropped_duplicate_faces = 0;   ///< that had the same three corners as another one
  std::size_t split_vertices = 0;            ///< in which parts met that are connected nowhere else
  std::size_t turned_single_faces = 0;       ///< to agree with their neighbours about the outside
  std::size_t turned_components = 0;         ///< that were inside out
  std::size_t turned_faces = 0;              ///< in those
  std::size_t dropped_components = 0;        ///< that lay inside of others
  std::size_t dropped_component_faces = 0;   ///< of those

  bool any() const { return *this != Repairs{}; }
  bool operator==(const Repairs&) const = default;
};

/// "welded 2,100 vertices", one phrase for each kind.
std::vector<std::string> describe(const Repairs& repairs);

struct ClosedMesh {
  TriangleMesh mesh;
  Repairs repairs;
  MeshReport report;      ///< of `mesh`
  MeshReport found = {};  ///< of the mesh as it came to closed_mesh
};

/// The mesh that hulls are built from: a closed 2-manifold of any number of components and any genus, outwards
/// oriented. Vertices at equal positions are welded only if the mesh is not closed without. A mesh of negative volume
/// is turned as a whole; then each component of negative volume is turned too, unless it lies inside others: there it
/// bounds a cavity. Throws InputError for anything else, with the first offending edge or vertex.
ClosedMesh closed_mesh(TriangleMesh mesh);

/// Drops the faces with a corner that is NaN or infinite; returns how many there were.
std::size_t drop_non_finite_faces(TriangleMesh& mesh);

/// Any triangles, and what of them is closed.
struct RepairedMesh {
  TriangleMesh original;             ///< the triangles of the input that are finite, as they were: what a hull covers
  std::optional<ClosedMesh> closed;  ///< if a hull can be built from it as from closed_mesh
  /// Triangles of `original` that `closed` has not, and no others of the same corners: it may leave them uncovered.
  TriangleMesh dropped;
  Repairs repairs;       ///< all of them; up to where it failed if `closed` is empty
  std::string obstacle;  ///< the first defect that was left if `closed` is empty
  MeshReport found;      ///< of the input as it came
};

/// Makes of any triangles a mesh as of closed_mesh, if that takes no new faces. Beyond what closed_mesh does, it drops
/// triangles that are not finite and duplicates, makes neighbours agree about the outside, and separates parts that
/// meet in a vertex only. Unless `keep_cavities`, components inside of another one, which they do not touch, are
/// dropped: an outer hull covers them with it. Exact.
/// Throws InputError if no finite triangle is left, or if coordinates are too large or too close for volumes.
RepairedMesh repaired_mesh(TriangleMesh mesh, bool keep_cavities = false);

}  // namespace prohull

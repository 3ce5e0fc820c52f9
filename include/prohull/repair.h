#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "prohull/detail/names.h"
#include "prohull/mesh_report.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// How many elements of a mesh were changed to make it closed, manifold and oriented outwards.
struct Repairs {
  std::size_t dropped_non_finite_faces = 0;  ///< faces dropped because a corner was NaN or infinite
  std::size_t welded_vertices = 0;           ///< vertices joined with another one at the same position
  std::size_t dropped_faces = 0;             ///< faces dropped because they had the same vertex twice, after welding
  std::size_t dropped_duplicate_faces = 0;   ///< faces dropped because another one had the same three corners
  std::size_t split_vertices = 0;            ///< vertices split because two parts met in nothing else
  std::size_t turned_single_faces = 0;       ///< faces turned to agree with their neighbours about the outside
  std::size_t turned_components = 0;         ///< components turned because they were inside out
  std::size_t turned_faces = 0;              ///< faces of these components
  /// Components that are inside out beside the others, and cross or repeat them: they may be holes, and count as solid.
  std::size_t crossing_components = 0;
  std::size_t crossing_faces = 0;           ///< faces of these components
  std::size_t dropped_components = 0;       ///< components dropped because they lay inside of others
  std::size_t dropped_component_faces = 0;  ///< faces of these components
  std::size_t closed_openings = 0;          ///< openings that got a cap
  double largest_opening = 0;               ///< the diameter of the largest of these (openings.h), in the input's unit

  bool any() const { return *this != Repairs{}; }
  bool operator==(const Repairs&) const = default;
};

/// One phrase for each kind of repair that was made, such as "welded 2,100 vertices".
std::vector<std::string> describe(const Repairs& repairs);

struct ClosedMesh {
  TriangleMesh mesh;
  Repairs repairs;
  MeshReport report;      ///< describes `mesh`
  MeshReport found = {};  ///< describes the mesh before the repairs
};

/// Makes the mesh that build_hull needs: a closed 2-manifold that is oriented outwards. It may have any number of
/// components, and any genus. Vertices at equal positions are welded, but only if the mesh is not closed otherwise. A
/// mesh of negative volume is turned as a whole. Then each component of negative volume is turned too, unless it lies
/// inside of others, where it bounds a cavity. Throws InputError for any other mesh, with the first offending edge or
/// vertex.
ClosedMesh closed_mesh(TriangleMesh mesh);

/// What is done to the openings of a surface. Those of a *sheet* are never closed, such as a leaf or a bedsheet: of a
/// component that makes up more than half of the mesh, and that would need caps of more than three quarters of its
/// area.
enum class OpenShells {
  Close,  ///< openings get caps (openings.h): what they lead into is inside
  Keep,   ///< they stay open: only the triangles themselves are to be enclosed
};

/// "close", "keep"
Names<OpenShells> open_shells_names();

struct RepairOptions {
  bool keep_cavities = false;  ///< keep components that lie inside of another one without touching it
  OpenShells open_shells = OpenShells::Close;
  /// Of a mesh that is not closed, what components enclose that are inside out and cross or repeat others counts as
  /// solid, for what has to enclose all that may be meant. Else, and of a closed mesh, where winding numbers make them
  /// holes, they are an obstacle.
  bool fill_crossing = false;
};

/// What repaired_mesh makes of any triangles.
struct RepairedMesh {
  TriangleMesh original;             ///< the finite triangles of the input, unchanged: a hull must cover these
  std::optional<ClosedMesh> closed;  ///< the closed mesh, if one could be made; it includes the caps
  TriangleMesh caps;                 ///< faces across openings, which a hull has to cover as well
  /// The triangles of `original` that have no counterpart in `closed`. A hull of `closed` may leave them uncovered.
  TriangleMesh dropped;
  Repairs repairs;       ///< the repairs that were made; if `closed` is empty, those before the obstacle
  std::string obstacle;  ///< the first defect that was left; empty if there is a closed mesh
  MeshReport found;      ///< describes the input before the repairs

  TriangleMesh with_caps() const;  ///< `original` and `caps`
  const TriangleMesh* closed_mesh() const { return closed ? &closed->mesh : nullptr; }
};

/// Makes a closed mesh of any triangles, if that takes no new faces but caps. It does what closed_mesh does. It also
/// drops triangles that are not finite and duplicates, makes neighbours agree about the outside, and separates parts
/// that meet in a vertex only. If the mesh still is not closed, its openings get caps. Components that lie inside of
/// another one without touching it are dropped too, because an outer hull of the other one covers them. All decisions
/// but those of the caps are exact. Throws InputError if no finite triangle is left, or if coordinates are too large or
/// too close for volumes.
RepairedMesh repaired_mesh(TriangleMesh mesh, const RepairOptions& options = {});

}  // namespace prohull

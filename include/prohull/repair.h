#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "prohull/mesh_report.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// What was done to a mesh to make it closed, manifold and oriented outwards.
struct Repairs {
  std::size_t welded_vertices = 0;    ///< that had the position of another one
  std::size_t dropped_faces = 0;      ///< that had the same vertex twice, after welding
  std::size_t turned_components = 0;  ///< that were inside out
  std::size_t turned_faces = 0;       ///< in those

  bool any() const { return welded_vertices + dropped_faces + turned_components > 0; }
};

/// "welded 2,100 vertices", one phrase for each kind.
std::vector<std::string> describe(const Repairs& repairs);

struct ClosedMesh {
  TriangleMesh mesh;
  Repairs repairs;
  MeshReport report;  ///< of `mesh`
};

/// The mesh that hulls are built from: a closed 2-manifold of any number of components and any genus, outwards
/// oriented. Vertices at equal positions are welded only if the mesh is not closed without. A mesh of negative volume
/// is turned as a whole; then each component of negative volume is turned too, unless it lies inside others: there it
/// bounds a cavity. Throws InputError for anything else, with the first offending edge or vertex.
ClosedMesh closed_mesh(TriangleMesh mesh);

}  // namespace prohull

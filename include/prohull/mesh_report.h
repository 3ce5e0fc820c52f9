#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/error.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// What a mesh is, and what is wrong with it. Edges and vertices are told apart by index, not by position.
struct MeshReport {
  std::size_t faces = 0;
  std::size_t vertices = 0;  ///< vertices that triangles use
  std::size_t unused_vertices = 0;
  std::size_t components = 0;             ///< parts whose faces are connected by shared vertices
  std::size_t non_finite_vertices = 0;    ///< vertices with a coordinate that is NaN or infinite
  std::size_t repeated_corner_faces = 0;  ///< faces that have the same vertex twice
  std::size_t zero_area_faces = 0;        ///< faces with three different vertices on one line, decided exactly; allowed
  std::size_t open_edges = 0;             ///< edges with one face
  std::size_t non_manifold_edges = 0;     ///< edges with more than two faces
  std::size_t misoriented_edges = 0;      ///< edges with two faces that disagree about the outside
  std::size_t non_manifold_vertices = 0;  ///< vertices whose faces are more than one disk or fan
  long euler_characteristic = 0;          ///< vertices - edges + faces
  Box box;                                ///< of the triangles that are finite
  double volume = 0;                      ///< signed; it has a meaning for closed meshes only
  Defect worst_defect = Defect::EmptyMesh;  ///< the worst kind of defect; only if first_defect is not empty
  std::string first_defect;                 ///< where that defect occurs first; empty if there is none

  bool is_watertight() const {
    return faces > 0 && repeated_corner_faces + open_edges + non_manifold_edges + misoriented_edges == 0;
  }
  bool is_closed_manifold() const { return is_watertight() && non_manifold_vertices == 0 && non_finite_vertices == 0; }
};

/// One kind of defect.
struct DefectCount {
  std::string_view name;         ///< "open_edges"
  std::string_view description;  ///< "open edges", or "open edge" of one
  std::size_t count;
  bool allowed;  ///< a hull can be built in spite of it
};

/// All kinds of defects, with a count of 0 for those that the mesh does not have.
std::vector<DefectCount> defect_counts(const MeshReport& report);

MeshReport inspect(const TriangleMesh& mesh);

}  // namespace prohull

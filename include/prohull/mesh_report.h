#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/error.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// What a mesh is and what is wrong with it. Edges and vertices are told apart by index, not by position.
struct MeshReport {
  std::size_t faces = 0;
  std::size_t vertices = 0;  ///< that triangles use
  std::size_t unused_vertices = 0;
  std::size_t components = 0;             ///< connected by shared vertices
  std::size_t non_finite_vertices = 0;    ///< a coordinate is NaN or infinite
  std::size_t repeated_corner_faces = 0;  ///< the same vertex twice
  std::size_t zero_area_faces = 0;        ///< three different vertices on one line; exact; allowed
  std::size_t open_edges = 0;             ///< one face
  std::size_t non_manifold_edges = 0;     ///< more than two faces
  std::size_t misoriented_edges = 0;      ///< two faces that disagree about the outside
  std::size_t non_manifold_vertices = 0;  ///< faces around them are more than one disk or fan
  long euler_characteristic = 0;          ///< vertices - edges + faces
  Box box;
  double volume = 0;                        ///< signed; meaningful for closed meshes
  Defect worst_defect = Defect::EmptyMesh;  ///< the worst kind there is; meaningful if first_defect is not empty
  std::string first_defect;                 ///< where it occurs first; empty if there is none

  bool is_watertight() const {
    return faces > 0 && repeated_corner_faces + open_edges + non_manifold_edges + misoriented_edges == 0;
  }
  bool is_closed_manifold() const { return is_watertight() && non_manifold_vertices == 0 && non_finite_vertices == 0; }
};

/// One kind of defect.
struct DefectCount {
  std::string_view name;         ///< "open_edges"
  std::string_view description;  ///< "open edges"
  std::size_t count;
  bool allowed;  ///< hulls are built nevertheless
};

/// Every kind of defect, also those that the mesh has not.
std::vector<DefectCount> defect_counts(const MeshReport& report);

MeshReport inspect(const TriangleMesh& mesh);

}  // namespace prohull

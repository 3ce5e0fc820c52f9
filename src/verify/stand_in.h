#pragma once

#include <cstddef>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull::verify {

/// A closed mesh that stands for an original which is not closed.
struct StandIn {
  TriangleMesh mesh;                ///< turned outwards
  std::vector<FaceId> number = {};  ///< of each face in the original; caps are numbered behind its faces
  std::size_t caps = 0;             ///< faces of the mesh that are no triangles of the original, in either orientation
  std::vector<FaceId> rest = {};    ///< faces of the original that are no faces of the mesh
};

/// Throws InputError if `closed` is empty, not closed or not finite.
StandIn stand_in(const TriangleMesh& closed, const TriangleMesh& original);

}  // namespace prohull::verify

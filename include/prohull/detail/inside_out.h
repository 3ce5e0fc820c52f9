#pragma once

#include <cstddef>
#include <string>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// The components of a mesh that are inside out: their volume is negative, and they are no cavities of others.
struct InsideOut {
  std::size_t parts = 0;
  bool is_all = false;   ///< the mesh has no other components
  bool crosses = false;  ///< one of them crosses or repeats others: repairs do not turn it
  FaceId first{};        ///< the first face of them, if there are any
};

/// Required: the mesh is closed and finite. Components are connected by edges, matched by position. As exact as
/// turned_outwards.
InsideOut inside_out_parts(const TriangleMesh& mesh);

/// "arm.stl is inside out", "the component of face 12 of arm.stl is inside out"; empty if there are none.
std::string described(const InsideOut& found, const std::string& name);

/// What turns them: "`prohull repair` turns it".
std::string remedy(const InsideOut& found);

}  // namespace prohull

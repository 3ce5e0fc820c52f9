#pragma once

#include <cstdint>
#include <string>

#include "prohull/triangle_mesh.h"

namespace prohull {

// The content of a file in each format; coordinates are finite, for STL and GLB float32.

std::string ply_content(const TriangleMesh& mesh);
std::string obj_content(const TriangleMesh& mesh);
std::string off_content(const TriangleMesh& mesh);
std::string stl_content(const TriangleMesh& mesh);
/// A scene of one node with one mesh of one primitive, without normals: glTF shades it flat. Without triangles the
/// scene is empty. glb_size(mesh) is below 4 GiB.
std::string glb_content(const TriangleMesh& mesh);
/// At most that many bytes.
std::uint64_t glb_size(const TriangleMesh& mesh);

/// Whether float32 stores the value without changing it (for -0.0, denormals and all others).
bool is_float32(double value);

}  // namespace prohull

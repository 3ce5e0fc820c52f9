#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "prohull/triangle_mesh.h"

namespace prohull {

// The content of a file in each format; coordinates are finite, for STL and GLB float32.

std::string ply_content(const TriangleMesh& mesh);
std::string obj_content(const TriangleMesh& mesh);
std::string off_content(const TriangleMesh& mesh);
std::string stl_content(const TriangleMesh& mesh);
/// A scene of one node with one mesh of one primitive, without normals: glTF shades it flat. Without triangles the
/// scene is empty. glb_size is below 4 GiB.
std::string glb_content(const TriangleMesh& mesh);

// Of several meshes, each with a name.

/// An object for each; what the name of an object cannot hold becomes _.
std::string obj_content(std::span<const TriangleMesh> meshes, std::span<const std::string> names);
/// A node with a mesh for each, in a colour of its own. Those without triangles are left out. glb_size is below 4 GiB.
std::string glb_content(std::span<const TriangleMesh> meshes, std::span<const std::string> names);
/// At most that many bytes.
std::uint64_t glb_size(std::span<const TriangleMesh> meshes, std::span<const std::string> names);

/// Whether float32 stores p without changing it (-0.0, denormals and all others).
bool float32_stores(const Vec3& p);

}  // namespace prohull

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "prohull/mesh_io.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

// One reader for each format. `file` stands in messages. See mesh_io.h for what they promise.

TriangleMesh read_ply(std::string_view content, const std::string& file, const ReadOptions& options);
TriangleMesh read_obj(std::string_view content, const std::string& file, const ReadOptions& options);
TriangleMesh read_off(std::string_view content, const std::string& file, const ReadOptions& options);
TriangleMesh read_stl(std::string_view content, const std::string& file, const ReadOptions& options);
/// MuJoCo's binary MSH.
TriangleMesh read_msh(std::string_view content, const std::string& file, const ReadOptions& options);
/// glTF or GLB; `file` is also where the files are that it names.
TriangleMesh read_gltf(std::string_view content, const std::string& file, const ReadOptions& options);

/// COLLADA with the bits that assimp 5.2 gives, in metres, and with `up_axis` ignored. Also refuses what takes more
/// than `most` bytes.
TriangleMesh read_collada(std::string_view content, const std::string& file, std::size_t most);
bool is_collada(const std::filesystem::path& name);  ///< .dae, with or without .gz

/// Whether files of that name, with or without .gz, are meshes that are read.
bool is_mesh_name(const std::filesystem::path& path);

/// The sizes decide: a file of 84 + 50 n bytes with n where a binary STL has its count is one, even if it starts with
/// "solid"; otherwise "solid" means ascii unless zero bytes follow.
bool is_binary_stl(std::string_view content);
bool is_ascii_stl(std::string_view content);
bool is_glb(std::string_view content);
/// Whether a word may stand at the start of a line of an OBJ file.
bool is_obj_keyword(std::string_view word);
/// OFF with its prefixes for normals, colours and texture coordinates.
bool is_off_keyword(std::string_view word);

}  // namespace prohull

#pragma once

#include <filesystem>
#include <string_view>

#include "prohull/triangle_mesh.h"

namespace prohull {

enum class MeshFormat { Ply, Obj, Off, Stl };

/// The format that a file name asks for (.ply, .obj, .off, .stl, in any case, optionally followed by .gz);
/// throws InputError(UnknownFormat) for any other name, listing those that are known.
MeshFormat mesh_format(const std::filesystem::path& path);

/// STL stores coordinates as float32. The others keep doubles.
bool stores_float32(MeshFormat format);

/// Reads a mesh: PLY (ascii, binary little and big endian; triangle strips), OBJ, OFF, STL (ascii, binary), each also
/// gzipped or alone in a zip archive. The name tells the format, the content if the name has none; a name that
/// contradicts the content is an error. Coordinates keep their bits as doubles. Polygons are triangulated, also where
/// they are not convex. STL corners at equal positions become one vertex; other formats keep their vertices as they
/// are. Normals, colours, textures, lines and points are skipped, and so is what follows the last record that a header
/// counts. A file without faces gives a mesh without triangles. Throws InputError with file, line or byte offset;
/// memory use is bounded by the size of the content, not by what headers claim, and a compressed file must not grow
/// more than 200 times (beyond 64 MiB).
TriangleMesh read_mesh(const std::filesystem::path& path);

/// The same for the content of a file; `name` gives the format and stands in error messages.
TriangleMesh read_mesh(std::string_view content, const std::filesystem::path& name);

/// Writes beside `path`, then renames: an interrupted write leaves no partial file. PLY is binary little endian, with
/// float coordinates if that loses no bit and double otherwise; OBJ and OFF have the shortest decimals that read back
/// as the same doubles; STL is binary and throws InputError(NonFiniteCoordinate) if a coordinate is not a float32.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace prohull

#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// Those that are written.
enum class MeshFormat { Ply, Obj, Off, Stl, Glb };

/// The format that a file name asks for (.ply, .obj, .off, .stl, .glb, in any case, optionally followed by .gz);
/// throws InputError(UnknownFormat) for any other name, listing those that are known.
MeshFormat mesh_format(const std::filesystem::path& path);

/// What the names of files end in that write_mesh takes: ".ply" and so on.
std::vector<std::string> written_mesh_extensions();

/// Of those that read_mesh takes, without ".gz", which may follow, and ".zip". The ones that prohull-import reads come
/// last, whether or not it is there.
std::vector<std::string> read_mesh_extensions();

/// STL and GLB store coordinates as float32. The others keep doubles.
bool stores_float32(MeshFormat format);

/// Units of length by their names ("mm", "cm", "m", "in"), each with its length in metres. As ReadOptions::scale that
/// number makes metres of a file in this unit.
std::span<const std::pair<std::string_view, double>> length_units();

/// What becomes of vertices with a coordinate that is NaN or infinite.
enum class NonFinite {
  Refuse,  ///< InputError(NonFiniteCoordinate), with the place in the file
  Keep,    ///< for those who can drop their faces (see repaired_mesh); files that assimp reads are refused nevertheless
};

struct ReadOptions {
  NonFinite non_finite = NonFinite::Refuse;
  double scale = 1;        ///< every coordinate is multiplied by it, and rounded to double; greater than 0
  Progress progress = {};  ///< stage "read"
};

/// Reads a mesh: PLY (ascii, binary little and big endian; triangle strips), OBJ, OFF, STL (ascii, binary), glTF 2.0
/// (.glb, .gltf), each also gzipped or alone in a zip archive. The name tells the format, the content if the name has
/// none; a name that contradicts the content is an error. Coordinates keep their bits as doubles. Polygons are
/// triangulated, also where they are not convex. STL corners at equal positions become one vertex; other formats keep
/// their vertices as they are. Of a scene all meshes are read wherever they are placed, in the coordinates and the
/// direction of up of the file (docs/formats.md), and mirrored ones are turned so that their faces stay outside.
/// Normals, colours, textures, lines and points are skipped, and so is what follows the last record that a header
/// counts. A file without faces gives a mesh without triangles. Throws InputError with file, line or byte offset;
/// memory use is bounded by the size of the content, not by what headers claim, and what is compressed, or placed many
/// times, must not grow more than 200 times (beyond 64 MiB).
///
/// COLLADA (.dae), 3MF, FBX, X3D and others are read by assimp in a program of its own, prohull-import, if that was
/// built: whatever it does, crashing included, is an InputError. It may use 20 s + 2 s per MiB and 1 GiB + 200 bytes
/// per byte of the file. It is found by the environment variable PROHULL_IMPORTER, beside the running program, or where
/// it was installed (docs/formats.md).
///
TriangleMesh read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for the content of a file; `name` gives the format, stands in error messages, and tells the folder of the
/// other files that a .gltf names.
TriangleMesh read_mesh(std::string_view content, const std::filesystem::path& name, const ReadOptions& options = {});

/// Writes beside `path`, then renames: an interrupted write leaves no partial file. PLY is binary little endian, with
/// float coordinates if that loses no bit and double otherwise; OBJ and OFF have the shortest decimals that read back
/// as the same doubles; STL is binary, GLB one mesh without normals, so that it is shaded flat. These two throw
/// InputError(NonFiniteCoordinate) if a coordinate is not a float32, and a GLB without triangles loses its vertices.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace prohull

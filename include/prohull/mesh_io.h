#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/detail/mesh_marks.h"
#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// The formats of meshes that write_mesh can write.
enum class MeshFormat { Ply, Obj, Off, Stl, Glb };

/// The format that a file name asks for: .ply, .obj, .off, .stl or .glb, in upper or lower case, and .gz may follow.
/// Throws InputError(UnknownFormat) for any other name; the message lists the known ones.
MeshFormat mesh_format(const std::filesystem::path& path);

/// The file name extensions that write_mesh takes: ".ply" and so on.
std::vector<std::string> written_mesh_extensions();

/// The file name extensions that read_mesh takes, without ".gz" (which may follow any of them) and ".zip". The formats
/// that prohull-import reads come last; they are listed even if that program is not installed.
std::vector<std::string> read_mesh_extensions();

/// Whether a format stores coordinates as float32: STL and GLB do; the others keep doubles.
bool stores_float32(MeshFormat format);

/// What becomes of vertices with a coordinate that is NaN or infinite.
enum class NonFinite {
  Refuse,  ///< InputError(NonFiniteCoordinate), with the place in the file
  Keep,    ///< for callers that drop their faces (repaired_mesh does); files that assimp reads are refused even so
};

/// The unit of the coordinates of a file, as they are read with a scale of 1.
struct FileUnit {
  double metres = 0;     ///< its length; 0 if neither the file nor its format says it
  bool is_said = false;  ///< whether the file says it (COLLADA, 3MF, AMF); glTF files are in metres by their standard
};

struct ReadOptions {
  NonFinite non_finite = NonFinite::Refuse;
  double scale = 1;  ///< every coordinate is multiplied by this number (length_units() has those of units) and
                     ///< rounded to double; greater than 0
  MeshMarks* marks = nullptr;  ///< where to put what PLY and OBJ files say of vertices and faces beside the geometry
  std::vector<DividedFace>* divided = nullptr;  ///< where to put polygons of PLY, OBJ and OFF files that are no fans
  FileUnit* unit = nullptr;                     ///< where to put the unit of the file
  bool alone = false;                           ///< InputError(CannotRead) for a file that has data in other files
  Progress progress = {};                       ///< stage "read"
};

/// Reads a mesh file. Throws InputError with the file and the line or byte offset; Cancelled. A file that needs more
/// memory than there is is refused before it is read (memory.h).
///
/// Formats: PLY (ascii, binary little and big endian; triangle strips), OBJ, OFF, STL (ascii, binary), glTF 2.0 (.glb,
/// .gltf), MSH of MuJoCo. Each may be gzipped, or alone in a zip archive. The file name tells the format; if it does
/// not, the content does. A name that contradicts the content is an error.
///
/// Guaranteed: coordinates keep their bits, as doubles. The memory that is used is bounded by the size of the content,
/// not by what headers claim. Compressed content, and meshes that a scene places many times, may grow 200 times, beyond
/// 64 MiB.
///
/// What is read: all meshes of a scene, wherever it places them, in the coordinates and with the up direction of the
/// file (docs/formats.md). Mirrored meshes are turned, so that their faces still look outwards. Polygons are
/// triangulated, also polygons that are not convex. STL corners at equal positions become one vertex; other formats
/// keep their vertices as they are. Normals, textures, lines and points are skipped, colours and groups too unless
/// ReadOptions::marks asks for them, and so is everything after the last record that a header counts. A file without
/// faces gives a mesh without triangles.
///
/// 3MF, FBX, X3D, what our reader of COLLADA refuses, and other formats are read by assimp, in a program of its own,
/// prohull-import. Whatever that program does, crashes included, becomes an InputError. It may use 20 s and 2 s more
/// for each MiB of the file, and 1 GiB of memory and 200 bytes more for each byte of the file. It is found by the
/// environment variable PROHULL_IMPORTER, beside the running program, or where it was installed (docs/formats.md).
TriangleMesh read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads the content of a mesh file. `name` tells the format, stands in error messages, and tells the folder of the
/// other files that a .gltf file names.
TriangleMesh read_mesh(std::string_view content, const std::filesystem::path& name, const ReadOptions& options = {});

/// Writes a mesh file: first beside `path`, then it is renamed, so that an interrupted write leaves no partial file.
/// PLY is binary little endian, with float coordinates if that loses no bit and with doubles otherwise. OBJ and OFF
/// have the shortest decimals that read back as the same doubles. STL is binary. GLB holds one mesh without normals, so
/// that viewers shade it flat; a GLB without triangles loses its vertices. STL and GLB throw
/// InputError(NonFiniteCoordinate) if a coordinate is not a float32 (float32_hull.h).
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

/// The bytes that write_mesh writes to a file of that name. Throws as it does.
std::string mesh_content(const std::filesystem::path& name, const TriangleMesh& mesh);

/// Whether write_meshes takes a format: OBJ and GLB.
bool holds_several_meshes(MeshFormat format);

/// Writes several meshes to one file, as write_mesh writes one. An OBJ file has an object for each of them, in whose
/// name blanks, control characters, # and backslashes become _. A GLB file has a node with a mesh for each that has
/// triangles, all at the same place, in seven colours that take turns. read_mesh reads all of them as one mesh again.
///
/// Throws as write_mesh does; InputError(UnknownFormat) for formats that hold one mesh, InputError(InvalidOption)
/// unless there is a name for each mesh.
void write_meshes(const std::filesystem::path& path, std::span<const TriangleMesh> meshes,
                  std::span<const std::string> names);

/// The bytes that write_meshes writes to a file of that name. Throws as it does.
std::string meshes_content(const std::filesystem::path& name, std::span<const TriangleMesh> meshes,
                           std::span<const std::string> names);

}  // namespace prohull

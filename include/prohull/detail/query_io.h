#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "prohull/collide.h"
#include "prohull/geometry.h"
#include "prohull/mesh_query.h"

namespace prohull {

// Files of queries and of their answers. Rows are counted from 0, and so are queries. Lines of text are counted from 1.

/// Reads segments, one a row: x0,y0,z0,x1,y1,z1. `name` is that of a file with this content:
///   .npy   an array of shape (n, 6) or (n, 2, 3), of floating point numbers of 32 or 64 bits or of integers, of either
///          byte order, in C or Fortran order
///   .npz   with one such array, or one called `segments`
///   .csv   numbers with commas, semicolons or blanks between them, as the first line has them; a decimal point; blank
///          lines, comments from # on, and a first line of names are skipped; LF or CR LF
/// Each may be gzipped. The file name tells the format; if it does not, the content does. A name that contradicts the
/// content is an error. Integers beyond 2^53 and decimals become the nearest double. A file without rows gives none.
/// Throws InputError with file, row or line, and what to do: UnknownFormat, Malformed (another shape, kind
/// of number, or truncated), NonFiniteCoordinate, NoLength for ends that are equal. Memory use is bounded by the size
/// of the content, as in mesh_io.h.
std::vector<Segment> read_segments(std::string_view content, const std::filesystem::path& name);

/// Reads rays in the same way: x,y,z,dx,dy,dz, an array called `rays`; NoLength for a direction of zeros.
std::vector<Ray> read_rays(std::string_view content, const std::filesystem::path& name);

/// Reads triangles in the same way: x0,y0,z0,x1,y1,z1,x2,y2,z2, of shape (n, 9) or (n, 3, 3), an array called
/// `triangles`. Triangles without area are allowed.
std::vector<Triangle> read_triangles(std::string_view content, const std::filesystem::path& name);

/// Reads poses in the same way, of an array called `poses`. Each row is one of these, which the file's first row tells:
///   x,y,z,qw,qx,qy,qz       a translation and a quaternion of any length, its real part first; shape (n, 7)
///   r00,r01,r02,x,r10,...   the upper three rows of a matrix; shape (n, 12) or (n, 3, 4)
///   r00,...,0,0,0,1         a whole matrix; shape (n, 16) or (n, 4, 4)
/// Malformed if a pose is not rigid (collide.h), and for names of columns that put the real part last. `of_matrix`
/// makes another pose of what a matrix is.
std::vector<Pose> read_poses(std::string_view content, const std::filesystem::path& name,
                             const std::function<Pose(const Pose&)>& of_matrix = {});

/// The same of one pose, the argument of an option, which messages name.
Pose read_pose(std::string_view text, const std::string& option);

/// Reads points in the same way: x,y,z, of shape (n, 3), an array called `points`.
std::vector<Vec3> read_points(std::string_view content, const std::filesystem::path& name);

enum class QueryFormat { Npy, Npz, Csv };

/// The format that a file name asks for (.npy or .csv, in any case); throws InputError(UnknownFormat) for any other.
QueryFormat segments_format(const std::filesystem::path& path);

/// Writes what read_segments reads, to .npy (of shape (n, 6), doubles) or .csv, as mesh_io.h does.
void write_segments(const std::filesystem::path& path, std::span<const Segment> segments);

/// Writes what read_points reads, in the same way, of shape (n, 3).
void write_points(const std::filesystem::path& path, std::span<const Vec3> points);

/// The format that a file name asks for (.npz or .csv, in any case); throws InputError(UnknownFormat) for any other.
QueryFormat hits_format(const std::filesystem::path& path);

enum class HitsOf { Segments, Rays };

/// Writes one row for each hit, in the order of the batch: segment (or ray), t, face, x, y, z, entering.
///   .csv   with a line of names; the shortest decimals that read back as the same doubles; entering 0 or 1
///   .npz   one array for each name: segment and face int64, entering bool, the others float64
/// The file is written beside `path`, then renamed. The same batch gives the same bytes. Throws
/// InputError(UnknownFormat), InputError(CannotWrite).
void write_hits(const std::filesystem::path& path, const HitBatch& batch, HitsOf of = HitsOf::Segments);

/// Writes one row for each face that a triangle meets, in the same way: triangle, face.
void write_faces_met(const std::filesystem::path& path, const FaceBatch& batch);

/// Writes one row for each pair of faces that meet, in the same way: pose, face_a, face_b.
void write_face_pairs(const std::filesystem::path& path, const FacePairBatch& batch);
/// Writes one row for each point, in the same way: point, inside (bool).
void write_inside(const std::filesystem::path& path, const std::vector<bool>& inside);

/// Writes one row for each point, in the same way: point, distance, lower, upper, face, x, y, z.
void write_distances(const std::filesystem::path& path, std::span<const ClosestPoint> distances);

}  // namespace prohull

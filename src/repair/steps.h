#pragma once

#include <cstddef>

#include "prohull/repair.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

// What a repair is made of. Each step counts what it did.

/// Throws InputError: NonFiniteCoordinate beyond 1e100, NoVolume for a box that is a point, or less than 1e-100 across.
/// An empty box is as good as any.
void require_usable_size(const Box& box);

/// Drops the faces with a corner that is NaN or infinite. Vertices stay, so that numbers of them do.
void drop_non_finite_faces(TriangleMesh& mesh, Repairs& repairs);

/// Finite vertices at equal positions become one, the first; -0 equals 0. Faces that then have a vertex twice go.
void weld(TriangleMesh& mesh, Repairs& repairs);

/// Of faces with the same three vertices in the same cyclic order, the first stays.
void drop_duplicate_faces(TriangleMesh& mesh, Repairs& repairs);

/// Turns faces until neighbours along edges of two faces agree about the outside, the fewer faces of each part; parts
/// where that is not possible stay as they are.
void turn_single_faces(TriangleMesh& mesh, Repairs& repairs);

/// Every vertex becomes as many as there are fans of faces around it. Fans are connected along edges of two faces; with
/// wedges also along edges of more faces, those that have the solid between them.
enum class FansAlong { EdgesOfTwo, Wedges };
void split_vertices(TriangleMesh& mesh, FansAlong along, Repairs& repairs);

/// Turns a closed mesh of negative volume, and then each component of negative volume outside of the others. One that
/// is partly inside of them looks outwards then, too, if `fill_crossing`; else InputError is thrown.
void turn_outwards(TriangleMesh& mesh, std::size_t components, bool fill_crossing, Repairs& repairs);

/// Drops the components of a closed mesh of oriented components that lie inside of one that faces outwards, without
/// touching it.
void drop_nested_components(TriangleMesh& mesh, std::size_t components, Repairs& repairs);

}  // namespace prohull

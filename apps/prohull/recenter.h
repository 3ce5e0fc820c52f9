#pragma once

#include <string>

#include "prohull/triangle_mesh.h"

namespace prohull::cli {

/// What `build --recenter` subtracts from the coordinates: a number near the middle of the mesh, of as few digits as
/// its size allows, and 0 along each axis where the origin is near: within four times the size. Subtracting it is exact
/// in doubles, so that a hull of the moved mesh encloses the mesh itself when it is moved back.
Vec3 recentering_offset(const TriangleMesh& mesh);

/// Throws InputError(InvalidOption) if that would round a vertex that a face uses.
TriangleMesh minus(TriangleMesh mesh, const Vec3& offset);

/// "500010,5400000,0": as `verify --offset` takes it, every bit.
std::string text_of_offset(const Vec3& offset);

}  // namespace prohull::cli

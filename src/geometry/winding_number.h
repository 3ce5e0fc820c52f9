#pragma once

#include <optional>
#include <span>

#include "prohull/geometry.h"

namespace prohull {

/// How often closed, outwards oriented surfaces wind around p: the signed number of triangles that a ray from p crosses.
/// Exact; rays through edges and corners are decided as if p were moved by an infinitesimal amount. Nothing if p lies in
/// the plane of a triangle that decides.
std::optional<int> winding_number(const Vec3& p, std::span<const Triangle> triangles);

}  // namespace prohull

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "prohull/convex_cover.h"

namespace prohull::robot {

/// A piece of a cover as a robot file names it: a primitive, or else a mesh file.
struct NamedPiece {
  decltype(ConvexPiece::primitive) primitive = {};
  std::string uri;  ///< of the mesh file, if there is no primitive
};

/// Names that sort in their order: "arm_01" and so on, with as many digits as the last one needs, at least two.
std::vector<std::string> piece_names(const std::string& name, std::size_t count);

/// A URDF file of one link with a collision element for each piece, to be pasted into a robot.
/// Throws InputError(InvalidOption) for names that XML cannot hold. Capsules, which URDF does not have, are written as
/// a cylinder and two spheres.
std::string urdf_of(const std::string& name, std::span<const NamedPiece> pieces);

/// An MJCF file of one body with a geom for each piece. The geoms collide and have no mass, and viewers hide them; the
/// inertia of the body is a placeholder. Mesh files are STL or OBJ, and their URIs are paths; throws
/// InputError(InvalidOption) for others, as MuJoCo reads no others, and for names that XML cannot hold.
std::string mjcf_of(const std::string& name, std::span<const NamedPiece> pieces);

}  // namespace prohull::robot

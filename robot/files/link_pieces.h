#pragma once

#include <string>
#include <vector>

#include "prohull/detail/shapes.h"
#include "prohull/triangle_mesh.h"
#include "robot/files/robot_file.h"

namespace prohull::robot {

/// The collision geometry of a link as the pieces of a union, in the frame of the link.
struct LinkPieces {
  std::vector<TriangleMesh> meshes;  ///< of mesh files, with the coordinates of the file; and of boxes
  std::vector<Ball> balls;
  std::vector<std::string> notes;  ///< sentences for the user
};

/// Nothing is larger than what the file says: what these pieces cover, the collision geometry covers. A box whose
/// corners have no exact coordinates, because it is turned, counts as smaller by about 1e-13 of its size.
///
/// Throws InputError with the file and the line: InvalidOption for cylinders, capsules and shapes that are not read,
/// and for meshes with an origin that would round their coordinates; as read_mesh.
LinkPieces link_pieces(const RobotFile& file, const Link& link);

}  // namespace prohull::robot

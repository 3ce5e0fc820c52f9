#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/sweep.h"

namespace prohull::robot {

/// The pose of 7 numbers, x, y, z and the quaternion w, x, y, z; or of the 12 or 16 of a matrix, row by row. None of
/// other numbers. Quaternions and matrices are made rotations, but for rounding. Throws InputError(InvalidOption) for a
/// matrix that is far from a rotation.
std::optional<Pose> pose_of(std::span<const double> numbers);

/// Reads poses, one a line, as numbers of pose_of. Commas, semicolons, tabs or blanks stand between them. Blank lines,
/// lines that begin with #, and a first line of names are skipped, but for names that tell w as the last column: those
/// are refused. Throws InputError(Malformed) with the file and the line.
std::vector<Pose> read_poses(std::string_view text, const std::string& file);

/// From each pose to the next: the origin of the body's frame goes straight, and the body turns about one axis the
/// shorter way round, at a constant rate (slerp). A single pose is a motion that stands still. The end of a motion is
/// the next pose but for rounding, which is less than the margin of `sweep`.
std::vector<RigidMotion> motions_between(std::span<const Pose> poses);

}  // namespace prohull::robot

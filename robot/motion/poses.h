#pragma once

#include <span>
#include <vector>

#include "prohull/sweep.h"

namespace prohull::robot {

/// The pose with a rotation that is one but for rounding. Throws InputError as require_rigid.
Pose corrected(const Pose& pose);

/// From each pose to the next: the origin of the body's frame goes straight, and the body turns about one axis the
/// shorter way round, at a constant rate (slerp). A single pose is a motion that stands still. The end of a motion is
/// the next pose but for rounding, which is less than the margin of `sweep`.
std::vector<RigidMotion> motions_between(std::span<const Pose> poses);

}  // namespace prohull::robot

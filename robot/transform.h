#pragma once

#include <array>

#include "prohull/collide.h"

namespace prohull::robot {

/// The rotation that takes the x, y and z axis to these, then the translation.
Pose of_columns(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& translation = {});

/// First `inner`, then `outer`: the pose in the outer frame of what `inner` places in a frame that `outer` places.
Pose composed(const Pose& outer, const Pose& inner);
Pose inverse(const Pose& pose);

/// Roll, pitch and yaw in radians, about the fixed axes x, y and z, in this order: as URDF and SDF say it.
Pose pose_of_rpy(const Vec3& rpy, const Vec3& translation = {});

/// The angles that pose_of_rpy takes to this rotation, but for rounding.
Vec3 rpy_of(const Pose& pose);

/// The unit quaternion w, x, y, z of the rotation.
std::array<double, 4> quaternion_of(const Pose& pose);

/// About an axis of any length but 0 through the origin, by `angle` radians.
Pose rotation_about(const Vec3& axis, double angle);

/// The shortest turn that takes the z axis to `z`, of length 1; half a turn about x if that is its opposite.
Pose turn_of_z_to(const Vec3& z);

Pose translation_by(const Vec3& offset);

}  // namespace prohull::robot

#pragma once

#include <array>
#include <optional>
#include <string>

#include "robot/files/xml.h"
#include "robot/transform.h"

namespace prohull::robot {

using InertiaTensor = std::array<Vec3, 3>;  ///< the rows of a symmetric matrix

/// The mass of a link, and how it is distributed.
struct Inertial {
  double mass = 0;
  Pose origin = {};  ///< the frame of the tensor, in the frame of the link; it begins in the centre of mass
  InertiaTensor tensor = {};
};

/// What <inertial> of a URDF link says; none if it has no mass greater than 0. Throws InputError(Malformed).
std::optional<Inertial> urdf_inertial(const XmlDocument& document, const XmlElement& link);

/// The tensor as MuJoCo takes it: none if it is that of no body, because a moment is not positive or greater than the
/// sum of the other two. If these are equal, as of a flat plate, rounding may break the rule: the moments then become
/// greater by 1e-9 of their sum. A body that does not move may have no moments.
std::optional<InertiaTensor> mujoco_tensor(const InertiaTensor& tensor, bool moves);

/// A tensor for a mass that has none which MuJoCo takes: that of a ball, with the mean of the moments.
InertiaTensor mean_tensor(const Inertial& inertial);

/// <inertial .../> of MJCF.
std::string mjcf_inertial(const Inertial& inertial);

}  // namespace prohull::robot

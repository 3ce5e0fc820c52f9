#include "robot/files/inertial.h"

#include <fmt/format.h>

#include <algorithm>

#include "robot/files/urdf.h"

namespace prohull::robot {
namespace {

constexpr double kLeast = 1e-14;  // MuJoCo refuses less, of what moves

double trace(const InertiaTensor& m) { return m[0].x + m[1].y + m[2].z; }

InertiaTensor ball(double moment) { return {Vec3{moment, 0, 0}, Vec3{0, moment, 0}, Vec3{0, 0, moment}}; }

/// The matrix times `factor`, plus the identity times `added`.
InertiaTensor changed(InertiaTensor m, double factor, double added) {
  for (std::size_t i = 0; i < 3; ++i) m[i] = m[i] * factor + ball(added)[i];
  return m;
}

/// Whether a symmetric matrix is positive definite, by its leading minors.
bool is_positive(const InertiaTensor& m) {
  return m[0].x > 0 && m[0].x * m[1].y - m[0].y * m[1].x > 0 && dot(m[0], cross(m[1], m[2])) > 0;
}

/// Whether all moments are positive, and none is greater than the sum of the other two, whatever rounding does.
bool is_possible(const InertiaTensor& m) {
  const double rounding = 1e-12 * trace(m);
  return is_positive(changed(m, 1, -rounding - kLeast)) && is_positive(changed(m, -1, trace(m) / 2 - rounding));
}

}  // namespace

std::optional<Inertial> urdf_inertial(const XmlDocument& document, const XmlElement& link) {
  const XmlElement* const element = link.child("inertial");
  const XmlElement* const mass = element ? element->child("mass") : nullptr;
  if (!mass) return std::nullopt;
  Inertial result{.mass = document.number(*mass, "value", 0), .origin = urdf_origin(document, *element)};
  if (result.mass <= kLeast) return std::nullopt;
  const XmlElement* const tensor = element->child("inertia");
  if (!tensor) return result;
  const auto entry = [&](std::string_view name) { return document.number(*tensor, name, 0); };
  result.tensor = {Vec3{entry("ixx"), entry("ixy"), entry("ixz")}, Vec3{entry("ixy"), entry("iyy"), entry("iyz")},
                   Vec3{entry("ixz"), entry("iyz"), entry("izz")}};
  return result;
}

std::optional<InertiaTensor> mujoco_tensor(const InertiaTensor& tensor, bool moves) {
  if (is_possible(tensor) || (!moves && tensor == InertiaTensor{})) return tensor;
  const InertiaTensor greater = changed(tensor, 1, 1e-9 * trace(tensor));
  return is_possible(greater) ? std::optional(greater) : std::nullopt;
}

InertiaTensor mean_tensor(const Inertial& inertial) {
  constexpr double kMomentOfMass = 1e-3;  // of a ball with a radius of 5 cm
  const double mean = trace(inertial.tensor) / 3;
  return ball(mean > kLeast ? mean : std::max(kMomentOfMass * inertial.mass, 2 * kLeast));
}

std::string mjcf_inertial(const Inertial& inertial) {
  const Vec3& at = inertial.origin.translation;
  std::string text = fmt::format("<inertial pos=\"{} {} {}\" mass=\"{}\"", at.x, at.y, at.z, inertial.mass);
  InertiaTensor m = inertial.tensor;
  const Pose turn{inertial.origin.rotation, {}};
  const bool is_diagonal = m[0].y == 0 && m[0].z == 0 && m[1].z == 0;
  if (is_diagonal && turn != Pose{}) {
    const std::array<double, 4> q = quaternion_of(turn);
    text += fmt::format(" quat=\"{} {} {} {}\"", q[0], q[1], q[2], q[3]);
  }
  if (is_diagonal) return text + fmt::format(" diaginertia=\"{} {} {}\"/>", m[0].x, m[1].y, m[2].z);
  // MuJoCo takes no orientation beside a full matrix.
  if (turn != Pose{}) m = composed(composed(turn, {m, {}}), inverse(turn)).rotation;
  return text + fmt::format(" fullinertia=\"{} {} {} {} {} {}\"/>", m[0].x, m[1].y, m[2].z, m[0].y, m[0].z, m[1].z);
}

}  // namespace prohull::robot

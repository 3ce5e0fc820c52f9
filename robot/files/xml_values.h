#pragma once

#include <set>
#include <string>

#include "robot/files/xml.h"
#include "robot/transform.h"

namespace prohull::robot {

// What is checked alike in SDF and MJCF. All throw InputError(Malformed) that names `element`.

/// The name, or the first of name_2, name_3 and so on that is not among `names`, which gets it.
std::string unique_name(const std::string& name, std::set<std::string>& names);

/// The vector with length 1. Throws for a vector of length 0.
Vec3 unit_vector(const XmlDocument& document, const XmlElement& element, const Vec3& v, const std::string& what);

/// The rotation of a quaternion of any length but 0.
Pose quaternion_rotation(const XmlDocument& document, const XmlElement& element, double w, double x, double y,
                         double z);

/// The vector, whose numbers have to be less than 1e12, so that what is computed from them stays finite.
Vec3 bounded(const XmlDocument& document, const XmlElement& element, const Vec3& v);

/// The number, which has to be more than 0 and less than 1e12.
double positive(const XmlDocument& document, const XmlElement& element, double value, std::string_view what);

}  // namespace prohull::robot

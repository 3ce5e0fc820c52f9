#include "robot/files/xml_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace prohull::robot {
namespace {

constexpr double kLargest = 1e12;

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

std::string unique_name(const std::string& name, std::set<std::string>& names) {
  std::string unique = name;
  for (int i = 2; !names.insert(unique).second; ++i) unique = fmt::format("{}_{}", name, i);
  return unique;
}

Vec3 unit_vector(const XmlDocument& document, const XmlElement& element, const Vec3& v, const std::string& what) {
  const double scale = largest(v);
  if (scale == 0) document.refuse(element, what + " has length 0");
  const Vec3 scaled = v / scale;
  return scaled / norm(scaled);
}

Pose quaternion_rotation(const XmlDocument& document, const XmlElement& element, double w, double x, double y,
                         double z) {
  const double scale = std::max(std::abs(w), largest({x, y, z}));
  if (scale == 0) document.refuse(element, fmt::format("<{}> has a quaternion of length 0", element.name));
  return pose_of_quaternion(w / scale, x / scale, y / scale, z / scale);
}

Vec3 bounded(const XmlDocument& document, const XmlElement& element, const Vec3& v) {
  if (largest(v) < kLargest) return v;
  document.refuse(element, fmt::format("<{}> has the number {}, which is too large", element.name, largest(v)));
}

double positive(const XmlDocument& document, const XmlElement& element, double value, std::string_view what) {
  if (value > 0) return bounded(document, element, {value, 0, 0}).x;
  document.refuse(element, fmt::format("the {} of <{}> is {}, expected more than 0", what, element.name, value));
}

}  // namespace prohull::robot

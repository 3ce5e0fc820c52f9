// Apart from sphere_file.cpp, as the browser has no YAML.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "prohull/error.h"
#include "robot/files/sphere_file.h"

namespace prohull::robot {

std::string sphere_json(const LinkBalls& link) {
  nlohmann::json spheres = nlohmann::json::array();
  for (const auto& [center, radius] : link.balls)
    spheres.push_back({{"center", {center.x, center.y, center.z}}, {"radius", radius}});
  try {
    return nlohmann::json{{"link", link.link}, {"spheres", spheres}}.dump(2) + "\n";
  } catch (const nlohmann::json::exception&) {
    throw InputError(Defect::InvalidOption, fmt::format("'{}' is no name of a link: it is not UTF-8", link.link));
  }
}

}  // namespace prohull::robot

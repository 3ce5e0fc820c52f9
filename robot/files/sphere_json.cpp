// Apart from sphere_file.cpp, as the browser has no YAML.
#include <fmt/format.h>

#include "prohull/detail/refuse.h"
#include "robot/files/sphere_file.h"
#include "robot/json.h"

namespace prohull::robot {

std::string sphere_json(const LinkBalls& link) {
  try {
    return nlohmann::json{{"link", link.link}, {"spheres", link.balls}}.dump(2) + "\n";
  } catch (const nlohmann::json::exception&) {
    refuse(fmt::format("'{}' is no name of a link: it is not UTF-8", link.link));
  }
}

}  // namespace prohull::robot

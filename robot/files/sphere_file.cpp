#include "robot/files/sphere_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "prohull/detail/refuse.h"
#include "prohull/error.h"
#include "robot/files/yaml_reader.h"
#include "robot/json.h"

namespace prohull::robot {
namespace {

constexpr const char* kSpheres = "collision_spheres";
constexpr std::size_t kMostBalls = 100'000;  // aliases let a short file name any number

void add(const Ball& ball, LinkBalls& link) {
  if (ball.radius > 0)
    link.balls.push_back(ball);
  else
    ++link.switched_off;
}

class SphereReader : YamlReader {
 public:
  using YamlReader::parse;
  using YamlReader::YamlReader;

  std::vector<LinkBalls> links(const YAML::Node& whole) {
    const YAML::Node kinematics = whole.IsMap() && whole["robot_cfg"] ? whole["robot_cfg"]["kinematics"] : whole;
    const YAML::Node file = kinematics ? kinematics : whole;
    if (!file.IsMap() || !file[kSpheres]) refuse(file, "expected collision_spheres: and below it links");
    const YAML::Node map = file[kSpheres];
    if (!map.IsMap()) refuse(map, "collision_spheres: expected the name of a link and its spheres on each line");
    std::vector<LinkBalls> links;
    for (const auto& entry : map) {
      const auto link = value<std::string>(entry.first, "the name of a link");
      if (std::ranges::find(links, link, &LinkBalls::link) != links.end())
        refuse(entry.first, fmt::format("the link {} occurs twice", link));
      links.push_back({link, {}});
      add_balls(entry.second, links.back());
    }
    return links;
  }

 private:
  void add_balls(const YAML::Node& list, LinkBalls& link) {
    if (list.IsNull()) return;
    if (!list.IsSequence()) refuse(list, "expected a list of spheres, each with a center and a radius");
    for (const YAML::Node& node : list) {
      add(ball(node), link);
      if (++count_ > kMostBalls) refuse(node, fmt::format("there are more than {} spheres", kMostBalls));
    }
  }

  Ball ball(const YAML::Node& node) const {
    if (!node.IsMap() || !node["center"] || !node["radius"])
      refuse(node, "expected a sphere, as {center: [x, y, z], radius: r}");
    const YAML::Node center = node["center"];
    if (!center.IsSequence() || center.size() != 3) refuse(center, "center: expected three numbers, as [x, y, z]");
    return {{number(center[0]), number(center[1]), number(center[2])}, number(node["radius"])};
  }

  double number(const YAML::Node& node) const {
    const auto number = value<double>(node, "a number");
    if (!std::isfinite(number)) refuse(node, fmt::format("'{}': expected a finite number", node.Scalar()));
    return number;
  }

  std::size_t count_ = 0;
};

[[noreturn]] void refuse_json(const std::filesystem::path& path, const std::string& why) {
  throw InputError(Defect::Malformed, fmt::format("{}: {}", path.string(), why));
}

double finite_number(const nlohmann::json& value, const std::filesystem::path& path) {
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    refuse_json(path, "a coordinate or radius is no finite number");
  return value.get<double>();
}

Ball ball_of(const nlohmann::json& sphere, const std::filesystem::path& path) {
  static const nlohmann::json none;
  const auto at = [&](const char* key) -> const nlohmann::json& {  // no copy, which may overflow the stack
    const auto found = sphere.is_object() ? sphere.find(key) : sphere.end();
    return found == sphere.end() ? none : *found;
  };
  const nlohmann::json& center = at("center");
  if (!center.is_array() || center.size() != 3)
    refuse_json(path, "expected spheres as {\"center\": [x, y, z], \"radius\": r}");
  return {{finite_number(center[0], path), finite_number(center[1], path), finite_number(center[2], path)},
          finite_number(at("radius"), path)};
}

}  // namespace

// YAML 1.1, which Python reads, has no numbers such as 1e-05: they need a point.
std::string yaml_decimal(double number) {
  std::string text = fmt::format("{}", number);
  if (text.find('.') == std::string::npos) text.insert(std::min(text.find('e'), text.size()), ".0");
  return text;
}

std::string yaml_quoted(const std::string& name) {
  std::string text = quoted(name);
  if (YAML::Load(text).as<std::string>() != name)
    refuse(fmt::format("'{}' is no name of a link: it is not UTF-8", name));
  return text;
}

std::string yaml_ball(const Ball& ball) {
  const auto& [center, radius] = ball;
  return fmt::format("{{center: [{}, {}, {}], radius: {}}}", yaml_decimal(center.x), yaml_decimal(center.y),
                     yaml_decimal(center.z), yaml_decimal(radius));
}

std::string sphere_file(std::span<const LinkBalls> links) {
  std::string text = fmt::format("{}:{}\n", kSpheres, links.empty() ? " {}" : "");
  for (const LinkBalls& link : links) {
    text += fmt::format("  {}:{}\n", yaml_quoted(link.link), link.balls.empty() ? " []" : "");
    for (const Ball& ball : link.balls) text += fmt::format("    - {}\n", yaml_ball(ball));
  }
  return text;
}

std::vector<LinkBalls> read_sphere_file(const std::string& text, const std::filesystem::path& path) {
  SphereReader reader(path.string());
  return reader.parse(text, [&](const YAML::Node& file) { return reader.links(file); });
}

LinkBalls read_sphere_json(const std::string& text, const std::filesystem::path& path) {
  const nlohmann::json file = parsed_json(text, path.string());
  const auto spheres = file.is_object() ? file.find("spheres") : file.end();
  if (spheres == file.end() || !spheres->is_array())
    refuse_json(path,
                "expected a list of spheres, as `prohull spheres` writes it: {\"link\": NAME, \"spheres\": [...]}");
  LinkBalls link;
  if (const auto name = file.find("link"); name != file.end() && name->is_string()) link.link = *name;
  for (const nlohmann::json& sphere : *spheres) add(ball_of(sphere, path), link);
  return link;
}

}  // namespace prohull::robot

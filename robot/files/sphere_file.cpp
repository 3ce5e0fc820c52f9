#include "robot/files/sphere_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "prohull/error.h"
#include "robot/files/yaml_reader.h"

namespace prohull::robot {
namespace {

constexpr const char* kSpheres = "collision_spheres";
constexpr std::size_t kMostBalls = 100'000;  // aliases let a short file name any number

/// Reads back as the same double. YAML 1.1, which Python reads, has no numbers such as 1e-05: they need a point.
std::string decimal(double number) {
  std::string text = fmt::format("{}", number);
  if (text.find('.') == std::string::npos) text.insert(std::min(text.find('e'), text.size()), ".0");
  return text;
}

std::string quoted_utf8(const std::string& name) {
  std::string text = quoted(name);
  if (YAML::Load(text).as<std::string>() != name)
    throw InputError(Defect::InvalidOption, fmt::format("'{}' is no name of a link: it is not UTF-8", name));
  return text;
}

class SphereReader : YamlReader {
 public:
  using YamlReader::parse;
  using YamlReader::YamlReader;

  std::vector<LinkBalls> links(const YAML::Node& file) {
    if (!file.IsMap() || !file[kSpheres]) refuse(file, "expected collision_spheres: and below it links");
    const YAML::Node map = file[kSpheres];
    if (!map.IsMap()) refuse(map, "collision_spheres: expected the name of a link and its spheres on each line");
    std::vector<LinkBalls> links;
    for (const auto& entry : map) {
      const auto link = value<std::string>(entry.first, "the name of a link");
      if (std::ranges::find(links, link, &LinkBalls::link) != links.end())
        refuse(entry.first, fmt::format("the link {} occurs twice", link));
      links.push_back({link, balls(entry.second)});
    }
    return links;
  }

 private:
  std::vector<Ball> balls(const YAML::Node& list) {
    std::vector<Ball> balls;
    if (list.IsNull()) return balls;
    if (!list.IsSequence()) refuse(list, "expected a list of spheres, each with a center and a radius");
    for (const YAML::Node& node : list) {
      const Ball found = ball(node);
      if (found.radius > 0) balls.push_back(found);
      if (++count_ > kMostBalls) refuse(node, fmt::format("there are more than {} spheres", kMostBalls));
    }
    return balls;
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

}  // namespace

std::string sphere_file(std::span<const LinkBalls> links) {
  std::string text = fmt::format("{}:{}\n", kSpheres, links.empty() ? " {}" : "");
  for (const auto& [link, balls] : links) {
    text += fmt::format("  {}:{}\n", quoted_utf8(link), balls.empty() ? " []" : "");
    for (const auto& [center, radius] : balls)
      text += fmt::format("    - {{center: [{}, {}, {}], radius: {}}}\n", decimal(center.x), decimal(center.y),
                          decimal(center.z), decimal(radius));
  }
  return text;
}

std::vector<LinkBalls> read_sphere_file(const std::string& text, const std::filesystem::path& path) {
  SphereReader reader(path.string());
  return reader.parse(text, [&](const YAML::Node& file) { return reader.links(file); });
}

}  // namespace prohull::robot

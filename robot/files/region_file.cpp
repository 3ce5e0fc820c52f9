#include "robot/files/region_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include "robot/files/yaml_reader.h"

namespace prohull::robot {
namespace {

constexpr std::array<std::string_view, 5> kSelectors{"box", "color", "group", "faces", "vertices"};
constexpr std::array<std::string_view, 4> kOthers{"name", "spread", "keep", "max_distance"};

class RegionsReader {
 public:
  RegionsReader(std::string name, const std::function<double(const Length&)>& in_mesh)
      : yaml_(std::move(name)), in_mesh_(in_mesh) {}

  std::vector<Region> read(const std::string& text) const {
    return yaml_.parse(text, [&](const YAML::Node& top) {
      if (!top.IsMap() || !top["regions"] || !top["regions"].IsSequence() || top["regions"].size() == 0)
        yaml_.refuse(top, "expected a list of regions, as in regions: [{box: [[0, 0, 0], [10, 20, 5]], keep: true}]");
      for (const auto& entry : top)
        if (entry.first.Scalar() != "regions")
          yaml_.refuse(entry.first, fmt::format("'{}' is not known; the file has regions only", entry.first.Scalar()));
      std::vector<Region> regions;
      for (const YAML::Node& node : top["regions"]) regions.push_back(region(node, regions.size() + 1));
      return regions;
    });
  }

 private:
  Region region(const YAML::Node& node, std::size_t number) const {
    if (!node.IsMap()) yaml_.refuse(node, "expected a region, such as {group: flange, keep: true}");
    std::optional<std::string> selector;
    for (const auto& entry : node) {
      const std::string& key = entry.first.Scalar();
      const bool is_selector = std::ranges::find(kSelectors, key) != kSelectors.end();
      if (!is_selector && std::ranges::find(kOthers, key) == kOthers.end())
        yaml_.refuse(entry.first, fmt::format("'{}' is not known; a region has {}, and {}", key,
                                              fmt::join(kSelectors, " or "), fmt::join(kOthers, ", ")));
      if (is_selector && selector)
        yaml_.refuse(entry.first, fmt::format("the region has {} and {}; make two regions", *selector, key));
      if (is_selector) selector = key;
    }
    if (!selector)
      yaml_.refuse(node, fmt::format("the region does not say which faces; give it {}", fmt::join(kSelectors, " or ")));
    if (node["spread"] && *selector != "color") yaml_.refuse(node["spread"], "spread is for a color only");
    Region region;
    region.name = node["name"] ? yaml_.value<std::string>(node["name"], "a name") : described(node, *selector, number);
    region.max_distance = distance(node);
    region.faces = faces(node, *selector);
    return region;
  }

  static std::string described(const YAML::Node& node, const std::string& selector, std::size_t number) {
    const YAML::Node& value = node[selector];
    return value.IsScalar() ? fmt::format("{} ({})", number, value.Scalar()) : fmt::format("{}", number);
  }

  double distance(const YAML::Node& node) const {
    const bool is_kept = node["keep"] && yaml_.value<bool>(node["keep"], "true or false");
    const YAML::Node bound = node["max_distance"];
    if (is_kept == static_cast<bool>(bound)) yaml_.refuse(node, "a region has either 'keep: true' or a max_distance");
    if (is_kept) return 0;
    const auto length = bound.IsScalar() ? length_of(bound.Scalar()) : std::nullopt;
    const double distance =
        length ? length_in_mesh(bound, *length) : yaml_.value<double>(bound, "a length, such as 2, 2mm or 0.5%");
    if (!(distance > 0))
      yaml_.refuse(bound, "max_distance must be greater than 0; 'keep: true' keeps faces as they are");
    return distance;
  }

  double length_in_mesh(const YAML::Node& node, const Length& length) const {
    try {
      return in_mesh_(length);
    } catch (const InputError& error) {
      yaml_.refuse(node, error.what());
    }
  }

  RegionFaces faces(const YAML::Node& node, const std::string& selector) const {
    const YAML::Node value = node[selector];
    if (selector == "box") return box(value);
    if (selector == "color") return color(value, node["spread"]);
    if (selector == "group") return NamedGroup{yaml_.value<std::string>(value, "a name")};
    if (selector == "faces") return NumberedFaces{ranges(value)};
    return NumberedVertices{ranges(value)};
  }

  Box box(const YAML::Node& node) const {
    constexpr const char* kExpected = "a box, as in [[0, 0, 0], [10, 20, 5]]: its least and its greatest x, y and z";
    if (!node.IsSequence() || node.size() != 2) yaml_.refuse(node, fmt::format("expected {}", kExpected));
    const Box result{corner(node[0], kExpected), corner(node[1], kExpected)};
    for (int axis = 0; axis < 3; ++axis)
      if (!(result.min[axis] <= result.max[axis]))
        yaml_.refuse(node,
                     fmt::format("the box is empty: its least {0} is greater than its greatest {0}", "xyz"[axis]));
    return result;
  }

  Vec3 corner(const YAML::Node& node, const char* expected) const {
    if (!node.IsSequence() || node.size() != 3) yaml_.refuse(node, fmt::format("expected {}", expected));
    return {yaml_.value<double>(node[0], "a number"), yaml_.value<double>(node[1], "a number"),
            yaml_.value<double>(node[2], "a number")};
  }

  PaintedColor color(const YAML::Node& node, const YAML::Node& spread) const {
    const auto text = yaml_.value<std::string>(node, "a color");
    std::uint32_t number = 0;
    const char* const end = text.data() + text.size();
    const bool has_form = text.size() == 7 && text.front() == '#';
    if (const auto [at, error] = std::from_chars(text.data() + has_form, end, number, 16);
        !has_form || error != std::errc() || at != end)
      yaml_.refuse(node, fmt::format("'{}' is not a color; write red, green and blue in hexadecimal digits and in "
                                     "quotes, as \"#ff8000\"",
                                     text));
    const auto byte = [&](int shift) { return static_cast<std::uint8_t>(number >> shift & 0xff); };
    PaintedColor result{.color = {byte(16), byte(8), byte(0)}};
    constexpr const char* kSpread = "a number from 0 to 255";
    if (spread) result.spread = yaml_.value<unsigned>(spread, kSpread);
    if (result.spread > 255) yaml_.refuse(spread, fmt::format("'{}': expected {}", spread.Scalar(), kSpread));
    return result;
  }

  std::vector<NumberRange> ranges(const YAML::Node& node) const {
    std::vector<NumberRange> result;
    if (node.IsScalar()) return {range(node)};
    if (!node.IsSequence()) yaml_.refuse(node, "expected numbers, as in [0-99, 120]");
    for (const YAML::Node& item : node) result.push_back(range(item));
    return result;
  }

  NumberRange range(const YAML::Node& node) const {
    const std::string& text = node.Scalar();
    NumberRange result;
    const char* const end = text.data() + text.size();
    auto [at, error] = std::from_chars(text.data(), end, result.first);
    result.last = result.first;
    if (error == std::errc() && at != end && *at == '-') {
      const auto last = std::from_chars(at + 1, end, result.last);
      at = last.ptr, error = last.ec;
    }
    if (error != std::errc() || at != end || result.last < result.first)
      yaml_.refuse(node, fmt::format("'{}': expected a number or a range such as 0-99; numbers count from 0", text));
    return result;
  }

  const YamlReader yaml_;
  const std::function<double(const Length&)>& in_mesh_;
};

}  // namespace

std::vector<Region> read_region_file(const std::string& text, const std::string& name,
                                     const std::function<double(const Length&)>& in_mesh) {
  return RegionsReader(name, in_mesh).read(text);
}

}  // namespace prohull::robot

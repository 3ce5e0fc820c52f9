#include "robot/hulls/budgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "prohull/detail/refuse.h"
#include "prohull/error.h"
#include "prohull/length.h"
#include "robot/files/yaml_reader.h"

namespace prohull::robot {
namespace {

class BudgetReader : YamlReader {
 public:
  using YamlReader::parse;
  BudgetReader(const std::string& name, const Robot& robot, LinkHullOptions& options)
      : YamlReader(name), robot_(robot), options_(options) {}

  void read(const YAML::Node& file) {
    if (file.IsNull()) return;
    require_keys(file, {"default", "links"});
    if (file["default"]) read_budget(file["default"], options_.budget);
    if (file["links"] && !file["links"].IsNull()) read_links(file["links"]);
    if (file["default"]) require_heeded(file["default"]);
  }

 private:
  void require_keys(const YAML::Node& map, const std::set<std::string>& known) const {
    if (!map.IsMap()) refuse(map, fmt::format("expected {}", fmt::join(known, ", ")));
    for (const auto& entry : map)
      if (!known.contains(entry.first.as<std::string>()))
        refuse(entry.first,
               fmt::format("'{}' is not known; expected {}", entry.first.as<std::string>(), fmt::join(known, ", ")));
  }

  void read_links(const YAML::Node& links) const {
    if (!links.IsMap()) refuse(links, "links: expected the name of a link and its budget on each line");
    for (const auto& link : links) read_link(link.first, link.second);
  }

  /// Sizes under default may be for links of another kind.
  void require_heeded(const YAML::Node& defaults) const {
    require_sizes(defaults, [&](Collision kind) {
      return options_.budget.collision == kind ||
             std::ranges::any_of(options_.budgets, [&](const auto& link) { return link.second.collision == kind; });
    });
  }

  template <class IsOfUse>
  void require_sizes(const YAML::Node& budget, const IsOfUse& is_of_use) const {
    constexpr std::pair<const char*, Collision> kSizes[]{{"faces", Collision::Hull},
                                                         {"pieces", Collision::Convex},
                                                         {"vertices", Collision::Convex},
                                                         {"spheres", Collision::Spheres}};
    for (const auto& [size, kind] : kSizes)
      if (budget[size] && !is_of_use(kind))
        refuse(budget[size], fmt::format("{} is for collision: {}; leave it out, or say so", size,
                                         prohull::name_of(collision_names(), kind)));
  }

  void read_link(const YAML::Node& key, const YAML::Node& node) const {
    const auto link = value<std::string>(key, "the name of a link");
    if (std::ranges::find(robot_.links, link, &Link::name) == robot_.links.end())
      refuse(key, fmt::format("{} has no link '{}'; a file of --write-budgets has all links", robot_.name, link));
    const auto [budget, is_new] = options_.budgets.try_emplace(link, options_.budget);
    if (!is_new) refuse(key, fmt::format("the link {} occurs twice", link));
    if (node.IsNull()) return;
    read_budget(node, budget->second);
    require_sizes(node, [&, &made = budget->second](Collision kind) { return made.collision == kind; });
  }

  void read_budget(const YAML::Node& node, Budget& budget) const {
    require_keys(node, {"collision", "faces", "pieces", "vertices", "spheres", "max_distance", "gap", "skip"});
    if (node["collision"]) budget.collision = collision(node["collision"]);
    if (node["faces"]) budget.faces = faces(node["faces"]);
    if (node["pieces"]) budget.pieces = count(node["pieces"], 1, "pieces");
    if (node["vertices"]) budget.vertices = count(node["vertices"], 4, "vertices");
    if (node["spheres"]) budget.spheres = count(node["spheres"], 1, "spheres");
    if (node["max_distance"]) budget.max_distance = length(node["max_distance"], "max_distance");
    if (node["gap"]) budget.padding = length(node["gap"], "gap");
    if (node["skip"]) budget.skip = value<bool>(node["skip"], "true or false");
  }

  double length(const YAML::Node& node, const std::string& what) const {
    try {
      return length_of(value<std::string>(node, "a length, such as 2mm"), what);
    } catch (const InputError& error) {
      if (error.defect() != Defect::InvalidOption) throw;
      refuse(node, error.what());
    }
  }

  Collision collision(const YAML::Node& node) const {
    const char* const expected = "hull, convex or spheres";
    const auto said = value<std::string>(node, expected);
    if (const auto kind = value_of(collision_names(), said)) return *kind;
    refuse(node, fmt::format("'{}': expected {}", said, expected));
  }

  std::size_t count(const YAML::Node& node, long long least, std::string_view of) const {
    const std::string expected = fmt::format("at least {} {}", least, of);
    const auto said = value<long long>(node, expected);
    if (said < least || said > 1'000'000'000) refuse(node, fmt::format("'{}': expected {}", said, expected));
    return static_cast<std::size_t>(said);
  }

  /// One number for each set of hulls. Every set has a hull of each link.
  std::vector<std::size_t> faces(const YAML::Node& node) const {
    std::vector<std::size_t> counts;
    if (node.IsSequence())
      for (const YAML::Node& each : node) counts.push_back(count(each, 4, "faces"));
    else
      counts.push_back(count(node, 4, "faces"));
    if (counts.size() != options_.budget.faces.size())
      refuse(node, fmt::format("{} numbers of faces, but {} sets of hulls are asked for", counts.size(),
                               options_.budget.faces.size()));
    return counts;
  }

  const Robot& robot_;
  LinkHullOptions& options_;
};

std::string in_millimetres(double length) { return fmt::format("{:.6g}mm", length * 1000); }

/// "faces: [500]", or "pieces: 8, vertices: 64"
std::string size_of(const Budget& budget) {
  if (budget.collision == Collision::Hull) return fmt::format("faces: [{}]", fmt::join(budget.faces, ", "));
  if (budget.collision == Collision::Spheres) return fmt::format("spheres: {}", budget.spheres);
  return fmt::format("pieces: {}, vertices: {}", budget.pieces, budget.vertices);
}

/// "{faces: [500], gap: 5mm}": what counts, and is not so anyhow.
std::string text_of(const Budget& budget, const Budget& anyhow) {
  std::string text("{");
  if (budget.collision != anyhow.collision)
    text += fmt::format("collision: {}, ", prohull::name_of(collision_names(), budget.collision));
  text += size_of(budget);
  if (budget.max_distance > 0 || anyhow.max_distance > 0)
    text += ", max_distance: " + in_millimetres(budget.max_distance);
  if (budget.padding > 0 || anyhow.padding > 0) text += ", gap: " + in_millimetres(budget.padding);
  if (budget.skip || anyhow.skip) text += fmt::format(", skip: {}", budget.skip);
  return text + "}";
}

}  // namespace

void read_budgets(std::string_view text, const std::string& name, const Robot& robot, LinkHullOptions& options) {
  BudgetReader reader(name, robot, options);
  reader.parse(std::string(text), [&](const YAML::Node& file) { reader.read(file); });
}

std::string budgets_text(const Robot& robot, const LinkHullOptions& options) {
  std::string text =
      "# Budgets of hulls. Of each link: faces, max_distance, gap (lengths with a unit: mm, cm, m, in), and\n"
      "# skip: true to leave its collision elements as they are. What is left out is as under default.\n"
      "# collision: convex takes pieces and vertices, collision: spheres takes spheres, in place of faces.\n";
  text += fmt::format("default: {}\nlinks:\n", text_of(options.budget, {}));
  for (const Link& link : robot.links) {
    if (shapes(link, options.from).empty() && !options.budgets.contains(link.name)) continue;
    text += fmt::format("  {}: {}\n", quoted(link.name), text_of(options.budget_of(link.name), options.budget));
  }
  return text;
}

double length_of(std::string_view text, const std::string& what) {
  const auto length = prohull::length_of(text);
  if (!length || length->unit == "%")
    refuse(
        fmt::format("{}: '{}' is no length; say a number in metres, or one with a unit, as 2mm, 0.2cm, "
                    "0.002m or 0.08in",
                    what, text));
  return length->of(0);
}

}  // namespace prohull::robot

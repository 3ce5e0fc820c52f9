#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "robot/files/xml.h"
#include "robot/motion/motion.h"

namespace prohull::robot {
namespace {

/// The reason is free text to MoveIt, which knows "Adjacent", "Always" and "Never" among others.
std::string_view reason_of(PairKind kind) {
  constexpr std::string_view kReasons[]{
      R"(reason="Adjacent"/>)",
      R"(reason="sampled"/>  <!-- in collision in 95 % or more of them -->)",
      R"(reason="sampled"/>  <!-- in collision in none of them -->)",
      R"(reason="Always"/>  <!-- proven: their hulls meet wherever the joints are -->)",
      R"(reason="Never"/>  <!-- proven: their hulls meet nowhere within the limits of the joints -->)",
      ""};
  return kReasons[static_cast<std::size_t>(kind)];
}

std::optional<std::size_t> link_called(const Robot& robot, const std::string& name) {
  const auto found = std::ranges::find(robot.links, name, &Link::name);
  if (found == robot.links.end()) return {};
  return static_cast<std::size_t>(found - robot.links.begin());
}

DisabledRow row_of(const Robot& robot, std::string link1, std::string link2, std::string reason, std::size_t line) {
  DisabledRow row{std::move(link1), std::move(link2), std::move(reason), {}, line};
  const auto a = link_called(robot, row.link1), b = link_called(robot, row.link2);
  if (a && b && a != b) row.links = std::minmax(*a, *b);
  return row;
}

bool is_left_out(const MotionPair& pair, bool sampled_pairs) {
  return pair.kind != PairKind::Sometimes && (sampled_pairs || !is_sampled(pair.kind));
}

/// Adds rows of links all pairs of which are disabled, but for pairs that are enabled. A pair that has a row of its own
/// keeps it.
void add_default_rows(const Robot& robot, const XmlDocument& document, std::vector<DisabledRow>& rows) {
  constexpr const char* kDefault = "disable_default_collisions";
  std::set<LinkPair> others;
  for (const DisabledRow& row : rows)
    if (row.links) others.insert(*row.links);
  for (const XmlElement* const element : document.root().children_called("enable_collisions")) {
    const DisabledRow row =
        row_of(robot, document.required(*element, "link1"), document.required(*element, "link2"), "", element->line);
    if (row.links) others.insert(*row.links);
  }
  for (const XmlElement* const element : document.root().children_called(kDefault)) {
    const std::string& name = document.required(*element, "link");
    if (!link_called(robot, name)) rows.push_back(row_of(robot, name, "all others", kDefault, element->line));
    for (const Link& link : robot.links) {
      DisabledRow row = row_of(robot, name, link.name, kDefault, element->line);
      const bool has_geometry = !link.visual.empty() || !link.collision.empty();
      if (has_geometry && row.links && others.insert(*row.links).second) rows.push_back(std::move(row));
    }
  }
}

std::vector<DisabledRow> rows_of(const Robot& robot, const XmlDocument& document) {
  if (document.root().name != "robot") document.refuse(document.root(), "an SRDF file begins with <robot>");
  std::vector<DisabledRow> rows;
  for (const XmlElement* const element : document.root().children_called("disable_collisions")) {
    const std::string* const reason = element->attribute("reason");
    rows.push_back(row_of(robot, document.required(*element, "link1"), document.required(*element, "link2"),
                          reason ? *reason : "", element->line));
  }
  add_default_rows(robot, document, rows);
  return rows;
}

std::vector<LinkPair> pairs_of(std::span<const DisabledRow> rows) {
  std::vector<LinkPair> pairs;
  for (const DisabledRow& row : rows)
    if (row.links) pairs.push_back(*row.links);
  std::ranges::sort(pairs);
  return pairs;
}

bool is_of_srdf(const XmlElement* element) {
  constexpr std::array<std::string_view, 10> kNames{"disable_collisions",
                                                    "disable_default_collisions",
                                                    "enable_collisions",
                                                    "end_effector",
                                                    "group",
                                                    "group_state",
                                                    "joint_property",
                                                    "passive_joint",
                                                    "virtual_joint",
                                                    "link_sphere_approximation"};
  return std::ranges::find(kNames, element->name) != kNames.end();
}

}  // namespace

std::vector<LinkPair> pairs_always_together(const MotionResult& motion) {
  std::vector<LinkPair> pairs;
  for (const MotionPair& pair : motion.pairs)
    if (pair.kind == PairKind::Adjacent || pair.kind == PairKind::Always || pair.kind == PairKind::ProvenAlways)
      pairs.emplace_back(pair.a, pair.b);
  return pairs;
}

std::vector<LinkPair> pairs_left_out(const MotionResult& motion, bool sampled_pairs) {
  std::vector<LinkPair> pairs;
  for (const MotionPair& pair : motion.pairs)
    if (is_left_out(pair, sampled_pairs)) pairs.emplace_back(pair.a, pair.b);
  return pairs;
}

std::vector<LinkPair> disabled_pairs(const Robot& robot, std::string srdf, std::string file) {
  return pairs_of(rows_of(robot, XmlDocument(std::move(srdf), std::move(file))));
}

std::vector<LinkPair> Srdf::pairs() const { return pairs_of(rows); }

Srdf read_srdf(const Robot& robot, std::string srdf, std::string file) {
  const XmlDocument document(std::move(srdf), file);
  Srdf read{rows_of(robot, document), {}};
  const XmlElement& root = document.root();
  if (!root.children.empty() && std::ranges::none_of(root.children, is_of_srdf))
    document.refuse(root,
                    "it has no element of an SRDF file, as <disable_collisions>; name the SRDF file of the robot");
  const std::string* const name = root.attribute("name");
  const bool is_of_other = name && *name != robot.name;
  const std::string whose = is_of_other ? fmt::format("it is of the robot '{}', not of '{}'", *name, robot.name) : "";
  if (!read.rows.empty() &&
      std::ranges::none_of(read.rows, [](const DisabledRow& row) { return row.links.has_value(); }))
    document.refuse(root,
                    fmt::format("no row of it names two links of this robot{}{}; name the SRDF file of this robot",
                                is_of_other ? ": " : "", whose));
  if (is_of_other) read.notes.push_back(fmt::format("{}: {}", file, whose));
  return read;
}

std::string srdf_of(const Robot& robot, const MotionResult& motion, bool sampled_pairs) {
  std::vector<std::string> lines;
  for (const MotionPair& pair : motion.pairs) {
    if (!is_left_out(pair, sampled_pairs)) continue;
    const auto [first, second] = std::minmax(robot.links[pair.a].name, robot.links[pair.b].name);
    lines.push_back(fmt::format("  <disable_collisions link1=\"{}\" link2=\"{}\" {}\n", xml_escaped(first),
                                xml_escaped(second), reason_of(pair.kind)));
  }
  std::sort(lines.begin(), lines.end());
  const std::string about =
      sampled_pairs
          ? fmt::format(
                "The reason \"sampled\" is what {} random configurations, seed {}, say of a pair: it is no proof.",
                motion.configurations, motion.seed)
          : "Of links whose collision geometry is proven to cover them: pairs that joints connect, and pairs proven to "
            "meet never or always. All others have to be checked.";
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
      "<!-- {} -->\n"
      "<robot name=\"{}\">\n{}</robot>\n",
      about, xml_escaped(robot.name), fmt::join(lines, ""));
}

}  // namespace prohull::robot

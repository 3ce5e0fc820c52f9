#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "robot/files/xml.h"
#include "robot/motion/motion.h"

namespace prohull::robot {
namespace {

/// As MoveIt names them; empty for pairs that have to be checked.
std::string_view reason_of(PairKind kind) {
  switch (kind) {
    case PairKind::Adjacent:
      return "Adjacent";
    case PairKind::Always:
      return "Always";
    case PairKind::Never:
      return "Never";
    case PairKind::Sometimes:
      break;
  }
  return "";
}

}  // namespace

std::string srdf_of(const Robot& robot, const MotionResult& motion) {
  std::vector<std::string> lines;
  for (const MotionPair& pair : motion.pairs) {
    if (pair.kind == PairKind::Sometimes) continue;
    const auto [first, second] = std::minmax(robot.links[pair.a].name, robot.links[pair.b].name);
    lines.push_back(fmt::format("  <disable_collisions link1=\"{}\" link2=\"{}\" reason=\"{}\"/>\n", xml_escaped(first),
                                xml_escaped(second), reason_of(pair.kind)));
  }
  std::sort(lines.begin(), lines.end());
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
      "<!-- Pairs of links that need no check. They were found in {} random configurations, seed {}. -->\n"
      "<robot name=\"{}\">\n{}</robot>\n",
      motion.configurations, motion.seed, xml_escaped(robot.name), fmt::join(lines, ""));
}

}  // namespace prohull::robot

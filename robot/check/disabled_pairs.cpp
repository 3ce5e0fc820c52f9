#include "robot/check/disabled_pairs.h"

#include <algorithm>
#include <array>
#include <utility>

#include "prohull/error.h"
#include "robot/motion/joint_paths.h"
#include "robot/motion/path_bodies.h"

namespace prohull::robot {
namespace {

/// The links by one of their geometries, and why some are not read.
struct Links {
  std::vector<std::optional<ProofBody>> shapes;
  std::vector<std::string> unread;
};

Links links_of(const Robot& robot, std::span<const DisabledRow> rows, Geometry which) {
  Links links{std::vector<std::optional<ProofBody>>(robot.links.size()), std::vector<std::string>(robot.links.size())};
  const auto read = [&](std::size_t link) {
    if (links.shapes[link] || !links.unread[link].empty()) return;
    try {
      PathBody body = link_body(robot, link, which);
      links.shapes[link] = std::move(body.shape), links.unread[link] = std::move(body.unread);
    } catch (const InputError& error) {
      links.unread[link] = error.what();
    }
  };
  for (const DisabledRow& row : rows)
    if (row.links) read(row.links->first), read(row.links->second);
  return links;
}

/// What needs no proof; nothing if it does.
std::optional<PairProof> plain_finding(const DisabledRow& row, const JointPaths& joints, const Links& links) {
  if (!row.links) return PairProof{.verdict = PairVerdict::Unknown};
  const auto& [a, b] = *row.links;
  if (joints.are_adjacent(a, b)) return PairProof{.a = a, .b = b, .verdict = PairVerdict::Adjacent};
  for (const std::size_t link : {a, b})
    if (!links.unread[link].empty()) return PairProof{.a = a, .b = b, .why = links.unread[link]};
  if (!links.shapes[a] || !links.shapes[b]) return PairProof{.a = a, .b = b, .verdict = PairVerdict::NoGeometry};
  return {};
}

std::vector<PairProof> findings_by(const Robot& robot, std::span<const DisabledRow> rows, Geometry which,
                                   const ProofOptions& options) {
  const Links links = links_of(robot, rows, which);
  const JointPaths joints(robot);
  std::vector<PairProof> findings(rows.size());
  std::vector<LinkPair> pairs;
  std::vector<std::size_t> asked;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (auto plain = plain_finding(rows[i], joints, links))
      findings[i] = std::move(*plain);
    else
      pairs.push_back(*rows[i].links), asked.push_back(i);
  std::vector<PairProof> proofs = prove_pairs(robot, links.shapes, pairs, options);
  for (std::size_t k = 0; k < asked.size(); ++k) findings[asked[k]] = std::move(proofs[k]);
  return findings;
}

}  // namespace

bool DisabledCheck::is_refuted() const {
  constexpr std::array<std::string_view, 4> kMayMeet{"Adjacent", "Always", "Default", "User"};
  return std::ranges::find(kMayMeet, row.reason) == kMayMeet.end() &&
         (collision.verdict == PairVerdict::Meets || visual.verdict == PairVerdict::Meets);
}

bool DisabledCheck::has_refuted_reason() const {
  const auto never = [](const PairProof& proof) {
    return proof.verdict == PairVerdict::Never || proof.verdict == PairVerdict::NoGeometry;
  };
  return row.reason == "Always" && never(collision) && never(visual);
}

std::vector<DisabledCheck> check_disabled_pairs(const Robot& robot, std::span<const DisabledRow> rows,
                                                const ProofOptions& options) {
  const std::vector<PairProof> collision = findings_by(robot, rows, Geometry::Collision, options);
  const std::vector<PairProof> visual = findings_by(robot, rows, Geometry::Visual, options);
  std::vector<DisabledCheck> checks;
  for (std::size_t i = 0; i < rows.size(); ++i) checks.push_back({rows[i], collision[i], visual[i]});
  return checks;
}

}  // namespace prohull::robot

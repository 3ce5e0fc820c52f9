#include "robot/check/disabled_pairs.h"

#include <algorithm>
#include <array>
#include <utility>

#include "prohull/detail/names.h"
#include "prohull/error.h"
#include "robot/motion/joint_paths.h"
#include "robot/motion/path_bodies.h"

namespace prohull::robot {
namespace {

constexpr std::array<std::pair<std::string_view, DisabledVerdict>, 7> kDisabledNames{
    {{"unknown", DisabledVerdict::Unknown},
     {"adjacent", DisabledVerdict::Adjacent},
     {"no-geometry", DisabledVerdict::NoGeometry},
     {"never", DisabledVerdict::Never},
     {"always", DisabledVerdict::Always},
     {"meets", DisabledVerdict::Meets},
     {"open", DisabledVerdict::Open}}};

DisabledVerdict verdict_of(const PairProof& proof) {
  return *value_of(Names<DisabledVerdict>(kDisabledNames), name_of(proof.verdict));
}

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
std::optional<DisabledFinding> plain_finding(const DisabledRow& row, const JointPaths& joints, const Links& links) {
  if (!row.links) return DisabledFinding{DisabledVerdict::Unknown};
  const auto& [a, b] = *row.links;
  if (joints.are_adjacent(a, b)) return DisabledFinding{DisabledVerdict::Adjacent};
  for (const std::size_t link : {a, b})
    if (!links.unread[link].empty()) {
      DisabledFinding finding{DisabledVerdict::Open};
      finding.proof.a = a, finding.proof.b = b, finding.proof.why = links.unread[link];
      return finding;
    }
  if (!links.shapes[a] || !links.shapes[b]) return DisabledFinding{DisabledVerdict::NoGeometry};
  return {};
}

std::vector<DisabledFinding> findings_by(const Robot& robot, std::span<const DisabledRow> rows, Geometry which,
                                         const ProofOptions& options) {
  const Links links = links_of(robot, rows, which);
  const JointPaths joints(robot);
  std::vector<DisabledFinding> findings(rows.size());
  std::vector<LinkPair> pairs;
  std::vector<std::size_t> asked;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (auto plain = plain_finding(rows[i], joints, links))
      findings[i] = std::move(*plain);
    else
      pairs.push_back(*rows[i].links), asked.push_back(i);
  const std::vector<PairProof> proofs = prove_pairs(robot, links.shapes, pairs, options);
  for (std::size_t k = 0; k < asked.size(); ++k) findings[asked[k]] = {verdict_of(proofs[k]), proofs[k]};
  return findings;
}

}  // namespace

std::string_view name_of(DisabledVerdict verdict) {
  return prohull::name_of(Names<DisabledVerdict>(kDisabledNames), verdict);
}

bool DisabledCheck::is_refuted() const {
  constexpr std::array<std::string_view, 4> kMayMeet{"Adjacent", "Always", "Default", "User"};
  return std::ranges::find(kMayMeet, row.reason) == kMayMeet.end() &&
         (collision.verdict == DisabledVerdict::Meets || visual.verdict == DisabledVerdict::Meets);
}

std::vector<DisabledCheck> check_disabled_pairs(const Robot& robot, std::span<const DisabledRow> rows,
                                                const ProofOptions& options) {
  const std::vector<DisabledFinding> collision = findings_by(robot, rows, Geometry::Collision, options);
  const std::vector<DisabledFinding> visual = findings_by(robot, rows, Geometry::Visual, options);
  std::vector<DisabledCheck> checks;
  for (std::size_t i = 0; i < rows.size(); ++i) checks.push_back({rows[i], collision[i], visual[i]});
  return checks;
}

}  // namespace prohull::robot

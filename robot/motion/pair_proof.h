#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "prohull/progress.h"
#include "robot/model.h"
#include "robot/motion/cell_tree.h"
#include "robot/motion/joint_chain.h"
#include "robot/motion/proof_body.h"

namespace prohull::robot {

/// Two links, numbered as in Robot::links, the lower number first.
using LinkPair = std::pair<std::size_t, std::size_t>;

/// What is known about a pair of links at all positions that the joints between them can have.
enum class PairVerdict {
  Never,   ///< proven: they have no point in common at any position
  Always,  ///< no joint moves them against each other, and they meet
  Meets,   ///< they meet at PairProof::positions, exactly for the rounded vertices there
  Open,    ///< neither was found; PairProof::why says why
  // Only rows of SRDF files have these verdicts, which are no proofs:
  Unknown,     ///< the robot has no link of one of the names
  Adjacent,    ///< a joint connects them, or fixed joints do
  NoGeometry,  ///< one of them has none, so that they never meet
};
/// "never", "always", "meets", "open", "unknown", "adjacent", "no-geometry"
std::string_view name_of(PairVerdict verdict);

struct PairProof {
  std::size_t a = 0, b = 0;  ///< links, as asked for
  PairVerdict verdict = PairVerdict::Open;
  std::string why = {};                ///< of Open: a clause without a full stop
  double proven_free = 0;              ///< the share of the positions at which they are proven to be apart
  std::size_t cells = 0;               ///< of the joints' positions that were looked at
  std::vector<double> positions = {};  ///< of Always and Meets: of all joints of the robot, within their limits
  FacePair faces = {};                 ///< two faces that meet there; 0 and 0 where one link is inside of the other
  /// Known of Never, if ProofOptions::keep_trees: the joints that move freely, the positions that are looked at of
  /// each, and what became of the cells.
  std::vector<std::size_t> freedoms = {};
  std::vector<JointRange> ranges = {};
  CellTree tree = {};
};

struct ProofOptions {
  /// Most cells of a pair; one in which many pairs of faces are looked at counts as several. Time does not count, so
  /// that results are the same everywhere.
  std::size_t cells = 10'000;
  unsigned threads = 0;     ///< 0: one for each core
  bool keep_trees = false;  ///< for certificates
  Progress progress = {};   ///< stage "prove"
};

/// Decides for each pair whether the two links can meet. `links` has the mesh of each link, in its frame; a closed mesh
/// stands for its solid, as in collide.h. The result is the same for any number of threads. Throws Cancelled;
/// InputError as CollisionIndex, and InvalidOption for limits of a joint that are out of order.
///
/// How it works: A cell is a range of positions of each joint between the links. The links are apart in all of it if
/// in the middle all faces are farther from each other than the joints can move them towards each other: stay_apart.
/// Otherwise it is halved, across the joint that can change the distance of faces that may meet most. Cells in which
/// these are close come first, so that positions at which the links meet are found early. Where the cells are used up,
/// such positions are looked for downhill from those that are left, by an eighth as many steps.
///
/// What "proven" means: the axes, anchors and limits are those of `robot`, and the origins of its joints are the
/// rotations closest to their matrices; what doubles lose on the way is bounded, and part of the change.
std::vector<PairProof> prove_pairs(const Robot& robot, std::span<const TriangleMesh> links,
                                   std::span<const LinkPair> pairs, const ProofOptions& options = {});
/// Decides it for bodies, which may have several parts. Those that the pairs name have to be there.
std::vector<PairProof> prove_pairs(const Robot& robot, std::span<const std::optional<ProofBody>> links,
                                   std::span<const LinkPair> pairs, const ProofOptions& options = {});

}  // namespace prohull::robot

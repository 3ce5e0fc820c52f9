#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/progress.h"
#include "robot/model.h"
#include "robot/motion/cell_tree.h"
#include "robot/motion/joint_path.h"
#include "robot/motion/path_bodies.h"

namespace prohull::robot {

enum class PathVerdict {
  Free,   ///< proven: the bodies are farther apart than the gap, all along
  Meets,  ///< at a place of the path they are no farther apart than the gap
  Open,   ///< neither was found; why says why
};
std::string_view name_of(PathVerdict verdict);  ///< "free", "meets", "open"

/// Between two places of the path, bodies are at least this far apart: proven.
struct DistanceBound {
  double begin = 0, end = 0;
  double distance = 0;
  std::size_t pair = 0;  ///< of PathProof::curve: which of its pairs
};

/// A PathPairProof::why.
inline constexpr const char* kCellsUsedUp = "the number of cells is used up";

/// What is known of two bodies. Places are those of JointPath.
struct PathPairProof {
  std::size_t a = 0, b = 0;  ///< bodies, as asked for
  PathVerdict verdict = PathVerdict::Free;
  /// A clause without a full stop: of Open, and of Meets where the budget does not tell whether they do before.
  std::string why = {};
  /// Where they may meet first: before `begin` they do not, which is proven. If they meet, they do at `end`; if it is
  /// open, they are apart for a while behind `end`. Both are the path's end if they are free.
  double begin = 0, end = 0;
  std::vector<double> positions = {};  ///< of Meets: of all joints of the robot, at `end`
  std::size_t part_a = 0, part_b = 0;  ///< of Meets: which parts of the bodies meet
  FacePair faces = {};                 ///< two faces of these; 0 and 0 where one part is inside of the other
  bool nothing_moves = false;          ///< the path moves no joint between them
  std::size_t cells = 0;               ///< pieces of the path that were looked at
  /// In their order; nothing is known between them. They are sharp only if PathProofOptions::distances asks for it.
  std::vector<DistanceBound> bounds = {};
  CellTree tree = {};  ///< of Free, if PathProofOptions::keep_trees: 0 for each piece that is halved
};

struct PathProof {
  std::vector<PathPairProof> pairs;       ///< in the order in which they were asked for
  std::vector<DistanceBound> curve = {};  ///< the least over all pairs, from the first place to the last; if asked for

  PathVerdict verdict() const;  ///< Meets if any pair does, Free if all are
  double free_until() const;    ///< all pairs are proven to be apart up to this place
  /// The pair that meets first; if none does, one that is open first. Null if all are free.
  const PathPairProof* first() const;
  std::size_t cells() const;
};

struct PathProofOptions {
  double gap = 0;              ///< how far bodies have to be apart
  std::size_t cells = 10'000;  ///< most pieces of the path for a pair. Time does not count: see ProofOptions
  bool distances = false;      ///< also find the curve: no bound is less than 0.6 of the distance, as cells allow
  bool keep_trees = false;     ///< for certificates
  unsigned threads = 0;        ///< 0: one for each core
  Progress progress = {};      ///< stage "prove"
};

/// Decides for each path and each pair of bodies whether they are apart, by more than the gap, at every moment of the
/// path. `pairs` are those of pairs_on_path. The result is the same for any number of threads. Throws Cancelled.
///
/// How it works: A cell is a piece of the path. In all of it each joint stays within its JointPath::reach. The cell is
/// free where the distance in the middle exceeds the sum of JointChain::Motion::change and the gap; or, if the curve of
/// distances is not asked for, where the bodies stay_apart_across the way between the closest faces. Otherwise it is
/// halved. Cells with
/// a large change come first, so that places where the bodies meet are found early; what lies behind such a place is
/// not looked at any more.
///
/// What "proven" means: see prove_pairs. The path is the one that JointPath describes, in real numbers.
std::vector<PathProof> prove_paths(const Robot& robot, std::span<const JointPath> paths,
                                   std::span<const PathBody> bodies, std::span<const BodyPair> pairs,
                                   const PathProofOptions& options = {});

}  // namespace prohull::robot

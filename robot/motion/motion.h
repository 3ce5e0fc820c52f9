#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/progress.h"
#include "robot/model.h"
#include "robot/motion/kinematics.h"
#include "robot/motion/pair_proof.h"
#include "robot/motion/sampling.h"

namespace prohull::robot {

/// The bodies that are compared, of each link, in the frame of the link; empty where a link has none. A link that has
/// some of the three uses those in place of the others: no hull, and its visual geometry stands for it; no visual
/// geometry, and its hull does. But pairs of a link without a hull are of the kind Sometimes.
struct Bodies {
  std::vector<TriangleMesh> visual;  ///< what is really there
  std::vector<TriangleMesh> hull;    ///< our hulls with the primitives that are kept
  std::vector<TriangleMesh> convex;  ///< the convex hulls
  /// Within curved shapes, around which the others are; empty where a link has no curved shapes. They decide whether
  /// links meet at a witness.
  std::vector<TriangleMesh> visual_within = {}, hull_within = {};
};

struct MotionOptions {
  std::size_t configurations = 2000;
  std::uint64_t seed = 1;
  unsigned threads = 0;
  Progress progress = {};  ///< stage "move"
};

enum class PairKind {
  /// A joint connects them directly, or fixed joints do (JointPaths::are_adjacent).
  Adjacent,
  Always,        ///< they collide in 95 % of the configurations or more, as the hulls say; sampled, no proof
  Never,         ///< they collide in none, as the hulls and the visual geometry say; sampled, no proof
  ProvenAlways,  ///< PairVerdict::Always of the hulls
  ProvenNever,   ///< PairVerdict::Never of the hulls, and so of what they enclose
  /// All others, and pairs about which nothing is known: if a joint between them stays at rest (a ball, planar or
  /// floating joint, a prismatic one without limits, and those that follow one of these), if no joints connect them, or
  /// if one has no hull.
  Sometimes,
};
std::string_view name_of(PairKind kind);  ///< "adjacent", "sampled-always", ..., "always", "never", "sometimes"

/// Whether the kind is what random configurations say: another configuration may say otherwise.
bool is_sampled(PairKind kind);

/// In how many configurations a pair of links collides.
struct MotionPair {
  std::size_t a = 0, b = 0;  ///< links, a < b
  PairKind kind = PairKind::Sometimes;
  std::size_t visual = 0, hull = 0, convex = 0;
  std::size_t false_hull = 0, false_convex = 0;  ///< the hulls collide, but the visual geometry does not
  /// The visual geometry collides, but the hulls do not: a failed certificate. 0 if one of the links has no hull.
  std::size_t missed = 0;
  std::optional<PairProof> proof = {};   ///< of the hulls, if it was asked for
  bool visual_meets_at_witness = false;  ///< whether the visual geometry meets, too, at PairProof::positions
};

struct MotionResult {
  std::size_t configurations = 0;
  std::uint64_t seed = 0;
  std::vector<MotionPair> pairs;  ///< of links with geometry, sorted; adjacent ones have no counts
  /// The mean time of a check of one pair in one configuration, in microseconds, on one thread: of the first 1000 pairs
  /// whose bounding spheres meet, in the fastest of three runs.
  double visual_us = 0, hull_us = 0;
  /// In how many configurations any pair collides that is neither adjacent nor in collision always, and about which
  /// something is known.
  std::size_t visual_configurations = 0, hull_configurations = 0, convex_configurations = 0;

  std::size_t sum(std::size_t MotionPair::*count) const;  ///< over the pairs
  std::size_t false_hull() const { return sum(&MotionPair::false_hull); }
  std::size_t false_convex() const { return sum(&MotionPair::false_convex); }
  std::size_t missed() const { return sum(&MotionPair::missed); }
};

/// Moves the robot at random and counts which pairs of links collide. The counts are the same for any number of
/// threads. Bodies are asked as `collide` does; hulls and convex hulls that are closed as `may_collide` does, whose
/// "no" is certain. Faces with coordinates that are not finite are left out. Throws Cancelled.
MotionResult check_motion(const Robot& robot, const Bodies& bodies, const MotionOptions& options = {});

/// Sets MotionPair::proof of all pairs that are not adjacent and have hulls, and their kinds: what is proven, or
/// refuted, takes the place of what was sampled. Throws as prove_pairs.
void add_proofs(const Robot& robot, const Bodies& bodies, const ProofOptions& options, MotionResult& motion);

/// How many pairs were decided.
struct PairVerdicts {
  std::size_t never = 0, always = 0, meets = 0, open = 0;

  std::size_t all() const { return never + always + meets + open; }
};
PairVerdicts verdicts_of(const MotionResult& motion);

/// The pairs that are adjacent, or in collision always, proven or as sampled.
std::vector<LinkPair> pairs_always_together(const MotionResult& motion);

/// The pairs that srdf_of lists.
std::vector<LinkPair> pairs_left_out(const MotionResult& motion, bool sampled_pairs = false);

/// A <disable_collisions> element of an SRDF file; or what <disable_default_collisions> says of a pair, with that as
/// the reason: of its link and each other one with geometry, but for those that <enable_collisions> names.
struct DisabledRow {
  std::string link1, link2, reason;  ///< as the file has them
  std::optional<LinkPair> links;     ///< none if the robot does not have them, or they are the same one
  std::size_t line = 0;
};

/// The pairs that an SRDF file disables, sorted. Names that the robot does not have are left out. `file` stands in
/// messages. Throws InputError(Malformed) for text that is no SRDF.
std::vector<LinkPair> disabled_pairs(const Robot& robot, std::string srdf, std::string file);

/// The SRDF file of a robot.
struct Srdf {
  std::vector<DisabledRow> rows;   ///< in their order, those by default last
  std::vector<std::string> notes;  ///< sentences for the user: that it has the name of another robot

  std::vector<LinkPair> pairs() const;  ///< as of disabled_pairs
};

/// Throws InputError(Malformed) as disabled_pairs, and where the file is not for this robot: there are rows, and none
/// names two links; or there are elements, and none is of SRDF, as in a URDF file.
Srdf read_srdf(const Robot& robot, std::string srdf, std::string file);

/// The pairs that are adjacent, or proven to meet never or always, as an SRDF file that MoveIt reads: it does not check
/// them. With `sampled_pairs` also those that were never, or always, in collision, with the reason "sampled": they may
/// collide, or be apart, elsewhere.
std::string srdf_of(const Robot& robot, const MotionResult& motion, bool sampled_pairs = false);

}  // namespace prohull::robot

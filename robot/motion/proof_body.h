#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "prohull/collide.h"
#include "prohull/detail/drift.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/detail/shapes.h"
#include "robot/motion/joint_chain.h"

namespace prohull::robot {

/// A body as proofs about motion see it.
struct ProofBody {
  explicit ProofBody(const TriangleMesh& mesh) : ProofBody(std::span(&mesh, 1)) {}
  /// Where the meshes lie around curved shapes, `within` are meshes that these enclose.
  explicit ProofBody(std::span<const TriangleMesh> meshes, std::span<const TriangleMesh> within = {});

  std::vector<CollisionIndex> parts;   ///< of each mesh: they enclose the body
  std::vector<CollisionIndex> within;  ///< the body encloses them; empty if the parts are the body
  std::vector<Vec3> corners;           ///< their convex hull encloses the body
  Ball ball;                           ///< around them, but for rounding
};

/// The closest parts of two bodies, and bounds of their distance, which is that of the bodies, as `separation` has them
/// with a limit.
struct Closest {
  std::size_t part_a = 0, part_b = 0;
  Separation separation;
};
Closest closest_parts(const ProofBody& a, const ProofBody& b, const Pose& pose,
                      double limit = std::numeric_limits<double>::infinity());

/// What is closest of the meshes within the bodies. Its distance is not less than that of the bodies.
Closest closest_within(const ProofBody& a, const ProofBody& b, const Pose& pose,
                       double limit = std::numeric_limits<double>::infinity());

/// Faces of parts of two bodies that may come near each other.
struct NearParts {
  std::size_t part_a = 0, part_b = 0;
  NearFaces faces;
};

/// Whether two bodies stay farther apart than `gap` while they drift. Proven if true. Otherwise `near` are faces that
/// may come nearer. What it was before, of a similar motion, is where they are looked for first. To `leaf_pairs` is
/// added how much was looked at, as by `may_come_near`.
bool stay_apart(const ProofBody& a, const ProofBody& b, const JointChain::Motion& motion, double gap,
                std::optional<NearParts>& near, std::size_t& leaf_pairs);

/// Whether a plane across the way, which is in the frame of a, stays between two bodies that drift, more than `gap`
/// apart. Proven if true.
bool stay_apart_across(const Vec3& way, const ProofBody& a, const ProofBody& b, const JointChain::Motion& motion,
                       double gap);

/// Why it stays open whether bodies meet.
inline constexpr const char* kTouchesMesh = "one touches the mesh around a curved shape";

/// The limit that tells whether bodies are farther apart than this. It is no denormal number: where a library has the
/// processor take these for 0, no pair of faces would be below the limit.
inline double just_above(double distance) {
  using Limits = std::numeric_limits<double>;
  return std::max(std::nextafter(distance, Limits::infinity()), Limits::min());
}

/// Two faces that meet where these parts collide; 0 and 0 if one part is inside of the other.
FacePair first_faces(const ProofBody& a, const ProofBody& b, const Pose& pose, const Closest& closest);

/// The least distance of the balls, `b` being where the pose puts it, less `rounding`.
double distance_of_balls(const ProofBody& a, const ProofBody& b, const Pose& pose, double rounding);

/// Calls work(i) once for each number below `count`, on up to `threads` threads (0: one for each core), and tells the
/// meter how many are done. Throws what `work` throws, and Cancelled.
void in_parallel(std::size_t count, unsigned threads, ProgressMeter& meter,
                 const std::function<void(std::size_t)>& work);

}  // namespace prohull::robot

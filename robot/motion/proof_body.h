#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "prohull/collide.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/shapes.h"

namespace prohull::robot {

/// A body as proofs about motion see it.
struct ProofBody {
  explicit ProofBody(const TriangleMesh& mesh);

  CollisionIndex index;
  std::vector<Vec3> corners;  ///< their convex hull encloses the body
  Ball ball;                  ///< around them, but for rounding
};

/// The least distance of the balls, `b` being where the pose puts it, less `rounding`.
double distance_of_balls(const ProofBody& a, const ProofBody& b, const Pose& pose, double rounding);

TriangleMesh with_finite_faces(TriangleMesh mesh);

/// Calls work(i) once for each number below `count`, on up to `threads` threads (0: one for each core), and tells the
/// meter how many are done. Throws what `work` throws, and Cancelled.
void in_parallel(std::size_t count, unsigned threads, ProgressMeter& meter,
                 const std::function<void(std::size_t)>& work);

}  // namespace prohull::robot

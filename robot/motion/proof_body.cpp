#include "robot/motion/proof_body.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>

#include "prohull/convex_hull.h"

namespace prohull::robot {

namespace {

Closest closest_of(std::span<const CollisionIndex> a, std::span<const CollisionIndex> b, const Pose& pose,
                   double limit) {
  Closest closest;
  closest.separation.lower = closest.separation.upper = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Separation separation =
          prohull::separation(a[i], {}, b[j], pose, std::min(limit, closest.separation.upper));
      const double lower = std::min(closest.separation.lower, separation.lower);
      if (separation.upper < closest.separation.upper) closest = {i, j, separation};
      closest.separation.lower = lower;
      if (separation.collide()) return closest;
    }
  return closest;
}

std::span<const CollisionIndex> within(const ProofBody& body) { return body.within.empty() ? body.parts : body.within; }

}  // namespace

ProofBody::ProofBody(std::span<const TriangleMesh> meshes, std::span<const TriangleMesh> meshes_within)
    : within(meshes_within.begin(), meshes_within.end()) {
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) parts.emplace_back(mesh), append(all, mesh);
  const TriangleMesh convex = convex_hull(all);
  const TriangleMesh& outside = convex.face_count() > 0 ? convex : all;
  corners.assign(outside.positions.begin(), outside.positions.end());
  Box box;
  for (const Vec3& corner : corners) box.extend(corner);
  ball.center = box.center(), ball.radius = 0;
  for (const Vec3& corner : corners) ball.radius = std::max(ball.radius, norm(corner - ball.center));
}

Closest closest_parts(const ProofBody& a, const ProofBody& b, const Pose& pose, double limit) {
  return closest_of(a.parts, b.parts, pose, limit);
}

Closest closest_within(const ProofBody& a, const ProofBody& b, const Pose& pose, double limit) {
  return closest_of(within(a), within(b), pose, limit);
}

bool stay_apart_across(const Vec3& way, const ProofBody& a, const ProofBody& b, const JointChain::Motion& motion,
                       double gap) {
  return stay_apart_along(way, a.corners, motion.of_a, b.corners, motion.pose, motion.of_b, gap);
}

namespace {

/// A plane across the way between faces that were near, or between the balls, may do for all.
bool has_plane_between(const ProofBody& a, const ProofBody& b, const JointChain::Motion& motion, double gap,
                       const std::optional<NearParts>& near) {
  std::vector<Vec3> ways{placed(motion.pose, b.ball.center) - a.ball.center};
  if (near)
    ways.insert(ways.begin(), {placed(motion.pose, near->faces.point_b) - near->faces.point_a, near->faces.way});
  return std::ranges::any_of(ways, [&](const Vec3& way) { return stay_apart_across(way, a, b, motion, gap); });
}

}  // namespace

bool stay_apart(const ProofBody& a, const ProofBody& b, const JointChain::Motion& motion, double gap,
                std::optional<NearParts>& near, std::size_t& leaf_pairs) {
  if (has_plane_between(a, b, motion, gap, near)) return true;
  const auto are_near = [&](std::size_t i, std::size_t j, const NearFaces* first) {
    const auto faces =
        may_come_near(a.parts[i], {}, motion.of_a, b.parts[j], motion.pose, motion.of_b, gap, first, leaf_pairs);
    if (faces) near = {i, j, *faces};
    return faces.has_value();
  };
  const std::optional<NearParts> before = near;
  if (before && are_near(before->part_a, before->part_b, &before->faces)) return false;
  for (std::size_t i = 0; i < a.parts.size(); ++i)
    for (std::size_t j = 0; j < b.parts.size(); ++j) {
      const bool is_done = before && i == before->part_a && j == before->part_b;
      if (!is_done && are_near(i, j, nullptr)) return false;
    }
  return true;
}

FacePair first_faces(const ProofBody& a, const ProofBody& b, const Pose& pose, const Closest& closest) {
  const std::vector<FacePair> faces = intersecting_faces(a.parts[closest.part_a], {}, b.parts[closest.part_b], pose);
  return faces.empty() ? FacePair{} : faces.front();
}

double distance_of_balls(const ProofBody& a, const ProofBody& b, const Pose& pose, double rounding) {
  return norm(placed(pose, b.ball.center) - a.ball.center) - a.ball.radius - b.ball.radius - rounding;
}

void in_parallel(std::size_t count, unsigned threads, ProgressMeter& meter,
                 const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> done = 0;
  const int cores = oneapi::tbb::this_task_arena::max_concurrency();
  oneapi::tbb::task_arena arena(threads == 0 ? cores : static_cast<int>(std::min(threads, 1024U)));
  arena.execute([&] {
    oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      work(i);
      meter.at(++done, count);
    });
  });
}

}  // namespace prohull::robot

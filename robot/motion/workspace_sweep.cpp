#include "robot/motion/workspace_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "prohull/convex_cover.h"
#include "prohull/detail/verdict_parts.h"
#include "prohull/distance.h"
#include "prohull/enclosing_hull.h"
#include "prohull/error.h"
#include "robot/motion/joint_limits.h"
#include "robot/motion/kinematics.h"
#include "robot/motion/sampling.h"

namespace prohull::robot {
namespace {

/// The positions that a joint can have, rounded outwards. `allowed` are allowed_ranges of the robot.
JointRange range_of(const Robot& robot, std::span<const JointRange> allowed, std::size_t number,
                    std::size_t followed = 0) {
  const Joint& joint = robot.joints[number];
  const auto refuse = [&](const char* what) {
    throw InputError(Defect::InvalidOption, fmt::format("joint '{}' {}", joint.name, what));
  };
  JointRange range = allowed[number];
  if (joint.mimic && followed > robot.joints.size()) refuse("follows itself");
  if (joint.mimic) {
    const JointRange other = range_of(robot, allowed, joint.mimic->joint, followed + 1);
    const auto [lower, upper] =
        std::minmax({joint.mimic->multiplier * other.lower, joint.mimic->multiplier * other.upper});
    const double rounding = 0x1p-50 * (std::abs(lower) + std::abs(upper) + std::abs(joint.mimic->offset));
    range = {std::max(range.lower, lower + joint.mimic->offset - rounding),
             std::min(range.upper, upper + joint.mimic->offset + rounding)};
  }
  constexpr double kHalfTurn = std::numbers::pi * (1 + 0x1p-40);
  if (!moves(joint)) refuse("neither turns nor slides");
  if (!(range.lower <= range.upper)) refuse("has no position within its limits and those of the joints that follow it");
  if (turns(joint) && !(range.upper - range.lower < 2 * kHalfTurn)) return {-kHalfTurn, kHalfTurn};
  if (!(std::max(std::abs(range.lower), std::abs(range.upper)) <= kFarthestLimit)) refuse("has no limits");
  return range;
}

/// What encloses links behind a joint, in the frame of the first of them.
struct Zone {
  std::vector<TriangleMesh> pieces;  // convex polytopes
  double reach = 0;                  // how far they are from what the links pass
};

class Workspace {
 public:
  Workspace(const Robot& robot, std::span<const std::size_t> links, Geometry which, const SweepOptions& options)
      : robot_(robot), allowed_(allowed_ranges(robot)), links_(links), which_(which), options_(options) {}

  std::vector<LinkSweep> run() {
    std::vector<LinkSweep> sweeps;
    for (std::size_t link = 0; link < robot_.links.size(); ++link) {
      if (std::ranges::any_of(robot_.joints, [&](const Joint& joint) { return joint.child == link; })) continue;
      LinkSweep made{robot_.links[link].name, {}};
      Zone zone = zone_of(link, made);
      if (zone.pieces.empty()) continue;
      made.sweep.pieces = std::move(zone.pieces);
      tell_reach(zone.reach, made.sweep.verdict);
      sweeps.push_back(std::move(made));
    }
    return sweeps;
  }

 private:
  /// With what joints have added.
  static void tell_reach(double reach, Verdict& verdict) {
    const bool has_solid = verdict.distance_to_solid.has_value();
    verdict.distance_to_triangles.reset();
    (has_solid ? verdict.distance_to_solid : verdict.distance_to_triangles) =
        DistanceBounds{.upper = reach * (1 + 0x1p-40)};
    verdict.proof = "sweep";
  }

  Zone zone_of(std::size_t link, LinkSweep& said) const {
    Zone zone;
    if (std::ranges::find(links_, link) != links_.end()) add_link(link, zone, said);
    for (std::size_t first = 0; first < robot_.joints.size(); ++first) {
      const Joint& joint = robot_.joints[first];
      if (joint.parent != link || continues_row(robot_, first)) continue;
      Zone behind = zone_of(joint.child, said);
      if (behind.pieces.empty()) continue;
      std::size_t last = first;
      while (last + 1 < robot_.joints.size() && continues_row(robot_, last + 1)) ++last;
      for (std::size_t j = last + 1; j-- > first;) behind = moved(j, std::move(behind));
      std::ranges::move(behind.pieces, std::back_inserter(zone.pieces));
      zone.reach = std::max(zone.reach, behind.reach);
    }
    return zone;
  }

  void add_link(std::size_t link, Zone& zone, LinkSweep& made) const {
    TriangleMesh mesh = triangles_to_sweep(robot_.links[link], which_);
    if (mesh.face_count() == 0) return;
    made.links.push_back(robot_.links[link].name);
    Sweep& said = made.sweep;
    ConvexCover cover = covered(std::move(mesh));
    zone.reach = cover.verdict.distance().upper;
    said.verdict = made.links.size() > 1 ? both(std::move(said.verdict), cover.verdict) : cover.verdict;
    said.fills_cavities = said.fills_cavities || cover.fills_cavities;
    said.cover_pieces += cover.pieces.size();
    for (const std::string& note : cover.notes) said.notes.push_back(robot_.links[link].name + ": " + note);
    take(cover, zone);
  }

  Zone moved(std::size_t number, Zone zone) const {
    const Joint& joint = robot_.joints[number];
    if (joint.type == JointType::Fixed) return placed_by(joint.origin, joint.anchor, std::move(zone));
    const JointRange range = range_of(robot_, allowed_, number);
    zone = of_few_pieces(std::move(zone));
    Joint itself = joint;
    itself.origin = {};
    RigidMotion motion{.start = joint_pose(itself, range.lower), .through = joint.anchor, .axis = joint.axis};
    if (turns(joint))
      motion.angle = range.upper - range.lower;
    else
      motion.shift = joint.axis * (range.upper - range.lower);
    SweepOptions how = options_;
    how.float32_coordinates = false;
    Sweep made = sweep(zone.pieces, {{motion}}, how);
    return placed_by(joint.origin, joint.anchor, {std::move(made.pieces), zone.reach + made.verdict.distance().upper});
  }

  // The pose in which the motion starts, its product with the rest, and this one are each rounded by less than 2^-46 of
  // the extent.
  Zone placed_by(const Pose& origin, const Vec3& anchor, Zone zone) const {
    double growth = 0;
    for (TriangleMesh& piece : zone.pieces) {
      double extent = norm(origin.translation) + 2 * norm(anchor);
      std::vector<Vec3> points;
      for (const Vec3& p : piece.positions) points.push_back(placed(origin, p)), extent = std::max(extent, norm(p));
      EnclosingPolytope polytope = polytope_around(std::move(points), 0x1p-43 * extent, options_.float32_coordinates);
      piece = std::move(polytope.mesh), growth = std::max(growth, polytope.growth);
    }
    zone.reach += growth;
    return zone;
  }

  /// Many overlap: a hull of all of them has fewer.
  Zone of_few_pieces(Zone zone) const {
    constexpr std::size_t kHullFaces = 1000;
    if (zone.pieces.size() <= options_.max_pieces) return zone;
    const TriangleMesh all = together(zone.pieces);
    EnclosingOptions how;
    how.hull.threads = options_.threads;
    how.progress = options_.progress;
    const EnclosingHull hull = enclosing_hull(all, kHullFaces, how);
    const ConvexCover cover = covered(hull.mesh);
    if (!hull.certified || !hull.verdict.original_closed || !cover.verdict.original_closed ||
        cover.verdict.encloses_solid != Answer::Yes)
      throw InputError(Defect::NoCertificate, "no hull of what a joint moves was certified; please report this robot");
    Zone few;
    take(cover, few);
    few.reach = zone.reach + distance_bounds(hull.mesh, all).upper + cover.verdict.distance().upper;
    return few;
  }

  ConvexCover covered(TriangleMesh mesh) const {
    return convex_cover(std::move(mesh), {.max_pieces = options_.max_pieces,
                                          .float32_coordinates = options_.float32_coordinates,
                                          .threads = options_.threads,
                                          .progress = options_.progress});
  }

  static void take(const ConvexCover& cover, Zone& zone) {
    for (const ConvexPiece& piece : cover.pieces) zone.pieces.push_back(piece.mesh);
  }

  const Robot& robot_;
  const std::vector<JointRange> allowed_;
  const std::span<const std::size_t> links_;
  const Geometry which_;
  const SweepOptions& options_;
};

}  // namespace

std::vector<LinkSweep> sweep_workspace(const Robot& robot, std::span<const std::size_t> links, Geometry which,
                                       const SweepOptions& options) {
  return Workspace(robot, links, which, options).run();
}

}  // namespace prohull::robot

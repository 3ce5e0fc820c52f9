#include "robot/motion/path_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
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

/// The positions that the joint is swept through, of those that it passes.
JointRange swept_range(const Joint& joint, const JointRange& passed) {
  const auto refuse = [&](const char* what) {
    throw InputError(Defect::InvalidOption, fmt::format("joint '{}' {}", joint.name, what));
  };
  if (!moves(joint)) refuse("neither turns nor slides");
  if (!(passed.lower <= passed.upper))
    refuse("has no position within its limits and those of the joints that follow it");
  const JointRange range = turns(joint) ? one_turn(passed) : passed;
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
      : robot_(robot),
        passed_(passed_ranges(robot)),
        is_swept_(robot.links.size()),
        below_(robot.links.size()),
        which_(which),
        options_(options) {
    for (const std::size_t link : links) is_swept_[link] = true;
    for (std::size_t j = 0; j < robot.joints.size(); ++j)
      if (!continues_row(robot, j)) below_[robot.joints[j].parent].push_back(j);
  }

  std::vector<LinkSweep> run() {
    std::vector<bool> is_child(robot_.links.size());
    for (const Joint& joint : robot_.joints) is_child[joint.child] = true;
    std::vector<LinkSweep> sweeps;
    std::vector<Zone> zones(robot_.links.size());
    for (std::size_t link = 0; link < robot_.links.size(); ++link) {
      if (is_child[link]) continue;
      LinkSweep made{robot_.links[link].name, {}};
      add_zones(link, zones, made);
      Zone& zone = zones[link];
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

  /// The links of a tree, a parent before its children, and what hangs on a child before the next child.
  std::vector<std::size_t> tree_of(std::size_t root) const {
    std::vector<std::size_t> tree, open{root};
    while (!open.empty()) {
      const std::size_t link = open.back();
      open.pop_back();
      tree.push_back(link);
      for (std::size_t i = below_[link].size(); i-- > 0;) open.push_back(robot_.joints[below_[link][i]].child);
    }
    return tree;
  }

  /// The zones of the links of a tree, without recursion, as trees may be deep. That of the root is left.
  void add_zones(std::size_t root, std::vector<Zone>& zones, LinkSweep& said) const {
    const std::vector<std::size_t> tree = tree_of(root);
    for (const std::size_t link : tree)
      if (is_swept_[link]) add_link(link, zones[link], said);
    for (std::size_t i = tree.size(); i-- > 0;)
      for (const std::size_t first : below_[tree[i]]) {
        Zone behind = moved_by_row(first, std::move(zones[robot_.joints[first].child]));
        Zone& zone = zones[tree[i]];
        std::ranges::move(behind.pieces, std::back_inserter(zone.pieces));
        zone.reach = std::max(zone.reach, behind.reach);
      }
  }

  /// By the joint and those that move its child on.
  Zone moved_by_row(std::size_t first, Zone zone) const {
    if (zone.pieces.empty()) return zone;
    std::size_t last = first;
    while (last + 1 < robot_.joints.size() && continues_row(robot_, last + 1)) ++last;
    for (std::size_t j = last + 1; j-- > first;) zone = moved(j, std::move(zone));
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
    const JointRange range = swept_range(joint, passed_[number]);
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
    const EnclosingHull hull =
        enclosing_hull(all, kHullFaces, {.hull = {.threads = options_.threads}, .progress = options_.progress});
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
  const std::vector<JointRange> passed_;
  std::vector<bool> is_swept_;                   // of each link
  std::vector<std::vector<std::size_t>> below_;  // of each link: the first joints of its children
  const Geometry which_;
  const SweepOptions& options_;
};

}  // namespace

std::vector<LinkSweep> sweep_workspace(const Robot& robot, std::span<const std::size_t> links, Geometry which,
                                       const SweepOptions& options) {
  return Workspace(robot, links, which, options).run();
}

}  // namespace prohull::robot

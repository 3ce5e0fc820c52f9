#include "robot/motion/path_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "prohull/convex_cover.h"
#include "prohull/detail/finite.h"
#include "prohull/detail/refuse.h"
#include "prohull/detail/verdict_parts.h"
#include "prohull/error.h"
#include "robot/link_triangles.h"
#include "robot/motion/joint_chain.h"
#include "robot/motion/proof_body.h"

namespace prohull::robot {
namespace {

/// One convex piece of a link, and what it passes.
class PieceSweep {
 public:
  PieceSweep(const Robot& robot, const JointPath& path, std::size_t link, TriangleMesh piece, double max_distance,
             bool float32_coordinates)
      : path_(path),
        piece_(std::move(piece)),
        chain_(robot, root_of(robot, link), link, {}, {piece_.positions.begin(), piece_.positions.end()},
               path.ranges()),
        max_distance_(max_distance),
        float32_(float32_coordinates) {
    if (!chain_.obstacle().empty()) refuse(fmt::format("{}: {}", robot.links[link].name, chain_.obstacle()));
    const Vec3 center = bounding_box(piece_).center();
    for (const Vec3& p : piece_.positions) radius_ = std::max(radius_, norm(p - center) * (1 + 0x1p-40));
    for (const std::size_t joint : chain_.freedoms()) numbers_.push_back(path_.number_of(joint));
  }

  void run(std::atomic<std::size_t>& count, ProgressMeter& meter) { add(0, path_.length(), count, meter); }

  std::vector<TriangleMesh> pieces;
  double reach = 0;

 private:
  /// Where freedom `f` is.
  double position(std::size_t f, double place) const {
    return numbers_[f] ? path_.reach(*numbers_[f], place, place).middle : chain_.ranges()[f].middle();
  }

  JointChain::Travel travel(double begin, double end) const {
    std::vector<JointReach> reaches;
    std::vector<double> strays;
    for (std::size_t f = 0; f < numbers_.size(); ++f) {
      const double from = position(f, begin), to = position(f, end);
      strays.push_back(numbers_[f] ? path_.stray(*numbers_[f], begin, end) : 0);
      reaches.push_back({std::midpoint(from, to), std::abs(to - from) / 2 + strays.back()});
    }
    return chain_.travel(reaches, strays);
  }

  Pose pose(double place) const {
    std::vector<JointReach> reaches;
    for (std::size_t f = 0; f < numbers_.size(); ++f) reaches.push_back({position(f, place), 0});
    return chain_.motion(reaches).pose;
  }

  void add(double begin, double end, std::atomic<std::size_t>& count, ProgressMeter& meter) {
    meter.go_on();
    const JointChain::Travel travel = this->travel(begin, end);
    const double spread = spread_of(travel);
    const double middle = middle_place(begin, end);
    if (!(spread <= max_distance_) && begin < middle && middle < end) {
      add(begin, middle, count, meter);
      return add(middle, end, count, meter);
    }
    if (++count > kMostSweptPieces)
      refuse(
          fmt::format("the sweep takes more than {} convex pieces: allow a larger distance or fewer pieces, or name "
                      "fewer links",
                      kMostSweptPieces));
    std::vector<Vec3> points;
    for (const double place : {begin, end})
      for (const Pose at = pose(place); const Vec3& p : piece_.positions) points.push_back(placed(at, p));
    EnclosingPolytope polytope = polytope_around(std::move(points), travel.bend, float32_);
    pieces.push_back(std::move(polytope.mesh));
    reach = std::max(reach, spread + polytope.growth);
  }

  // As in src/cover/sweep.cpp: a point of the convex hull is a mean of points of the piece at the two ends. What lies
  // between them on the path has its middle within `bend` of the mean of both middles, and is turned against them.
  double spread_of(const JointChain::Travel& travel) const { return radius_ * travel.turn + travel.bend; }

  const JointPath& path_;
  const TriangleMesh piece_;
  const JointChain chain_;
  const double max_distance_;
  const bool float32_;
  double radius_ = 0;
  std::vector<std::optional<std::size_t>> numbers_;  // of the chain's freedoms on the path
};

TriangleMesh triangles_of(const Shape& shape, const std::string& link) {
  if (const auto* const form = std::get_if<OtherForm>(&shape.form))
    refuse(fmt::format("{}: its geometry of type {} is not read", link, form->what));
  TriangleMesh mesh = link_triangles({&shape, 1}, {});
  if (mesh.face_count() == 0)
    throw InputError(Defect::EmptyMesh, fmt::format("{}: a mesh of it has no triangles", link));
  if (with_finite_faces(mesh).face_count() != mesh.face_count())
    throw InputError(Defect::NonFiniteCoordinate,
                     fmt::format("{}: a mesh of it has corners that are not finite", link));
  return mesh;
}

}  // namespace

TriangleMesh triangles_to_sweep(const Link& link, Geometry which) {
  const Geometry other = which == Geometry::Visual ? Geometry::Collision : Geometry::Visual;
  TriangleMesh mesh;
  for (const Shape& shape : shapes(link, which).empty() ? shapes(link, other) : shapes(link, which))
    append(mesh, triangles_of(shape, link.name));
  return mesh;
}

std::vector<LinkSweep> sweep_links(const Robot& robot, const JointPath& path, std::span<const std::size_t> links,
                                   Geometry which, const SweepOptions& options) {
  constexpr double kUsualDistance = 0.02;  // of the diagonal, as in `sweep`
  const Robot moved = moved_by(robot, path);
  std::vector<LinkSweep> sweeps;
  std::vector<PieceSweep> tasks;
  std::vector<std::size_t> owners;
  for (const std::size_t link : links) {
    TriangleMesh mesh = triangles_to_sweep(robot.links[link], which);
    if (mesh.face_count() == 0) continue;
    const double diagonal = bounding_box(mesh).diagonal();
    ConvexCover cover = convex_cover(
        std::move(mesh), {.max_pieces = options.max_pieces, .threads = options.threads, .progress = options.progress});
    for (ConvexPiece& piece : cover.pieces) {
      tasks.emplace_back(moved, path, link, std::move(piece.mesh),
                         options.max_distance > 0 ? options.max_distance : kUsualDistance * diagonal,
                         options.float32_coordinates);
      owners.push_back(sweeps.size());
    }
    LinkSweep& made = sweeps.emplace_back(LinkSweep{robot.links[link].name, {}});
    made.sweep.verdict = std::move(cover.verdict);
    made.sweep.verdict.proof = "sweep";
    made.sweep.fills_cavities = cover.fills_cavities;
    made.sweep.cover_pieces = cover.pieces.size();
    made.sweep.notes = std::move(cover.notes);
  }
  std::atomic<std::size_t> count = 0;
  ProgressMeter meter(options.progress, "sweep");
  in_parallel(tasks.size(), options.threads, meter, [&](std::size_t i) { tasks[i].run(count, meter); });
  std::vector<double> reach(sweeps.size());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    std::vector<TriangleMesh>& pieces = sweeps[owners[i]].sweep.pieces;
    std::ranges::move(tasks[i].pieces, std::back_inserter(pieces));
    reach[owners[i]] = std::max(reach[owners[i]], tasks[i].reach);
  }
  for (std::size_t s = 0; s < sweeps.size(); ++s)
    sweeps[s].sweep.verdict = farther_by(std::move(sweeps[s].sweep.verdict), reach[s]);
  return sweeps;
}

}  // namespace prohull::robot

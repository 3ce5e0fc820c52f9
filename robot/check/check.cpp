#include "robot/check/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "prohull/closed_solid.h"
#include "prohull/convex_hull.h"
#include "prohull/detail/solid_pieces.h"
#include "prohull/enclosing_hull.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/mesh_query.h"
#include "prohull/union_verification.h"
#include "robot/side_by_side.h"

namespace prohull::robot {
namespace {

InsideVolume enclosed_volume(const TriangleMesh& triangles, const Progress& progress) {
  return triangles.face_count() == 0 ? InsideVolume{} : volume_inside(prepared_for_hulls(triangles), progress);
}

double area(const Triangle& t) { return norm(cross(t.b - t.a, t.c - t.a)) / 2; }

/// Points that are spread evenly over the surface, the same ones every time. In a face they follow the R2 sequence
/// (Roberts 2018), whose steps are powers of the plastic number.
std::vector<Vec3> samples(const TriangleMesh& mesh, std::size_t count) {
  double whole = 0;
  for (const FaceId f : mesh.triangles.ids()) whole += area(mesh.triangle(f));
  std::vector<Vec3> points;
  double before = 0;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    before += area(t);
    while (points.size() < count &&
           (static_cast<double>(points.size()) + 0.5) / static_cast<double>(count) * whole <= before) {
      double ignored, u = std::modf(0.7548776662466927 * static_cast<double>(points.size()), &ignored),
                      v = std::modf(0.5698402909980532 * static_cast<double>(points.size()), &ignored);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      points.push_back(t.a + u * (t.b - t.a) + v * (t.c - t.a));
    }
  }
  return points;
}

double mean_distance(const TriangleMesh& from, const TriangleMesh& to) {
  constexpr std::size_t kSamples = 1'000;
  MeshQuery query{QueryIndex(to)};
  const std::vector<Vec3> points = samples(from, kSamples);
  double sum = 0;
  for (const Vec3& p : points) sum += query.closest_point(p)->distance;
  return points.empty() ? 0 : sum / static_cast<double>(points.size());
}

std::string millimetres(double metres) { return fmt::format("{:.3g} mm", metres * 1000); }

/// Without the faces that have a corner which is not finite. Returns how many there were.
std::size_t drop_non_finite(TriangleMesh& mesh) {
  PerFace<std::array<VertexId, 3>> finite;
  for (const auto& t : mesh.triangles)
    if (std::all_of(t.begin(), t.end(), [&](VertexId v) { return is_finite(mesh.positions[v]); })) finite.push_back(t);
  for (Vec3& p : mesh.positions)
    if (!is_finite(p)) p = {};
  std::swap(mesh.triangles, finite);
  return finite.size() - mesh.triangles.size();
}

/// One link. Everything is in the common frame of its shapes, if they have one, so that nothing is rounded.
class LinkChecker {
 public:
  LinkChecker(const Link& link, std::size_t number, Progress progress) : link_(link), progress_(std::move(progress)) {
    check_.link = number;
    std::vector<Shape> all = link.visual;
    all.insert(all.end(), link.collision.begin(), link.collision.end());
    frame_ = common_frame(all);
  }

  LinkCheck run() {
    for (const Shape& shape : link_.visual) check_visual(shape);
    for (const Shape& shape : link_.collision) check_collision(shape);
    check_.visual_faces = flat_.face_count();
    check_.collision_faces = pieces_.triangles.face_count();
    if (check_.verdict != CheckVerdict::Missing) attempt([&] { decide(); });
    measure();
    for (TriangleMesh* mesh : {&check_.visual, &check_.collision}) *mesh = placed(frame_.in_link, std::move(*mesh));
    for (Vec3* point : {&check_.worst_point, &check_.reach.farthest}) *point = placed(frame_.in_link, *point);
    return std::move(check_);
  }

 private:
  void check_visual(const Shape& shape) {
    if (const auto* other = std::get_if<OtherForm>(&shape.form)) {
      check_.verdict = CheckVerdict::Missing;
      return note(
          fmt::format("{}: a visual geometry that is not read; nothing tells whether it is covered", other->what));
    }
    attempt([&] { add_visual(shape); });
  }

  void check_collision(const Shape& shape) {
    if (const auto* other = std::get_if<OtherForm>(&shape.form)) {
      has_unread_piece_ = true;
      return note(fmt::format("{}: a collision geometry that is not read; it counts as nothing", other->what));
    }
    attempt([&] { add_collision(shape); });
  }

  /// Notes why, if that cannot be.
  template <class Step>
  void attempt(Step step) {
    try {
      step();
    } catch (const InputError& error) {
      check_.verdict = CheckVerdict::Missing;
      note(error.what());
    }
  }

  void note(std::string sentence) { check_.notes.push_back(std::move(sentence)); }

  Pose pose_of(const Shape& shape) const { return shape.origin == frame_.in_link ? Pose{} : shape.origin; }

  void see(const Vec3& p, const Pose& pose) {
    if (!is_finite(p)) return;
    size_ = std::max(size_, norm(p) + norm(pose.translation));
    for (int axis = 0; axis < 3; ++axis) is_rounded_ |= !is_exact_sum(p[axis], pose.translation[axis]);
    is_rounded_ |= pose.rotation != Pose{}.rotation;
  }

  void see(const CurvedForm& form, const Pose& pose) {
    size_ = std::max(size_, form.largest_coordinate());
    is_rounded_ |= pose.rotation != Pose{}.rotation;
  }

  /// The finite triangles of a mesh file or of a box.
  TriangleMesh triangles_of(const Shape& shape) {
    const MeshFile* const file = shape.mesh();
    TriangleMesh mesh = file ? mesh_triangles(*file) : form_mesh(shape.form, Curved::Around);
    for (const Vec3& p : mesh.positions) see(p, pose_of(shape));
    mesh = in_frame(std::move(mesh), shape.origin, frame_);
    if (const std::size_t dropped = drop_non_finite(mesh); dropped > 0)
      note(fmt::format("{}: faces with a corner that is not finite: {}; they are left out", file->uri, dropped));
    return mesh;
  }

  void add_visual(const Shape& shape) {
    if (const auto form = curved_form(shape.form, pose_of(shape))) {
      see(*form, pose_of(shape));
      append(check_.visual, form->mesh(Curved::Around, shown_segments(link_.visual.size())));
      return curved_.push_back(*form);
    }
    const TriangleMesh mesh = triangles_of(shape);
    append(flat_, mesh);
    append(check_.visual, mesh);
  }

  void add_collision(const Shape& shape) {
    if (const auto form = curved_form(shape.form, pose_of(shape))) {
      see(*form, pose_of(shape));
      append(check_.collision, form->mesh(Curved::Around, shown_segments(link_.collision.size())));
      pieces_.curved.push_back(*form);
    } else {
      const TriangleMesh mesh = triangles_of(shape);
      if (mesh.face_count() == 0) return note(fmt::format("{}: no triangles", shape.mesh()->uri));
      append(pieces_.triangles, mesh);
      append(check_.collision, mesh);
      add_solid(shape, mesh);
    }
    ++check_.pieces;
  }

  /// What an open mesh bounds depends on the program that reads it: bullet fills it, fcl takes the triangles alone.
  void add_solid(const Shape& shape, const TriangleMesh& mesh) {
    if (is_closed(mesh)) return solids_.push_back(turned_outwards(mesh));
    const RepairedMesh repaired = repaired_mesh(mesh, {.keep_cavities = true});
    const std::string& uri = shape.mesh()->uri;
    if (!repaired.closed)
      return note(
          fmt::format("{}: the collision mesh is open and cannot be closed ({}); it bounds no solid, so that "
                      "only its own triangles count",
                      uri, repaired.obstacle));
    solids_.push_back(turned_outwards(repaired.closed->mesh));
    const Repairs& repairs = repaired.repairs;
    note(fmt::format(
        "{}: the collision mesh is open, so that programs disagree about its inside; for the check {} "
        "closed, the largest {} wide",
        uri, repairs.closed_openings == 1 ? "1 opening was" : fmt::format("{} openings were", repairs.closed_openings),
        millimetres(repairs.largest_opening)));
  }

  void add_solids() {
    const bool is_alone = solids_.size() + pieces_.curved.size() == 1;
    for (const TriangleMesh& solid : solids_)
      if (!is_alone && is_tangled(solid, progress_))
        pieces_.tangled.push_back(solid);
      else
        append(pieces_.solids, solid);
  }

  void decide() {
    if (link_.visual.empty()) return;
    check_.verdict = CheckVerdict::Missing;
    if (flat_.face_count() + curved_.size() == 0) return note("the visual geometry has no face that could be read");
    if (pieces_.empty() && has_unread_piece_) return;
    check_.verdict = CheckVerdict::NoCollision;
    if (pieces_.empty()) return;
    add_solids();
    check_.verdict = CheckVerdict::Covered;
    if (flat_.face_count() > 0) take(verify_pieces(flat_, pieces_, progress_));
    for (const CurvedForm& form : curved_) take(verify_pieces(form, pieces_, progress_));
    judge_rounding();
    // What is not read may cover the rest.
    if (check_.verdict == CheckVerdict::Covered || !has_unread_piece_) return;
    check_.verdict = CheckVerdict::Missing;
    check_.sticks_out_at_least = 0;
  }

  /// With size the largest norm of a point in the frame of its shape and of the translation, together: three angles,
  /// each up to a turn and within 2^-51, and the sines, cosines and products of a rotation make its entries wrong by
  /// less than 2^-49. For a vertex that comes to 2^-47 size in each coordinate, its own sums and products included, and
  /// for two shapes to less than 2^-45 size. PieceCover::reach itself is up to 2^-41 size too great.
  void judge_rounding() {
    check_.rounding = 0x1p-40 * size_;
    if (check_.verdict != CheckVerdict::Leaks || !is_rounded_ || check_.sticks_out_at_most > check_.rounding) return;
    check_.verdict = CheckVerdict::Undecided;
    check_.sticks_out_at_least = 0;
  }

  void take(const PieceCover& part) {
    if (part.covers == Covers::Yes) return;
    if (part.covers == Covers::No) check_.verdict = CheckVerdict::Leaks;
    if (part.covers == Covers::Unknown && check_.verdict == CheckVerdict::Covered)
      check_.verdict = CheckVerdict::Undecided;
    check_.faces_outside += part.outside.face_count();
    check_.sticks_out_at_most = std::max(check_.sticks_out_at_most, part.reach.upper);
    if (part.reach.lower < check_.sticks_out_at_least) return;
    check_.sticks_out_at_least = part.reach.lower;
    check_.worst_point = part.reach.farthest;
  }

  template <class Measure>
  auto measured(Measure measure_it) -> decltype(measure_it()) {
    try {
      return measure_it();
    } catch (const InputError& error) {
      note(fmt::format("no volume: {}", error.what()));
      return {};
    }
  }

  void measure_volumes(const std::optional<RepairedMesh>& visual) {
    const auto balls = only_balls(pieces_);
    const InsideVolume inside = measured([&] { return visual ? volume_inside(*visual, progress_) : InsideVolume{}; });
    const InsideVolume collision = measured([&] {
      return balls.empty() ? enclosed_volume(check_.collision, progress_) : InsideVolume{union_volume(balls)};
    });
    check_.collision_volume = collision.volume;
    // No estimate may say that what is covered is larger than what covers it.
    const bool is_exact = !inside.is_estimated && !collision.is_estimated;
    if (is_exact || check_.verdict != CheckVerdict::Covered || inside.volume <= collision.volume)
      check_.visual_volume = inside.volume;
  }

  void measure_reach(const std::optional<RepairedMesh>& visual) {
    const bool is_solid = visual && visual->closed;
    const TriangleMesh& solid = is_solid ? visual->closed->mesh : check_.visual;
    const DistanceOptions how{.max_cells = 100'000, .progress = progress_};
    if (const auto balls = only_balls(pieces_); !balls.empty())
      check_.reach = union_reach(balls, solid, how);
    else
      check_.reach =
          is_solid ? union_reach({&check_.collision, 1}, solid, how) : distance_bounds(check_.collision, solid, how);
    check_.mean_distance = mean_distance(check_.collision, check_.visual);
  }

  void measure() {
    std::optional<RepairedMesh> visual;
    if (check_.visual.face_count() > 0)
      visual = measured([&] { return std::optional(prepared_for_hulls(check_.visual)); });
    measure_volumes(visual);
    if (check_.visual.face_count() == 0) return;
    check_.convex_volume = signed_volume(convex_hull(check_.visual));
    if (check_.collision.face_count() > 0) measure_reach(visual);
  }

  /// Corners around the axis of the meshes that are measured and shown: many forms need fewer each.
  static std::size_t shown_segments(std::size_t forms) { return forms <= 8 ? 64 : 32; }

  const Link& link_;
  const Progress progress_;
  Frame frame_;
  TriangleMesh flat_;               // of the visual meshes and boxes
  std::vector<CurvedForm> curved_;  // the other visual forms
  SolidPieces pieces_;
  std::vector<TriangleMesh> solids_;  // of the pieces, before they are put together
  bool has_unread_piece_ = false;
  double size_ = 0;
  bool is_rounded_ = false;
  LinkCheck check_;
};

}  // namespace

std::string_view name_of(CheckVerdict verdict) {
  constexpr std::string_view kNames[]{"covered", "leaks", "undecided", "no-collision", "no-visual", "missing"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::vector<LinkCheck> check_links(const Robot& robot, const CheckOptions& options) {
  std::vector<LinkCheck> checks(robot.links.size());
  std::vector<std::string> names;
  for (const Link& link : robot.links) names.push_back(link.name);
  side_by_side(names, options.threads, options.progress,
               [&](std::size_t i, const Progress& go_on) { checks[i] = LinkChecker(robot.links[i], i, go_on).run(); });
  return checks;
}

bool passes(const LinkCheck& check, double allow) {
  switch (check.verdict) {
    case CheckVerdict::Covered:
    case CheckVerdict::NoVisual:
      return true;
    case CheckVerdict::Leaks:
      return check.sticks_out_at_most <= allow;
    case CheckVerdict::Undecided:
      return check.sticks_out_at_most <= std::max(allow, check.rounding);
    case CheckVerdict::NoCollision:
    case CheckVerdict::Missing:
      return false;
  }
  return false;
}

}  // namespace prohull::robot

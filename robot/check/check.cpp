#include "robot/check/check.h"

#include <fmt/format.h>

#include <algorithm>
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
#include "robot/form_measures.h"
#include "robot/side_by_side.h"

namespace prohull::robot {
namespace {

/// Frames that lead so many times the size of a link away, and back, round more than 1e-9 of it.
constexpr double kFar = 1000;

/// Segments of the meshes that stand for so many curved forms where distances are measured.
std::size_t fine_segments(std::size_t forms) { return forms <= 8 ? 128 : 32; }

/// How far the meshes around the forms reach out of them.
double reach_of_meshes(std::span<const CurvedForm> forms, std::size_t segments) {
  double upper = 0;
  for (const CurvedForm& form : forms)
    upper = std::max(upper, reach_at_most(form.mesh(Curved::Around, segments), form));
  return upper;
}

/// How far something reaches out of the form that lies within the mesh `around`, and encloses the mesh `within`.
DistanceBounds reach_out_of(const CurvedForm& form, const TriangleMesh& around, const TriangleMesh& within) {
  DistanceBounds reach{0, reach_at_most(around, form), {}};
  for (const Vec3& p : within.positions)
    if (const double lower = form.distance(p).lower; lower > reach.lower) reach.lower = lower, reach.farthest = p;
  return reach;
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

template <class Distance>
double mean_over(const TriangleMesh& surface, Distance distance) {
  constexpr std::size_t kSamples = 1'000;
  const std::vector<Vec3> points = samples(surface, kSamples);
  double sum = 0;
  for (const Vec3& p : points) sum += distance(p);
  return points.empty() ? 0 : sum / static_cast<double>(points.size());
}

std::string millimetres(double metres) { return fmt::format("{:.3g} mm", metres * 1000); }

/// One link. Everything is in the common frame of its shapes, if they have one, so that nothing is rounded.
class LinkChecker {
 public:
  LinkChecker(const Link& link, std::size_t number, Progress progress) : link_(link), progress_(std::move(progress)) {
    check_.link = number;
    std::vector<Shape> all = link.visual;
    all.insert(all.end(), link.collision.begin(), link.collision.end());
    frame_ = common_frame(all);
    for (const Shape& shape : all) way_ = std::max(way_, shape.way);
  }

  LinkCheck run() {
    for (const Shape& shape : link_.visual) check_visual(shape);
    for (const Shape& shape : link_.collision) check_collision(shape);
    check_.visual_faces = visual_.triangles.face_count();
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

  /// Once: the visual and the collision geometry may name one file.
  void note(std::string sentence) {
    if (std::ranges::find(check_.notes, sentence) == check_.notes.end()) check_.notes.push_back(std::move(sentence));
  }

  Pose pose_of(const Shape& shape) const { return pose_in(frame_, shape); }

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
    const std::size_t given = mesh.face_count();
    mesh = finite_triangles(std::move(mesh));
    if (const std::size_t dropped = given - mesh.face_count(); dropped > 0)
      note(fmt::format("{}: faces with a corner that is not finite: {}; they are left out", file->uri, dropped));
    return mesh;
  }

  void add_visual(const Shape& shape) {
    if (const auto form = curved_form(shape.form, pose_of(shape))) {
      see(*form, pose_of(shape));
      append(check_.visual, form->mesh(Curved::Around, shown_segments(link_.visual.size())));
      return visual_.curved.push_back(*form);
    }
    const TriangleMesh mesh = triangles_of(shape);
    append(visual_.triangles, mesh);
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
    if (visual_.empty()) return note("the visual geometry has no face that could be read");
    if (pieces_.empty() && has_unread_piece_) return;
    check_.verdict = CheckVerdict::NoCollision;
    if (pieces_.empty()) return;
    add_solids();
    check_.verdict = CheckVerdict::Covered;
    if (visual_.triangles.face_count() > 0) take(verify_pieces(visual_.triangles, pieces_, progress_));
    for (const CurvedForm& form : visual_.curved) take(verify_pieces(form, pieces_, progress_));
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
  /// The same holds of the frames that origins were computed from, with the lengths of their poses as the size.
  void judge_rounding() {
    constexpr double kRounding = 0x1p-40;
    check_.rounding = kRounding * std::max(size_, std::min(way_, kFar * size_));
    if (way_ > kFar * size_) {
      check_.sticks_out_at_most += kRounding * way_;
      check_.sticks_out_at_least = std::max(0.0, check_.sticks_out_at_least - kRounding * way_);
      if (check_.sticks_out_at_least == 0) check_.verdict = CheckVerdict::Undecided;
      return;
    }
    const bool is_rounded = is_rounded_ || way_ > 0;
    if (check_.verdict != CheckVerdict::Leaks || !is_rounded || check_.sticks_out_at_most > check_.rounding) return;
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
    if (part.reach.lower > check_.sticks_out_at_least) {
      check_.sticks_out_at_least = part.reach.lower;
      check_.worst_point = part.reach.farthest;
    } else if (check_.sticks_out_at_least == 0 && part.outside.face_count() > 0) {
      const Triangle face = part.outside.triangle(FaceId{});
      check_.worst_point = (face.a + face.b + face.c) / 3;
    } else if (check_.sticks_out_at_least == 0) {
      check_.worst_point = part.reach.farthest;
    }
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

  InsideVolume volume_of_visual(const RepairedMesh& visual) const {
    return visual_.curved.empty() ? volume_inside(visual, progress_) : volume_of(visual_, progress_);
  }

  void measure_volumes(const std::optional<RepairedMesh>& visual) {
    const InsideVolume inside = measured([&] { return visual ? volume_of_visual(*visual) : InsideVolume{}; });
    const InsideVolume collision = measured([&] { return volume_of(pieces_, progress_); });
    check_.collision_volume = collision.volume;
    // No estimate may say that what is covered is larger than what covers it.
    const bool is_exact = !inside.is_estimated && !collision.is_estimated;
    check_.is_estimated = !is_exact;
    if (is_exact || check_.verdict != CheckVerdict::Covered || inside.volume <= collision.volume)
      check_.visual_volume = inside.volume;
  }

  TriangleMesh fine_mesh(const SolidPieces& all, Curved curved) const {
    return with_forms(all.triangles, all.curved, curved, fine_segments(all.curved.size()));
  }

  /// The pieces, but for those that are visual ones as well: these reach nowhere.
  SolidPieces other_pieces() const {
    SolidPieces others{.solids = {}, .tangled = {}, .triangles = pieces_.triangles, .curved = pieces_.curved};
    if (pieces_.triangles == visual_.triangles) others.triangles = {};
    std::erase_if(others.curved, [&](const CurvedForm& form) { return std::ranges::count(visual_.curved, form) > 0; });
    return others;
  }

  /// How far pieces reach out of a solid, or from triangles that bound none. Meshes around the curved forms of the
  /// pieces give the upper bound, and of a solid meshes within them the lower one.
  DistanceBounds reach_of(const SolidPieces& all, const TriangleMesh& from, bool is_solid) const {
    if (all.empty()) return {};
    const DistanceOptions how{.max_cells = 100'000, .progress = progress_};
    if (const auto balls = only_balls(all); !balls.empty()) return union_reach(balls, from, how);
    const auto reach = [&](Curved curved) {
      const TriangleMesh mesh = fine_mesh(all, curved);
      return is_solid ? union_reach({&mesh, 1}, from, how) : distance_bounds(mesh, from, how);
    };
    DistanceBounds bounds = reach(Curved::Around);
    if (all.curved.empty()) return bounds;
    if (!is_solid) {
      const double error = reach_of_meshes(all.curved, fine_segments(all.curved.size()));
      return widened(bounds, error, error);
    }
    const double upper = bounds.upper;
    bounds = reach(Curved::Within);
    bounds.upper = upper;
    return bounds;
  }

  /// From the visual geometry as a mesh, which is around its curved forms: the solid reaches farther than theirs.
  void measure_reach_from(const TriangleMesh& from, bool is_solid) {
    const double around = reach_of_meshes(visual_.curved, shown_segments(link_.visual.size()));
    if (const SolidPieces others = other_pieces(); !others.empty())
      check_.reach = from_forms(reach_of(others, from, is_solid), around, is_solid);
    MeshQuery query{QueryIndex(from)};
    check_.mean_distance = mean_over(fine_mesh(pieces_, Curved::Within), [&](const Vec3& p) {
      return is_solid ? std::max(0.0, query.signed_distance(p).distance) : query.closest_point(p)->distance;
    });
  }

  void measure_reach_from(const CurvedForm& form) {
    const TriangleMesh within = fine_mesh(pieces_, Curved::Within);
    check_.reach = reach_out_of(form, fine_mesh(other_pieces(), Curved::Around), within);
    check_.mean_distance = mean_over(within, [&](const Vec3& p) { return form.distance(p).lower; });
  }

  void measure_reach(const std::optional<RepairedMesh>& visual) {
    if (visual_.triangles.face_count() == 0 && visual_.curved.size() == 1)
      measure_reach_from(visual_.curved[0]);
    else if (visual && visual->closed)
      measure_reach_from(visual->closed->mesh, true);
    else
      measure_reach_from(check_.visual, false);
  }

  void measure() {
    std::optional<RepairedMesh> visual;
    if (check_.visual.face_count() > 0)
      visual = measured([&] { return std::optional(prepared_for_hulls(check_.visual)); });
    measure_volumes(visual);
    if (check_.visual.face_count() == 0) return;
    check_.convex_volume = signed_volume(convex_hull(with_same_volume(visual_)));
    if (check_.collision.face_count() > 0) measure_reach(visual);
  }

  const Link& link_;
  const Progress progress_;
  Frame frame_;
  SolidPieces visual_;  // triangles of meshes and boxes, and the other forms
  SolidPieces pieces_;
  std::vector<TriangleMesh> solids_;  // of the pieces, before they are put together
  bool has_unread_piece_ = false;
  double size_ = 0, way_ = 0;  // of the shapes; of the frames that their origins were computed from
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

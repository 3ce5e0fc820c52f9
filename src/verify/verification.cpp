#include "prohull/verification.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/largest_coordinate.h"
#include "mesh/closed.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/detail/text.h"
#include "prohull/error.h"
#include "verify/gap.h"
#include "verify/original.h"
#include "verify/solids.h"
#include "verify/surface.h"

namespace prohull {
namespace {

/// Two units between which people forget to convert.
struct UnitPair {
  double factor;
  std::string_view what;
};
constexpr std::array kUnitPairs{UnitPair{1000, "metres and the other in millimetres"},
                                UnitPair{25.4, "inches and the other in millimetres"}};
constexpr double kAbout = 1.35;  ///< a coarse hull is so much larger than what it encloses

void note_units(const Box& hull, const Box& original, std::vector<std::string>& notes) {
  const double small = std::min(hull.diagonal(), original.diagonal());
  const double ratio = std::max(hull.diagonal(), original.diagonal()) / small;
  for (const auto& [factor, what] : kUnitPairs)
    if (ratio > factor / kAbout && ratio < factor * kAbout)
      notes.push_back(fmt::format("the hull is {:.4g} times {} than the original: perhaps one of them is in {}", ratio,
                                  small == hull.diagonal() ? "smaller" : "larger", what));
}

void note_place(const Box& hull, const Box& original, std::vector<std::string>& notes) {
  note_units(hull, original, notes);
  if (!hull.is_empty() && !original.is_empty() && !hull.overlaps(original))
    notes.emplace_back(
        "the hull lies beside the original: if it was built with --recenter, give the --offset that the build told");
}

/// The replay judges positions that are not finite.
Box usable_box(const ProgressiveHull& hull) {
  Box box;
  for (const Vec3& p : hull.positions())
    if (is_finite(p)) box.extend(p);
  require_usable_reach(box, "coordinates of the hull");
  return box;
}

/// One verification, step by step. Each step has its share of the progress.
class Judge {
 public:
  Judge(verify::Original& original, HullSide side, const VerificationOptions& options, std::size_t steps)
      : original_(original),
        stand_in_(original.stand_in()),
        options_(options),
        meter_(options.progress, "verify"),
        steps_(steps) {
    found.side = side;
    const verify::PreparedOriginal& prepared = original.facts();
    found.notes = original.notes();
    found.original_closed = prepared.closed;
    found.turned_original_faces = prepared.turned_faces;
    found.non_finite_faces = prepared.non_finite_faces;
    if (stand_in_) found.cap_faces = stand_in_->caps;
    if (!is_outer() && !has_solid())
      throw InputError(
          Defect::OpenEdge,
          "the original is not closed: it has no inside that could enclose an inner hull; `prohull repair` "
          "closes it, and --open-shells close closes its openings");
    if (has_solid()) found.encloses_solid = Answer::Undecided;
    if (!has_solid() || !options.solid_only) found.covers_triangles = Answer::Undecided;
  }

  bool has_solid() const { return original_.has_solid(); }
  bool asks_triangles() const { return found.covers_triangles != Answer::NotAsked; }
  bool encloses_solid() const { return found.encloses_solid == Answer::Yes; }

  bool is_outer() const { return found.side == HullSide::Outer; }

  /// The closed mesh that the hull is compared with, if there is one.
  const TriangleMesh& solid() const { return original_.solid().mesh(); }

  EnclosureOptions next_step() {
    const double from = static_cast<double>(done_++), steps = static_cast<double>(steps_);
    return {.max_offenders = options_.max_offenders,
            .most_outside = options_.most_outside,
            .progress = meter_.part(from / steps, (from + 1) / steps),
            .max_steps = verify::most_steps(options_, original_.mesh().face_count())};
  }

  /// Hulls are not turned, but refused: who uses one believes that it looks outwards.
  bool refuses_inverted(const TriangleMesh& hull) {
    require_closed(hull, "hull");
    TriangleMesh turned = hull;
    const auto [faces, inwards] = verify::turn_outwards(turned, "hull");
    found.inverted_hull_faces = faces;
    if (faces == 0) return false;
    (has_solid() ? found.encloses_solid : found.covers_triangles) = Answer::No;
    found.why_not =
        inwards < faces
            ? "the hull is inside out as a whole: its volume is negative; turn it (trimesh: mesh.invert()) if that is "
              "meant"
        : faces == hull.face_count()
            ? "all faces of the hull look inwards; turn it (trimesh: mesh.invert()) if that is meant"
            : fmt::format(
                  "{} of the hull {} inwards, in whole components; turn these (trimesh: "
                  "mesh.fix_normals(multibody=True)) if that is meant",
                  counted(found.inverted_hull_faces, "face"), found.inverted_hull_faces == 1 ? "looks" : "look");
    return true;
  }

  void enclose_solid(verify::KnownSolid& hull) {
    found.encloses_solid = take(enclosure_of_solids(hull),
                                is_outer() ? "a part of the solid that the original bounds lies outside of the hull"
                                           : "a part of the solid that the hull bounds lies outside of the original");
    if (asks_triangles() && any_triangle_is_outside()) found.covers_triangles = Answer::No;
  }

  /// Of an original that is not closed.
  void cover_all(const TriangleMesh& hull) { cover_all(hull, options_.most_outside); }

  void cover_all(const TriangleMesh& hull, std::size_t most_outside) {
    EnclosureOptions how = next_step();
    how.most_outside = most_outside;
    found.covers_triangles = take(verify_cover(original_.mesh(), hull, how), kLeavesTriangles);
  }

  /// By the finest level of a hull, and so by all, or else by the base mesh.
  void cover_all_by_levels(const TriangleMesh& finest, const TriangleMesh& base) {
    cover_all(finest, std::numeric_limits<std::size_t>::max());  // they are counted
    if (found.faces_outside == 0) return;
    const std::size_t outside = found.faces_beside_solid = found.faces_outside;
    cover_all(base);
    if (found.is_yes())
      found.notes.push_back(
          fmt::format("{} of the original lie{} outside of the finest level, as in folds: the base mesh "
                      "covers {}, finer levels may not",
                      counted(outside, "face"), outside == 1 ? "s" : "", outside == 1 ? "it" : "them"));
  }

  /// Where solids are enclosed, triangles that bound them are covered: what is left are the others.
  void cover_the_rest(verify::KnownSolid& hull) {
    const EnclosureOptions looking = next_step(), how = next_step();
    const std::vector<FaceId>& rest = inner(hull).faces_beside(looking.progress);
    found.faces_beside_solid = rest.size();
    found.covers_triangles = Answer::Yes;
    if (rest.empty()) return;
    found.covers_triangles =
        take(covered(inner(hull).mesh(), rest, outer(hull).mesh(), how),
             is_outer() ? "triangles of folds of the original, or of parts that are inside out, lie "
                          "outside of the hull; its solid is enclosed"
                        : "triangles of folds of the hull, or of parts that are inside out, lie outside "
                          "of the original; its solid is enclosed");
  }

  /// The triangles of the original that are no faces of its stand-in, as those that repair has dropped.
  void cover_what_is_not_in_the_solid(const TriangleMesh& hull) {
    if (!asks_triangles() || !stand_in_ || !is_outer() || !found.is_yes() || stand_in_->rest.empty()) return;
    EnclosureReport report = covered(original_.mesh(), stand_in_->rest, hull, next_step());
    found.covers_triangles = verify::answer_of(report);
    if (found.covers_triangles == Answer::No) found.why_not = kLeavesTriangles;
    if (found.covers_triangles == Answer::Undecided) found.why_not = verify::undecided(report.faces_undecided);
    found.faces_undecided = report.faces_undecided;
    found.faces_outside = report.faces_outside;
    found.worst = std::move(report.worst);
  }

  void conclude() {
    found.encloses = found.is_yes();
    verify::refuse_non_finite_faces(found.non_finite_faces, options_, found.encloses, found.why_not);
  }

  /// What cover_the_rest asks first of an outer hull: may run beside other steps.
  void look_at_solid() { original_.solid().bounds_one(meter_); }

  void keep_gap(const TriangleMesh& hull) {
    verify::GapReport report = verify::verify_gap(hull, original_.mesh(), options_.gap, next_step());
    found.keeps_gap = report.keeps_gap();
    if (found.keeps_gap) found.gap = options_.gap;
    found.faces_undecided += report.faces_undecided;
    found.faces_too_near = report.faces_too_near;
    found.nearest = std::move(report.nearest);
    found.least_distance = report.least_distance;
    const bool decides = found.encloses || (found.is_undecided() && found.faces_too_near > 0);
    if (found.keeps_gap || !decides) return;
    found.why_not = found.faces_too_near > 0
                        ? fmt::format("{} of it {} nearer to the original than that",
                                      counted(found.faces_too_near, "face"), found.faces_too_near == 1 ? "is" : "are")
                        : verify::undecided(report.faces_undecided);
  }

  void measure(verify::KnownSolid& hull) {
    if (!found.encloses && gives_up()) return;
    found.self_intersections = hull.self_intersections(meter_).size();
    found.hull_volume = found.inverted_hull_faces > 0 ? signed_volume(hull.mesh()) : hull.volume(meter_);
    if (has_solid()) found.original_volume = original_.solid().volume(meter_);
    if (found.original_volume > 0) found.void_ratio = found.hull_volume / found.original_volume - 1;
    found.certified = found.encloses && found.keeps_gap;
    meter_.at(1);
  }

  Verification found;

 private:
  bool gives_up() const { return options_.most_outside < std::numeric_limits<std::size_t>::max(); }

  /// Caps are none.
  bool any_triangle_is_outside() const {
    if (!stand_in_ || !is_outer()) return found.faces_outside > 0;
    return std::ranges::any_of(found.worst,
                               [&](const Offender& o) { return index(o.face) < original_.mesh().face_count(); });
  }

  EnclosureReport enclosure_of_solids(verify::KnownSolid& hull) {
    const EnclosureOptions how = next_step();
    EnclosureReport of_itself;
    of_itself.encloses = true;
    if (has_triangles_of(hull.mesh(), solid())) return of_itself;
    return verify::verify_enclosure(inner(hull).surface(), outer(hull).surface(), how);
  }

  static constexpr std::string_view kLeavesTriangles = "triangles of the original lie outside of the hull, or in part";

  Answer take(EnclosureReport report, std::string_view why_not) {
    const Answer answer = verify::answer_of(report);
    if (answer == Answer::No) found.why_not = why_not;
    if (answer == Answer::Undecided) found.why_not = verify::undecided(report.faces_undecided);
    found.faces_undecided = report.faces_undecided;
    found.faces_outside = report.faces_outside;
    found.worst = std::move(report.worst);
    if (stand_in_ && is_outer())
      for (Offender& o : found.worst) o.face = stand_in_->number[index(o.face)];
    found.cavities += report.cavities;
    return answer;
  }

  /// verify_cover of some faces of a mesh.
  static EnclosureReport covered(const TriangleMesh& mesh, const std::vector<FaceId>& faces, const TriangleMesh& outer,
                                 const EnclosureOptions& how) {
    TriangleMesh triangles{mesh.positions, {}};
    for (const FaceId f : faces) triangles.triangles.push_back(mesh.triangles[f]);
    EnclosureReport report = verify_cover(triangles, outer, how);
    for (Offender& o : report.worst) o.face = faces[index(o.face)];
    return report;
  }

  verify::KnownSolid& inner(verify::KnownSolid& hull) { return is_outer() ? original_.solid() : hull; }
  verify::KnownSolid& outer(verify::KnownSolid& hull) { return is_outer() ? hull : original_.solid(); }

  verify::Original& original_;
  const std::optional<verify::StandIn>& stand_in_;
  const VerificationOptions& options_;
  ProgressMeter meter_;
  const std::size_t steps_;
  std::size_t done_ = 0;
};

}  // namespace

Verification verify::verify_hull(const TriangleMesh& hull, Original& original, HullSide side,
                                 const VerificationOptions& options) {
  if (!(options.gap >= 0 && std::isfinite(options.gap)))
    throw InputError(Defect::InvalidOption,
                     fmt::format("the gap is {:g}; it must be a finite number of at least 0", options.gap));
  Judge judge(original, side, options, options.gap > 0 ? 5 : 4);
  Verification& found = judge.found;
  found.proof = judge.has_solid() ? "enclosure" : "coverage";
  note_place(usable_box(hull, "hull"), original.facts().box, found.notes);
  KnownSolid known(hull, "hull");
  if (!judge.refuses_inverted(hull)) {
    if (judge.has_solid())
      judge.enclose_solid(known);
    else
      judge.cover_all(hull);
    if (judge.encloses_solid() && judge.asks_triangles()) judge.cover_the_rest(known);
    judge.cover_what_is_not_in_the_solid(hull);
  }
  judge.conclude();
  if (options.gap > 0) judge.keep_gap(hull);
  judge.measure(known);
  return std::move(judge.found);
}

Verification verify::verify_hull(const ProgressiveHull& hull, Original& original, const VerificationOptions& options) {
  if (options.gap != 0)
    throw InputError(Defect::InvalidOption,
                     "levels of a hull touch each other, so there is no gap to verify; name a mesh, as `prohull lod` "
                     "writes it of one level");
  const bool is_of_input = hull.finest_level() == FinestLevel::Input;
  Judge judge(original, hull.side(), options, is_of_input ? 4 : 5);
  Verification& found = judge.found;
  found.proof = "replay";
  note_place(prohull::usable_box(hull), original.facts().box, found.notes);
  const bool is_finest = judge.has_solid() && is_of_input;  // the solid has to be the finest level
  const TriangleMesh finest = is_finest ? TriangleMesh{} : hull.original();
  ReplayReport replay;
  const EnclosureOptions replaying = judge.next_step();
  oneapi::tbb::parallel_invoke(
      [&] {
        replay = is_finest ? verify::replay(hull, judge.solid(), replaying.progress)
                           : verify_replay(hull, finest, replaying.progress);
      },
      [&] {
        if (is_finest && judge.asks_triangles() && judge.is_outer()) judge.look_at_solid();
      });
  found.why_not = std::move(replay.why_not);
  found.splits = replay.splits;
  found.signs = replay.signs;
  if (!replay.holds) return std::move(judge.found);
  const TriangleMesh base = hull.base();
  KnownSolid known(base, "hull");
  if (!judge.has_solid()) {
    judge.cover_all_by_levels(finest, base);
  } else if (!judge.refuses_inverted(base)) {
    KnownSolid level(finest, "hull");
    if (is_finest)
      found.encloses_solid = Answer::Yes;
    else
      judge.enclose_solid(level);
    if (judge.encloses_solid() && judge.asks_triangles()) judge.cover_the_rest(known);
    if (const std::size_t beside = found.faces_beside_solid; beside > 0 && found.is_yes() && judge.is_outer())
      found.notes.push_back(
          fmt::format("{} of the original bound{} no part of its solid, as in folds: the base mesh "
                      "covers {}, finer levels may not",
                      counted(beside, "face"), beside == 1 ? "s" : "", beside == 1 ? "it" : "them"));
  }
  judge.cover_what_is_not_in_the_solid(base);
  judge.conclude();
  judge.measure(known);
  return std::move(judge.found);
}

Verification verify_hull(const TriangleMesh& hull, const TriangleMesh& original, HullSide side,
                         const VerificationOptions& options) {
  verify::Original known(original, options.closed);
  return verify::verify_hull(hull, known, side, options);
}

Verification verify_hull(const ProgressiveHull& hull, const TriangleMesh& original,
                         const VerificationOptions& options) {
  verify::Original known(original, options.closed);
  return verify::verify_hull(hull, known, options);
}

}  // namespace prohull

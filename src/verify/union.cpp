#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "geometry/triangle_predicates.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/detail/text.h"
#include "prohull/error.h"
#include "prohull/union_verification.h"
#include "verify/exposed_surface.h"
#include "verify/offenders.h"
#include "verify/original.h"
#include "verify/solid_volume.h"
#include "verify/solids.h"
#include "verify/surface.h"
#include "verify/union_clipping.h"
#include "verify/union_pieces.h"

// Why sums of windings decide. No piece winds around a point a negative number of times (prepare_pieces), so that the
// mesh of all pieces winds at least once where one of them does. Kernels decide most of it faster: what lies in one, or
// in several together, is covered, and where pieces are convex nothing else is.

namespace prohull {
namespace {

std::string text(const Vec3& p) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", p.x, p.y, p.z); }

/// One verification, step by step.
class UnionJudge {
 public:
  UnionJudge(const verify::Pieces& pieces, const TriangleMesh& original, const VerificationOptions& options,
             ProgressMeter& meter, UnionVerification& found)
      : pieces_(pieces),
        original_(original),
        options_(options),
        meter_(meter),
        found_(found),
        together_(pieces.together()),
        all_(together_, "united") {
    found.certified = true;
  }

  void cover_triangles() {
    std::vector<FaceId> undecided;
    for (const FaceId f : verify::faces_beyond_kernels(original_, pieces_)) {
      meter_.go_on();
      const Triangle t = original_.triangle(f);
      const auto axis = projection_axis(t);
      const auto points = axis ? verify::points_beyond_kernels(t, *axis, pieces_) : std::vector<Vec3>{};
      if (!axis || (!points.empty() && !are_convex_around(t)))
        undecided.push_back(f);
      else if (!points.empty())
        offenders_.push_back(verify::farthest(f, points, all_));
    }
    if (!undecided.empty()) ask_windings(undecided);
    const std::size_t left = found_.faces_undecided;
    found_.covers_triangles = !offenders_.empty() ? Answer::No : left > 0 ? Answer::Undecided : Answer::Yes;
    take_offenders("triangles of the original lie outside of the pieces, or in part");
    if (left > 0) refuse(verify::undecided(left));
  }

  void fill_inside() {
    const verify::Holes holes = verify::find_holes(verify::Surface(original_, "original"), pieces_, all_,
                                                   search(original_.face_count(), 0.5, 0.9));
    found_.holes = holes.count;
    found_.inside_undecided = holes.count == 0 && holes.undecided > 0;
    const bool is_yes = found_.certified && !found_.inside_undecided;
    found_.encloses_solid = holes.count > 0 ? Answer::No : is_yes ? Answer::Yes : Answer::Undecided;
    if (holes.count > 0)
      refuse(fmt::format("the pieces leave a part of the inside open, for instance at {}", text(holes.point)));
    if (found_.inside_undecided) refuse(verify::undecided(holes.undecided));
  }

  void enclose_solid() {
    EnclosureReport report = verify_enclosure(original_, together_, search(original_.face_count(), 0.1, 0.9));
    found_.holes = report.cavities;
    found_.faces_undecided = report.faces_undecided;
    found_.encloses_solid = verify::answer_of(report);
    offenders_ = std::move(report.worst);
    take_offenders("a part of the solid that the original bounds lies outside of the pieces");
    if (report.cavities > 0) refuse("the pieces leave a part of the inside open");
    if (report.faces_undecided > 0) refuse(verify::undecided(report.faces_undecided));
  }

  /// Where a sum of windings is at least 1, one of the pieces winds that often. Where it is less, one may be inside
  /// out.
  void doubt() {
    if (found_.covers_triangles == Answer::No) found_.covers_triangles = Answer::Undecided;
    if (found_.encloses_solid == Answer::No) {
      found_.encloses_solid = Answer::Undecided;
      found_.inside_undecided = true;
    }
    const std::size_t in_doubt = std::exchange(found_.faces_outside, 0) + std::exchange(found_.holes, 0);
    if (in_doubt == 0) return;
    found_.worst.clear();
    found_.faces_undecided += in_doubt;
    found_.why_not = verify::undecided(found_.faces_undecided);
  }

  void measure() {
    constexpr std::size_t kMostFaces = 50'000;  // the time grows with the square
    if (pieces_.meshes.size() > 1 && together_.face_count() > kMostFaces) {
      found_.notes.emplace_back("the pieces have so many faces that the volume of the union is not measured");
      return;
    }
    const auto dented = std::ranges::find_if_not(pieces_.meshes, verify::is_about_convex);
    if (dented != pieces_.meshes.end()) {
      found_.notes.push_back(fmt::format("piece {} is not convex: the volume of the union is not measured",
                                         dented - pieces_.meshes.begin() + 1));
      return;
    }
    found_.union_volume = union_volume(pieces_.meshes);
    if (found_.original_volume > 0) found_.void_ratio = found_.union_volume / found_.original_volume - 1;
  }

 private:
  EnclosureOptions search(std::size_t max_offenders, double from, double to) {
    return {.max_offenders = max_offenders,
            .progress = meter_.part(from, to),
            .max_steps = verify::most_steps(options_, original_.face_count())};
  }

  bool are_convex_around(const Triangle& t) const {
    return std::ranges::all_of(pieces_.near(box_of(t)), [](const verify::Kernel* k) { return k->is_whole_piece(); });
  }

  void ask_windings(const std::vector<FaceId>& faces) {
    TriangleMesh triangles{original_.positions, {}};
    for (const FaceId f : faces) triangles.triangles.push_back(original_.triangles[f]);
    const EnclosureReport report = verify_cover(triangles, together_, search(faces.size(), 0.1, 0.5));
    found_.faces_undecided = report.faces_undecided;
    for (const Offender& o : report.worst) offenders_.push_back({faces[index(o.face)], o.point, o.distance});
  }

  void take_offenders(const std::string& why_not) {
    if (!offenders_.empty()) refuse(why_not);
    found_.faces_outside = offenders_.size();
    found_.worst = verify::worst_of(std::move(offenders_), options_.max_offenders);
  }

  /// The first reason is told.
  void refuse(const std::string& why_not) {
    if (found_.certified) found_.why_not = why_not;
    found_.certified = false;
  }

  const verify::Pieces& pieces_;
  const TriangleMesh& original_;
  const VerificationOptions& options_;
  ProgressMeter& meter_;
  UnionVerification& found_;
  const TriangleMesh together_;
  const verify::Surface all_;
  std::vector<Offender> offenders_;
};

}  // namespace

UnionVerification verify_union(std::span<const TriangleMesh> pieces, TriangleMesh original,
                               const VerificationOptions& options) {
  ProgressMeter meter(options.progress, "verify");
  UnionVerification found;
  const verify::PreparedOriginal prepared = verify::prepare_original(original, found.notes);
  if (!prepared.closed) found.notes.emplace_back(verify::kNotClosed);
  verify::take_facts(prepared, found);
  if (prepared.closed) found.original_volume = verify::solid_volume(original, meter);
  const verify::Pieces sound = verify::prepare_pieces(pieces, options, meter.part(0, 0.1));
  found.turned_pieces = sound.turned;
  UnionJudge judge(sound, original, options, meter, found);
  if (prepared.closed && options.solid_only) {
    judge.enclose_solid();
  } else {
    judge.cover_triangles();
    if (prepared.closed && found.faces_outside == 0)
      judge.fill_inside();
    else if (prepared.closed)
      found.encloses_solid = Answer::Undecided;  // triangles that stick out may bound no solid
  }
  if (!sound.are_sure) judge.doubt();
  verify::refuse_non_finite_faces(prepared.non_finite_faces, options, found.certified, found.why_not);
  judge.measure();
  meter.at(1);
  return found;
}

}  // namespace prohull

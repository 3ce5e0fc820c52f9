#include "prohull/verification.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/text.h"
#include "parallel/progress_meter.h"
#include "prohull/error.h"
#include "prohull/replay.h"

namespace prohull {
namespace {

std::size_t drop_non_finite_faces(TriangleMesh& mesh) {
  const std::size_t before = mesh.face_count();
  PerFace<std::array<VertexId, 3>> finite;
  finite.reserve(before);
  for (const auto& corners : mesh.triangles)
    if (std::ranges::all_of(corners, [&](VertexId v) { return is_finite(mesh.positions[v]); }))
      finite.push_back(corners);
  mesh.triangles = std::move(finite);
  return before - mesh.face_count();
}

/// Two units between which people forget to convert.
struct UnitPair {
  double factor;
  std::string_view what;
};
constexpr std::array kUnitPairs{UnitPair{1000, "metres and the other in millimetres"},
                                UnitPair{25.4, "inches and the other in millimetres"}};
constexpr double kAbout = 1.5;  ///< a coarse hull is so much larger than what it encloses

void note_units(const Box& hull, const Box& original, std::vector<std::string>& notes) {
  const double small = std::min(hull.diagonal(), original.diagonal());
  const double ratio = std::max(hull.diagonal(), original.diagonal()) / small;
  for (const auto& [factor, what] : kUnitPairs)
    if (ratio > factor / kAbout && ratio < factor * kAbout)
      notes.push_back(fmt::format("the hull is about {} times {} than the original: perhaps one of them is in {}",
                                  factor == 1000 ? "1,000" : "25.4", small == hull.diagonal() ? "smaller" : "larger",
                                  what));
}

Box box_of(const ProgressiveHull& hull) {
  Box box;
  for (const Vec3& p : hull.positions()) box.extend(p);
  return box;
}

/// The mesh as turned_outwards turns it. Counts the faces that this turns.
TriangleMesh turned(const TriangleMesh& mesh, std::string_view name, std::size_t& count,
                    std::vector<std::string>& notes) {
  TriangleMesh result = turned_outwards(mesh);
  for (const FaceId f : mesh.triangles.ids()) count += result.triangles[f] != mesh.triangles[f];
  if (count > 0)
    notes.push_back(fmt::format("{} of the {} {} inwards and {} as turned", counted(count, "face", "faces"), name,
                                count == 1 ? "faces" : "face", count == 1 ? "counts" : "count"));
  return result;
}

/// Steps of one verification, each of which has its share of the progress.
class Steps {
 public:
  Steps(std::size_t count, const VerificationOptions& options)
      : count_(static_cast<double>(count)), options_(options), meter_(options.progress, "verify") {}

  EnclosureOptions next() {
    const double from = done_++;
    return {.max_offenders = options_.max_offenders, .progress = meter_.part(from / count_, (from + 1) / count_)};
  }

 private:
  const double count_;
  double done_ = 0;
  const VerificationOptions& options_;
  ProgressMeter meter_;
};

/// Everything that does not depend on the hull.
Verification begin(TriangleMesh& original, HullSide side, const VerificationOptions& options) {
  Verification found;
  found.side = side;
  if (const std::size_t dropped = drop_non_finite_faces(original))
    found.notes.push_back(fmt::format("{} of the original {} not finite and {} left out",
                                      counted(dropped, "face", "faces"), dropped == 1 ? "is" : "are",
                                      dropped == 1 ? "is" : "are"));
  found.original_closed = is_closed(original);
  if (side == HullSide::Inner && options.every_triangle)
    throw InputError(Defect::InvalidOption, "every triangle is asked for, but only an outer hull can cover triangles");
  if (side == HullSide::Inner && !found.original_closed)
    throw InputError(Defect::OpenEdge, "the original is not closed: it has no inside that could enclose an inner hull");
  found.every_triangle = options.every_triangle || !found.original_closed;
  if (found.original_closed) {
    original = turned(original, "original", found.turned_original_faces, found.notes);
    found.original_volume = signed_volume(original);
  } else {
    found.notes.emplace_back("the original is not closed: it has no volume, and every triangle of it must be covered");
  }
  return found;
}

void take(EnclosureReport report, Verification& found) {
  found.encloses = report.encloses;
  found.faces_outside = report.faces_outside;
  found.worst = std::move(report.worst);
  found.cavities += report.cavities;
}

void measure(const TriangleMesh& hull, Verification& found) {
  found.hull_volume = signed_volume(hull);
  found.void_ratio = found.hull_volume / found.original_volume - 1;
  found.self_intersections = count_self_intersections(hull);
}

}  // namespace

Verification verify_hull(const TriangleMesh& given_hull, TriangleMesh original, HullSide side,
                         const VerificationOptions& options) {
  Verification found = begin(original, side, options);
  found.proof = found.original_closed ? "enclosure" : "coverage";
  note_units(bounding_box(given_hull), bounding_box(original), found.notes);
  const TriangleMesh hull = turned(given_hull, "hull", found.turned_hull_faces, found.notes);
  Steps steps(found.original_closed && found.every_triangle ? 2 : 1, options);
  found.encloses = true;
  if (found.original_closed)
    take(side == HullSide::Outer ? verify_enclosure(original, hull, steps.next())
                                 : verify_enclosure(hull, original, steps.next()),
         found);
  if (found.every_triangle && found.encloses) take(verify_cover(original, hull, steps.next()), found);
  measure(hull, found);
  return found;
}

Verification verify_hull(const ProgressiveHull& hull, TriangleMesh original, const VerificationOptions& options) {
  Verification found = begin(original, hull.side(), options);
  found.proof = "replay";
  note_units(box_of(hull), bounding_box(original), found.notes);
  const TriangleMesh finest = found.every_triangle ? hull.original() : TriangleMesh{};
  Steps steps(found.every_triangle ? 2 : 1, options);
  ReplayReport replay = verify_replay(hull, found.original_closed ? original : finest, steps.next().progress);
  found.encloses = replay.holds;
  found.why_not = std::move(replay.why_not);
  found.splits = replay.splits;
  found.signs = replay.signs;
  if (!replay.holds) return found;
  if (found.every_triangle) take(verify_cover(original, finest, steps.next()), found);
  measure(hull.base(), found);
  return found;
}

}  // namespace prohull

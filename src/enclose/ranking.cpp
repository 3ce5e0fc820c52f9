#include "enclose/ranking.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "prohull/detail/text.h"
#include "prohull/distance.h"
#include "prohull/error.h"

namespace prohull {
namespace {

/// " near (0.1, 0.2, 0.3)", if it is known where triangles stick out.
std::string place_of(const Verification& verdict) {
  if (verdict.worst.empty()) return "";
  const Vec3& p = verdict.worst.front().point;
  return fmt::format(", as near ({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

/// Another format is a way out if that keeps doubles.
std::string what_to_try(const EnclosingOptions& options) {
  std::string ways = options.hull.side == HullSide::Inner ? "more faces, or mend the mesh where it intersects itself"
                     : options.repair == Repair::Wrap     ? "more faces"
                     : options.repair == Repair::None     ? "fewer faces, or --repair auto"
                                                          : "more faces, or --repair wrap";
  if (options.hull.float32_coordinates) ways += ", or a .ply, .obj or .off file, which keep doubles";
  return ways;
}

std::string described(const Solid& solid, const Repairs& repairs) {
  switch (solid.source) {
    case Source::Mesh:
      return repairs.any() || solid.folds.faces > 0 ? "the repaired mesh" : "the mesh itself";
    case Source::ConvexHull:
      return "the convex hull";
    default:
      return fmt::format("the wrap with a spacing of {:.4g}", solid.wrap_spacing);
  }
}

}  // namespace

void Notes::add(std::string text) {
  if (std::ranges::find(notes_, text, &Note::text) == notes_.end()) notes_.push_back({std::move(text), {}});
}

void Notes::add_why_not(Source source, std::string text) {
  std::erase_if(notes_, [&](const Note& note) { return note.why_not == source; });
  notes_.push_back({std::move(text), source});
}

void Notes::add(const Notes& others) {
  for (const Note& note : others.notes_)
    if (note.why_not)
      add_why_not(*note.why_not, note.text);
    else
      add(note.text);
}

void Notes::remove(const std::string& text) {
  std::erase_if(notes_, [&](const Note& note) { return note.text == text; });
}

std::vector<std::string> Notes::beside(Source source, bool is_as_asked) const {
  std::vector<std::string> texts;
  for (const Note& note : notes_)
    if (!is_as_asked || !note.why_not || (note.why_not == Source::Mesh && source != Source::Mesh))
      texts.push_back(note.text);
  return texts;
}

void Ranking::take(std::optional<Attempt> attempt) {
  last_failed_ = !attempt || !attempt->hull.certified;
  is_last_best_ = false;
  second_.reset();
  if (!attempt) return;
  const EnclosingHull& hull = attempt->hull;
  build_seconds_ += hull.build_seconds, verify_seconds_ += hull.verify_seconds;
  if (hull.source == Source::Wrap) fewest_of_wraps_ = std::min(fewest_of_wraps_, hull.mesh.face_count());
  if (attempt->void_before_padding) void_before_padding_ = *attempt->void_before_padding;
  if (!attempt->why_not_storable.empty())
    notes_.add_why_not(hull.source,
                       fmt::format("a hull of {} has no float32 coordinates: {}",
                                   described(solids_[hull.solid], request_.input.repairs), attempt->why_not_storable));
  else if (!is_as_asked(hull) && request_.is_free() && attempt->candidate.recipe.method != Method::Early &&
           !is_in_spite_of_bounds(*attempt) && (hull.certified || !other_way(attempt->candidate.recipe, request_)))
    note_why_not(hull);
  const bool is_kept = hull.certified && hull.within_bounds;
  if (!best_ || is_better(hull, best_->hull))
    best_ = std::move(attempt), is_last_best_ = is_kept;
  else if (is_kept)
    second_ = std::move(attempt->hull);
}

/// It was made without a look at them.
bool Ranking::is_in_spite_of_bounds(const Attempt& attempt) const {
  const HullBounds& bounds = request_.options.bounds;
  return attempt.candidate.bounds != bounds || (bounds.any() && attempt.candidate.recipe.method == Method::InSteps);
}

bool Ranking::is_clean(const EnclosingHull& hull) const {
  return hull.self_intersections == 0 || !request_.options.hull.refuses_self_intersections();
}

bool Ranking::is_as_asked(const EnclosingHull& hull) const {
  return hull.certified && hull.target_reached && hull.within_bounds && is_clean(hull);
}

bool Ranking::is_better(const EnclosingHull& a, const EnclosingHull& b) const {
  const auto rank = [&](const EnclosingHull& hull) {
    return std::tuple(!hull.certified, std::max(hull.excess, 1.0), std::max(hull.mesh.face_count(), hull.target_faces),
                      hull.relaxed_guards == kRelaxedGuards.size(), weighed_size(hull));
  };
  return rank(a) < rank(b);
}

bool Ranking::is_near_flat() const {
  return is_as_asked() && weighed_size(best_->hull) <= kTentHeight * solids_[best_->hull.solid].slab_width;
}

bool Ranking::is_on_triangles() const {
  constexpr double kOn = 1e-9;  // of the diagonal
  constexpr std::size_t kMostCells = 1000;
  if (!is_as_asked() || best_->hull.source != Source::ConvexHull || volume() > 0) return false;
  return distance_bounds(best_->hull.mesh, request_.to_cover(), {.max_cells = kMostCells}).upper <=
         kOn * request_.diagonal;
}

// Around what is flat, spikes that are far away have hardly any volume.
double Ranking::weighed_size(const EnclosingHull& hull) const {
  if (solids_[hull.solid].slab_width > 0) return distance_bounds(hull.mesh, request_.to_cover()).upper;
  constexpr double kOfSelfIntersections = 1.1;
  const double size = signed_volume(hull.mesh);
  if (!request_.is_outer()) return -size;
  return is_clean(hull) ? size : size + (kOfSelfIntersections - 1) * std::max(0.0, size - volume());
}

// With padding, the void that a hull of the mesh had before tells, and the smallest solid beside a wrap.
double Ranking::slack() const {
  if (!request_.is_padded()) return best_void();
  if (best_->hull.source == Source::Mesh) return void_before_padding_;
  if (!has_wrap()) return std::numeric_limits<double>::infinity();
  double least = best_volume();
  for (SolidId id = 0; id < solids_.size(); ++id)
    if (solids_[id].source == Source::ConvexHull) least = std::min(least, solids_[id].volume);
  for (const SolidId id : solids_.wraps(target_faces_)) least = std::min(least, solids_[id].volume);
  return best_volume() / least - 1;
}

std::string Ranking::none_within_bounds(SolidId solid) const {
  return fmt::format("no hull of {} was found within the bounds", described(solids_[solid], request_.input.repairs));
}

void Ranking::note_why_not(const EnclosingHull& hull) { notes_.add_why_not(hull.source, why_not(hull)); }

std::string Ranking::why_not(const EnclosingHull& hull) const {
  const std::string source = described(solids_[hull.solid], request_.input.repairs);
  if (!hull.certified)
    return fmt::format(
        "a hull of {} {}", source,
        request_.is_padded()
            ? std::string(
                  "does not keep the gap everywhere, as where parts are closer to each other than twice the gap")
        : request_.is_outer() ? "does not cover every triangle" + place_of(hull.verdict)
                              : "is not proven to lie inside of the mesh");
  if (!hull.within_bounds) return none_within_bounds(hull.solid);
  if (!hull.target_reached)
    return fmt::format("no legal collapse of {} is left at {} faces{}", source, grouped(hull.mesh.face_count()),
                       describe_refusals(hull.blocked, ": of its edges, "));
  return fmt::format("a hull of {} intersects itself in {}", source,
                     counted(hull.self_intersections, "pair of faces", "pairs of faces"));
}

void Ranking::refuse() {
  const RepairedMesh& input = request_.input;
  if (!best_)
    throw InputError(input.closed ? Defect::NoVolume : Defect::OpenEdge,
                     fmt::format("nothing could be wrapped: {}", notes_.is_empty() ? input.obstacle : notes_.last()));
  if (!request_.is_outer() && request_.is_padded())
    throw InputError(
        Defect::NoCertificate,
        fmt::format(
            "no inner hull of {} faces was found that keeps the gap of {:g}{}; use a smaller gap, or more faces",
            target_faces_, request_.options.padding,
            has_wrap() ? "" : ": the mesh must be thicker than twice the gap somewhere"));
  if (notes_.is_empty()) note_why_not(best_->hull);
  throw InputError(Defect::NoCertificate, fmt::format("no hull of {} faces could be certified: {}; try {}",
                                                      target_faces_, notes_.last(), what_to_try(request_.options)));
}

std::optional<Attempt> Ranking::taken() && {
  if (best_) best_->hull.build_seconds = build_seconds_, best_->hull.verify_seconds = verify_seconds_;
  return std::move(best_);
}

EnclosingHull Ranking::winner() {
  if (!has_certified()) refuse();
  EnclosingHull hull = std::move(*this).taken()->hull;
  const Solid& solid = solids_[hull.solid];
  if (hull.within_bounds) notes_.remove(none_within_bounds(hull.solid));  // of an attempt before
  if (solid.folds.faces > 0)
    notes_.add(describe(solid.folds) +
               ": the hull is built from the mesh with other faces around them, which cover them");
  if (solid.slab_width > 0) notes_.add("the triangles are flat: the hull is one of a thin solid around them");
  if (solid.largest_door > 0)
    notes_.add(fmt::format("{}openings up to about {:.4g} across count as closed",
                           is_closed(request_.input.original) ? "" : "the mesh is not closed: ", solid.largest_door));
  if (solid.source == Source::Wrap && !request_.input.closed && volume() == 0 && !(hull.verdict.original_volume > 0))
    notes_.add("no space was found inside of the triangles: the hull is a sheet around them");
  if (hull.mesh.face_count() == solid.mesh.face_count()) hull.relaxed_guards = 0;  // nothing collapsed
  hull.notes = notes_.beside(hull.source, is_as_asked(hull));
  return hull;
}

}  // namespace prohull

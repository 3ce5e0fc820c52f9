#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "enclose/candidates.h"
#include "enclose/making.h"

namespace prohull {
namespace {

// Handles and gaps take faces, so that hulls swell that have few: the second wraps have less of them. Of sheets, the
// later ones are smooth.
constexpr WrapKind kWrapsOfSolids[]{{3.5, 0.3, 1.5}, {6, 0.9, 4}, {3.5, 0.3, 8}};
constexpr WrapKind kWrapsOfSoups[]{{3.5, 0.3, 1.5}, {6, 0.9, 4}};
// A padding closes gaps too, and asks for a finer grid. Without the third one, of a bracket of 992 faces, hulls of 60
// with gaps of 0.3 to 2.5 % of the diagonal had a void of 100 to 204 %, up and down; with it, of 83 to 134 %.
constexpr WrapKind kPaddedWraps[]{{6, 0.3, 1.5}, {3.5, 0.3, 0}, {6, 0.9, 4}};
constexpr WrapKind kWrapsOfSheets[]{{3.5, 0.3, 1.5}, {7, 0.9, 4}, {9, 0.5, 4}};
constexpr WrapKind kWrapInside{3.5, 0.3, 0};

constexpr std::size_t kMostWraps = 3;
constexpr double kMoreVoid = 0.15, kVeryMuchVoid = 0.3;

// The first ones are the same: they tell whether the triangles enclose anything.
std::span<const WrapKind> wraps(const Request& request, double volume) {
  if (request.is_padded()) return kPaddedWraps;
  if (request.input.closed) return kWrapsOfSolids;
  return volume > 0 ? std::span<const WrapKind>(kWrapsOfSoups) : kWrapsOfSheets;
}

}  // namespace

double Candidates::spacing_for(const WrapKind& kind) const {
  constexpr double kFewest = 25, kMost = 256;
  constexpr double kMostPadding = 2.6;  // in spacings, with the offset
  const double per_diagonal = std::clamp(kind.nodes_per_edge * std::sqrt(double(target_faces_)), kFewest, kMost);
  return std::max({request_.diagonal / per_diagonal, request_.options.seal_holes / 32,
                   request_.aim() / (kMostPadding - kind.offset)});
}

// The faces of a wrap go with the square of its spacing. Hulls of wraps with so many are no better, and take most of
// the time: of soups, wraps had 700 and 900 times as many faces as asked for. Sheets with more had nearer and farther
// hulls, and took 1.7 times as long.
double Candidates::finest_worth_its_faces(const Solids& solids) const {
  constexpr double kMany = 400'000, kMostReduced = 200;
  double least = std::numeric_limits<double>::infinity(), finest = 0;
  const double most = std::max(kMany, kMostReduced * double(target_faces_));
  for (const SolidId id : solids.wraps(target_faces_))
    if (const Solid& solid = solids[id]; solid.wrap_spacing < least) {
      least = solid.wrap_spacing;
      finest = least * std::sqrt(double(solid.mesh.face_count()) / most);
    }
  return finest;
}

std::optional<SolidId> Candidates::wrap(const WrapKind& kind, double spacing, Solids& solids) const {
  std::string why_not;
  const std::optional<SolidId> id = solids.wrap(kind, spacing, target_faces_, why_not);
  if (!why_not.empty()) notes_.add_why_not(Source::Wrap, why_not);
  return id;
}

std::optional<Candidate> Candidates::of_wrap(const WrapKind& kind, const Ranking& ranking, Solids& solids) const {
  const std::optional<SolidId> id = wrap(kind, std::max(spacing_for(kind), finest_worth_its_faces(solids)), solids);
  if (!id || (ranking.has_certified() && has_too_many_parts(solids[*id]))) return std::nullopt;
  return of(*id, solids);
}

// Where the mesh's own hull beats that of the first wrap, no later one of 110 parts and clean meshes was better by 1 %.
bool Candidates::is_worth_a_wrap(const Ranking& ranking, const Solids& solids, bool is_first) const {
  if (ranking.is_empty()) return true;
  if (bounds_.any() && !has_few_faces(ranking)) return true;
  const EnclosingHull& best = ranking.best().hull;
  if (!best.certified || !best.target_reached || !best.within_bounds) return true;
  if (ranking.is_of_flat() || ranking.is_on_triangles()) return false;  // and convex: no wrap comes nearer
  if ((request_.options.levels || request_.options.keep_cavities) && best.source == Source::Mesh) return false;
  if (solids.volume(target_faces_) == 0) return true;
  constexpr double kLittleVoid = 0.03, kMuchVoid = 0.12;
  if (best.source == Source::Mesh && ranking.is_clean())
    return ranking.slack() > (request_.is_padded() || !is_first ? kVeryMuchVoid : kMoreVoid);
  return ranking.slack() > (is_first ? kLittleVoid : kMuchVoid);
}

/// Wraps were tried, but all of their hulls have a few faces more than were asked for, or guards were relaxed to get
/// there, and what has fewer swells.
bool Candidates::are_wraps_stuck(const Ranking& ranking) const {
  constexpr double kAFew = 3;
  constexpr std::size_t kFewestOfWraps = 30;  // with 20, other wraps were no better of any of 84 meshes
  if (!has_few_faces(ranking) || target_faces_ < kFewestOfWraps) return false;
  const EnclosingHull& best = ranking.best().hull;
  const bool has_relaxed = best.relaxed_guards > 0;
  if (!has_relaxed && best.source != Source::ConvexHull) return false;
  return ranking.slack() > (has_relaxed ? kMoreVoid : kVeryMuchVoid) &&
         double(ranking.fewest_faces_of_wraps()) <= kAFew * double(target_faces_);
}

// Whether collapses go on to the end is a matter of luck: around a bracket, hulls of three wraps got down to 50 faces,
// but not to 60, where the convex hull has a void of 175 % and the hull of another spacing one of 16 %; nor to 40,
// where the coarser ones do (16 %). Where guards were relaxed at 80, 29 % become 18. With a gap of a millionth, one got
// down to 60 with weaker guards and 167 %, and that of another spacing has 13 %.
//
// Of 63 robots' parts and 21 models at 40 faces, 5 have 0.85 to 0.99 times the void by the coarser ones, and 11 take up
// to 1.5 times as long in vain. Where convex hulls have 15 to 30 %, none had less void.
void Candidates::plan_other_wraps() {
  static constexpr WrapKind kOther{6, 0.9, 4};
  for (const double coarser : {1.1, 1.21, 1.33, 1.46, 1.61, 1.77, 1.95})
    steps_.push_back([=, this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
      if (!are_wraps_stuck(ranking)) return std::nullopt;
      const double spacing = std::max(spacing_for(kOther), finest_worth_its_faces(solids));
      const auto id = wrap(kOther, coarser * spacing, solids);
      return id ? std::optional(of(*id, solids)) : std::nullopt;
    });
}

// Hulls that may touch the triangles, and move away by the gap in the end, are mostly the better ones: of 63 robots'
// parts at 100 faces with a gap of 0.1 % of the diagonal, 36 have less void, down to half of it, and one has more.
void Candidates::plan_clear_of_wraps() {
  for (std::size_t i = 0; i < kMostWraps; ++i)
    steps_.push_back([=, this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
      constexpr double kMuchVoid = 0.12;
      const std::span<const SolidId> made = solids.wraps(target_faces_);
      if (!request_.is_padded() || i >= made.size() || (has_few_faces(ranking) && ranking.slack() < kMuchVoid))
        return std::nullopt;
      Candidate candidate = of(made[i], solids);
      if (candidate.recipe.approach == Approach::Clear) return std::nullopt;  // it was tried
      candidate.recipe.approach = Approach::Clear;
      return candidate;
    });
}

// The best hull of a wrap, once more. Which wrap is best is known by then, and how far a hull need not reach.
void Candidates::plan_early() {
  steps_.push_back([this](const Ranking& ranking, Solids&) -> std::optional<Candidate> {
    if (request_.is_padded() || !has_few_faces(ranking)) return std::nullopt;
    const Attempt& best = ranking.best();
    if (best.hull.source != Source::Wrap || best.candidate.recipe.method != Method::InSteps) return std::nullopt;
    Candidate candidate = best.candidate;
    candidate.recipe.method = Method::Early;
    candidate.within = short_bound_of_reach(best.hull.mesh, request_.input.original);
    return candidate;
  });
}

/// Of what is not closed, the first wrap tells the volume, with which bounds of the void compare the first hulls.
void Candidates::plan_volume() {
  steps_.push_back([this](const Ranking&, Solids& solids) -> std::optional<Candidate> {
    const WrapKind& kind = wraps(request_, 0).front();
    wrap(kind, spacing_for(kind), solids);
    return std::nullopt;
  });
}

// With bounds, in case that they are as loose as to ask for no more faces: then the best hull is the one without them.
// Such hulls of five samples were 2.5 to 6 spacings away.
void Candidates::plan_wraps() {
  for (std::size_t i = 0; i < kMostWraps; ++i)
    steps_.push_back([this, i](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
      const auto kinds = wraps(request_, solids.volume(target_faces_));
      if (i >= kinds.size() || !is_worth_a_wrap(ranking, solids, i == 0) ||
          spacing_for(kinds[i]) > bounds_.max_distance)
        return std::nullopt;
      std::optional<Candidate> candidate = of_wrap(kinds[i], ranking, solids);
      if (candidate && bounds_.any()) candidate->recipe.method = Method::InSteps;
      return candidate;
    });
}

// Where one that touched has moved away by a small gap, these are worse, and take twice the time: of 63 robots' parts
// at 100 faces with a gap of 0.05 % of the diagonal, they had the better hull of none of the first 40.
void Candidates::plan_inner_with_padding() {
  for (const WrapKind& kind : kPaddedWraps)
    steps_.push_back([this, kind](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
      constexpr double kMostLost = 0.06;  // of a wrap, where it has too many handles for so few faces
      const SolidId id = ranking.best().hull.solid;
      if (is_small_gap(spacing_for(kWrapInside)) && ranking.is_as_asked() &&
          ranking.best().candidate.recipe.approach == Approach::Touching)
        return std::nullopt;
      if (solids[id].source == Source::Wrap && ranking.is_as_asked() &&
          ranking.best_volume() > (1 - kMostLost) * solids[id].volume)
        return std::nullopt;
      return of_wrap(kind, ranking, solids);
    });
}

void Candidates::plan_inner() {
  constexpr double kMuchVoid = 0.15;
  plan_moved_mesh();
  if (bounds_.any()) return plan_loose_wraps();
  for (const int finer : {1, 2, 4}) {               // where nothing is thick enough
    if (finer > 1 && request_.is_padded()) return;  // the gap has to be thin beside the spacing
    steps_.push_back([=, this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
      if (ranking.has_certified() && (finer > 1 || ranking.best_void() >= -kMuchVoid)) return std::nullopt;
      const auto id = wrap(kWrapInside, spacing_for(kWrapInside) / finer, solids);
      return id ? std::optional(moved(*id)) : std::nullopt;
    });
  }
}

}  // namespace prohull

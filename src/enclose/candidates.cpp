#include "enclose/candidates.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

namespace prohull {
namespace {

// Handles and gaps take faces, so that hulls swell that have few: the second wraps have less of them. Of sheets, the
// later ones are smooth.
constexpr WrapKind kWrapsOfSolids[]{{3.5, 0.3, 1.5}, {6, 0.9, 4}, {3.5, 0.3, 8}};
constexpr WrapKind kWrapsOfSoups[]{{3.5, 0.3, 1.5}, {6, 0.9, 4}};
// A padding closes gaps too, and asks for a finer grid.
constexpr WrapKind kPaddedWraps[]{{6, 0.3, 1.5}, {3.5, 0.3, 0}};
constexpr WrapKind kWrapsOfSheets[]{{3.5, 0.3, 1.5}, {7, 0.9, 4}, {9, 0.5, 4}};
constexpr WrapKind kWrapInside{3.5, 0.3, 0};

constexpr std::size_t kMostWraps = 3;

// The first ones are the same: they tell whether the triangles enclose anything.
std::span<const WrapKind> wraps(const Request& request, const Solids& solids) {
  if (request.is_padded()) return kPaddedWraps;
  if (request.input.closed) return kWrapsOfSolids;
  return solids.volume() > 0 ? std::span<const WrapKind>(kWrapsOfSoups) : kWrapsOfSheets;
}

// Where many parts overlap, the mesh's hull is several times larger than the others, if there is any. But it may be the
// only one that keeps a bound.
bool is_worth_the_mesh(const Request& request, const Solids& solids) {
  constexpr std::size_t kMany = 120;
  return solids.has_mesh() && (!request.is_free() || request.options.levels || request.options.bounds.any() ||
                               solids[0].self_intersections <= kMany);
}

}  // namespace

Candidates::Candidates(const Request& request, std::size_t target_faces, Notes& notes)
    : request_(request), target_faces_(target_faces), notes_(notes) {
  plan_mesh();
  if (request.is_outer() && !request.is_bound_to_mesh()) plan_unfolded_mesh();
  if (request.is_free()) {
    plan_convex_hull();
    request.options.bounds.any() ? plan_bounded_wraps() : plan_wraps();
    if (!request.is_padded() && !request.options.bounds.any() && !request.options.levels) plan_fewer_faces();
  }
  if (!request.is_outer() && request.options.repair != Repair::None) {
    if (request.is_padded())
      plan_inner_with_padding();
    else if (!request.is_bound_to_mesh() && !request.options.levels)
      plan_inner();
  }
  if (request.options.tight) plan_tight();
}

std::optional<Candidate> Candidates::next(const Ranking& ranking, Solids& solids) {
  std::optional<Candidate> next = last_ ? follow_up(ranking, solids) : std::nullopt;
  while (!next && next_step_ < steps_.size()) next = steps_[next_step_++](ranking, solids);
  return last_ = next;
}

/// Another way with the solid that was just tried.
std::optional<Candidate> Candidates::follow_up(const Ranking& ranking, const Solids& solids) const {
  // With few faces, a tight hull of the mesh may have less void than one of its gap's body.
  const bool is_body_of_mesh =
      last_->recipe.method == Method::TightOfGapBody && solids[last_->solid].source == Source::Mesh;
  const auto other = other_way(last_->recipe, request_);
  if (!other || !(is_body_of_mesh || ranking.last_failed())) return std::nullopt;
  return Candidate{last_->solid, target_faces_, *other};
}

Candidate Candidates::of(SolidId id, const Solids& solids) const {
  Candidate candidate = moved(id);
  if (solids[id].source == Source::Mesh || request_.options.levels)
    candidate.recipe = {.method = Method::Levels};
  else if (request_.is_padded() || !request_.input.closed || solids[id].doors.face_count() > 0)
    candidate.recipe.approach = Approach::Clear;
  return candidate;
}

Candidate Candidates::moved(SolidId id) const {
  return {id, target_faces_, {request_.options.bounds.any() ? Method::Levels : Method::InSteps, /*moves=*/true}};
}

double Candidates::spacing_for(const WrapKind& kind) const {
  constexpr double kFewest = 25, kMost = 256;
  constexpr double kMostPadding = 2.6;  // in spacings, with the offset
  const double per_diagonal = std::clamp(kind.nodes_per_edge * std::sqrt(double(target_faces_)), kFewest, kMost);
  return std::max({request_.diagonal / per_diagonal, request_.options.seal_holes / 32,
                   request_.aim() / (kMostPadding - kind.offset)});
}

// The faces of a wrap go with the square of its spacing. Hulls of wraps with so many are no better, and take most of
// the time: of soups, wraps had 700 and 900 times as many faces as asked for. But sheets get as thin as the spacing.
double Candidates::finest_worth_its_faces(const Solids& solids) const {
  constexpr double kMany = 400'000, kMostReduced = 200;
  double finest = 0;
  if (!(solids.volume() > 0)) return finest;
  const double most = std::max(kMany, kMostReduced * double(target_faces_));
  for (SolidId id = 0; id < solids.size(); ++id)
    if (const Solid& solid = solids[id]; solid.source == Source::Wrap)
      finest = std::max(finest, solid.wrap_spacing * std::sqrt(double(solid.mesh.face_count()) / most));
  return finest;
}

std::optional<SolidId> Candidates::wrap(const WrapKind& kind, double spacing, Solids& solids) const {
  std::string why_not;
  const std::optional<SolidId> id = solids.wrap(kind, spacing, why_not);
  if (!why_not.empty()) notes_.add(why_not);
  return id;
}

std::optional<Candidate> Candidates::of_wrap(const WrapKind& kind, Solids& solids) const {
  const std::optional<SolidId> id = wrap(kind, std::max(spacing_for(kind), finest_worth_its_faces(solids)), solids);
  return id ? std::optional(of(*id, solids)) : std::nullopt;
}

void Candidates::plan_mesh() {
  steps_.push_back([this](const Ranking&, Solids& solids) -> std::optional<Candidate> {
    if (!is_worth_the_mesh(request_, solids)) return std::nullopt;
    return of(0, solids);
  });
}

// Where the mesh's own hull leaves folds uncovered, as with many faces.
void Candidates::plan_unfolded_mesh() {
  steps_.push_back([this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
    if (ranking.is_empty() || ranking.has_certified()) return std::nullopt;
    const auto id = solids.unfolded();
    return id ? std::optional(of(*id, solids)) : std::nullopt;
  });
}

void Candidates::plan_convex_hull() {
  steps_.push_back([this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
    constexpr double kLittleVoid = 0.02;
    const EnclosingOptions& options = request_.options;
    const bool is_good = ranking.is_as_asked();
    if (options.levels || (is_good && (options.keep_cavities || ranking.slack() < kLittleVoid))) return std::nullopt;
    const auto too_large = is_good ? std::optional(ranking.best_volume()) : std::nullopt;
    const auto id = solids.convex_hull(too_large);
    if (!id || (too_large && solids[*id].volume >= *too_large)) return std::nullopt;
    return of(*id, solids);
  });
}

bool Candidates::is_worth_a_wrap(const Ranking& ranking, const Solids& solids, bool is_first) const {
  if (ranking.is_empty()) return true;
  const EnclosingHull& best = ranking.best().hull;
  if (!best.certified || !best.target_reached || !best.within_bounds) return true;
  // No wrap of what is flat and convex comes nearer.
  if (const Solid& solid = solids[best.solid]; solid.slab_width > 0 && ranking.best_volume() <= 2 * solid.volume)
    return false;
  if (request_.options.levels || (request_.options.keep_cavities && best.source == Source::Mesh)) return false;
  if (solids.volume() == 0) return true;
  constexpr double kLittleVoid = 0.03, kMuchVoid = 0.12, kVeryMuchVoid = 0.3;
  if (best.source == Source::Mesh && ranking.is_clean()) return ranking.slack() > kVeryMuchVoid;
  return ranking.slack() > (is_first ? kLittleVoid : kMuchVoid);
}

void Candidates::plan_wraps() {
  for (std::size_t i = 0; i < kMostWraps; ++i)
    steps_.push_back([this, i](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
      const auto kinds = wraps(request_, solids);
      if (i >= kinds.size() || !is_worth_a_wrap(ranking, solids, i == 0)) return std::nullopt;
      return of_wrap(kinds[i], solids);
    });
}

// With a dozen faces and less, each has a large part in the volume, and a hull of fewer may be the smaller one: around
// a cube, the 10 faces that collapses led to had a void of 466 %, and 6 faces one of 189 %.
void Candidates::plan_fewer_faces() {
  constexpr std::size_t kFew = 12, kFewest = 4;
  if (target_faces_ > kFew) return;
  for (std::size_t faces = (target_faces_ + 1) / 2 * 2; faces > kFewest; faces -= 2)
    steps_.push_back([=](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
      constexpr double kHugeVoid = 1;
      if (!ranking.has_certified() || !(solids.volume() > 0) || ranking.best_void() < kHugeVoid) return std::nullopt;
      Candidate candidate = ranking.best().candidate;
      candidate.fewer_faces = faces - 2;
      return candidate;
    });
}

void Candidates::plan_inner_with_padding() {
  for (const WrapKind& kind : kPaddedWraps)
    steps_.push_back([this, kind](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
      constexpr double kMostLost = 0.06;  // of a wrap, where it has too many handles for so few faces
      const SolidId id = ranking.best().hull.solid;
      if (solids[id].source == Source::Wrap && ranking.is_as_asked() &&
          ranking.best_volume() > (1 - kMostLost) * solids[id].volume)
        return std::nullopt;
      return of_wrap(kind, solids);
    });
}

// Of the mesh, if that is closed, and of the solid that has the best hull so far. That hull is kept if no tight one is
// better. Without padding, of 8 robots' parts of which a wrap had it, no tight hull of the wrap was; nor of soups,
// where levels of the wrap keep bounds.
void Candidates::plan_tight() {
  const auto tight = [this](SolidId id, const Solids& solids) {
    const bool may_have_body =
        request_.is_padded() && !request_.options.bounds.any() && solids[id].source != Source::ConvexHull;
    return Candidate{id, target_faces_, {may_have_body ? Method::TightOfGapBody : Method::Tight}};
  };
  steps_.push_back([=, this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
    if (!is_worth_the_mesh(request_, solids)) return std::nullopt;
    const bool is_of_mesh = ranking.best().hull.source == Source::Mesh;  // with its folds, or without
    return tight(is_of_mesh ? ranking.best().hull.solid : 0, solids);
  });
  steps_.push_back([=, this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
    if (!ranking.has_certified()) return std::nullopt;
    const SolidId id = ranking.best().hull.solid;
    const bool has_levels_that_moved = request_.options.bounds.any() && solids[id].source == Source::Wrap;
    if (solids[id].source == Source::Mesh ||
        (!request_.is_padded() && (has_levels_that_moved || is_worth_the_mesh(request_, solids))))
      return std::nullopt;
    return tight(id, solids);
  });
}

void Candidates::plan_inner() {
  constexpr double kLittleVoid = 0.1, kMuchVoid = 0.15;
  steps_.push_back([this](const Ranking& ranking, Solids&) -> std::optional<Candidate> {
    if (ranking.is_as_asked() && ranking.best_void() >= -kLittleVoid) return std::nullopt;
    return moved(0);
  });
  steps_.push_back([=, this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
    if (ranking.has_certified() && ranking.best_void() >= -kMuchVoid) return std::nullopt;
    const auto id = wrap(kWrapInside, spacing_for(kWrapInside), solids);
    return id ? std::optional(moved(*id)) : std::nullopt;
  });
}

}  // namespace prohull

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "enclose/candidates.h"
#include "enclose/known_void.h"
#include "enclose/making.h"
#include "mesh/area.h"

namespace prohull {
namespace {

// Wraps of three robots' parts have 17, 21 and 40 % of the faces that cells of one size would give. Of 12 parts at 1
// and 3 % of the diagonal, hulls of those have 1.09 times the faces, and took 1.25 times as long. By a flatness of
// 0.12, wraps of two parts leave triangles uncovered.
constexpr WrapKind kBoundedWrap{3.5, 0.3, 0, 0.08};

// Of the same parts, hulls have 1.06 to 1.23 times the faces by 0.45, 0.5, 0.55, 0.65 and 0.7.
constexpr double kBoundedSpacing = 0.6;    // of the largest distance
constexpr double kCloseSpacing = 2.0 / 3;  // the same where it is small
constexpr double kReach = 0.6;             // of most vertices of a wrap from the triangles, in spacings

constexpr double kFineWrap = 256;  // to the diagonal; finer ones take ten seconds and more

double pairs_of_faces(const TriangleMesh& mesh) { return double(mesh.face_count()) * double(mesh.face_count()); }

// With as many nodes as memory and patience allow, and less for a mesh of few faces. A wrap of a million nodes has up
// to 340,000 faces, and a hull of it takes seconds.
double finest_spacing(const Request& request, double nodes, double most) {
  constexpr double kMargin = 20;  // nodes on both sides
  const double most_nodes = std::clamp(nodes, 0x1p20, most);
  const Box box = bounding_box(request.to_cover());
  const Vec3 size = box.max - box.min;
  double spacing = request.diagonal / std::cbrt(most_nodes);
  const auto nodes_at = [&](double s) {
    return (size.x / s + kMargin) * (size.y / s + kMargin) * (size.z / s + kMargin);
  };
  while (nodes_at(spacing / 1.1) < most_nodes) spacing /= 1.1;
  return spacing;
}

double finest_loose_spacing(const Request& request) {
  constexpr double kNodesPerFace = 0x1p12, kMostNodes = 0x1p25;  // 128 MB of distances
  return finest_spacing(request, kNodesPerFace * double(request.to_cover().face_count()), kMostNodes);
}

// With as many faces as patience allows, and less for a mesh of few faces: a hull of a wrap of 2.9 million takes 26 s.
// A wheel of 476 faces keeps 0.3 % of the diagonal by so many; 59 loose ones shall not take a minute.
double spacing_of_many_faces(const TriangleMesh& mesh) {
  constexpr double kPerPair = 16, kLeast = 0x1p16, kMost = 25e6;  // of cells of one size
  constexpr double kFacesPerArea = 8.4;  // in spacings; wraps of two robots' parts had 8.0 and 8.4
  const double most = std::clamp(kPerPair * pairs_of_faces(mesh), kLeast, kMost);
  return std::sqrt(kFacesPerArea * area_of(mesh) / most);
}

double finest_close_spacing(const Request& request) {
  constexpr double kNodesPerPair = 0x1p9;
  constexpr double kMostNodes = 0x1p28;  // 6 bytes for each, or 10 where the mesh is not closed: less than 3 GB
  const TriangleMesh& mesh = request.to_cover();
  return std::max(finest_spacing(request, kNodesPerPair * pairs_of_faces(mesh), kMostNodes),
                  spacing_of_many_faces(mesh));
}

/// No wrap is nearer than the hull of a mesh that does not intersect itself.
bool is_of_clean_mesh(const Ranking& ranking, const Solids& solids) {
  return ranking.best().hull.source == Source::Mesh && solids[0].self_intersections == 0;
}

/// A wrap of half the spacing misses at least half as much of the bounds.
bool may_keep_bounds(double spacing, const Ranking& ranking, double last) {
  return !ranking.has_certified() || ranking.best().hull.excess * spacing <= last;
}

}  // namespace

// Collapses move faces away from the triangles, so that a hull of an offset surface needs no millions of faces. A foot
// and a leg of robots, which fold over, have 2,596 and 1,742 faces at 0.1 % of the diagonal, after 3 and 2 s; of wraps
// they had 3,350 and 2,024, after 32 and 22 s. A tent of four faces has 16.
void Candidates::plan_offset() {
  steps_.push_back([this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
    constexpr double kNear = 0.125;  // of the bound; the rest is for collapses
    if (ranking.keeps_bounds() || (ranking.has_certified() && is_of_clean_mesh(ranking, solids))) return std::nullopt;
    const bool is_sheet = !request_.input.closed;
    if (is_sheet && (request_.options.seal_holes > 0 || solids.volume(target_faces_) > 0)) return std::nullopt;
    const auto id = solids.offset(kNear * bounds_.max_distance);
    return id ? std::optional(within(*id, bounds_.max_distance, solids)) : std::nullopt;
  });
}

// Where a mesh does not cover its own folds, as where caps of openings cross its walls, sheets cover them, and all
// collapses of both keep the bound. At 0.1 % of the diagonal, hulls of 9 robots' parts for which no wrap was fine
// enough keep it with 1,248 to 15,314 faces after 0.5 to 12 s. At 0.3 % there are parts with 0.5 and with 1.5 times the
// faces of the hull of a wrap. At 1/8 of the bound, sheets around a wrist closed a cavity.
void Candidates::plan_sheets(bool is_instead_of_wraps) {
  steps_.push_back([=, this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
    constexpr double kNear = 0.03;  // of the bound; the rest is for collapses
    if (ranking.keeps_bounds() && (is_instead_of_wraps || ranking.best().hull.source == Source::Mesh))
      return std::nullopt;
    if (has_few_faces(ranking) || !is_worth_the_mesh(solids)) return std::nullopt;
    const auto id = solids.with_sheets(kNear * bounds_.max_distance);
    if (!id) return std::nullopt;
    EnclosingHull start;
    start.mesh = solids[*id].mesh, start.solid = *id;
    Candidate candidate = further(start, bounds_.max_distance);
    candidate.recipe.approach = Approach::Clear;
    return candidate;
  });
}

void Candidates::plan_bounded_wraps() {
  constexpr double kClose = 1.0 / 200, kVeryClose = 1.0 / 500;  // to the diagonal
  const double max_distance = bounds_.max_distance;
  if (may_stay_within() && request_.options.repair != Repair::Wrap) plan_offset();
  const bool is_small = max_distance < kClose * request_.diagonal;
  const bool is_close = is_small || kBoundedSpacing * max_distance < finest_loose_spacing(request_);
  const bool is_very_small = max_distance < kVeryClose * request_.diagonal;
  if (may_stay_within() && is_very_small) plan_sheets(/*is_instead_of_wraps=*/true);
  const double finest = finest_close_spacing(request_);
  const bool is_hopeless = kReach * finest > kNearerByMoving * max_distance;
  const bool may_be_close = may_stay_within() && is_close;
  // Of 8 triangles, the close wrap is coarser than the loose one, and its hull nearer: by a third.
  if (may_be_close && (!is_hopeless || finest >= finest_loose_spacing(request_))) plan_close_wraps();
  if (may_stay_within() && is_small && !is_very_small) plan_sheets(/*is_instead_of_wraps=*/false);
  if (!may_be_close || is_hopeless) plan_loose_wraps();
  const bool is_too_close = may_stay_within() && finest > kCloseSpacing * max_distance;
  if (is_too_close) plan_why_not_closer(finest, kCloseSpacing * max_distance);
}

// A few vertices of a wrap are up to 1.3 spacings away, most of them less than 0.6; the rest of the bound is for
// collapses. What is between vertices may break it by a little. If memory and patience are not enough for a wrap that
// could keep it, the hull is as near as they allow. Where more is missed than 0.85 of the bound would make
// up for, the wrap itself misses it.
void Candidates::plan_close_wraps() {
  constexpr double kFiner = 2.0 / 3;  // of the spacing before
  constexpr double kNearer = 0.85;    // of the bound
  constexpr int kMost = 2;
  const double max_distance = bounds_.max_distance;
  const double finest = finest_close_spacing(request_);
  const auto plan = [this](double spacing, double distance) {
    steps_.push_back([=, this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
      if (ranking.keeps_bounds() || (ranking.has_certified() && is_of_clean_mesh(ranking, solids))) return std::nullopt;
      const std::span<const SolidId> made = solids.wraps(target_faces_);
      const bool is_made = !made.empty() && solids[made.back()].wrap_spacing == spacing;
      if (is_made && kNearer * ranking.best().hull.excess > 1) return std::nullopt;
      const auto id = is_made ? std::optional(made.back()) : wrap(kBoundedWrap, spacing, solids);
      return id ? std::optional(within(*id, distance, solids)) : std::nullopt;
    });
  };
  double spacing = std::max(kCloseSpacing * max_distance, finest);
  for (int i = 0; i < kMost; ++i) {
    plan(spacing, kReach * spacing < max_distance ? max_distance : spacing);
    if (spacing < max_distance) plan(spacing, kNearer * max_distance);
    if (spacing == finest) break;
    spacing = std::max(kFiner * spacing, finest);
  }
}

/// The last step: it has no candidate.
void Candidates::plan_why_not_closer(double finest, double wanted) {
  steps_.push_back([=, this](const Ranking& ranking, Solids&) -> std::optional<Candidate> {
    if (!ranking.keeps_bounds())
      notes_.add(
          fmt::format("a wrap that keeps the largest distance needs a spacing of about {:.4g}, and so more memory "
                      "and time than a single hull may take: the finest one that is tried has a spacing of {:.4g}",
                      wanted, finest));
    return std::nullopt;
  });
}

// Ever finer ones, until one keeps the bounds; a single one, as near as patience allows, if none can. A hull of a wrap
// moves towards the triangles, so that it may keep a bound that the wrap misses. Of a mesh that does not intersect
// itself no wrap does better: its own hull touches it. A padding of more than 2.4 spacings is too much for a wrap.
void Candidates::plan_loose_wraps() {
  constexpr int kMostBounded = 4;
  constexpr double kPlain = 100;  // to the diagonal; a finer one takes a second and more
  const double finest = std::max(finest_loose_spacing(request_), request_.aim() / 2),
               max_distance = bounds_.max_distance - request_.options.padding;
  const bool is_hopeless = kBoundedWrap.offset * finest > kNearerByMoving * max_distance;
  const double wanted =
      std::max(kBoundedSpacing * max_distance, request_.diagonal / (is_hopeless ? kPlain : kFineWrap));
  LooseWrap next{0, std::max(std::min(spacing_for(kBoundedWrap), wanted), finest), false};
  for (; !next.is_last && next.number < (is_hopeless ? 1 : kMostBounded); ++next.number) {
    next.is_last = next.number + 1 == kMostBounded || next.spacing == finest;
    steps_.push_back([=, this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
      const std::span<const SolidId> made = solids.wraps(target_faces_);
      // The last one is as near as the next larger bounds have it.
      if (!next.is_last && next.number > 0 && !made.empty() &&
          !may_keep_bounds(next.spacing, ranking, solids[made.back()].wrap_spacing))
        return std::nullopt;
      return loose_wrap(next, ranking, solids);
    });
    next.spacing = std::max(next.spacing / 2, finest);
  }
}

// Where another hull keeps the bounds already. One of the void alone says nothing about the spacing: a hull of a wrap
// may have fewer faces by a finer one.
bool Candidates::may_be_better(const LooseWrap& next, const Ranking& ranking, const Solids& solids) const {
  const EnclosingHull& best = ranking.best().hull;
  if (is_of_clean_mesh(ranking, solids) || best.mesh.face_count() <= target_faces_ ||
      next.spacing < request_.diagonal / kFineWrap)
    return false;
  const std::span<const SolidId> made = solids.wraps(target_faces_);
  const bool was_better = std::isinf(bounds_.max_distance) && !made.empty() && best.solid == made.back();
  return next.number == 0 || was_better || !ranking.is_clean();
}

// A hull of a wrap that keeps the bounds has at most kMostReduced times fewer faces than the wrap. Where another hull
// keeps them with fewer still, the wrap is left out.
std::optional<Candidate> Candidates::loose_wrap(const LooseWrap& next, const Ranking& ranking, Solids& solids) const {
  constexpr std::size_t kMostReduced = 400;
  const bool is_within = ranking.keeps_bounds();
  if (is_within && !may_be_better(next, ranking, solids)) return std::nullopt;
  const auto id = wrap(kBoundedWrap, next.spacing, solids);
  if (!request_.input.closed) require_volume(solids.volume(target_faces_), bounds_);
  if (!id || (is_within && ranking.best().hull.mesh.face_count() * kMostReduced < solids[*id].mesh.face_count()))
    return std::nullopt;
  return of(*id, solids);
}

}  // namespace prohull

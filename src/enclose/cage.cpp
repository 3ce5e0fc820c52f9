#include "prohull/cage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "construct/even/even_hull.h"
#include "construct/tight/original.h"
#include "construct/turned.h"
#include "enclose/known_void.h"
#include "prohull/collide.h"
#include "prohull/detail/refuse.h"
#include "prohull/detail/summary.h"
#include "prohull/detail/text.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/padded_hull.h"
#include "prohull/tight_hull.h"
#include "prohull/verification.h"
#include "repair/steps.h"
#include "verify/gap.h"

namespace prohull {
namespace {

constexpr double kHair = 1 + 1e-6;  ///< on the gap, for rounding

class CageMaker {
 public:
  CageMaker(TriangleMesh triangles, const CageOptions& options) : options_(options), triangles_(std::move(triangles)) {
    cage_.gap = options.gap > 0 ? options.gap : kCageGap * finite_bounding_box(triangles_).diagonal();
  }

  Cage run() {
    const auto make = [&](HullSide side, std::size_t faces) {
      return CageHull{.made = options_.even ? even_hull(side, faces) : hull(side, faces)};
    };
    cage_.outer = make(HullSide::Outer, options_.outer_faces);
    if (options_.inner_faces > 0) cage_.inner = make(HullSide::Inner, options_.inner_faces);
    note_contacts();
    return std::move(cage_);
  }

 private:
  EnclosingHulls build(HullSide side, Repair repair, std::size_t faces, double padding) const;
  EnclosingHulls outer_hull(std::size_t faces) const;
  std::optional<EnclosingHulls> hull_moved_inwards(std::size_t faces) const;
  std::optional<EnclosingHulls> hull_with_gap(std::size_t faces) const;
  EnclosingHulls inner_hull(std::size_t faces) const;
  EnclosingHulls hull(HullSide side, std::size_t faces) const;
  EnclosingHulls even_hull(HullSide side, std::size_t faces) const;
  bool move_inwards(EnclosingHulls& made) const;
  void make_even(EnclosingHulls& made, HullSide side) const;
  bool accept(EnclosingHulls& made, HullSide side, TriangleMesh mesh) const;
  double distance_of(const EnclosingHulls& made, const TriangleMesh& mesh) const;
  std::optional<Verification> proven(const EnclosingHulls& made, HullSide side, const TriangleMesh& mesh) const;
  void note_contacts();

  const CageOptions& options_;
  TriangleMesh triangles_;
  Cage cage_;
};

EnclosingHulls CageMaker::outer_hull(std::size_t faces) const {
  EnclosingHulls made = build(HullSide::Outer, Repair::Auto, faces, cage_.gap);
  if (made.hulls[0].self_intersections == 0) return made;
  // As where faces have passed through each other in a narrow gap.
  EnclosingHulls wrapped = build(HullSide::Outer, Repair::Wrap, faces, cage_.gap);
  return wrapped.hulls[0].self_intersections == 0 ? wrapped : made;
}

// Where the hull cannot move inwards, one with fewer faces may: of a teapot, one of 100 where those of 200 and more
// touch themselves.
std::optional<EnclosingHulls> CageMaker::hull_moved_inwards(std::size_t faces) const {
  for (const std::size_t fewer : {faces, faces / 2, faces / 4, faces / 8}) {
    EnclosingHulls made = build(HullSide::Inner, Repair::Auto, std::max<std::size_t>(fewer, 4), 0);
    made.hulls[0].target_faces = faces;
    if (move_inwards(made)) return made;
  }
  return std::nullopt;
}

std::optional<EnclosingHulls> CageMaker::hull_with_gap(std::size_t faces) const try {
  EnclosingHulls made = build(HullSide::Inner, Repair::Auto, faces, cage_.gap);
  if (accept(made, HullSide::Inner, TriangleMesh(made.hulls[0].mesh))) return made;
  return std::nullopt;
} catch (const InputError& error) {
  if (error.defect() != Defect::NoCertificate) throw;
  return std::nullopt;
}

// Of boxes that overlap, only a hull that keeps the gap from the beginning lies inside. Of thin parts, it has far more
// void: of an elephant 65 % for 27. So it takes the place of one that keeps less only where the gap was asked for.
EnclosingHulls CageMaker::inner_hull(std::size_t faces) const {
  const auto merits = [&](const EnclosingHulls& made) {
    const EnclosingHull& hull = made.hulls[0];
    return std::tuple(options_.gap == 0 || hull.padding >= cage_.gap, hull.target_reached, hull.verdict.hull_volume);
  };
  std::optional<EnclosingHulls> best = hull_moved_inwards(faces);
  if (!best || best->hulls[0].padding < cage_.gap || !best->hulls[0].target_reached) {
    std::optional<EnclosingHulls> plain = hull_with_gap(faces);
    if (plain && (!best || merits(*plain) > merits(*best))) best = std::move(plain);
  }
  if (best) return std::move(*best);
  throw InputError(
      Defect::NoCertificate,
      fmt::format("no inner hull of at most {} faces was found that lies strictly inside of the mesh: use another "
                  "gap, mend the mesh where it intersects itself, or leave out the inner hull",
                  faces));
}

EnclosingHulls CageMaker::hull(HullSide side, std::size_t faces) const {
  return side == HullSide::Outer ? outer_hull(faces) : inner_hull(faces);
}

// Room is left for splits. A hull that begins with more faces, or with fewer, may do where this one does not.
EnclosingHulls CageMaker::even_hull(HullSide side, std::size_t faces) const {
  constexpr double kBegin[]{0.8, 1, 0.6, 0.4};
  const auto rank = [&](const EnclosingHulls& made) {
    const double compactness = mesh_quality(made.hulls[0].mesh).compactness.worst;
    return std::pair(made.hulls[0].mesh.face_count() <= faces, std::min(compactness, kEvenCompactness));
  };
  std::optional<EnclosingHulls> best;
  std::optional<InputError> why_not;
  for (const double part : kBegin) try {
      EnclosingHulls made = hull(side, std::max<std::size_t>(4, std::size_t(std::llround(part * double(faces)))));
      made.hulls[0].target_faces = faces;
      make_even(made, side);
      if (!best || rank(made) > rank(*best)) best = std::move(made);
      if (rank(*best) == std::pair(true, kEvenCompactness)) break;
    } catch (const InputError& error) {
      if (error.defect() != Defect::NoCertificate) throw;
      why_not = error;
    }
  if (!best) throw InputError(*why_not);
  best->hulls[0].target_reached = best->hulls[0].mesh.face_count() <= faces;
  return std::move(*best);
}

EnclosingHulls CageMaker::build(HullSide side, Repair repair, std::size_t faces, double padding) const {
  EnclosingOptions how;
  how.hull.side = side;
  how.hull.relax_guards = true;
  how.hull.float32_coordinates = options_.float32_coordinates;
  how.hull.threads = options_.threads;
  how.tight = options_.tight;
  how.repair = repair;
  how.progress = options_.progress;
  how.padding = padding;
  return enclosing_hulls(triangles_, {&faces, 1}, how);
}

double CageMaker::distance_of(const EnclosingHulls& made, const TriangleMesh& mesh) const {
  const CollisionIndex hull(mesh, StandsFor::Surface),
      original(triangles_to_cover(made, made.hulls[0]), StandsFor::Surface);
  return separation(hull, {}, original, {}).lower;
}

/// What verify_hull says of the mesh in the place of the hull; none if it is no hull.
std::optional<Verification> CageMaker::proven(const EnclosingHulls& made, HullSide side,
                                              const TriangleMesh& mesh) const {
  const RepairedMesh& input = made.input;
  Verification verdict =
      of_file(verify_hull(mesh, input.original, side,
                          {.closed = input.closed_mesh(), .max_offenders = 0, .progress = options_.progress}),
              input);
  if (!verdict.encloses) return std::nullopt;
  TriangleMesh beside = made.solids[made.hulls[0].solid].doors;
  if (!input.closed) append(beside, input.caps);
  if (side == HullSide::Outer && beside.face_count() > 0 &&
      !verify_cover(beside, mesh, {.max_offenders = 0, .progress = options_.progress}).encloses)
    return std::nullopt;
  return verdict;
}

/// Takes the mesh for the hull if it is proven to be one, strictly apart from the triangles, and no worse.
bool CageMaker::accept(EnclosingHulls& made, HullSide side, TriangleMesh mesh) const {
  EnclosingHull& hull = made.hulls[0];
  const std::size_t self_intersections = count_self_intersections(mesh);
  if (self_intersections > hull.self_intersections) return false;
  const double distance =
      verify::verify_gap(mesh, triangles_to_cover(made, hull), cage_.gap, {.progress = options_.progress})
          .proven_distance;
  if (!(distance > 0) || distance < std::min(hull.padding, cage_.gap)) return false;
  std::optional<Verification> verdict = proven(made, side, mesh);
  if (!verdict) return false;
  hull.verdict = std::move(*verdict);
  hull.mesh = std::move(mesh);
  hull.levels.reset();
  hull.padding = distance;
  hull.self_intersections = self_intersections;
  hull.verdict.proof = "padding", hull.verdict.gap = distance;
  hull.target_reached = hull.mesh.face_count() <= hull.target_faces;
  hull.void_ratio = known_void(made, hull);
  return true;
}

// What is missing of the gap is added, and measured again. Where that finds no hull, as in a thin mesh, less of the gap
// is kept. False if there is none at all.
bool CageMaker::move_inwards(EnclosingHulls& made) const {
  constexpr int kMostAttempts = 4;
  constexpr double kLeast = 1e-6;  // of the gap
  const TriangleMesh before = turned(made.hulls[0].mesh);
  bool found = false;
  for (double aim = kHair * cage_.gap; !found && aim > kLeast * cage_.gap; aim /= 4) {
    double added = aim - distance_of(made, turned(before));
    for (int i = 0; i < kMostAttempts && added > 0; ++i) {
      const TriangleMesh moved = turned(padded_hull(before, added, options_.float32_coordinates).mesh);
      found |= accept(made, HullSide::Inner, moved);
      if (found && made.hulls[0].padding >= cage_.gap) return true;
      added += 2 * std::max(0.0, aim - distance_of(made, moved));
    }
  }
  return found;
}

void CageMaker::make_even(EnclosingHulls& made, HullSide side) const {
  const EnclosingHull& hull = made.hulls[0];
  const Original original =
      Original::padded_triangles(triangles_to_cover(made, hull), std::min(hull.padding, cage_.gap), options_.threads);
  const EvenOptions how{.max_faces = hull.target_faces,
                        .compactness = kEvenCompactness,
                        .float32_coordinates = options_.float32_coordinates,
                        .progress = options_.progress};
  const bool inner = side == HullSide::Inner;
  const TriangleMesh even = prohull::even_hull(inner ? turned(hull.mesh) : hull.mesh, original, how);
  accept(made, side, inner ? turned(even) : even);
}

void CageMaker::note_contacts() {
  const auto finish = [&](CageHull& side) {
    const EnclosingHull& hull = side.hull();
    side.keeps_gap = hull.padding >= cage_.gap;
    side.is_disjoint = hull.padding > 0 && hull.self_intersections == 0;
    side.quality = mesh_quality(hull.mesh);
    if (options_.even && side.quality.compactness.worst < kEvenCompactness)
      cage_.notes.push_back(fmt::format(
          "not all triangles of {} faces could be made even: the thinnest one of the {} hull has a compactness of "
          "{:.2g}, below {:g}; allow more faces",
          grouped(hull.mesh.face_count()), &side == &cage_.outer ? "outer" : "inner", side.quality.compactness.worst,
          kEvenCompactness));
  };
  finish(cage_.outer);
  if (!cage_.inner) return;
  finish(*cage_.inner);
  const CollisionIndex outer(cage_.outer.hull().mesh, StandsFor::Surface),
      inner(cage_.inner->hull().mesh, StandsFor::Surface);
  if (collide(outer, {}, inner, {})) cage_.outer.is_disjoint = cage_.inner->is_disjoint = false;
}

void require_usable(const CageOptions& options) {
  if (!(options.gap >= 0 && std::isfinite(options.gap)))
    refuse(fmt::format("the gap is {:g}; it must be a number of at least 0", options.gap));
  if (options.outer_faces < 4 || (options.inner_faces > 0 && options.inner_faces < 4))
    refuse("a hull has at least 4 faces");
}

}  // namespace

Cage build_cage(TriangleMesh triangles, const CageOptions& options) {
  require_usable_size(finite_bounding_box(triangles));
  require_usable(options);
  return CageMaker(std::move(triangles), options).run();
}

}  // namespace prohull

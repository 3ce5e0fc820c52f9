#include "prohull/cage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "construct/even/even_hull.h"
#include "construct/tight/original.h"
#include "construct/turned.h"
#include "enclose/surface_of.h"
#include "prohull/collide.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/padded_hull.h"
#include "prohull/tight_hull.h"
#include "prohull/verification.h"

namespace prohull {
namespace {

constexpr double kHair = 1 + 1e-6;  ///< on the gap, for rounding

double finite_diagonal(const TriangleMesh& mesh) {
  Box box;
  for (const FaceId f : mesh.triangles.ids())
    if (const Triangle t = mesh.triangle(f); is_finite(t.a) && is_finite(t.b) && is_finite(t.c))
      box.extend(t.a), box.extend(t.b), box.extend(t.c);
  return box.diagonal();
}

class CageMaker {
 public:
  CageMaker(TriangleMesh triangles, const CageOptions& options) : options_(options), triangles_(std::move(triangles)) {
    cage_.gap = options.gap > 0 ? options.gap : kCageGap * finite_diagonal(triangles_);
    if (!(cage_.gap > 0))
      throw InputError(Defect::InvalidOption, "the mesh has no size that a gap could be taken from: give the gap");
  }

  Cage run() {
    add_outer();
    if (options_.inner_faces > 0) add_inner();
    note_contacts();
    return std::move(cage_);
  }

 private:
  void add_outer();
  void add_inner();
  EnclosingHulls build(HullSide side, Repair repair) const;
  std::size_t faces_of(HullSide side) const;
  void move_inwards(EnclosingHulls& made) const;
  void make_even(EnclosingHulls& made, HullSide side);
  bool accept(EnclosingHulls& made, HullSide side, TriangleMesh mesh) const;
  double distance_of(const EnclosingHulls& made, const TriangleMesh& mesh) const;
  bool is_proven(const EnclosingHulls& made, HullSide side, const TriangleMesh& mesh) const;
  void note_contacts();

  const CageOptions& options_;
  TriangleMesh triangles_;
  Cage cage_;
};

void CageMaker::add_outer() {
  cage_.outer.made = build(HullSide::Outer, Repair::Auto);
  if (cage_.outer.hull().self_intersections > 0)  // as where faces have passed through each other in a narrow gap
    if (EnclosingHulls wrapped = build(HullSide::Outer, Repair::Wrap); wrapped.hulls[0].self_intersections == 0)
      cage_.outer.made = std::move(wrapped);
  if (options_.even) make_even(cage_.outer.made, HullSide::Outer);
}

void CageMaker::add_inner() {
  CageHull& inner = cage_.inner.emplace();
  inner.made = build(HullSide::Inner, Repair::Auto);
  move_inwards(inner.made);
  if (options_.even) make_even(inner.made, HullSide::Inner);
}

std::size_t CageMaker::faces_of(HullSide side) const {
  return side == HullSide::Outer ? options_.outer_faces : options_.inner_faces;
}

// Room is left for the splits that make triangles even.
EnclosingHulls CageMaker::build(HullSide side, Repair repair) const {
  constexpr double kBeforeSplits = 0.7;
  const std::size_t asked = faces_of(side);
  const std::size_t faces =
      options_.even ? std::max<std::size_t>(4, std::size_t(std::llround(kBeforeSplits * double(asked)))) : asked;
  EnclosingOptions how;
  how.hull.side = side;
  how.hull.relax_guards = true;
  how.hull.float32_coordinates = options_.float32_coordinates;
  how.hull.threads = options_.threads;
  how.tight = options_.tight;
  how.repair = repair;
  how.progress = options_.progress;
  if (side == HullSide::Outer) how.padding = cage_.gap;
  EnclosingHulls made = enclosing_hulls(triangles_, {&faces, 1}, how);
  made.hulls[0].target_faces = asked;
  return made;
}

double CageMaker::distance_of(const EnclosingHulls& made, const TriangleMesh& mesh) const {
  return separation(surface_of(mesh), {}, surface_of(triangles_to_cover(made, made.hulls[0])), {}).lower;
}

bool CageMaker::is_proven(const EnclosingHulls& made, HullSide side, const TriangleMesh& mesh) const {
  const VerificationOptions options{.max_offenders = 0, .progress = options_.progress};
  const auto& closed = made.input.closed;
  const bool encloses =
      !closed ||
      verify_hull(mesh, is_closed(made.input.original) ? made.input.original : closed->mesh, side, options).encloses;
  if (side == HullSide::Inner) return encloses;
  const TriangleMesh all = triangles_to_cover(made, made.hulls[0]);
  return encloses && verify_cover(all, mesh, {.max_offenders = 0, .progress = options_.progress}).encloses;
}

/// Takes the mesh for the hull if it is proven to be one, strictly apart from the triangles, and no worse.
bool CageMaker::accept(EnclosingHulls& made, HullSide side, TriangleMesh mesh) const {
  EnclosingHull& hull = made.hulls[0];
  const std::size_t self_intersections = count_self_intersections(mesh);
  if (self_intersections > hull.self_intersections) return false;
  const double distance = distance_of(made, mesh);
  if (!(distance > 0) || distance < std::min(hull.padding, cage_.gap) || !is_proven(made, side, mesh)) return false;
  hull.mesh = std::move(mesh);
  hull.levels.reset();
  hull.padding = distance;
  hull.self_intersections = self_intersections;
  hull.proof = "padding";
  hull.target_reached = hull.mesh.face_count() <= hull.target_faces;
  if (made.volume > 0) hull.void_ratio = signed_volume(hull.mesh) / made.volume - 1;
  return true;
}

// What is missing of the gap is added, and measured again. Where the mesh is too thin for that, as much of the gap is
// kept as can be.
void CageMaker::move_inwards(EnclosingHulls& made) const {
  constexpr int kMostAttempts = 4;
  constexpr double kLeast = 1e-3;  // of the gap
  const TriangleMesh before = turned(made.hulls[0].mesh);
  bool found = false;
  for (double aim = kHair * cage_.gap; aim > kLeast * cage_.gap; aim /= 4) {
    double added = aim - distance_of(made, turned(before));
    for (int i = 0; i < kMostAttempts && added > 0; ++i) {
      const TriangleMesh moved = turned(padded_hull(before, added, options_.float32_coordinates).mesh);
      found |= accept(made, HullSide::Inner, moved);
      if (found && made.hulls[0].padding >= cage_.gap) return;
      added += 2 * std::max(0.0, aim - distance_of(made, moved));
    }
    if (found) return;
  }
  throw InputError(Defect::NoCertificate,
                   fmt::format("no inner hull of {} faces lies strictly inside of the mesh; try more faces",
                               made.hulls[0].target_faces));
}

void CageMaker::make_even(EnclosingHulls& made, HullSide side) {
  const EnclosingHull& hull = made.hulls[0];
  const Original original =
      Original::padded_triangles(triangles_to_cover(made, hull), std::min(hull.padding, cage_.gap));
  const EvenOptions how{.max_faces = hull.target_faces,
                        .compactness = kEvenCompactness,
                        .float32_coordinates = options_.float32_coordinates,
                        .progress = options_.progress};
  const bool inner = side == HullSide::Inner;
  const TriangleMesh even = even_hull(inner ? turned(hull.mesh) : hull.mesh, original, how);
  if (!accept(made, side, inner ? turned(even) : even))
    cage_.notes.push_back(
        fmt::format("the triangles of the {} hull could not be made even", inner ? "inner" : "outer"));
}

void CageMaker::note_contacts() {
  const auto finish = [&](CageHull& side) {
    const EnclosingHull& hull = side.hull();
    side.keeps_gap = hull.padding >= cage_.gap;
    side.is_disjoint = hull.padding > 0 && hull.self_intersections == 0;
    side.quality = mesh_quality(hull.mesh);
  };
  finish(cage_.outer);
  if (!cage_.inner) return;
  finish(*cage_.inner);
  if (collide(surface_of(cage_.outer.hull().mesh), {}, surface_of(cage_.inner->hull().mesh), {}))
    cage_.outer.is_disjoint = cage_.inner->is_disjoint = false;
}

void require_usable(const CageOptions& options) {
  const auto refuse = [](const std::string& what) { throw InputError(Defect::InvalidOption, what); };
  if (!(options.gap >= 0 && std::isfinite(options.gap)))
    refuse(fmt::format("the gap is {:g}; it must be a number of at least 0", options.gap));
  if (options.outer_faces < 4 || (options.inner_faces > 0 && options.inner_faces < 4))
    refuse("a hull has at least 4 faces");
}

}  // namespace

Cage build_cage(TriangleMesh triangles, const CageOptions& options) {
  require_usable(options);
  return CageMaker(std::move(triangles), options).run();
}

}  // namespace prohull

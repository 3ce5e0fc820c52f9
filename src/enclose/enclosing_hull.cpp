#include "prohull/enclosing_hull.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/stopwatch.h"
#include "base/text.h"
#include "construct/lifting.h"
#include "construct/shape_guards.h"
#include "construct/tight/few_faces.h"
#include "construct/tight/gap_body.h"
#include "construct/tight/unsearched.h"
#include "construct/turned.h"
#include "enclose/surface_of.h"
#include "enclose/tolerances.h"
#include "geometry/float32.h"
#include "geometry/usable_size.h"
#include "mesh/area.h"
#include "parallel/arena.h"
#include "parallel/progress_meter.h"
#include "prohull/collide.h"
#include "prohull/convex_hull.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/float32_hull.h"
#include "prohull/mesh_report.h"
#include "prohull/padded_hull.h"
#include "prohull/replay.h"
#include "prohull/tight_hull.h"
#include "prohull/tolerances.h"
#include "prohull/verification.h"
#include "prohull/wrap.h"

namespace prohull {
namespace {

/// The grid is as fine as the faces can carry, about.
struct WrapKind {
  double nodes_per_edge;   ///< of a face of the hull
  double offset, closing;  ///< as in WrapOptions, in spacings
};
// Handles and gaps take faces, so that hulls swell that have few: the second wraps have less of them. Of sheets, the
// later ones are smooth.
constexpr WrapKind kWrapsOfSolids[]{{3.5, 0.3, 1.5}, {6, 0.9, 4}, {3.5, 0.3, 8}};
constexpr WrapKind kWrapsOfSoups[]{{3.5, 0.3, 1.5}, {6, 0.9, 4}};
// A padding closes gaps too, and asks for a finer grid.
constexpr WrapKind kPaddedWraps[]{{6, 0.3, 1.5}, {3.5, 0.3, 0}};
constexpr WrapKind kWrapsOfSheets[]{{3.5, 0.3, 1.5}, {7, 0.9, 4}, {9, 0.5, 4}};

constexpr std::array<std::pair<std::string_view, Repair>, 3> kRepairNames{
    {{"auto", Repair::Auto}, {"none", Repair::None}, {"wrap", Repair::Wrap}}};

constexpr std::array<std::pair<std::string_view, Source>, 3> kSourceNames{
    {{"mesh", Source::Mesh}, {"convex-hull", Source::ConvexHull}, {"wrap", Source::Wrap}}};

class Ladder {
 public:
  Ladder(TriangleMesh triangles, std::span<const std::size_t> target_faces, const EnclosingOptions& options)
      : options_(options), target_faces_(target_faces), fewest_faces_(std::ranges::min(target_faces)) {
    Timer timer(made_.repair_seconds);
    ProgressMeter(options_.progress, "repair").at(0);
    const TriangleMesh given = has_tolerances() ? triangles : TriangleMesh{};
    made_.input = prepared_for_hulls(std::move(triangles), options);
    if (is_symmetric() && !made_.input.closed)
      throw InputError(Defect::OpenEdge, made_.input.obstacle + "; only a closed mesh has symmetric hulls");
    if (has_tolerances()) {
      if (!made_.input.closed)
        throw InputError(Defect::OpenEdge, made_.input.obstacle +
                                               "; faces have tolerances, and only a closed mesh still has these faces");
      tolerances_ = carried_tolerances(given, options.hull.tolerances, made_.input.closed->mesh);
    }
    diagonal_ = bounding_box(made_.input.original).diagonal();
    if (made_.input.closed && options_.repair != Repair::Wrap) {
      const ClosedMesh& closed = *made_.input.closed;
      add_solid({.source = Source::Mesh, .mesh = closed.mesh});
      is_volume_exact_ = made_.solids[0].self_intersections == 0;
      made_.volume = closed.report.volume;
      constexpr std::size_t kMostPairs = 10'000;
      if (const std::size_t pairs = made_.solids[0].self_intersections; !is_outer() && pairs > kMostPairs)
        throw InputError(Defect::NoVolume,
                         fmt::format("{} pairs of its faces intersect, too many to prove what lies inside of it; unite "
                                     "its parts first, for instance by Blender's voxel remesh",
                                     grouped(pairs)));
    }
    if (made_.input.closed) is_original_closed_ = is_closed(made_.input.original);
    if (made_.input.caps.face_count() > 0) {
      with_caps_ = made_.input.original;
      append(with_caps_, made_.input.caps);
    }
    if (options_.repair == Repair::None) return;
    if (made_.input.closed && !is_volume_exact_ && is_outer()) {  // parts that overlap would count twice
      constexpr double kPerDiagonal = 100;
      const double volume =
          inside_volume(made_.input.closed->mesh, {.spacing = diagonal_ / kPerDiagonal, .progress = options_.progress});
      if (volume > 0) made_.volume = volume;
    }
  }

  EnclosingHulls climb() {
    for (const std::size_t faces : target_faces_) {
      notes_.clear();
      made_.hulls.push_back(hull_of(faces));
      made_.hulls.back().notes = notes_;
    }
    for (EnclosingHull& hull : made_.hulls)
      if (made_.volume > 0) hull.void_ratio = signed_volume(hull.mesh) / made_.volume - 1;
    return std::move(made_);
  }

 private:
  static constexpr unsigned kMostRounds = 6;

  struct Attempt {
    EnclosingHull hull;
    bool is_storable;  ///< with the float32 coordinates asked for; a note says why not
  };

  /// Adds the time until it ends.
  class Timer {
   public:
    explicit Timer(double& seconds) : seconds_(seconds) {}
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;
    ~Timer() { seconds_ += watch_.seconds(); }

   private:
    double& seconds_;
    const Stopwatch watch_;
  };

  bool is_outer() const { return options_.hull.side == HullSide::Outer; }
  bool is_padded() const { return options_.padding > 0; }
  bool has_tolerances() const { return !options_.hull.tolerances.empty(); }
  bool is_symmetric() const { return options_.hull.mirror.has_value(); }
  /// Only the mesh itself will do, and hulls that do not move.
  bool is_bound_to_mesh() const { return has_tolerances() || is_symmetric(); }
  bool is_free() const { return is_outer() && options_.repair != Repair::None && !is_bound_to_mesh(); }

  EnclosingHull hull_of(std::size_t target_faces);
  bool is_worth_the_convex_hull(const std::optional<EnclosingHull>& best);
  TriangleMesh padded_convex_solid(TriangleMesh convex) const;
  bool is_worth_the_mesh() const;
  std::span<const WrapKind> wraps() const;
  bool is_worth_a_wrap(const std::optional<EnclosingHull>& best, std::size_t tried) const;
  std::size_t add_solid(Solid solid);
  std::optional<std::size_t> wrap_with(const WrapKind& kind, std::size_t target_faces);
  bool is_better(const EnclosingHull& a, const EnclosingHull& b) const;
  double aim() const;
  void note_solid(const Solid& solid);
  void note_why_not(const EnclosingHull& hull);
  void note(std::string text);
  std::string described(const Solid& solid) const;
  Attempt build(std::size_t solid, std::size_t target_faces);
  Attempt build_moved_away(std::size_t solid, std::size_t target_faces);
  EnclosingHull build_levels(std::size_t solid, std::size_t target_faces);
  EnclosingHull build_in_steps(std::size_t solid, std::size_t target_faces);
  MoveOptions move_options(unsigned max_rounds) const;
  TriangleMesh placed(const TriangleMesh& level, std::size_t solid, unsigned max_rounds = kMostRounds) const;
  bool is_moved_closely(std::size_t solid) const;
  EnclosingHull build_tight(std::size_t solid, std::size_t target_faces);
  TightHull tight_hull(const TriangleMesh& mesh, const HullOptions& options, const TriangleMesh* wrapped,
                       double padding) const;
  std::optional<TightHull> tight_hull_of_gap(std::size_t solid, std::size_t target_faces);
  const TriangleMesh& to_cover() const { return made_.input.caps.face_count() > 0 ? with_caps_ : made_.input.original; }
  const TriangleMesh& to_cover(std::size_t solid) const;
  void certify(EnclosingHull& hull) const;
  void certify_with_padding(EnclosingHull& hull);
  void keep_away(EnclosingHull& hull);
  double distance_from(const TriangleMesh& hull, std::size_t solid);
  bool is_proven(EnclosingHull& hull) const;
  bool encloses_mesh(EnclosingHull& hull) const;
  bool lift_over(EnclosingHull& hull, const TriangleMesh& outside, std::vector<Offender> offenders) const;
  bool covers(const TriangleMesh& hull, const TriangleMesh& triangles) const;
  std::optional<Float32Hull> as_stored(const TriangleMesh& hull, std::size_t solid);
  double excess_of(const TriangleMesh& hull, std::size_t solid) const;
  bool is_within_as_stored(const TriangleMesh& hull, std::size_t solid);
  bool is_as_asked(const EnclosingHull& hull) const;
  double weighed_volume(const EnclosingHull& hull) const;
  bool may_be_searched(std::size_t target_faces) const;
  bool is_much_worse(const EnclosingHull& hull, const EnclosingHull& best) const;
  double slack_of(const EnclosingHull& hull) const;
  double void_of(const EnclosingHull& hull) const { return signed_volume(hull.mesh) / made_.volume - 1; }
  HullOptions hull_options(std::size_t target_faces) const;
  void require_tolerances(const TriangleMesh& hull) const;
  void require_symmetry(const TriangleMesh& hull) const;

  const EnclosingOptions& options_;
  PerFace<double> tolerances_;  ///< of the closed mesh
  const std::span<const std::size_t> target_faces_;
  const std::size_t fewest_faces_;
  EnclosingHulls made_;
  TriangleMesh with_caps_;                               ///< the input and its caps, if it has any
  std::vector<TriangleMesh> with_doors_;                 ///< of each solid that has doors: the same and these
  std::vector<std::optional<CollisionIndex>> surfaces_;  ///< of each solid: what to keep away from, if that was asked
  std::vector<std::string> notes_;                       ///< on the hull that is being built
  double diagonal_ = 0;                                  ///< of the input
  double void_before_padding_ = 0;                       ///< of the last hull of the mesh
  bool is_moved_ = false;                                ///< hulls of the mesh move towards it
  bool has_body_ = false;                                ///< the last tight hull is one of the gap's body
  bool has_folded_body_ = false;                         ///< the gap's body of the mesh intersects itself
  bool is_searched_ = true;                              ///< tight hulls of few faces are searched on from
  bool moves_away_ = false;                              ///< tight hulls move away from what they enclose
  bool is_moved_loosely_ = false;                        ///< hulls do not touch the mesh
  bool is_original_closed_ = false, is_volume_exact_ = false, has_wrap_ = false;
  std::optional<std::size_t> convex_hull_;         ///< its solid
  bool has_no_convex_hull_ = false;                ///< all lies in a plane
  std::vector<std::optional<HullResult>> levels_;  ///< of each solid, down to fewest_faces_
};

EnclosingHull Ladder::hull_of(std::size_t target_faces) {
  std::optional<EnclosingHull> best;
  double build_seconds = 0, verify_seconds = 0;
  const auto take = [&](Attempt&& attempt) {
    auto& [hull, is_storable] = attempt;
    build_seconds += hull.build_seconds, verify_seconds += hull.verify_seconds;
    if (!is_as_asked(hull) && is_storable && is_free()) note_why_not(hull);
    if (!best || is_better(hull, *best)) best = std::move(hull);
  };
  const auto try_solid = [&](std::size_t solid) { take(build(solid, target_faces)); };
  const auto try_other_solid = [&](std::size_t solid) {
    if (may_be_searched(target_faces) && best) {
      is_searched_ = false;
      Attempt attempt = build(solid, target_faces);
      is_searched_ = true;
      const bool is_hopeless = is_much_worse(attempt.hull, *best);
      take(std::move(attempt));
      if (is_hopeless) return;
    }
    try_solid(solid);
  };
  if (is_worth_the_mesh()) {
    try_solid(0);
    has_folded_body_ = options_.tight && is_padded() && !has_body_;
    if (has_body_) take(build_moved_away(0, target_faces));  // with few faces, it may have less void
  }
  if (!is_outer() && is_padded() && options_.repair != Repair::None) {
    constexpr double kMostLost = 0.06;  // of a wrap, where it has too many handles for so few faces
    for (const WrapKind& kind : wraps()) {
      if (best->source == Source::Wrap && is_as_asked(*best) &&
          signed_volume(best->mesh) > (1 - kMostLost) * made_.solids[best->solid].volume)
        break;
      if (const auto solid = wrap_with(kind, target_faces)) try_solid(*solid);
    }
  } else if (!is_outer() && options_.repair != Repair::None && !is_bound_to_mesh() && !options_.levels &&
             !(options_.tight && best->certified)) {
    constexpr double kLittleVoid = 0.1;
    is_moved_ = true;
    if (!is_as_asked(*best) || void_of(*best) < -kLittleVoid) try_solid(0);
    constexpr double kMuchVoid = 0.15;
    if (!best->certified || void_of(*best) < -kMuchVoid)
      if (const auto solid = wrap_with({3.5, 0.3, 0}, target_faces)) try_solid(*solid);
    is_moved_ = false;
  }
  if (is_free()) {
    if (is_worth_the_convex_hull(best)) try_other_solid(*convex_hull_);
    for (std::size_t i = 0; i < wraps().size() && is_worth_a_wrap(best, i); ++i)
      if (const auto solid = wrap_with(wraps()[i], target_faces)) try_other_solid(*solid);
  }
  if (!best)
    throw InputError(
        made_.input.closed ? Defect::NoVolume : Defect::OpenEdge,
        fmt::format("nothing could be wrapped: {}", notes_.empty() ? made_.input.obstacle : notes_.back()));
  if (!best->certified && !is_outer() && is_padded())
    throw InputError(
        Defect::NoCertificate,
        fmt::format("no inner hull of {} faces keeps the gap of {:g}{}; use a smaller gap, or more faces", target_faces,
                    options_.padding, has_wrap_ ? "" : ": the mesh must be thicker than twice the gap somewhere"));
  if (!best->certified) {
    if (notes_.empty()) note_why_not(*best);
    throw InputError(Defect::NoCertificate,
                     fmt::format("no hull of {} faces could be certified: {}; try more faces, or "
                                 "--repair wrap, or another format if that keeps float32 only",
                                 target_faces, notes_.back()));
  }
  if (has_tolerances()) require_tolerances(best->mesh);
  if (is_symmetric()) require_symmetry(best->mesh);
  note_solid(made_.solids[best->solid]);
  best->build_seconds = build_seconds, best->verify_seconds = verify_seconds;
  return std::move(*best);
}

// Also finds it.
bool Ladder::is_worth_the_convex_hull(const std::optional<EnclosingHull>& best) {
  constexpr double kLittleVoid = 0.02;
  const bool is_good = best && is_as_asked(*best);
  if (options_.levels || (is_good && (options_.keep_cavities || slack_of(*best) < kLittleVoid))) return false;
  if (!convex_hull_ && !has_no_convex_hull_) {
    TriangleMesh convex = convex_hull(is_padded() ? to_cover() : made_.input.original);
    if (is_padded()) {
      if (is_good && signed_volume(convex) + aim() * area_of(convex) >= signed_volume(best->mesh)) return false;
      convex = padded_convex_solid(convex.face_count() > 0 ? convex : to_cover());
    }
    if (convex.face_count() > 0)
      convex_hull_ = add_solid({.source = Source::ConvexHull, .mesh = std::move(convex)});
    else
      has_no_convex_hull_ = true;
  }
  return convex_hull_ && !(is_good && made_.solids[*convex_hull_].volume >= signed_volume(best->mesh));
}

// Of 96 times as many points: where that takes long, those of a hull of the convex hull.
TriangleMesh Ladder::padded_convex_solid(TriangleMesh convex) const {
  constexpr std::size_t kMany = 2000;
  if (convex.face_count() > kMany && inspect(convex).is_closed_manifold())
    convex = build_hull(convex, {.target_faces = kMany}).hull.base();
  return padded_convex_hull(convex, aim());
}

// Where many parts overlap, its hull is several times larger than the others, if there is any.
bool Ladder::is_worth_the_mesh() const {
  if (made_.solids.empty() || made_.solids[0].source != Source::Mesh) return false;
  constexpr std::size_t kMany = 120;
  return !is_free() || options_.levels || made_.solids[0].self_intersections <= kMany;
}

// The first ones are the same: they tell whether the triangles enclose anything.
std::span<const WrapKind> Ladder::wraps() const {
  if (is_padded()) return kPaddedWraps;
  if (made_.input.closed) return kWrapsOfSolids;
  return made_.volume > 0 ? std::span<const WrapKind>(kWrapsOfSoups) : kWrapsOfSheets;
}

bool Ladder::is_worth_a_wrap(const std::optional<EnclosingHull>& best, std::size_t tried) const {
  if (!best || !best->certified || !best->target_reached || !best->within_bounds) return true;
  if (options_.levels || (options_.keep_cavities && best->source == Source::Mesh)) return false;
  if (made_.volume == 0) return true;
  constexpr double kLittleVoid = 0.03, kMuchVoid = 0.12, kVeryMuchVoid = 0.3;
  const bool is_clean = best->self_intersections == 0 || !options_.hull.refuses_self_intersections();
  if (best->source == Source::Mesh && is_clean) return has_folded_body_ || slack_of(*best) > kVeryMuchVoid;
  return slack_of(*best) > (tried == 0 ? kLittleVoid : kMuchVoid);
}

std::size_t Ladder::add_solid(Solid solid) {
  solid.volume = signed_volume(solid.mesh);
  solid.self_intersections = solid.source == Source::Mesh ? count_self_intersections(solid.mesh) : 0;
  with_doors_.emplace_back();
  surfaces_.emplace_back();
  if (solid.doors.face_count() > 0) {
    with_doors_.back() = to_cover();
    append(with_doors_.back(), solid.doors);
  }
  made_.solids.push_back(std::move(solid));
  levels_.resize(made_.solids.size());
  return made_.solids.size() - 1;
}

std::optional<std::size_t> Ladder::wrap_with(const WrapKind& kind, std::size_t target_faces) {
  constexpr double kFewest = 25, kMost = 256;
  Timer timer(made_.repair_seconds);
  const double per_diagonal = std::clamp(kind.nodes_per_edge * std::sqrt(double(target_faces)), kFewest, kMost);
  // A wrap that bounds rule out is of no use, unless all are.
  const double near = options_.bounds.max_distance / 3, wanted = diagonal_ / per_diagonal;
  constexpr double kMostPadding = 2.6;  // in spacings, with the offset
  const double spacing = std::max({near < diagonal_ / kMost ? wanted : std::min(near, wanted), options_.seal_holes / 32,
                                   aim() / (kMostPadding - kind.offset)});
  const bool may_leak = !made_.input.closed && options_.open_shells == OpenShells::Close;
  const WrapOptions how{.spacing = spacing,
                        .offset = kind.offset,
                        .padding = aim(),
                        .seal_holes = options_.seal_holes,
                        .seal_rooms = may_leak,
                        .closing = kind.closing * spacing,
                        .progress = options_.progress};
  Wrap made;
  if (is_outer())
    made = wrap(to_cover(), how);
  else
    made.mesh = inner_wrap(made_.input.closed->mesh, how);
  if (options_.hull.float32_coordinates)  // the wrap is farther from the triangles than what that moves it
    for (Vec3& p : made.mesh.positions) p = nearest_float32(p);
  if (!is_outer() && is_padded() && made.mesh.face_count() == 0) return std::nullopt;  // nothing is thick enough
  try {
    Solid solid{.source = Source::Wrap,
                .mesh = closed_mesh(std::move(made.mesh)).mesh,
                .wrap_spacing = spacing,
                .doors = std::move(made.doors),
                .largest_door = made.largest_door};
    const std::size_t i = add_solid(std::move(solid));
    if (is_outer() && !made_.input.closed && !has_wrap_) made_.volume = made.inside_volume;
    has_wrap_ = true;
    return i;
  } catch (const InputError& error) {
    note(fmt::format("the wrap with a spacing of {:.4g} is no closed 2-manifold: {}", spacing, error.what()));
    return std::nullopt;
  }
}

bool Ladder::is_better(const EnclosingHull& a, const EnclosingHull& b) const {
  const auto rank = [&](const EnclosingHull& hull) {
    return std::tuple(!hull.certified, std::max(hull.excess, 1.0), std::max(hull.mesh.face_count(), hull.target_faces),
                      hull.relaxed_guards == kRelaxedGuards.size(), weighed_volume(hull));
  };
  return rank(a) < rank(b);
}

// How much larger it is than it has to be, about. With padding, the void that a hull of the mesh had before tells, and
// the smallest solid beside it.
double Ladder::slack_of(const EnclosingHull& hull) const {
  if (!is_padded()) return void_of(hull);
  if (hull.source == Source::Mesh) return void_before_padding_;
  double least = signed_volume(hull.mesh);
  bool has_wrap = false;
  for (const Solid& solid : made_.solids) {
    if (solid.source != Source::Mesh) least = std::min(least, solid.volume);
    has_wrap |= solid.source == Source::Wrap;
  }
  return has_wrap ? signed_volume(hull.mesh) / least - 1 : std::numeric_limits<double>::infinity();
}

double Ladder::weighed_volume(const EnclosingHull& hull) const {
  constexpr double kOfSelfIntersections = 1.1;
  const double volume = signed_volume(hull.mesh);
  if (!is_outer()) return -volume;
  const bool is_clean = hull.self_intersections == 0 || !options_.hull.refuses_self_intersections();
  return is_clean ? volume : volume + (kOfSelfIntersections - 1) * std::max(0.0, volume - made_.volume);
}

// Tight hulls of few faces are searched on from, which takes most of their time.
bool Ladder::may_be_searched(std::size_t target_faces) const {
  return options_.tight && !options_.bounds.any() && target_faces <= kFewFaces;
}

// The search makes up for no more, where another hull was searched already: of 24 wraps and convex hulls of four models
// at 20 and 50 faces, none that had more than 1.4 times its void was better in the end.
bool Ladder::is_much_worse(const EnclosingHull& hull, const EnclosingHull& best) const {
  constexpr double kMuch = 2;
  const double least = void_of(best);  // below 0 where the volume is only estimated
  return is_better(best, hull) && least > 0 && void_of(hull) > kMuch * least;
}

// The padding and a hair, for rounding; 0 without padding.
double Ladder::aim() const { return is_padded() ? options_.padding * (1 + 1e-6) + 1e-12 * diagonal_ : 0; }

bool Ladder::is_as_asked(const EnclosingHull& hull) const {
  const bool clean = hull.self_intersections == 0 || !options_.hull.refuses_self_intersections();
  return hull.certified && hull.target_reached && hull.within_bounds && clean;
}

HullOptions Ladder::hull_options(std::size_t target_faces) const {
  HullOptions options = options_.hull;
  options.target_faces = target_faces;
  options.tolerances = tolerances_;
  options.progress = options_.progress;
  return options;
}

void Ladder::require_tolerances(const TriangleMesh& hull) const {
  const ToleranceReport found = verify_tolerances(hull, made_.input.closed->mesh, tolerances_, options_.progress);
  if (found.holds) return;
  const std::string what =
      found.missing_faces > 0
          ? fmt::format("{} that should be kept {} not in the hull", counted(found.missing_faces, "face", "faces"),
                        found.missing_faces == 1 ? "is" : "are")
          : fmt::format("{} farther from the hull than allowed", counted(found.far_faces, "face is", "faces are"));
  throw InputError(Defect::NoCertificate,
                   what + (options_.hull.float32_coordinates
                               ? ": the file has float32 coordinates, which move vertices a little; write a .ply, .obj "
                                 "or .off file, which keep doubles"
                               : "; where the mesh intersects itself, vertices of the hull are lifted over its folds: "
                                 "remove the folds, or allow a small distance there"));
}

void Ladder::require_symmetry(const TriangleMesh& hull) const {
  const SymmetryReport found = inspect_symmetry(hull, *options_.hull.mirror);
  if (found.is_symmetric()) return;
  throw InputError(Defect::NoCertificate,
                   "the hull is not symmetric: " + found.first_defect +
                       (options_.hull.float32_coordinates
                            ? "; the file has float32 coordinates, which move vertices a little; write a .ply, .obj or "
                              ".off file, which keep doubles"
                            : "; where the mesh intersects itself, vertices of the hull are lifted over its folds: "
                              "remove the folds"));
}

// The hull with the coordinates that a file keeps, if it has such.
std::optional<Float32Hull> Ladder::as_stored(const TriangleMesh& hull, std::size_t solid) {
  if (!options_.hull.float32_coordinates) return Float32Hull{hull, 0};
  try {
    // A hull of a mesh that intersects itself may have no room for its vertices. The certificate decides, and lifting
    // may help.
    const bool may_lift = made_.solids[solid].self_intersections > 0;
    return with_float32_coordinates(hull, options_.hull.side, may_lift ? NoRoom::Round : NoRoom::Refuse);
  } catch (const InputError& error) {
    note(fmt::format("a hull of {} has no float32 coordinates: {}", described(made_.solids[solid]), error.what()));
    return std::nullopt;
  }
}

double Ladder::excess_of(const TriangleMesh& hull, std::size_t solid) const {
  const bool from_mesh = made_.solids[solid].source == Source::Mesh, has_padding = is_padded() && !from_mesh;
  const double volume = made_.volume > 0 && !has_padding ? made_.volume : made_.solids[solid].volume;
  HullBounds bounds = options_.bounds;
  if (has_padding) bounds.max_distance += options_.padding;
  return bounds.excess(hull, from_mesh ? made_.solids[solid].mesh : to_cover(solid), volume, options_.progress);
}

bool Ladder::is_within_as_stored(const TriangleMesh& hull, std::size_t solid) {
  const auto file = as_stored(hull, solid);
  return file && excess_of(file->mesh, solid) <= 1;
}

// Not of the gap's body.
Ladder::Attempt Ladder::build_moved_away(std::size_t solid, std::size_t target_faces) {
  moves_away_ = true;
  Attempt attempt = build(solid, target_faces);
  moves_away_ = false;
  return attempt;
}

Ladder::Attempt Ladder::build(std::size_t solid, std::size_t target_faces) {
  const Stopwatch building;
  const bool solid_is_moved = made_.solids[solid].source != Source::Mesh && !options_.levels && is_outer();
  EnclosingHull hull =
      options_.tight && !is_moved_ ? build_tight(solid, target_faces) : build_levels(solid, target_faces);
  hull.target_faces = target_faces;
  hull.solid = solid;
  hull.source = made_.solids[solid].source;
  auto file = as_stored(hull.mesh, solid);
  if (file) hull.mesh = std::move(file->mesh), hull.rounded_vertices = file->rounded_vertices;
  hull.build_seconds = building.seconds();
  const Stopwatch verifying;
  if (file && options_.bounds.any() && is_padded()) hull.excess = excess_of(hull.mesh, solid);
  if (file) is_padded() ? certify_with_padding(hull) : certify(hull);
  if (!hull.certified && solid_is_moved && is_moved_closely(solid)) {
    is_moved_loosely_ = true;
    Attempt again = build(solid, target_faces);
    is_moved_loosely_ = false;
    return again;
  }
  if (!hull.certified && has_body_) return build_moved_away(solid, target_faces);
  hull.self_intersections = count_self_intersections(hull.mesh);
  if (file && options_.bounds.any() && !is_padded()) hull.excess = excess_of(hull.mesh, solid);
  hull.within_bounds = hull.excess <= 1;
  hull.verify_seconds = verifying.seconds();
  return {std::move(hull), file.has_value()};
}

EnclosingHull Ladder::build_levels(std::size_t solid, std::size_t target_faces) {
  const bool may_move = !options_.levels && !options_.bounds.any();
  if (may_move && (made_.solids[solid].source != Source::Mesh || is_moved_)) return build_in_steps(solid, target_faces);
  std::optional<HullResult>& result = levels_[solid];
  if (!result) result = build_hull(made_.solids[solid].mesh, hull_options(fewest_faces_));
  EnclosingHull hull;
  std::size_t faces = target_faces;
  const bool is_hopeless = options_.bounds.any() && excess_of(made_.solids[solid].mesh, solid) > 1;
  if (options_.bounds.any() && !is_hopeless)
    faces = std::max(faces, faces_within(result->hull, [&](const TriangleMesh& level) {
                       return is_within_as_stored(level, solid);  // moved, it is nearer
                     }));
  if (is_symmetric()) {
    const std::size_t coarser = symmetric_faces(result->hull, *options_.hull.mirror, faces);
    faces = faces > target_faces && coarser < faces ? faces + 2 : coarser;  // bounds need the finer one
  }
  const TriangleMesh level = result->hull.level(faces);
  hull.target_reached = faces > target_faces || level.face_count() <= target_faces;
  hull.mesh = placed(level, solid);
  if (hull.mesh == level)
    hull.levels = faces > result->hull.base_face_count() ? result->hull.with_base(faces) : result->hull;
  hull.refusals = result->refusals, hull.blocked = result->blocked;
  if (level.face_count() == result->hull.base_face_count()) hull.relaxed_guards = result->relaxed_guards;
  return hull;
}

// A hull of a wrap or of the convex hull moves towards the triangles. Moved before it has come down to its faces, too,
// it is up to 1 % smaller.
EnclosingHull Ladder::build_in_steps(std::size_t solid, std::size_t target_faces) {
  constexpr std::pair<double, unsigned> kSteps[]{{1.5, 2}, {1, kMostRounds}};
  EnclosingHull hull;
  hull.mesh = made_.solids[solid].mesh;
  for (const auto& [faces, rounds] : kSteps) {
    if (!(signed_volume(hull.mesh) > 0)) break;  // an inner hull may vanish
    HullOptions options = hull_options(std::size_t(std::llround(faces * double(target_faces))));
    options.guards.max_overhang =
        overhang_left(bounding_box(hull.mesh), bounding_box(made_.input.original), options_.hull.guards.max_overhang);
    HullResult result = build_hull(hull.mesh, options);
    hull.mesh = placed(result.hull.base(), solid, rounds);
    hull.target_reached = result.stopped == Stopped::TargetReached;
    hull.refusals += result.refusals, hull.blocked = result.blocked;
    hull.relaxed_guards = std::max(hull.relaxed_guards, result.relaxed_guards);
  }
  return hull;
}

// A hull that touches a closed mesh is tighter than one that keeps away from single triangles, but where the mesh
// intersects itself it may not cover them all.
bool Ladder::is_moved_closely(std::size_t solid) const {
  if (is_padded()) return false;
  return !is_outer() || (made_.input.closed && made_.solids[solid].doors.face_count() == 0 && !is_moved_loosely_);
}

MoveOptions Ladder::move_options(unsigned max_rounds) const {
  const HullOptions& hull = options_.hull;
  return {.guards = hull.guards,
          .float32_coordinates = hull.float32_coordinates,
          .max_rounds = max_rounds,
          .padding = aim(),
          .side = hull.side,
          .threads = hull.threads,
          .progress = options_.progress};
}

// A level of a wrap or of the convex hull moves towards the triangles, if it need not be one of a hierarchy.
TriangleMesh Ladder::placed(const TriangleMesh& level, std::size_t solid, unsigned max_rounds) const {
  if ((made_.solids[solid].source == Source::Mesh && !is_moved_) || options_.levels) return level;
  const MoveOptions how = move_options(max_rounds);
  return is_moved_closely(solid) ? moved_towards_closed(level, made_.input.closed->mesh, how.side, how)
                                 : moved_towards(level, to_cover(solid), how);
}

TightHull Ladder::tight_hull(const TriangleMesh& mesh, const HullOptions& options, const TriangleMesh* wrapped,
                             double padding) const {
  return is_searched_ ? build_tight_hull(mesh, options, wrapped, padding)
                      : build_unsearched_tight_hull(mesh, options, wrapped, padding);
}

EnclosingHull Ladder::build_tight(std::size_t solid, std::size_t target_faces) {
  TightHull tight;
  if (auto of_gap = tight_hull_of_gap(solid, target_faces)) {
    tight = std::move(*of_gap);
  } else {
    const TriangleMesh& mesh = made_.solids[solid].mesh;
    const TriangleMesh* wrapped = made_.solids[solid].source == Source::Mesh ? nullptr : &to_cover(solid);
    tight = options_.bounds.any()
                ? build_tight_hull_within(
                      mesh, [&](const TriangleMesh& hull) { return is_within_as_stored(hull, solid); },
                      hull_options(target_faces), wrapped, aim())
                : tight_hull(mesh, hull_options(target_faces), wrapped, aim());
  }
  EnclosingHull hull;
  hull.mesh = std::move(tight.mesh);
  hull.target_reached = tight.stopped == Stopped::TargetReached;
  hull.refusals = tight.refusals, hull.blocked = tight.blocked;
  hull.relaxed_guards = tight.relaxed_guards;
  return hull;
}

// At 2,000 faces a tight hull of the gap's body has up to a quarter less void than a tight hull of the mesh that is
// moved away from it. None if the body intersects itself.
std::optional<TightHull> Ladder::tight_hull_of_gap(std::size_t solid, std::size_t target_faces) {
  const Source source = made_.solids[solid].source;
  has_body_ = false;
  if (!is_padded() || moves_away_ || options_.bounds.any() || source == Source::ConvexHull) return std::nullopt;
  const HullOptions options = hull_options(target_faces);
  const TriangleMesh body = source == Source::Mesh
                                ? gap_body(made_.solids[solid].mesh, to_cover(solid), aim(), options)
                                : gap_body_of_wrap(made_.solids[solid].mesh, to_cover(solid), aim(), options);
  if (count_self_intersections(body) > 0) return std::nullopt;
  has_body_ = true;
  TightHull tight = tight_hull(body, options, nullptr, 0);
  tight.mesh = moved_towards(tight.mesh, to_cover(solid), move_options(kMostRounds));
  return tight;
}

const TriangleMesh& Ladder::to_cover(std::size_t solid) const {
  return with_doors_[solid].face_count() > 0 ? with_doors_[solid] : to_cover();
}

bool Ladder::covers(const TriangleMesh& hull, const TriangleMesh& triangles) const {
  if (triangles.face_count() == 0) return true;
  return verify_cover(triangles, hull, {.max_offenders = 0, .progress = options_.progress}).encloses;
}

void Ladder::certify(EnclosingHull& hull) const {
  hull.certified = is_proven(hull);
  if (!hull.certified) hull.proof = {};
}

// The splits of a progressive hull, replayed, lead from its base mesh to the solid; where the hull is another mesh, for
// it is tight or rounded to float32, it is compared with the mesh. What repair has dropped, and the doors of a wrap,
// have to be covered too; of what is not closed, every triangle.
bool Ladder::is_proven(EnclosingHull& hull) const {
  const Solid& solid = made_.solids[hull.solid];
  const auto& closed = made_.input.closed;
  if (solid.source != Source::Mesh && hull.levels && !verify_replay(*hull.levels, solid.mesh, options_.progress).holds)
    return false;
  if (!closed) {
    hull.proof = "coverage";
    return covers(hull.mesh, to_cover(hull.solid));
  }
  return encloses_mesh(hull) && (!is_outer() || covers(hull.mesh, solid.doors));
}

bool Ladder::encloses_mesh(EnclosingHull& hull) const {
  constexpr std::size_t kMostProtrusions = 200;
  const Solid& solid = made_.solids[hull.solid];
  const bool covers_dropped = !is_outer() || covers(hull.mesh, made_.input.dropped);
  if (solid.source == Source::Mesh && hull.levels) {
    hull.proof = "replay";
    const VerificationOptions options{.max_offenders = 0, .progress = options_.progress};
    if (hull.mesh == hull.levels->base() && verify_hull(*hull.levels, solid.mesh, options).encloses && covers_dropped)
      return true;
    if (!verify_replay(*hull.levels, solid.mesh, options_.progress).holds) return false;
  }
  hull.proof = "enclosure";
  const TriangleMesh& mesh = is_original_closed_ ? made_.input.original : made_.input.closed->mesh;
  const bool may_lift = is_outer() && solid.source == Source::Mesh && !options_.levels && hull.padding == 0;
  const VerificationOptions options{.max_offenders = may_lift ? kMostProtrusions : 0, .progress = options_.progress};
  const auto is_proven = [&](const Verification& found) {
    return found.encloses && (is_original_closed_ || !is_outer() || covers(hull.mesh, made_.input.dropped));
  };
  const Verification found = verify_hull(hull.mesh, mesh, options_.hull.side, options);
  if (found.encloses || !may_lift || found.worst.size() < found.faces_outside) return is_proven(found);
  TriangleMesh outside{mesh.positions, {}};
  for (const Offender& o : found.worst) outside.triangles.push_back(mesh.triangles[o.face]);
  return lift_over(hull, outside, found.worst) &&
         is_proven(
             verify_hull(hull.mesh, mesh, options_.hull.side, {.max_offenders = 0, .progress = options_.progress}));
}

// What is lifted covers what it has covered before: only the triangles that lay outside have to be looked at again.
bool Ladder::lift_over(EnclosingHull& hull, const TriangleMesh& outside, std::vector<Offender> offenders) const {
  constexpr int kLifts = 5;
  hull.levels.reset();
  for (int lifts = 0; lifts < kLifts; ++lifts) {
    std::vector<Protrusion> protrusions;
    for (const Offender& o : offenders) protrusions.push_back({o.point, o.distance});
    hull.mesh = lifted_over(hull.mesh, protrusions,
                            {.least = std::pow(10.0, lifts - 8) * diagonal_,
                             .rings = lifts,
                             .float32_coordinates = options_.hull.float32_coordinates});
    EnclosureReport report =
        verify_cover(outside, hull.mesh, {.max_offenders = offenders.size(), .progress = options_.progress});
    if (report.encloses) return true;
    offenders = std::move(report.worst);
  }
  return false;
}

// Why the distance suffices: a point nearer to the triangles than their distance from the surface is joined to a
// triangle by a segment that does not meet the surface. So the hull winds around it as often as around the triangle,
// which it covers: at least once. Points inside of the triangles are enclosed.
void Ladder::certify_with_padding(EnclosingHull& hull) {
  if (made_.solids[hull.solid].source == Source::Mesh) {
    certify(hull);  // also lifts it over what sticks out
    if (!hull.certified) return;
    void_before_padding_ = void_of(hull);
  }
  hull.certified = false;
  keep_away(hull);
  if (hull.padding < options_.padding) return;
  hull.levels.reset();
  certify(hull);
  if (hull.certified) hull.proof = "padding";
}

// What is missing is added, and measured again; twice of it after the first time, as faces turn when they move.
void Ladder::keep_away(EnclosingHull& hull) {
  constexpr int kMostAttempts = 6;
  const TriangleMesh before = hull.mesh;
  double added = 0;
  for (int i = 0;; ++i) {
    hull.padding = distance_from(hull.mesh, hull.solid);
    if (hull.padding >= options_.padding || (i > 0 && hull.padding == 0) || i == kMostAttempts) break;
    added += (i == 0 ? 1 : 2) * (aim() - hull.padding);
    hull.mesh = is_outer() ? padded_hull(before, added, options_.hull.float32_coordinates).mesh
                           : turned(padded_hull(turned(before), added, options_.hull.float32_coordinates).mesh);
  }
  // Where the solid is thin, the faces of an inner hull have passed through each other.
  if (!is_outer() && count_self_intersections(hull.mesh) > 0) hull.padding = 0;
  if (added == 0 || hull.padding < options_.padding) return;
  TriangleMesh moved = moved_towards(hull.mesh, to_cover(hull.solid), move_options(kMostRounds));
  if (const double distance = distance_from(moved, hull.solid); distance >= options_.padding)
    hull.mesh = std::move(moved), hull.padding = distance;
}

double Ladder::distance_from(const TriangleMesh& hull, std::size_t solid) {
  std::optional<CollisionIndex>& surface = surfaces_[solid];
  if (!surface) surface = surface_of(to_cover(solid));
  return separation(surface_of(hull), {}, *surface, {}).lower;
}

void Ladder::note(std::string text) {
  if (std::ranges::find(notes_, text) == notes_.end()) notes_.push_back(std::move(text));
}

std::string Ladder::described(const Solid& solid) const {
  switch (solid.source) {
    case Source::Mesh:
      return "the mesh itself";
    case Source::ConvexHull:
      return "the convex hull";
    default:
      return fmt::format("the wrap with a spacing of {:.4g}", solid.wrap_spacing);
  }
}

// Of the solid that was taken: what it closes.
void Ladder::note_solid(const Solid& solid) {
  if (solid.source != Source::Wrap) return;
  if (solid.largest_door > 0)
    note(fmt::format("the mesh is not closed: openings up to about {:.4g} across count as closed", solid.largest_door));
  if (!made_.input.closed && made_.volume == 0) note("the triangles enclose no space: the hull is a sheet around them");
}

void Ladder::note_why_not(const EnclosingHull& hull) {
  const std::string source = described(made_.solids[hull.solid]);
  if (!hull.certified)
    note(fmt::format("a hull of {} {}", source,
                     is_padded()  ? "does not keep the padding everywhere, as in gaps narrower than twice the padding"
                     : is_outer() ? "does not cover every triangle"
                                  : "is not proven to lie inside of the mesh"));
  else if (!hull.within_bounds)
    note(fmt::format("no hull of {} is within the bounds", source));
  else if (!hull.target_reached)
    note(fmt::format("no legal collapse of {} is left at {} faces: of its edges, {}", source,
                     grouped(hull.mesh.face_count()), describe_refusals(hull.blocked)));
  else
    note(fmt::format("a hull of {} intersects itself in {}", source,
                     counted(hull.self_intersections, "pair of faces", "pairs of faces")));
}

void require_usable_padding(const EnclosingOptions& options) {
  const auto refuse = [](const std::string& what) { throw InputError(Defect::InvalidOption, what); };
  constexpr double kRoom = 64;  // for the corners of hulls, in paddings
  const double most = options.hull.float32_coordinates ? double(std::numeric_limits<float>::max()) : kLargestCoordinate;
  if (!(options.padding >= 0 && options.padding <= most / kRoom))
    refuse(fmt::format("the padding is {:g}; it must be a number from 0 to {:.3g}", options.padding, most / kRoom));
  if (options.padding > 0 && options.levels) refuse("a hull with padding has no levels: ask for one of the two");
}

void require_usable_tolerances(const TriangleMesh& triangles, const EnclosingOptions& options) {
  const std::size_t given = options.hull.tolerances.size();
  if (given == 0) return;
  const auto refuse = [](const std::string& what) { throw InputError(Defect::InvalidOption, what); };
  if (given != triangles.face_count())
    refuse(fmt::format("{} tolerances for {} faces: there must be one for each face", given, triangles.face_count()));
  if (!std::ranges::all_of(options.hull.tolerances, [](double tolerance) { return tolerance >= 0; }))
    refuse("tolerances must be at least 0; 0 keeps a face, infinity allows any distance");
  if (options.tight) refuse("a tight hull has no tolerances for single faces: build it without tight");
  if (options.padding > 0)
    refuse("a hull with padding has no tolerances for single faces: all its faces move outwards");
  if (options.repair == Repair::Wrap)
    refuse("a wrap has none of the faces that have a tolerance: choose another repair");
}

void require_usable_mirror(const EnclosingOptions& options) {
  if (!options.hull.mirror) return;
  const auto refuse = [](const std::string& what) { throw InputError(Defect::InvalidOption, what); };
  if (options.tight) refuse("a tight hull is not symmetric: build it without tight");
  if (options.padding > 0) refuse("a hull with padding is not symmetric: ask for one of the two");
  if (options.repair == Repair::Wrap || options.seal_holes > 0)
    refuse("a wrap is not symmetric: choose another repair, and no holes to seal");
}

}  // namespace

Names<Repair> repair_names() { return kRepairNames; }

Names<Source> source_names() { return kSourceNames; }

RepairedMesh prepared_for_hulls(TriangleMesh triangles, const EnclosingOptions& options) {
  if (options.repair == Repair::None) {
    ClosedMesh closed = closed_mesh(std::move(triangles));
    RepairedMesh result;
    result.original = closed.mesh;
    result.repairs = closed.repairs;
    result.found = closed.found;
    result.closed = std::move(closed);
    return result;
  }
  const bool is_outer = options.hull.side == HullSide::Outer;
  RepairedMesh result = repaired_mesh(
      std::move(triangles), {.keep_cavities = options.keep_cavities || !is_outer, .open_shells = options.open_shells});
  if (!is_outer && !result.closed)
    throw InputError(Defect::OpenEdge, result.obstacle + "; there is no inner hull of what is not closed");
  return result;
}

TriangleMesh triangles_to_cover(const EnclosingHulls& made, const EnclosingHull& hull) {
  TriangleMesh all = made.input.original;
  append(all, made.input.caps);
  append(all, made.solids[hull.solid].doors);
  return all;
}

EnclosingHulls enclosing_hulls(TriangleMesh triangles, std::span<const std::size_t> target_faces,
                               const EnclosingOptions& options) {
  if (target_faces.empty()) throw InputError(Defect::InvalidOption, "no number of faces was asked for");
  if (options.tight && options.levels)
    throw InputError(Defect::InvalidOption, "a tight hull has no levels: ask for one of the two");
  require_usable_padding(options);
  require_usable_tolerances(triangles, options);
  require_usable_mirror(options);
  if (options.hull.side == HullSide::Inner && (options.repair == Repair::Wrap || options.seal_holes > 0))
    throw InputError(Defect::InvalidOption, "nothing is known to be inside of a wrap: inner hulls do without");
  if (options.hull.float32_coordinates) check_float32_spacing(triangles);
  return arena_of(options.hull.threads).execute([&] {
    return Ladder(std::move(triangles), target_faces, options).climb();
  });
}

EnclosingHull enclosing_hull(TriangleMesh triangles, std::size_t target_faces, const EnclosingOptions& options) {
  return std::move(enclosing_hulls(std::move(triangles), {&target_faces, 1}, options).hulls.front());
}

}  // namespace prohull

#include "prohull/enclosing_hull.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/text.h"
#include "geometry/float32.h"
#include "parallel/progress_meter.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/float32_hull.h"
#include "prohull/replay.h"
#include "prohull/tight_hull.h"

namespace prohull {
namespace {

// A fiftieth is close to the triangles, but may have handles where they have holes; how far each gets: docs/repair.md.
constexpr double kWrapAlphas[]{1.0 / 50, 1.0 / 20, 1.0 / 10};  // of the diagonal
constexpr double kWrapOffset = 1.0 / 600;

constexpr std::array<std::pair<std::string_view, Repair>, 3> kRepairNames{
    {{"auto", Repair::Auto}, {"none", Repair::None}, {"wrap", Repair::Wrap}}};

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// The corners of a face, those of the longest edge first.
std::array<VertexId, 3> longest_edge_first(const TriangleMesh& mesh, FaceId f) {
  auto corners = mesh.triangles[f];
  const auto length = [&](std::size_t i) {
    return squared_norm(mesh.positions[corners[(i + 1) % 3]] - mesh.positions[corners[i]]);
  };
  const std::size_t longest = std::ranges::max(std::array<std::size_t, 3>{0, 1, 2}, {}, length);
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(longest), corners.end());
  return corners;
}

/// As long as v, which is not zero, or nearly.
Vec3 perpendicular(const Vec3& v) {
  const Vec3 axis = std::abs(v.x) < 0.6 * norm(v) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = cross(v, axis);
  return across * (norm(v) / norm(across));
}

class Ladder {
 public:
  Ladder(TriangleMesh triangles, std::span<const std::size_t> target_faces, const EnclosingOptions& options)
      : options_(options), target_faces_(target_faces), fewest_faces_(std::ranges::min(target_faces)) {
    Timer timer(made_.repair_seconds);
    ProgressMeter(options_.progress, "repair").at(0);
    made_.input = prepared_for_hulls(std::move(triangles), options);
    diagonal_ = bounding_box(made_.input.original).diagonal();
  }

  EnclosingHulls climb() {
    for (const std::size_t faces : target_faces_) {
      made_.hulls.push_back(hull_of(faces));
      made_.hulls.back().notes = notes_;
    }
    return std::move(made_);
  }

 private:
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
    ~Timer() { seconds_ += now() - start_; }

   private:
    double& seconds_;
    double start_ = now();
  };

  bool is_outer() const { return options_.hull.side == HullSide::Outer; }
  bool may_wrap() const { return is_outer() && options_.repair != Repair::None && options_.wrap; }

  EnclosingHull hull_of(std::size_t target_faces);
  void make_solid(std::size_t rung);
  TriangleMesh to_be_wrapped(double offset) const;
  void add_wrap(double alpha);
  void note_open_shell(const Solid& wrap);
  void note_why_not(const EnclosingHull& hull);
  void note(std::string text);
  std::string described(const Solid& solid) const;
  Attempt build(std::size_t solid, std::size_t target_faces);
  EnclosingHull build_levels(std::size_t solid, std::size_t target_faces);
  TriangleMesh placed(const TriangleMesh& level, std::size_t solid) const;
  EnclosingHull build_tight(std::size_t solid, std::size_t target_faces);
  void certify(EnclosingHull& hull) const;
  bool covers(const TriangleMesh& hull, const TriangleMesh& triangles) const;
  std::optional<Float32Hull> as_stored(const TriangleMesh& hull, std::size_t solid);
  bool is_within(const TriangleMesh& hull, std::size_t solid) const;
  bool is_within_as_stored(const TriangleMesh& hull, std::size_t solid);
  bool is_as_asked(const EnclosingHull& hull) const;
  bool is_loose(const EnclosingHull& hull) const;
  HullOptions hull_options(std::size_t target_faces) const;

  const EnclosingOptions& options_;
  const std::span<const std::size_t> target_faces_;
  const std::size_t fewest_faces_;
  EnclosingHulls made_;
  std::vector<std::string> notes_;                 ///< on all hulls so far
  double diagonal_;                                ///< of the input
  std::vector<std::optional<HullResult>> levels_;  ///< of each solid, down to fewest_faces_
  std::size_t next_rung_ = 0;
};

// Rung 0 is the repaired input, the others are wraps; some give nothing.
void Ladder::make_solid(std::size_t rung) {
  if (rung == 0) {
    if (!made_.input.closed || options_.repair == Repair::Wrap) return;
    const ClosedMesh& closed = *made_.input.closed;
    made_.solids.push_back({closed.mesh, 0, closed.report.volume, count_self_intersections(closed.mesh)});
    return;
  }
  const double alpha = std::max(kWrapAlphas[rung - 1] * diagonal_, options_.seal_holes / 2);
  if (made_.solids.empty() || made_.solids.back().wrap_alpha < alpha) add_wrap(alpha);
}

// What is wrapped: as wrappers may look at faces with an area only, the others get a little of it.
TriangleMesh Ladder::to_be_wrapped(double offset) const {
  TriangleMesh triangles = made_.input.original;
  const double little = 1e-3 * offset;
  for (const FaceId f : triangles.triangles.ids()) {
    const auto [a, b, c] = longest_edge_first(triangles, f);
    const Vec3 along = triangles.positions[b] - triangles.positions[a];
    const Vec3 up = cross(along, triangles.positions[c] - triangles.positions[a]);
    if (norm(up) > little * norm(along)) continue;
    // Beside the longest edge, or the point.
    const Vec3 beside = norm(along) > 0 ? little / norm(along) * perpendicular(along) : Vec3{little, 0, 0};
    const VertexId d = triangles.positions.push_back(triangles.positions[a] + beside);
    const VertexId e = norm(along) > 0 ? b : triangles.positions.push_back(triangles.positions[a] + Vec3{0, little, 0});
    triangles.triangles.push_back({a, e, d});
  }
  return triangles;
}

void Ladder::add_wrap(double alpha) {
  Timer timer(made_.repair_seconds);
  const bool is_first = made_.solids.empty() || made_.solids.back().wrap_alpha == 0;
  const double offset = kWrapOffset * diagonal_;
  TriangleMesh wrap = options_.wrap(to_be_wrapped(offset), alpha, offset, options_.progress);
  if (options_.hull.float32_coordinates)  // the offset is far greater than what that moves them
    for (Vec3& p : wrap.positions) p = nearest_float32(p);
  try {
    const ClosedMesh closed = closed_mesh(std::move(wrap));
    made_.solids.push_back({closed.mesh, alpha, closed.report.volume, count_self_intersections(closed.mesh)});
    if (is_first) note_open_shell(made_.solids.back());
  } catch (const InputError& error) {
    note(fmt::format("the wrap with alpha {:.4g} is no closed 2-manifold: {}", alpha, error.what()));
  }
}

EnclosingHull Ladder::hull_of(std::size_t target_faces) {
  std::optional<EnclosingHull> best;
  const auto rank = [&](const EnclosingHull& hull) {
    return std::tuple(!hull.certified, hull.self_intersections > 0, !hull.within_bounds,
                      std::max(hull.mesh.face_count(), target_faces), signed_volume(hull.mesh));
  };
  const std::size_t rungs = may_wrap() ? 1 + std::size(kWrapAlphas) : 1;
  for (std::size_t solid = 0;; ++solid) {
    while (solid == made_.solids.size() && next_rung_ < rungs) make_solid(next_rung_++);
    if (solid == made_.solids.size()) break;
    auto [hull, is_storable] = build(solid, target_faces);
    const bool is_good = is_as_asked(hull) && !is_loose(hull);
    if (!is_good && is_storable && rungs > 1) note_why_not(hull);
    if (!best || rank(hull) < rank(*best)) best = std::move(hull);
    if (is_good) break;
  }
  if (!best)
    throw InputError(
        made_.input.closed ? Defect::NoVolume : Defect::OpenEdge,
        fmt::format("nothing could be wrapped: {}", notes_.empty() ? made_.input.obstacle : notes_.back()));
  return std::move(*best);
}

// Where handles and thin parts are in the way, the last levels of a hull swell, and one of a wrap may be smaller. Of
// wraps coarser ones are no better on the whole.
bool Ladder::is_loose(const EnclosingHull& hull) const {
  constexpr double kMuch = 1.5;
  const Solid& solid = made_.solids[hull.solid];
  return is_outer() && solid.wrap_alpha == 0 && !options_.levels && options_.hull.refuses_self_intersections() &&
         signed_volume(hull.mesh) > kMuch * solid.volume;
}

bool Ladder::is_as_asked(const EnclosingHull& hull) const {
  const bool clean = hull.self_intersections == 0 || !options_.hull.refuses_self_intersections();
  return hull.certified && hull.target_reached && hull.within_bounds && clean;
}

HullOptions Ladder::hull_options(std::size_t target_faces) const {
  HullOptions options = options_.hull;
  options.target_faces = target_faces;
  options.progress = options_.progress;
  return options;
}

// The hull with the coordinates that a file keeps, if it has such.
std::optional<Float32Hull> Ladder::as_stored(const TriangleMesh& hull, std::size_t solid) {
  if (!options_.hull.float32_coordinates) return Float32Hull{hull, 0};
  try {
    return with_float32_coordinates(hull, options_.hull.side);
  } catch (const InputError& error) {
    note(fmt::format("a hull of {} has no float32 coordinates: {}", described(made_.solids[solid]), error.what()));
    return std::nullopt;
  }
}

bool Ladder::is_within(const TriangleMesh& hull, std::size_t solid) const {
  if (!options_.bounds.any()) return true;
  return options_.bounds.hold(hull,
                              made_.solids[solid].wrap_alpha > 0 ? made_.input.original : made_.input.closed->mesh,
                              made_.solids.front().volume, options_.progress);
}

bool Ladder::is_within_as_stored(const TriangleMesh& hull, std::size_t solid) {
  const auto file = as_stored(hull, solid);
  return file && is_within(file->mesh, solid);
}

Ladder::Attempt Ladder::build(std::size_t solid, std::size_t target_faces) {
  const double start = now();
  EnclosingHull hull = options_.tight ? build_tight(solid, target_faces) : build_levels(solid, target_faces);
  hull.target_faces = target_faces;
  hull.solid = solid;
  hull.wrap_alpha = made_.solids[solid].wrap_alpha;
  auto file = as_stored(hull.mesh, solid);
  if (file) hull.mesh = std::move(file->mesh), hull.rounded_vertices = file->rounded_vertices;
  hull.void_ratio = signed_volume(hull.mesh) / made_.solids[solid].volume - 1;
  hull.self_intersections = count_self_intersections(hull.mesh);
  hull.within_bounds = !file || is_within(hull.mesh, solid);
  const double built = now();
  if (file) certify(hull);
  hull.build_seconds = built - start, hull.verify_seconds = now() - built;
  return {std::move(hull), file.has_value()};
}

EnclosingHull Ladder::build_levels(std::size_t solid, std::size_t target_faces) {
  levels_.resize(made_.solids.size());
  std::optional<HullResult>& result = levels_[solid];
  if (!result) result = build_hull(made_.solids[solid].mesh, hull_options(fewest_faces_));
  EnclosingHull hull;
  std::size_t faces = target_faces;
  if (options_.bounds.any())
    faces = std::max(faces, faces_within(result->hull, [&](const TriangleMesh& level) {
                       return is_within_as_stored(placed(level, solid), solid);
                     }));
  const TriangleMesh level = result->hull.level(faces);
  hull.target_reached = faces > target_faces || level.face_count() <= target_faces;
  hull.mesh = placed(level, solid);
  if (hull.mesh == level)
    hull.levels = faces > result->hull.base_face_count() ? result->hull.with_base(faces) : result->hull;
  hull.refusals = result->refusals, hull.blocked = result->blocked;
  if (level.face_count() == result->hull.base_face_count()) hull.relaxed_guards = result->relaxed_guards;
  return hull;
}

// A level of a wrap moves towards the triangles, if it need not be one of a hierarchy.
TriangleMesh Ladder::placed(const TriangleMesh& level, std::size_t solid) const {
  if (made_.solids[solid].wrap_alpha == 0 || options_.levels) return level;
  const HullOptions& hull = options_.hull;
  return moved_towards(level, made_.input.original, {hull.guards, hull.float32_coordinates, options_.progress});
}

EnclosingHull Ladder::build_tight(std::size_t solid, std::size_t target_faces) {
  const TriangleMesh& mesh = made_.solids[solid].mesh;
  const TriangleMesh* wrapped = made_.solids[solid].wrap_alpha > 0 ? &made_.input.original : nullptr;
  TightHull tight = options_.bounds.any()
                        ? build_tight_hull_within(
                              mesh, [&](const TriangleMesh& hull) { return is_within_as_stored(hull, solid); },
                              hull_options(target_faces), wrapped)
                        : build_tight_hull(mesh, hull_options(target_faces), wrapped);
  EnclosingHull hull;
  hull.mesh = std::move(tight.mesh);
  hull.target_reached = tight.stopped == Stopped::TargetReached;
  hull.refusals = tight.refusals, hull.blocked = tight.blocked;
  hull.relaxed_guards = tight.relaxed_guards;
  return hull;
}

bool Ladder::covers(const TriangleMesh& hull, const TriangleMesh& triangles) const {
  if (triangles.face_count() == 0) return true;
  const EnclosureOptions options{.max_offenders = 0, .progress = options_.progress};
  return verify_cover(triangles, hull, options).encloses;
}

// The splits of a progressive hull, replayed, lead from its base mesh to the solid; where the hull is another mesh, for
// it is tight or rounded to float32, it is compared with the solid. What repair has dropped, and faces of a solid that
// intersects itself, which may be inside out somewhere, have to be covered one by one; so has all that was wrapped.
void Ladder::certify(EnclosingHull& hull) const {
  const Solid& solid = made_.solids[hull.solid];
  if (solid.wrap_alpha > 0) {
    hull.certified = covers(hull.mesh, made_.input.original) &&
                     (!hull.levels || verify_replay(*hull.levels, solid.mesh, options_.progress).holds);
    if (hull.certified) hull.proof = "coverage";
    return;
  }
  hull.proof = "replay";
  hull.certified = !hull.levels || verify_replay(*hull.levels, solid.mesh, options_.progress).holds;
  if (hull.certified && (!hull.levels || hull.mesh != hull.levels->base())) {
    const EnclosureOptions options{.max_offenders = 0, .progress = options_.progress};
    hull.proof = "enclosure";
    hull.certified = is_outer() ? verify_enclosure(solid.mesh, hull.mesh, options).encloses
                                : verify_enclosure(hull.mesh, solid.mesh, options).encloses;
  }
  if (hull.certified && is_outer() && options_.repair != Repair::None)
    hull.certified = covers(hull.mesh, solid.self_intersections > 0 ? made_.input.original : made_.input.dropped);
  if (!hull.certified) hull.proof = {};
}

// Of both sides of a sheet a wrap keeps the offset; a solid is thicker.
void Ladder::note_open_shell(const Solid& wrap) {
  double doubled_area = 0;
  for (const FaceId f : wrap.mesh.triangles.ids()) {
    const Triangle t = wrap.mesh.triangle(f);
    doubled_area += norm(cross(t.b - t.a, t.c - t.a));
  }
  const double thickness = 4 * wrap.volume / doubled_area;
  constexpr double kSheet = 3;  // offsets
  if (thickness < kSheet * kWrapOffset * diagonal_)
    note(
        fmt::format("the wrap is a sheet, {:.4g} thick on average: it went in through openings; --seal-holes D closes "
                    "those up to D across",
                    thickness));
}

void Ladder::note(std::string text) {
  if (std::ranges::find(notes_, text) == notes_.end()) notes_.push_back(std::move(text));
}

std::string Ladder::described(const Solid& solid) const {
  return solid.wrap_alpha > 0 ? fmt::format("the wrap with alpha {:.4g}", solid.wrap_alpha)
                              : std::string("the mesh itself");
}

void Ladder::note_why_not(const EnclosingHull& hull) {
  const std::string source = described(made_.solids[hull.solid]);
  if (!hull.certified)
    note(fmt::format("a hull of {} does not cover every triangle", source));
  else if (hull.self_intersections > 0 && options_.hull.refuses_self_intersections())
    note(fmt::format("a hull of {} intersects itself in {} pairs of faces", source, grouped(hull.self_intersections)));
  else if (!hull.within_bounds)
    note(fmt::format("no hull of {} is within the bounds", source));
  else if (hull.target_reached)
    note(fmt::format("a hull of {} with {} faces has {:.1f} times the volume", source, grouped(hull.mesh.face_count()),
                     signed_volume(hull.mesh) / made_.solids.front().volume));
  else
    note(fmt::format("no legal collapse of {} is left at {} faces: of its edges, {}", source,
                     grouped(hull.mesh.face_count()), describe_refusals(hull.blocked)));
}

}  // namespace

Names<Repair> repair_names() { return kRepairNames; }

RepairedMesh prepared_for_hulls(TriangleMesh triangles, const EnclosingOptions& options) {
  if (options.repair == Repair::None) {
    ClosedMesh closed = closed_mesh(std::move(triangles));
    RepairedMesh result{closed.mesh, std::nullopt, {}, closed.repairs, {}, closed.found};
    result.closed = std::move(closed);
    return result;
  }
  const bool is_outer = options.hull.side == HullSide::Outer;
  RepairedMesh result = repaired_mesh(std::move(triangles), options.keep_cavities || !is_outer);
  if (result.closed && options.repair != Repair::Wrap) return result;
  const std::string why = result.closed ? "" : result.obstacle + "; ";
  if (!is_outer) throw InputError(Defect::OpenEdge, why + "there is no inner hull of what is not closed");
  if (!options.wrap)
    throw InputError(Defect::OpenEdge,
                     why +
                         "this build cannot wrap what is not closed: build prohull where CGAL's alpha wrap is "
                         "installed (libcgal-dev), with PROHULL_WRAP=ON");
  return result;
}

EnclosingHulls enclosing_hulls(TriangleMesh triangles, std::span<const std::size_t> target_faces,
                               const EnclosingOptions& options) {
  if (target_faces.empty()) throw InputError(Defect::InvalidOption, "no number of faces was asked for");
  if (options.tight && options.levels)
    throw InputError(Defect::InvalidOption, "a tight hull has no levels: ask for one of the two");
  if (options.hull.side == HullSide::Inner && (options.repair == Repair::Wrap || options.seal_holes > 0))
    throw InputError(Defect::InvalidOption, "nothing is known to be inside of a wrap: inner hulls do without");
  return Ladder(std::move(triangles), target_faces, options).climb();
}

EnclosingHull enclosing_hull(TriangleMesh triangles, std::size_t target_faces, const EnclosingOptions& options) {
  return std::move(enclosing_hulls(std::move(triangles), {&target_faces, 1}, options).hulls.front());
}

}  // namespace prohull

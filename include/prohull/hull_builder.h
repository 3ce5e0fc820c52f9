#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "prohull/detail/names.h"
#include "prohull/detail/symmetry.h"
#include "prohull/progress.h"
#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// The priority of edges: the edge with the least is collapsed first.
enum class Strategy {
  Lazy,    ///< added volume, evaluated again only when the edge comes to the front of the queue; tightest and fastest
  Paper1,  ///< P&T 3.1.3, first strategy: added volume, evaluated again after each collapse nearby
  Paper2,  ///< P&T 3.1.3, second strategy: the volume between the star of the edge and the centre of its link
};

/// "lazy", "paper1", "paper2"
Names<Strategy> strategy_names();

/// The priority queue (P&T 3.1.4). Heap and RedBlackTree give the same hulls. Bucket is the fastest; it treats
/// priorities that differ by less than about 9 % as equal.
enum class QueueKind { Bucket, Heap, RedBlackTree };

/// Whether a collapse is refused if it would make the hull intersect itself: if two faces would then meet at points
/// that are no corner or edge of both.
enum class SelfIntersections {
  ByStrategy,  ///< Refused for Strategy::Lazy; Allowed for the paper's two strategies, which do not test for it
  Refused,     ///< decided exactly; the hull has no more intersecting pairs of faces than the mesh
  Allowed,     ///< faster
};

/// "by-strategy", "refused", "allowed"
Names<SelfIntersections> self_intersections_names();

/// Why an edge was not collapsed.
enum class Refusal : std::uint8_t {
  LinkCondition,     ///< the surface would be pinched
  Valence,           ///< the new vertex would have more than max_valence faces
  NoRoomOutside,     ///< no point is outside of every face of the star (P&T formula 2)
  Certificate,       ///< the best point, as stored, is not provably outside of every face
  Compactness,       ///< a face would become too thin
  NormalDeviation,   ///< a face would turn too far
  SelfIntersection,  ///< faces would meet that share nothing there
  Overhang,          ///< the new vertex would lie too far outside of the mesh's box
  Tolerance,         ///< the hull would go too far from faces of the mesh that have a tolerance
  Symmetry,          ///< the hull would not be symmetric any more
};
constexpr std::size_t kRefusalKinds = 10;

/// Identifiers for reports, which stay the same in later versions: "link_condition", "valence" and so on.
Names<Refusal> refusal_names();

class RefusalCounts {
 public:
  void count(Refusal refusal) { ++counts_[static_cast<std::size_t>(refusal)]; }
  std::size_t operator[](Refusal refusal) const { return counts_[static_cast<std::size_t>(refusal)]; }
  RefusalCounts& operator+=(const RefusalCounts& other) {
    for (std::size_t i = 0; i < kRefusalKinds; ++i) counts_[i] += other.counts_[i];
    return *this;
  }

 private:
  std::array<std::size_t, kRefusalKinds> counts_{};
};

/// Why edges were not collapsed, for people: "12 would pinch the surface, 3 would make a triangle too thin". Reasons
/// that did not occur are left out. Behind `before`, if there are any.
std::string describe_refusals(const RefusalCounts& counts, std::string_view before = "");

/// Limits for the faces that a collapse makes; a collapse beyond them is refused (P&T 3.1.4). The *compactness* of a
/// triangle is 4 sqrt(3) area / (sum of the squared edges): 1 if it is equilateral, near 0 if it is thin.
struct ShapeGuards {
  unsigned max_valence = 12;           ///< faces around the new vertex, at most; in [3, 1000]
  double min_compactness_ratio = 0.8;  ///< least compactness after the collapse / before it, at least; in [0, 1]
  double sufficient_compactness =
      0.15;  ///< a face this compact is accepted whatever the ratio is; Strategy::Lazy only; in [0, 1]
  double max_normal_deviation = std::numbers::pi / 4;  ///< a face turns by this angle at most; radians, in [0, pi/2]
  /// How far the new vertex may lie outside of the bounding box of the mesh, at most, along each axis, relative to the
  /// diagonal of the box; at least 0, or infinity. Not in the paper: a hull of few faces may have spikes without it.
  double max_overhang = 0.1;

  bool operator==(const ShapeGuards&) const = default;
};

/// The guards of which each limit is the weaker one of `a` and `b`.
ShapeGuards weaker(const ShapeGuards& a, const ShapeGuards& b);

/// With HullOptions::relax_guards the guards weaken to these, one after the other, each time no legal collapse is left
/// above the target.
constexpr std::array<ShapeGuards, 4> kRelaxedGuards{
    {{12, 0.8, 0.15, std::numbers::pi / 3},
     {16, 0.5, 0.05, 89 * std::numbers::pi / 180},
     {32, 0.1, 0.01, 89 * std::numbers::pi / 180},
     {32, 0.1, 0.01, 89 * std::numbers::pi / 180, std::numeric_limits<double>::infinity()}}};

struct HullOptions {
  std::size_t target_faces = 2000;  ///< at least 4
  HullSide side = HullSide::Outer;
  Strategy strategy = Strategy::Lazy;
  ShapeGuards guards = {};
  bool relax_guards = false;  ///< weaken the guards where the target is out of reach; see kRelaxedGuards
  SelfIntersections self_intersections = SelfIntersections::ByStrategy;
  /// Of each face of the mesh, how far it may be from the hull: no point of it is farther away, in the input's unit. 0:
  /// the face is kept, so that the hull has it with the same coordinates. Infinity: any distance. Empty: any distance,
  /// of all faces.
  PerFace<double> tolerances = {};
  /// Of each vertex of the mesh, how much of the tolerances is used up already, as if the mesh were that far from what
  /// they are meant for: at least 0. Empty: nothing.
  PerVertex<double> deviations = {};
  /// Build a hull that is its own mirror image, exactly, in the plane through the middle of the mesh's bounding box
  /// that is perpendicular to this axis. The mesh must be so too; inspect_symmetry tells. Most edges are collapsed in
  /// pairs: the level between the two collapses is not symmetric (symmetric_faces). Not together with `tolerances`.
  std::optional<Axis> mirror = {};
  bool float32_coordinates = false;  ///< give new vertices coordinates that a float32 file (STL, GLB) keeps
  QueueKind queue = QueueKind::Bucket;
  /// A seed other than 0 changes the order of the collapses a little, and so the hull.
  std::uint64_t seed = 0;
  unsigned tight_trials = 1000;  ///< most trials of the search for a tight hull of few faces (tight_hull.h)
  unsigned threads = 0;          ///< threads at most; 0: one for each core. The hull is the same for any number.
  Progress progress = {};        ///< stage "build"

  /// Whether collapses are refused that make the hull intersect itself. Inner hulls always refuse them, because an
  /// inner hull that intersects itself may stick out of the mesh.
  bool refuses_self_intersections() const {
    if (side == HullSide::Inner) return true;
    if (self_intersections == SelfIntersections::ByStrategy) return strategy == Strategy::Lazy;
    return self_intersections == SelfIntersections::Refused;
  }
};

enum class Stopped { TargetReached, NoLegalCollapse };

struct HullResult {
  ProgressiveHull hull;
  Stopped stopped;
  RefusalCounts refusals;           ///< over the whole construction; one edge may be refused many times
  RefusalCounts blocked;            ///< why each edge of the base mesh was refused the last time it was tried
  std::size_t linear_programs = 0;  ///< how many were solved
  unsigned relaxed_guards = 0;      ///< how many of kRelaxedGuards were used, from the first on
};

/// Simplifies `mesh` by edge collapses (P&T 3.1), until the hull has at most target_faces faces or no collapse is
/// legal.
///
/// Guaranteed: what ProgressiveHull guarantees. A collapse places its new vertex outside of all faces that it replaces,
/// and an exact predicate decides that for the coordinates that are stored.
///
/// Required: `mesh` is a closed 2-manifold oriented outwards. repair.h makes one where it can; enclosing_hull.h takes
/// any triangles. Throws InputError otherwise, and for options that are outside their range or contradict each other;
/// Cancelled.
///
///   const TriangleMesh horse = closed_mesh(read_mesh("horse.ply")).mesh;
///   const HullResult result = build_hull(horse, {.target_faces = 500});
///   write_mesh("hull.ply", result.hull.base());
HullResult build_hull(const TriangleMesh& mesh, const HullOptions& options = {});

}  // namespace prohull

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>

#include "prohull/names.h"
#include "prohull/progress.h"
#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// In which order edges are collapsed.
enum class Strategy {
  Lazy,    ///< enclosed volume, re-evaluated only when an edge comes to the front of the queue; best and fastest
  Paper1,  ///< P&T 3.1.3, first strategy: enclosed volume, re-evaluated after each collapse nearby
  Paper2,  ///< P&T 3.1.3, second strategy: the volume that the star spans with the centre of its link
};

/// "lazy", "paper1", "paper2"
Names<Strategy> strategy_names();

/// The priority queue (P&T 3.1.4). Heap and RedBlackTree give the same hulls; Bucket sorts to an eighth of an octave.
enum class QueueKind { Bucket, Heap, RedBlackTree };

/// Whether collapses are refused that would add pairs of faces that meet without sharing anything there.
enum class SelfIntersections {
  ByStrategy,  ///< Refused by Strategy::Lazy, Allowed by the paper's two, which do not look
  Refused,     ///< exact; a hull has no more such pairs than the mesh itself
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
};
constexpr std::size_t kRefusalKinds = 7;

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
/// that did not occur are left out.
std::string describe_refusals(const RefusalCounts& counts);

/// Which collapses are refused for the shape of the faces that they would make (P&T 3.1.4).
struct ShapeGuards {
  unsigned max_valence = 12;                           ///< of a new vertex; bigger stars, bigger linear programs
  double min_compactness_ratio = 0.8;                  ///< worst face of the star, after / before; in [0, 1]
  double sufficient_compactness = 0.15;                ///< good enough whatever it was before; not for the paper's two
                                                       ///< strategies; in [0, 1]
  double max_normal_deviation = std::numbers::pi / 4;  ///< of a face that a collapse moves; radians, in [0, pi/2]

  bool operator==(const ShapeGuards&) const = default;
};

/// Of each guard the weaker one.
ShapeGuards weaker(const ShapeGuards& a, const ShapeGuards& b);

/// The guards that HullOptions::relax_guards comes down to, one after the other, where no legal collapse is left above
/// the target.
constexpr std::array<ShapeGuards, 3> kRelaxedGuards{{{12, 0.8, 0.15, std::numbers::pi / 3},
                                                     {16, 0.5, 0.05, 89 * std::numbers::pi / 180},
                                                     {32, 0.1, 0.01, 89 * std::numbers::pi / 180}}};

struct HullOptions {
  std::size_t target_faces = 2000;  ///< at least 4
  HullSide side = HullSide::Outer;
  Strategy strategy = Strategy::Lazy;
  ShapeGuards guards = {};
  bool relax_guards = false;  ///< see kRelaxedGuards; never what makes the hull enclose
  SelfIntersections self_intersections = SelfIntersections::ByStrategy;  ///< see refuses_self_intersections
  bool float32_coordinates = false;  ///< new vertices have coordinates that a float32 file keeps
  QueueKind queue = QueueKind::Bucket;
  std::uint64_t seed =
      0;  ///< others than 0 change the order of the collapses a little, and so the hull; Strategy::Lazy only
  unsigned best_of =
      1;  ///< builds with so many seeds from `seed` on; keeps what is nearest to the target, of that the least void
  unsigned threads = 0;    ///< at most, and no more than cores; 0: one for each core; the hull is the same for any
  Progress progress = {};  ///< stage "build"

  /// Inner hulls always do: one that intersects itself may stick out of the mesh.
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
  RefusalCounts refusals;  ///< over the whole construction; an edge may be refused many times
  RefusalCounts blocked;   ///< of the edges that are left, why each was refused last
  std::size_t linear_programs = 0;
  unsigned relaxed_guards = 0;  ///< so many of kRelaxedGuards were used at the end
};

/// Simplifies `mesh` by edge collapses, every new vertex on the outside of all faces that it replaces, until
/// target_faces or no collapse is legal (P&T 3.1). Every vertex is accepted by an exact predicate on its stored
/// coordinates; the guarantees are those of ProgressiveHull.
/// Throws InputError for options outside their range or that contradict each other, or if `mesh` is not a closed
/// 2-manifold oriented outwards (repair.h makes one where it can); Cancelled.
///
///   const TriangleMesh horse = closed_mesh(read_mesh("horse.ply")).mesh;
///   const HullResult result = build_hull(horse, {.target_faces = 500});
///   write_mesh("hull.ply", result.hull.base());
HullResult build_hull(const TriangleMesh& mesh, const HullOptions& options = {});

}  // namespace prohull

#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "prohull/detail/names.h"
#include "prohull/progress.h"
#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// Where a segment or ray crosses the surface of a mesh.
struct Hit {
  FaceId face{};  ///< of the original mesh
  double t = 0;   ///< segment: fraction of the way from a to b, in [0, 1]; ray: in lengths of its direction, >= 0
  Vec3 position;  ///< the point at t; both are rounded
  bool entering = true;  ///< the query passes from the outside of the face to its inside

  bool operator==(const Hit&) const = default;
};

/// The point of a mesh that is closest to a given one, and how far it is, in the input's unit.
///
/// Guaranteed: the distance from the given point to the mesh, as real numbers, is in [lower, upper]; so is `distance`,
/// which is rounded. The bounds are some 1e-14 of the distance and the size of the face apart, or more where a face is
/// a needle; on a vertex they are 0. Of several closest faces, as far as their upper bounds tell, it is the one with
/// the lowest number.
struct ClosestPoint {
  FaceId face{};  ///< of the original mesh
  Vec3 position;  ///< on the face, but for rounding
  double distance = 0, lower = 0, upper = 0;

  bool operator==(const ClosestPoint&) const = default;
};

/// How queries are answered. All engines give the same answers.
enum class Engine {
  Auto,  ///< the fastest engine: Bvh, or Filter for two hulls of a mesh of a million faces or more
  Bvh,   ///< a tree of boxes over the faces of the original mesh
  /// For an outer and an inner hull: levels of few faces decide what they can of `crosses`, and Bvh the rest. All other
  /// queries are those of Bvh.
  Filter,
  Brute,  ///< tests every face, exactly
};

/// "auto", "bvh", "filter", "brute"
Names<Engine> engine_names();

/// What queries have cost. The engines of the library count nothing; those that refine hulls do (docs/queries.md).
struct QueryCounts {
  std::size_t tests = 0;        ///< faces tested against queries, at all levels (P&T Table 3, "#tests")
  std::size_t splits = 0;       ///< vertex splits that were made ("#splits")
  std::size_t coarsenings = 0;  ///< collapses that were made between queries (BetweenQueries::Coarsen)

  QueryCounts& operator+=(const QueryCounts& other) {
    tests += other.tests, splits += other.splits, coarsenings += other.coarsenings;
    return *this;
  }
};

/// A mesh made ready for queries. It is immutable and cheap to copy: copies share their data, and any number of threads
/// may share one index. Face numbers are those of the mesh that is handed over, or of the original mesh of the hull.
class QueryIndex {
 public:
  /// Takes any triangles, closed or not. Throws InputError(NonFiniteCoordinate) if a vertex of a face is not finite,
  /// and InputError(InvalidOption) for Filter, which needs two hulls.
  explicit QueryIndex(TriangleMesh mesh, Engine engine = Engine::Auto);

  /// Of the original mesh of the hull.
  explicit QueryIndex(const ProgressiveHull& hull, Engine engine = Engine::Auto);

  /// Takes an outer and an inner hull of one mesh. Throws InputError(InvalidOption) if they are not that. Filter throws
  /// InputError(NoCertificate) if the record of the outer hull is not one of a hull (verify_replay).
  QueryIndex(const ProgressiveHull& outer, const ProgressiveHull& inner, Engine engine = Engine::Auto);

  std::string_view engine_name() const;  ///< of the engine that answers, such as "bvh"; never "auto"
  std::size_t face_count() const;
  std::size_t memory_bytes() const;  ///< of what all copies share

 private:
  friend class MeshQuery;
  friend struct QueryAccess;
  struct Shared;
  explicit QueryIndex(std::shared_ptr<const Shared> shared) : shared_(std::move(shared)) {}
  std::shared_ptr<const Shared> shared_;
};

/// Asks a mesh where segments, rays and triangles meet it. It keeps its scratch memory from query to query; that memory
/// does not grow with the number of queries. Use one object per thread.
///
/// Guaranteed: every crossing is found once, also at edges and vertices. Which faces are crossed, and in which order,
/// is exact. The crossings of a closed mesh that does not intersect itself enter and leave in turn. Not guaranteed:
/// whether a segment or ray crosses a face that it only touches, or at which it ends. Segments of no length, rays of no
/// direction and faces without area cross nothing.
///
///     const QueryIndex index(mesh);
///     MeshQuery query(index);
///     for (const Segment& s : segments)
///       if (const auto hit = query.first_hit(s)) mark(hit->face, hit->t);
///
/// How it works: a query is answered as if it were moved by (e, e^2, e^3), for an e smaller than any distance. So it
/// passes every edge and vertex on one side, and it neither starts, ends nor runs in a face.
class MeshQuery {
 public:
  explicit MeshQuery(QueryIndex index);
  ~MeshQuery();
  MeshQuery(MeshQuery&&) noexcept;
  MeshQuery& operator=(MeshQuery&&) noexcept;

  /// The crossing nearest to the start. The coordinates of all queries must be finite.
  std::optional<Hit> first_hit(const Segment& segment);
  std::optional<Hit> first_hit(const Ray& ray);

  /// One of the crossings; faster than first_hit.
  std::optional<Hit> any_hit(const Segment& segment);
  std::optional<Hit> any_hit(const Ray& ray);

  /// Whether there is any crossing; faster than any_hit, as it need not know where.
  bool crosses(const Segment& segment);
  bool crosses(const Ray& ray);

  /// Every crossing, in the order in which the segment or ray passes them.
  std::vector<Hit> all_hits(const Segment& segment);
  std::vector<Hit> all_hits(const Ray& ray);

  /// The faces that have a point in common with the triangle, in ascending order. Faces that only touch it count:
  /// nothing is moved here. A triangle or face without area counts as the segment or point that it is.
  std::vector<FaceId> faces_met(const Triangle& triangle);
  bool meets(const Triangle& triangle);

  /// Whether the point is inside: whether the mesh winds around it at least once. So a point in several overlapping
  /// parts is inside, and a point in a cavity is not; nothing is inside of a mesh that is inside out. Exact. A point on
  /// the surface may count as inside or as outside, but every engine says the same. Throws InputError(OpenEdge) if the
  /// mesh is not closed as is_closed (triangle_mesh.h) has it, and InputError(EmptyMesh) if it has no faces: it has no
  /// inside. The first call for an index finds that out, and takes longer.
  bool contains(const Vec3& point);

  /// The point of the mesh that is closest to `point`; nothing if the mesh is not certainly within `max_distance`,
  /// which is so if the upper bound is greater, or if it has no faces. All faces count, those without area too. Throws
  /// InputError(InvalidOption) unless max_distance >= 0.
  std::optional<ClosestPoint> closest_point(const Vec3& point,
                                            double max_distance = std::numeric_limits<double>::infinity());

  /// The same; distance and bounds are negative if the point is inside, as `contains` has it. Throws what that throws.
  ClosestPoint signed_distance(const Vec3& point);

  /// What all queries so far have cost.
  QueryCounts counts() const;

  std::size_t memory_bytes() const;  ///< of this object alone

 private:
  friend struct QueryAccess;
  struct State;
  std::unique_ptr<State> state_;
};

enum class HitMode { First, Any, All };

/// "first", "any", "all"
Names<HitMode> hit_mode_names();

struct BatchOptions {
  unsigned threads = 0;    ///< threads at most; 0: one for each core
  Progress progress = {};  ///< stage "query"
};

/// The hits of query i are hits[offsets[i]] to hits[offsets[i + 1] - 1].
struct HitBatch {
  std::vector<std::size_t> offsets;
  std::vector<Hit> hits;
  QueryCounts counts;
};

/// The faces met by triangle i are faces[offsets[i]] to faces[offsets[i + 1] - 1].
struct FaceBatch {
  std::vector<std::size_t> offsets;
  std::vector<FaceId> faces;
  QueryCounts counts;
};

/// A batch of queries, answered by many threads. The answers are those of MeshQuery, in the same order, for any number
/// of threads. Throws InputError(NonFiniteCoordinate) with the number of the first query that is not finite; Cancelled.
HitBatch find_hits(const QueryIndex& index, std::span<const Segment> segments, HitMode mode,
                   const BatchOptions& options = {});
HitBatch find_hits(const QueryIndex& index, std::span<const Ray> rays, HitMode mode, const BatchOptions& options = {});
FaceBatch find_faces_met(const QueryIndex& index, std::span<const Triangle> triangles,
                         const BatchOptions& options = {});

/// A batch of MeshQuery::crosses: for each segment or ray whether it crosses the mesh.
std::vector<bool> crosses(const QueryIndex& index, std::span<const Segment> segments, const BatchOptions& options = {});
std::vector<bool> crosses(const QueryIndex& index, std::span<const Ray> rays, const BatchOptions& options = {});

/// A batch of MeshQuery::contains: for each point whether it is inside. Also throws what that throws.
///
///     const std::vector<bool> inside = contains(QueryIndex(mesh), points);
std::vector<bool> contains(const QueryIndex& index, std::span<const Vec3> points, const BatchOptions& options = {});

/// A batch of MeshQuery::closest_point. Also throws what that throws.
std::vector<std::optional<ClosestPoint>> closest_points(const QueryIndex& index, std::span<const Vec3> points,
                                                        double max_distance = std::numeric_limits<double>::infinity(),
                                                        const BatchOptions& options = {});

/// A batch of MeshQuery::signed_distance. Also throws what that throws.
std::vector<ClosestPoint> signed_distances(const QueryIndex& index, std::span<const Vec3> points,
                                           const BatchOptions& options = {});

/// Receives the hits of consecutive queries, starting with query `first`. `counts` is left empty.
using TakeHits = std::function<void(std::size_t first, HitBatch chunk)>;

/// find_hits for batches whose hits shall not all be in memory at once. Queries are asked as they come: for large
/// batches at random find_hits, which may sort them, is faster. Each chunk of some hundred queries goes to
/// `take`, which is called by several threads at a time and in any order. Returns the counts of all. What `take` throws
/// goes on to the caller.
QueryCounts find_hits_in_chunks(const QueryIndex& index, std::span<const Segment> segments, HitMode mode,
                                const TakeHits& take, const BatchOptions& options = {});
QueryCounts find_hits_in_chunks(const QueryIndex& index, std::span<const Ray> rays, HitMode mode, const TakeHits& take,
                                const BatchOptions& options = {});

}  // namespace prohull

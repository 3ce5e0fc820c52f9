#include "prohull/mesh_query.h"

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>

#include "parallel/arena.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/error.h"
#include "query/coherent_order.h"
#include "query/engine.h"
#include "query/filter_engine.h"

namespace prohull {
namespace {

constexpr std::array<std::pair<std::string_view, Engine>, 4> kEngineNames{
    {{"auto", Engine::Auto}, {"bvh", Engine::Bvh}, {"filter", Engine::Filter}, {"brute", Engine::Brute}}};

constexpr std::array<std::pair<std::string_view, HitMode>, 3> kHitModeNames{
    {{"first", HitMode::First}, {"any", HitMode::Any}, {"all", HitMode::All}}};

}  // namespace

Names<Engine> engine_names() { return kEngineNames; }

Names<HitMode> hit_mode_names() { return kHitModeNames; }

struct QueryIndex::Shared {
  TriangleMesh mesh;
  std::string_view engine_name;
  std::unique_ptr<QueryEngine> engine;  ///< refers to `mesh`

  /// Around the mesh.
  const Box& box() const {
    std::call_once(box_is_known_, [&] { box_ = bounding_box(mesh); });
    return box_;
  }

  /// Throws InputError if the mesh is not closed.
  void require_closed() const {
    std::call_once(closed_is_known_, [&] { is_closed_ = is_closed(mesh); });
    if (!is_closed_)
      throw InputError(Defect::OpenEdge,
                       "the mesh is not closed, so that it has no inside; `prohull repair` closes it");
  }

 private:
  mutable std::once_flag box_is_known_, closed_is_known_;
  mutable Box box_;
  mutable bool is_closed_ = false;
};

namespace {

void require_finite(const TriangleMesh& mesh) {
  for (const FaceId f : mesh.triangles.ids())
    for (const VertexId v : mesh.triangles[f])
      if (!is_finite(mesh.positions[v]))
        throw InputError(Defect::NonFiniteCoordinate,
                         fmt::format("face {}: vertex {} has a coordinate that is not finite; remove such faces first",
                                     index(f), index(v)));
}

}  // namespace

/// What of these classes is not for users.
struct QueryAccess {
  static QueryIndex index(TriangleMesh mesh, std::string_view engine_name, const MakeEngine& make_engine) {
    require_finite(mesh);
    auto shared = std::make_shared<QueryIndex::Shared>();
    shared->mesh = std::move(mesh);
    shared->engine_name = engine_name;
    shared->engine = make_engine(shared->mesh);
    return QueryIndex(std::move(shared));
  }

  static void require_closed(const QueryIndex& index) { index.shared_->require_closed(); }

  /// The order in which a batch is asked; empty: as it comes.
  template <class Primitive>
  static std::vector<std::uint32_t> coherent_order(const QueryIndex& index, std::span<const Primitive> primitives) {
    if (!index.shared_->engine->gains_from_order()) return {};
    return prohull::coherent_order(primitives, index.shared_->box());
  }

  /// Each chunk of a batch starts afresh, so that answers and counts are the same whatever thread had which before.
  static void start(MeshQuery& query);

  template <class Primitive>
  static void append_all(MeshQuery& query, const Primitive& primitive, std::vector<Hit>& hits);
};

namespace {

QueryIndex index_of(TriangleMesh mesh, Engine engine) {
  if (engine == Engine::Filter)
    throw InputError(Defect::InvalidOption, "the engine filter needs an outer and an inner hull of the mesh");
  if (engine == Engine::Brute)
    return QueryAccess::index(std::move(mesh), name_of(engine_names(), engine), make_brute_engine);
  return QueryAccess::index(std::move(mesh), name_of(engine_names(), Engine::Bvh), make_bvh_engine);
}

}  // namespace

TriangleMesh original_of(const ProgressiveHull& outer, const ProgressiveHull& inner) {
  if (outer.side() != HullSide::Outer || inner.side() != HullSide::Inner)
    throw InputError(Defect::InvalidOption, "of two hulls, the first must be an outer one and the second an inner one");
  TriangleMesh original = outer.original();
  if (original != inner.original())
    throw InputError(Defect::InvalidOption, "the outer and the inner hull are not of the same mesh");
  return original;
}

QueryIndex peer_index(TriangleMesh mesh, std::string_view name, const MakeEngine& make_engine) {
  return QueryAccess::index(std::move(mesh), name, make_engine);
}

QueryIndex::QueryIndex(TriangleMesh mesh, Engine engine) : QueryIndex(index_of(std::move(mesh), engine)) {}

QueryIndex::QueryIndex(const ProgressiveHull& hull, Engine engine) : QueryIndex(hull.original(), engine) {}

QueryIndex::QueryIndex(const ProgressiveHull& outer, const ProgressiveHull& inner, Engine engine)
    : QueryIndex([&] {
        TriangleMesh original = original_of(outer, inner);
        if (engine == Engine::Auto && filter_pays(original.face_count())) engine = Engine::Filter;
        if (engine != Engine::Filter) return index_of(std::move(original), engine);
        return peer_index(std::move(original), name_of(engine_names(), engine),
                          [&](const TriangleMesh& mesh) { return make_filter_engine(mesh, outer, inner); });
      }()) {}

std::string_view QueryIndex::engine_name() const { return shared_->engine_name; }

std::size_t QueryIndex::face_count() const { return shared_->mesh.face_count(); }

std::size_t QueryIndex::memory_bytes() const {
  const TriangleMesh& mesh = shared_->mesh;
  return sizeof(Shared) + mesh.vertex_count() * sizeof(Vec3) + mesh.face_count() * sizeof(mesh.triangles[FaceId{}]) +
         shared_->engine->memory_bytes();
}

struct MeshQuery::State {
  explicit State(QueryIndex i) : index(std::move(i)), worker(index.shared_->engine->worker()) {}

  template <class Primitive>
  std::optional<Hit> one(const Primitive& primitive, HitMode mode) {
    const DirectedLine line(primitive);
    return line.is_a_point() ? std::nullopt : worker->one_hit(index.shared_->mesh, line, mode);
  }
  template <class Primitive>
  void append_all(const Primitive& primitive, std::vector<Hit>& hits) {
    const DirectedLine line(primitive);
    if (!line.is_a_point()) worker->all_hits(index.shared_->mesh, line, hits);
  }
  template <class Primitive>
  std::vector<Hit> all(const Primitive& primitive) {
    std::vector<Hit> hits;
    append_all(primitive, hits);
    return hits;
  }
  template <class Primitive>
  bool crosses(const Primitive& primitive) {
    const DirectedLine line(primitive);
    return !line.is_a_point() && worker->crosses(index.shared_->mesh, line);
  }
  FaceCollector collected(const Triangle& triangle, HitMode mode) {
    FaceCollector faces(index.shared_->mesh, triangle, mode);
    worker->collect(triangle, faces);
    return faces;
  }

  QueryIndex index;
  std::unique_ptr<QueryWorker> worker;
};

void QueryAccess::start(MeshQuery& query) { query.state_->worker->forget(); }

template <class Primitive>
void QueryAccess::append_all(MeshQuery& query, const Primitive& primitive, std::vector<Hit>& hits) {
  query.state_->append_all(primitive, hits);
}

namespace {

/// Along an axis, from a point of the box, and about as long: boxes are ill seen along directions that are 2^60 times
/// as short (wide_line.h).
Ray ray_to_nearest_side(const Vec3& point, const Box& box) {
  const Vec3 size = box.max - box.min;
  const double length = std::clamp(std::max({size.x, size.y, size.z}), 1e-300, std::numeric_limits<double>::max());
  Ray ray{point, {-length, 0, 0}};
  double nearest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {box.min[axis], box.max[axis]})
      if (const double away = std::abs(side - point[axis]); away < nearest) {
        nearest = away;
        ray.direction = {};
        ray.direction[axis] = side == box.min[axis] ? -length : length;
      }
  return ray;
}

void require_distance(double max_distance) {
  if (!(max_distance >= 0))
    throw InputError(Defect::InvalidOption, fmt::format("max_distance={}: expected a number >= 0", max_distance));
}

}  // namespace

MeshQuery::MeshQuery(QueryIndex index) : state_(std::make_unique<State>(std::move(index))) {}
MeshQuery::~MeshQuery() = default;
MeshQuery::MeshQuery(MeshQuery&&) noexcept = default;
MeshQuery& MeshQuery::operator=(MeshQuery&&) noexcept = default;

std::optional<Hit> MeshQuery::first_hit(const Segment& segment) { return state_->one(segment, HitMode::First); }
std::optional<Hit> MeshQuery::first_hit(const Ray& ray) { return state_->one(ray, HitMode::First); }
std::optional<Hit> MeshQuery::any_hit(const Segment& segment) { return state_->one(segment, HitMode::Any); }
std::optional<Hit> MeshQuery::any_hit(const Ray& ray) { return state_->one(ray, HitMode::Any); }

std::vector<Hit> MeshQuery::all_hits(const Segment& segment) { return state_->all(segment); }
std::vector<Hit> MeshQuery::all_hits(const Ray& ray) { return state_->all(ray); }

bool MeshQuery::crosses(const Segment& segment) { return state_->crosses(segment); }
bool MeshQuery::crosses(const Ray& ray) { return state_->crosses(ray); }

std::vector<FaceId> MeshQuery::faces_met(const Triangle& triangle) {
  return state_->collected(triangle, HitMode::All).all();
}
bool MeshQuery::meets(const Triangle& triangle) { return state_->collected(triangle, HitMode::Any).any(); }

// A first hit that leaves would not do in place of the winding number: of two spheres, one in the other, it enters the
// inner one, and of one that is inside out it leaves from outside. The ray to the nearest side of the box passes few
// faces.
bool MeshQuery::contains(const Vec3& point) {
  QueryAccess::require_closed(state_->index);
  const Box& box = state_->index.shared_->box();
  if (!box.overlaps({point, point})) return false;
  return state_->worker->winding(state_->index.shared_->mesh, DirectedLine(ray_to_nearest_side(point, box))) > 0;
}

std::optional<ClosestPoint> MeshQuery::closest_point(const Vec3& point, double max_distance) {
  require_distance(max_distance);
  ClosestCollector closest(state_->index.shared_->mesh, point, max_distance);
  state_->worker->collect(closest);
  return closest.best();
}

ClosestPoint MeshQuery::signed_distance(const Vec3& point) {
  const bool inside = contains(point);
  const ClosestPoint closest = closest_point(point).value();  // a closed mesh has faces
  if (!inside) return closest;
  return {closest.face, closest.position, 0 - closest.distance, 0 - closest.upper, 0 - closest.lower};
}

QueryCounts MeshQuery::counts() const { return state_->worker->counts(); }
std::size_t MeshQuery::memory_bytes() const { return sizeof(State) + state_->worker->memory_bytes(); }

namespace {

using prohull::is_finite;
bool is_finite(const Segment& s) { return prohull::is_finite(s.a) && prohull::is_finite(s.b); }
bool is_finite(const Ray& r) { return prohull::is_finite(r.origin) && prohull::is_finite(r.direction); }
bool is_finite(const Triangle& t) {
  return prohull::is_finite(t.a) && prohull::is_finite(t.b) && prohull::is_finite(t.c);
}

template <class Answer>
struct Batch {
  std::vector<std::size_t> offsets{0};
  std::vector<Answer> answers;
  QueryCounts counts;
};

template <class Primitive>
void require_finite(std::span<const Primitive> primitives) {
  for (std::size_t i = 0; i < primitives.size(); ++i)
    if (!is_finite(primitives[i]))
      throw InputError(Defect::NonFiniteCoordinate,
                       fmt::format("query {} has a coordinate that is not finite; remove it", i));
}

constexpr std::size_t kChunk = 512;
constexpr std::size_t kGlance = 8;  ///< queries between two looks at progress: each of them may take a while

/// ask(query, primitive, answers) appends the answers to a primitive; take(first, Batch<Answer>) is given those of each
/// chunk.
template <class Answer, class Primitive, class Ask, class Take>
QueryCounts ask_in_chunks(const QueryIndex& index, std::span<const Primitive> primitives, const BatchOptions& options,
                          Ask ask, Take take) {
  const std::size_t chunks = (primitives.size() + kChunk - 1) / kChunk;
  ProgressMeter meter(options.progress, "query");
  std::atomic<std::size_t> done = 0;
  oneapi::tbb::enumerable_thread_specific<MeshQuery> queries([&] { return MeshQuery(index); });
  arena_of(options.threads).execute([&] {
    oneapi::tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
      MeshQuery& query = queries.local();
      QueryAccess::start(query);
      const auto chunk = primitives.subspan(c * kChunk, std::min(kChunk, primitives.size() - c * kChunk));
      Batch<Answer> batch;
      batch.offsets.reserve(chunk.size() + 1);
      for (const Primitive& primitive : chunk) {
        ask(query, primitive, batch.answers);
        batch.offsets.push_back(batch.answers.size());
        if (batch.offsets.size() % kGlance == 0) meter.at(done, primitives.size());
      }
      take(c * kChunk, std::move(batch));
      meter.at(done += chunk.size(), primitives.size());
    });
  });
  QueryCounts counts;
  for (const MeshQuery& query : queries) counts += query.counts();
  return counts;
}

/// Of the queries in the order in which they stand.
template <class Answer, class Primitive, class Ask>
Batch<Answer> ask_in_turn(const QueryIndex& index, std::span<const Primitive> primitives, const BatchOptions& options,
                          Ask ask) {
  std::vector<Batch<Answer>> chunks((primitives.size() + kChunk - 1) / kChunk);
  Batch<Answer> all;
  all.counts = ask_in_chunks<Answer>(index, primitives, options, ask, [&](std::size_t first, Batch<Answer> chunk) {
    chunks[first / kChunk] = std::move(chunk);
  });
  all.offsets.reserve(primitives.size() + 1);
  for (const Batch<Answer>& chunk : chunks) {
    const std::size_t before = all.answers.size();
    for (std::size_t i = 1; i < chunk.offsets.size(); ++i) all.offsets.push_back(before + chunk.offsets[i]);
    all.answers.insert(all.answers.end(), chunk.answers.begin(), chunk.answers.end());
  }
  return all;
}

/// Puts the answers to query order[0], order[1], ... in the order of the queries.
template <class Answer>
Batch<Answer> reordered(const Batch<Answer>& asked, std::span<const std::uint32_t> order) {
  Batch<Answer> all;
  all.counts = asked.counts;
  all.offsets.resize(order.size() + 1);
  for (std::size_t i = 0; i < order.size(); ++i) all.offsets[order[i] + 1] = asked.offsets[i + 1] - asked.offsets[i];
  std::partial_sum(all.offsets.begin(), all.offsets.end(), all.offsets.begin());
  all.answers.resize(asked.answers.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    std::copy(asked.answers.begin() + static_cast<std::ptrdiff_t>(asked.offsets[i]),
              asked.answers.begin() + static_cast<std::ptrdiff_t>(asked.offsets[i + 1]),
              all.answers.begin() + static_cast<std::ptrdiff_t>(all.offsets[order[i]]));
  return all;
}

template <class Answer, class Primitive, class Ask>
Batch<Answer> ask_all(const QueryIndex& index, std::span<const Primitive> primitives, const BatchOptions& options,
                      Ask ask) {
  require_finite(primitives);
  const std::vector<std::uint32_t> order = QueryAccess::coherent_order(index, primitives);
  if (order.empty()) return ask_in_turn<Answer>(index, primitives, options, ask);
  std::vector<Primitive> sorted;
  sorted.reserve(order.size());
  for (const std::uint32_t i : order) sorted.push_back(primitives[i]);
  return reordered(ask_in_turn<Answer>(index, std::span<const Primitive>(sorted), options, ask), order);
}

/// What a batch asks of each segment or ray.
struct AskHits {
  HitMode mode;

  template <class Primitive>
  void operator()(MeshQuery& query, const Primitive& primitive, std::vector<Hit>& hits) const {
    if (mode == HitMode::All) return QueryAccess::append_all(query, primitive, hits);
    const auto hit = mode == HitMode::First ? query.first_hit(primitive) : query.any_hit(primitive);
    if (hit) hits.push_back(*hit);
  }
};

HitBatch hit_batch(Batch<Hit> batch) { return {std::move(batch.offsets), std::move(batch.answers), batch.counts}; }

template <class Primitive>
QueryCounts take_hits_of(const QueryIndex& index, std::span<const Primitive> primitives, HitMode mode,
                         const TakeHits& take, const BatchOptions& options) {
  require_finite(primitives);
  return ask_in_chunks<Hit>(index, primitives, options, AskHits{mode},
                            [&](std::size_t first, Batch<Hit> chunk) { take(first, hit_batch(std::move(chunk))); });
}

}  // namespace

HitBatch find_hits(const QueryIndex& index, std::span<const Segment> segments, HitMode mode,
                   const BatchOptions& options) {
  return hit_batch(ask_all<Hit>(index, segments, options, AskHits{mode}));
}

HitBatch find_hits(const QueryIndex& index, std::span<const Ray> rays, HitMode mode, const BatchOptions& options) {
  return hit_batch(ask_all<Hit>(index, rays, options, AskHits{mode}));
}

QueryCounts find_hits_in_chunks(const QueryIndex& index, std::span<const Segment> segments, HitMode mode,
                                const TakeHits& take, const BatchOptions& options) {
  return take_hits_of(index, segments, mode, take, options);
}

QueryCounts find_hits_in_chunks(const QueryIndex& index, std::span<const Ray> rays, HitMode mode, const TakeHits& take,
                                const BatchOptions& options) {
  return take_hits_of(index, rays, mode, take, options);
}

FaceBatch find_faces_met(const QueryIndex& index, std::span<const Triangle> triangles, const BatchOptions& options) {
  auto batch = ask_all<FaceId>(index, triangles, options,
                               [](MeshQuery& query, const Triangle& triangle, std::vector<FaceId>& faces) {
                                 const std::vector<FaceId> met = query.faces_met(triangle);
                                 faces.insert(faces.end(), met.begin(), met.end());
                               });
  return {std::move(batch.offsets), std::move(batch.answers), batch.counts};
}

namespace {

/// ask(query, primitive) -> bool
template <class Primitive, class Ask>
std::vector<bool> truths(const QueryIndex& index, std::span<const Primitive> primitives, const BatchOptions& options,
                         Ask ask) {
  const auto batch = ask_all<char>(index, primitives, options,
                                   [&](MeshQuery& query, const Primitive& primitive, std::vector<char>& answers) {
                                     answers.push_back(ask(query, primitive));
                                   });
  return {batch.answers.begin(), batch.answers.end()};
}

}  // namespace

std::vector<bool> crosses(const QueryIndex& index, std::span<const Segment> segments, const BatchOptions& options) {
  return truths(index, segments, options, [](MeshQuery& query, const Segment& s) { return query.crosses(s); });
}

std::vector<bool> crosses(const QueryIndex& index, std::span<const Ray> rays, const BatchOptions& options) {
  return truths(index, rays, options, [](MeshQuery& query, const Ray& ray) { return query.crosses(ray); });
}

std::vector<bool> contains(const QueryIndex& index, std::span<const Vec3> points, const BatchOptions& options) {
  QueryAccess::require_closed(index);
  return truths(index, points, options, [](MeshQuery& query, const Vec3& point) { return query.contains(point); });
}

std::vector<std::optional<ClosestPoint>> closest_points(const QueryIndex& index, std::span<const Vec3> points,
                                                        double max_distance, const BatchOptions& options) {
  require_distance(max_distance);
  using Closest = std::optional<ClosestPoint>;
  return ask_all<Closest>(index, points, options,
                          [&](MeshQuery& query, const Vec3& point, std::vector<Closest>& answers) {
                            answers.push_back(query.closest_point(point, max_distance));
                          })
      .answers;
}

std::vector<ClosestPoint> signed_distances(const QueryIndex& index, std::span<const Vec3> points,
                                           const BatchOptions& options) {
  QueryAccess::require_closed(index);
  return ask_all<ClosestPoint>(index, points, options,
                               [](MeshQuery& query, const Vec3& point, std::vector<ClosestPoint>& answers) {
                                 answers.push_back(query.signed_distance(point));
                               })
      .answers;
}

}  // namespace prohull

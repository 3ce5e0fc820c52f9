#include "prohull/mesh_query.h"

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "parallel/arena.h"
#include "parallel/progress_meter.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "query/engine.h"
#include "query/refinement_engine.h"

namespace prohull {
namespace {

constexpr std::array<std::pair<std::string_view, Engine>, 5> kEngineNames{
    {{"auto", Engine::Auto},
     {"bvh", Engine::Bvh},
     {"refinement", Engine::Refinement},
     {"paper-refinement", Engine::PaperRefinement},
     {"brute", Engine::Brute}}};

constexpr std::array<std::pair<std::string_view, HitMode>, 3> kHitModeNames{
    {{"first", HitMode::First}, {"any", HitMode::Any}, {"all", HitMode::All}}};

}  // namespace

Names<Engine> engine_names() { return kEngineNames; }

Names<HitMode> hit_mode_names() { return kHitModeNames; }

struct QueryIndex::Shared {
  TriangleMesh mesh;
  std::string_view engine_name;
  std::unique_ptr<QueryEngine> engine;  ///< refers to `mesh`

  /// Throws InputError if the mesh is not closed.
  void require_closed() const {
    std::call_once(closed_is_known_, [&] { is_closed_ = is_closed(mesh); });
    if (!is_closed_)
      throw InputError(Defect::OpenEdge, "the mesh is not closed, so that it has no inside; close it first");
  }

 private:
  mutable std::once_flag closed_is_known_;
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
  using MakeEngine = std::unique_ptr<QueryEngine> (*)(const TriangleMesh&);

  static QueryIndex index(TriangleMesh mesh, std::string_view engine_name, MakeEngine make_engine) {
    require_finite(mesh);
    auto shared = std::make_shared<QueryIndex::Shared>();
    shared->mesh = std::move(mesh);
    shared->engine_name = engine_name;
    shared->engine = make_engine(shared->mesh);
    return QueryIndex(std::move(shared));
  }

  static QueryIndex index(const ProgressiveHull& hull, Engine engine, const RefinementOptions& options) {
    if (options.queries_per_roll_back < 1) throw InputError(Defect::InvalidOption, "queries per roll back: at least 1");
    auto shared = std::make_shared<QueryIndex::Shared>();
    shared->mesh = hull.original();
    shared->engine_name = name_of(engine_names(), engine);
    shared->engine = make_refinement_engine(
        hull, engine == Engine::Refinement ? Refine::WhereBoundsMeet : Refine::WhereFacesMeet, options);
    return QueryIndex(std::move(shared));
  }

  static void require_closed(const QueryIndex& index) { index.shared_->require_closed(); }

  /// Each chunk of a batch starts afresh, so that answers and counts are the same whatever thread had which before.
  static void start(MeshQuery& query);
};

namespace {

bool refines(Engine engine) { return engine == Engine::Refinement || engine == Engine::PaperRefinement; }

QueryIndex index_of(TriangleMesh mesh, Engine engine) {
  if (refines(engine))
    throw InputError(Defect::InvalidOption, "this engine refines a progressive hull, which a mesh is not");
  if (engine == Engine::Brute)
    return QueryAccess::index(std::move(mesh), name_of(engine_names(), engine), make_brute_engine);
  return QueryAccess::index(std::move(mesh), name_of(engine_names(), Engine::Bvh), make_bvh_engine);
}

}  // namespace

QueryIndex peer_index(TriangleMesh mesh, std::string_view name, QueryAccess::MakeEngine make_engine) {
  return QueryAccess::index(std::move(mesh), name, make_engine);
}

QueryIndex::QueryIndex(TriangleMesh mesh, Engine engine) : QueryIndex(index_of(std::move(mesh), engine)) {}

QueryIndex::QueryIndex(const ProgressiveHull& hull, Engine engine, const RefinementOptions& options)
    : QueryIndex(refines(engine) ? QueryAccess::index(hull, engine, options) : index_of(hull.original(), engine)) {}

std::string_view QueryIndex::engine_name() const { return shared_->engine_name; }

std::size_t QueryIndex::face_count() const { return shared_->mesh.face_count(); }

std::size_t QueryIndex::memory_bytes() const {
  const TriangleMesh& mesh = shared_->mesh;
  return sizeof(Shared) + mesh.vertex_count() * sizeof(Vec3) + mesh.face_count() * sizeof(mesh.triangles[FaceId{}]) +
         shared_->engine->memory_bytes();
}

struct MeshQuery::State {
  explicit State(QueryIndex i) : index(std::move(i)), worker(index.shared_->engine->worker()) {}

  HitCollector collected(const DirectedLine& line, HitMode mode) {
    HitCollector hits(index.shared_->mesh, line, mode);
    const bool is_a_point = line.end == line.origin && line.direction == Vec3{};
    if (!is_a_point) worker->collect(line, hits);
    return hits;
  }
  template <class Primitive>
  std::optional<Hit> one(const Primitive& primitive, HitMode mode) {
    const DirectedLine line(primitive);
    return collected(line, mode).best();
  }
  template <class Primitive>
  std::vector<Hit> all(const Primitive& primitive) {
    const DirectedLine line(primitive);
    return collected(line, HitMode::All).all();
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

std::vector<FaceId> MeshQuery::faces_met(const Triangle& triangle) {
  return state_->collected(triangle, HitMode::All).all();
}
bool MeshQuery::meets(const Triangle& triangle) { return state_->collected(triangle, HitMode::Any).any(); }

bool MeshQuery::contains(const Vec3& point) {
  QueryAccess::require_closed(state_->index);
  int winding = 0;
  for (const Hit& hit : all_hits(Ray{point, {1, 0, 0}})) winding += hit.entering ? -1 : 1;
  return winding > 0;
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

constexpr std::size_t kChunk = 512;
constexpr std::size_t kGlance = 8;  ///< queries between two looks at progress: each of them may take a while

/// ask(query, primitive) -> std::vector<Answer>, or something else with begin and end; take(first, Batch<Answer>) is
/// given the answers of each chunk.
template <class Answer, class Primitive, class Ask, class Take>
QueryCounts ask_in_chunks(const QueryIndex& index, std::span<const Primitive> primitives, const BatchOptions& options,
                          Ask ask, Take take) {
  for (std::size_t i = 0; i < primitives.size(); ++i)
    if (!is_finite(primitives[i]))
      throw InputError(Defect::NonFiniteCoordinate,
                       fmt::format("query {} has a coordinate that is not finite; remove it", i));
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
      for (const Primitive& primitive : chunk) {
        const auto answers = ask(query, primitive);
        batch.answers.insert(batch.answers.end(), answers.begin(), answers.end());
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

template <class Answer, class Primitive, class Ask>
Batch<Answer> ask_all(const QueryIndex& index, std::span<const Primitive> primitives, const BatchOptions& options,
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

/// What a batch asks of each segment or ray.
struct AskHits {
  HitMode mode;

  template <class Primitive>
  std::vector<Hit> operator()(MeshQuery& query, const Primitive& primitive) const {
    if (mode == HitMode::All) return query.all_hits(primitive);
    const auto hit = mode == HitMode::First ? query.first_hit(primitive) : query.any_hit(primitive);
    return hit ? std::vector{*hit} : std::vector<Hit>{};
  }
};

HitBatch hit_batch(Batch<Hit> batch) { return {std::move(batch.offsets), std::move(batch.answers), batch.counts}; }

template <class Primitive>
QueryCounts take_hits_of(const QueryIndex& index, std::span<const Primitive> primitives, HitMode mode,
                         const TakeHits& take, const BatchOptions& options) {
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
                               [](MeshQuery& query, const Triangle& triangle) { return query.faces_met(triangle); });
  return {std::move(batch.offsets), std::move(batch.answers), batch.counts};
}

std::vector<bool> contains(const QueryIndex& index, std::span<const Vec3> points, const BatchOptions& options) {
  QueryAccess::require_closed(index);
  const auto batch = ask_all<char>(index, points, options, [](MeshQuery& query, const Vec3& point) {
    return std::array{static_cast<char>(query.contains(point))};
  });
  return {batch.answers.begin(), batch.answers.end()};
}

}  // namespace prohull

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <random>

#include "command.h"
#include "io/file.h"
#include "machine.h"
#include "models.h"
#include "prohull/mesh_query.h"
#include "query_peers.h"
#include "segment_sets.h"
#include "subdivided.h"
#include "table.h"

namespace prohull::bench {
namespace {

struct RayOptions {
  ModelOptions models;
  std::vector<std::string> sets;  ///< none: all
  std::size_t segments = 1000000, aimed_segments = 100000, cgal_segments = 0, points = 100000;
  std::size_t rounds = 5;
  unsigned subdivide = 0;
  std::filesystem::path out;
};

constexpr std::uint64_t kSeed = 1;
constexpr std::string_view kOurs = "bvh", kEmbree = "Embree", kRobust = "Embree robust", kCgal = "CGAL AABB tree",
                           kPackets8 = "Embree robust, packets of 8", kPackets16 = "Embree robust, packets of 16";

/// Asks all queries of a set; returns how many hits there are, so that no compiler leaves the answers out.
struct RayContestant {
  std::string_view engine;
  std::size_t queries;
  std::function<std::size_t()> ask;
};

struct RayResult {
  std::string_view engine;
  std::size_t queries, hits;
  double ns;  ///< per query
};

/// What one set of queries is asked for.
struct Comparison {
  std::string set, ask;
  bool is_batch = false;
  std::vector<RayResult> results = {};

  double ns(std::string_view engine) const {
    const auto found = std::ranges::find(results, engine, &RayResult::engine);
    return found == results.end() ? kUnknown : found->ns;
  }
};

struct TreeFacts {
  std::string_view engine;
  double seconds, elapsed_seconds;  ///< of all threads; by the clock on the wall
  double bytes_per_face;            ///< beside the mesh
};

struct RayFacts {
  std::string name;
  std::size_t faces;
  std::vector<Comparison> comparisons = {};
  std::vector<TreeFacts> trees = {};
};

/// The contestants take turns, and the median of the rounds counts. A round before is not timed: it warms the caches.
std::vector<RayResult> compared(const std::vector<RayContestant>& contestants, std::size_t rounds) {
  std::vector<RayResult> results;
  for (const RayContestant& c : contestants) results.push_back({c.engine, c.queries, c.ask(), 0});
  std::vector<std::vector<double>> seconds(contestants.size());
  for (std::size_t round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < contestants.size(); ++i)
      seconds[i].push_back(seconds_of([&] { results[i].hits = contestants[i].ask(); }));
  for (std::size_t i = 0; i < contestants.size(); ++i)
    results[i].ns = 1e9 * median(seconds[i]) / static_cast<double>(contestants[i].queries);
  return results;
}

/// The sum of what `answer` gives for each.
template <class Query, class Answer>
std::size_t sum(std::span<const Query> queries, Answer answer) {
  std::size_t hits = 0;
  for (const Query& q : queries) hits += static_cast<std::size_t>(answer(q));
  return hits;
}

template <class Answer>
RayContestant one_by_one(std::string_view engine, std::span<const Segment> segments, Answer answer) {
  return {engine, segments.size(), [=] { return sum(segments, answer); }};
}

bool finds_any(MeshQuery& query, const Segment& s) { return query.any_hit(s).has_value(); }
bool finds_whether(MeshQuery& query, const Segment& s) { return query.crosses(s); }
bool finds_any(QueryPeer& peer, const Segment& s) { return peer.any_hit(s); }
bool finds_whether(QueryPeer& peer, const Segment& s) { return peer.any_hit(s); }

class ModelComparison {
 public:
  ModelComparison(const ModelSource& source, const RayOptions& options) : options_(options) {
    mesh_ = load(source);
    for (unsigned i = 0; i < options.subdivide; ++i) mesh_ = subdivided(mesh_);
    facts_ = {source.name, mesh_.face_count()};
    fmt::print(stderr, "{}: {} faces\n", facts_.name, facts_.faces);
  }

  RayFacts facts() {
    if (is_asked("trees")) compare_trees();
    index_ = std::make_unique<QueryIndex>(mesh_, Engine::Bvh);
    query_ = std::make_unique<MeshQuery>(*index_);
    if (auto embree = make_embree(mesh_, false)) peers_.push_back({kEmbree, std::move(embree)});
    if (auto embree = make_embree(mesh_, true)) peers_.push_back({kRobust, std::move(embree)});
    if (options_.cgal_segments > 0)
      if (auto cgal = make_cgal_tree(mesh_)) peers_.push_back({kCgal, std::move(cgal)});
    for (const SegmentSet& set : common_sets()) compare(set, options_.segments);
    for (const SegmentSet& set : aimed_sets()) compare(set, options_.aimed_segments);
    if (is_asked("points")) compare_contains();
    return std::move(facts_);
  }

 private:
  struct NamedPeer {
    std::string_view name;
    std::unique_ptr<QueryPeer> peer;
  };

  bool is_asked(std::string_view set) const {
    return options_.sets.empty() || std::ranges::find(options_.sets, set) != options_.sets.end();
  }

  void compare_trees() {
    const auto compare_tree = [&](std::string_view engine, const auto& build, std::size_t bytes) {
      std::vector<double> seconds, elapsed;
      for (std::size_t round = 0; round < options_.rounds; ++round) {
        seconds.push_back(seconds_of([&] { build(1); }));
        elapsed.push_back(elapsed_seconds_of([&] { build(0); }));
      }
      facts_.trees.push_back({engine, median(seconds), median(elapsed),
                              static_cast<double>(bytes) / static_cast<double>(mesh_.face_count())});
    };
    const std::size_t mesh_bytes =
        mesh_.vertex_count() * sizeof(Vec3) + mesh_.face_count() * sizeof(mesh_.triangles[FaceId{}]);
    compare_tree(
        kOurs, [&](unsigned) { QueryIndex(mesh_, Engine::Bvh); },
        QueryIndex(mesh_, Engine::Bvh).memory_bytes() - mesh_bytes);
    for (const bool robust : {false, true})
      if (const auto embree = make_embree(mesh_, robust))
        compare_tree(
            robust ? kRobust : kEmbree, [&](unsigned threads) { make_embree(mesh_, robust, threads); },
            embree->memory_bytes());
  }

  void compare(const SegmentSet& set, std::size_t count) {
    if (!is_asked(set.name)) return;
    fmt::print(stderr, "  {}\n", set.name);
    const std::vector<Segment> segments = set.make(mesh_, count, kSeed);
    compare_one_by_one(set, segments, "first",
                       [](auto& tree, const Segment& s) { return tree.first_hit(s).has_value(); });
    compare_one_by_one(set, segments, "any", [](auto& tree, const Segment& s) { return finds_any(tree, s); });
    compare_one_by_one(set, segments, "crosses", [](auto& tree, const Segment& s) { return finds_whether(tree, s); });
    compare_one_by_one(set, segments, "all", [](auto& tree, const Segment& s) { return tree.all_hits(s).size(); });
    compare_batches(set, segments);
  }

  template <class Answer>
  void compare_one_by_one(const SegmentSet& set, std::span<const Segment> segments, std::string_view ask,
                          Answer answer) {
    const std::vector<Segment> fewer = some(segments, options_.cgal_segments);
    std::vector<RayContestant> contestants{
        one_by_one(kOurs, segments, [&, answer](const Segment& s) { return answer(*query_, s); })};
    for (const NamedPeer& p : peers_)
      contestants.push_back(one_by_one(p.name, p.name == kCgal ? fewer : segments,
                                       [&tree = *p.peer, answer](const Segment& s) { return answer(tree, s); }));
    facts_.comparisons.push_back(
        {std::string(set.name), std::string(ask), false, compared(contestants, options_.rounds)});
  }

  /// From all parts of the list.
  static std::vector<Segment> some(std::span<const Segment> segments, std::size_t count) {
    std::vector<Segment> chosen;
    for (std::size_t i = 0; i < std::min(count, segments.size()); ++i)
      chosen.push_back(segments[i * segments.size() / count]);
    return chosen;
  }

  void compare_batches(const SegmentSet& set, std::span<const Segment> segments) {
    const BatchOptions one_thread{.threads = 1};
    std::vector<RayContestant> first{
        {kOurs, segments.size(), [&] { return find_hits(*index_, segments, HitMode::First, one_thread).hits.size(); }}};
    std::vector<RayContestant> crossing{{kOurs, segments.size(), [&] {
                                           const std::vector<bool> crossed = crosses(*index_, segments, one_thread);
                                           return static_cast<std::size_t>(std::ranges::count(crossed, true));
                                         }}};
    const auto robust = std::ranges::find(peers_, kRobust, &NamedPeer::name);
    std::unique_ptr<PeerPackets> packets[2];
    if (robust != peers_.end()) {
      QueryPeer& tree = *robust->peer;
      first.push_back(one_by_one(kRobust, segments, [&](const Segment& s) { return tree.first_hit(s).has_value(); }));
      crossing.push_back(one_by_one(kRobust, segments, [&](const Segment& s) { return tree.any_hit(s); }));
      for (const std::size_t i : {0, 1}) {
        packets[i] = tree.packets(segments, i == 0 ? 8 : 16, set.is_coherent);
        const std::string_view name = i == 0 ? kPackets8 : kPackets16;
        first.push_back({name, segments.size(), [&, i] { return packets[i]->first_hits(); }});
        crossing.push_back({name, segments.size(), [&, i] { return packets[i]->any_hits(); }});
      }
    }
    facts_.comparisons.push_back({std::string(set.name), "first", true, compared(first, options_.rounds)});
    facts_.comparisons.push_back({std::string(set.name), "crosses", true, compared(crossing, options_.rounds)});
  }

  void compare_contains() {
    fmt::print(stderr, "  points\n");
    std::mt19937_64 random(kSeed);
    const Box box = bounding_box(mesh_);
    std::vector<Vec3> points(options_.points);
    for (Vec3& p : points)
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = box.min[axis] + (box.max[axis] - box.min[axis]) * (static_cast<double>(random() >> 11) * 0x1p-53);
    const std::span<const Vec3> asked(points);
    std::vector<RayContestant> contestants{
        {kOurs, points.size(), [&] { return sum(asked, [&](const Vec3& p) { return query_->contains(p); }); }}};
    for (const NamedPeer& p : peers_)
      if (p.peer->contains(points[0]))
        contestants.push_back({p.name, points.size(), [&, &tree = *p.peer] {
                                 return sum(asked, [&](const Vec3& point) { return *tree.contains(point); });
                               }});
    facts_.comparisons.push_back({"points", "contains", false, compared(contestants, options_.rounds)});
    contestants[0].ask = [&] {
      const std::vector<bool> inside = contains(*index_, points, {.threads = 1});
      return static_cast<std::size_t>(std::ranges::count(inside, true));
    };
    facts_.comparisons.push_back({"points", "contains", true, compared(contestants, options_.rounds)});
  }

  const RayOptions& options_;
  TriangleMesh mesh_;
  RayFacts facts_;
  std::unique_ptr<QueryIndex> index_;
  std::unique_ptr<MeshQuery> query_;
  std::vector<NamedPeer> peers_;
};

std::string one_by_one_table(const std::vector<RayFacts>& models) {
  Table table({"model", "faces", "queries", "ask", "number", "bvh", "Embree", "Embree robust", "CGAL AABB tree",
               "bvh / Embree robust"});
  for (const RayFacts& m : models)
    for (const Comparison& c : m.comparisons)
      if (!c.is_batch)
        table.add({m.name, fmt::to_string(m.faces), c.set, c.ask, fmt::to_string(c.results[0].queries),
                   number(c.ns(kOurs), 0, " ns"), number(c.ns(kEmbree), 0, " ns"), number(c.ns(kRobust), 0, " ns"),
                   number(c.ns(kCgal), 0, " ns"), number(c.ns(kOurs) / c.ns(kRobust), 2)});
  return table.markdown();
}

std::string batches_table(const std::vector<RayFacts>& models) {
  Table table({"model", "faces", "queries", "ask", "bvh", "Embree robust", "packets of 8", "packets of 16",
               "bvh / fastest Embree"});
  for (const RayFacts& m : models)
    for (const Comparison& c : m.comparisons)
      if (c.is_batch)
        table.add({m.name, fmt::to_string(m.faces), c.set, c.ask, number(c.ns(kOurs), 0, " ns"),
                   number(c.ns(kRobust), 0, " ns"), number(c.ns(kPackets8), 0, " ns"),
                   number(c.ns(kPackets16), 0, " ns"),
                   number(c.ns(kOurs) / std::min({c.ns(kRobust), c.ns(kPackets8), c.ns(kPackets16)}), 2)});
  return table.markdown();
}

std::string trees_table(const std::vector<RayFacts>& models) {
  Table table({"model", "faces", "tree", "build", "elapsed, all cores", "bytes per face"});
  for (const RayFacts& m : models)
    for (const TreeFacts& t : m.trees)
      table.add({m.name, fmt::to_string(m.faces), std::string(t.engine), number(t.seconds, 3, " s"),
                 number(t.elapsed_seconds, 3, " s"), number(t.bytes_per_face, 1)});
  return table.markdown();
}

std::string rays_csv(const std::vector<RayFacts>& models) {
  Table table({"mesh", "faces", "set", "ask", "how", "engine", "queries", "hits", "query_ns"});
  for (const RayFacts& m : models)
    for (const Comparison& c : m.comparisons)
      for (const RayResult& r : c.results)
        table.add({m.name, fmt::to_string(m.faces), c.set, c.ask, c.is_batch ? "batch" : "one by one",
                   as_cell(std::string(r.engine)), fmt::to_string(r.queries), fmt::to_string(r.hits), number(r.ns, 1)});
  return table.csv();
}

std::string trees_csv(const std::vector<RayFacts>& models) {
  Table table({"mesh", "faces", "engine", "build_seconds", "elapsed_seconds", "bytes_per_face"});
  for (const RayFacts& m : models)
    for (const TreeFacts& t : m.trees)
      table.add({m.name, fmt::to_string(m.faces), std::string(t.engine), number(t.seconds, 4),
                 number(t.elapsed_seconds, 4), number(t.bytes_per_face, 2)});
  return table.csv();
}

int run_rays(const RayOptions& options) {
  std::vector<RayFacts> models;
  measure_each(options.models, [&](const ModelSource& source) {
    RayOptions mine = options;
    if (source.is_record_sample)  // it is measured by a test
      mine.segments = mine.aimed_segments = mine.points = 1000;
    models.push_back(ModelComparison(source, mine).facts());
  });
  publish(
      options.out, "rays",
      fmt::format("# Rays and points\n\n{}; time per query: processor time of one thread, warm, median of {} rounds "
                  "in turns.\n\n## One by one\n\n{}\n## In batches\n\n{}\n## Trees\n\n{}",
                  machine(), options.rounds, one_by_one_table(models), batches_table(models), trees_table(models)),
      rays_csv(models));
  if (!options.out.empty()) write_file(options.out / "ray_trees.csv", trees_csv(models));
  return kDone;
}

}  // namespace

void add_rays(CLI::App& app, Run& run) {
  const auto options = std::make_shared<RayOptions>();
  CLI::App& command = *app.add_subcommand("rays", "Time of segments and points, beside Embree and CGAL's tree");
  add_model_options(command, options->models);
  std::vector<std::string> names{"points", "trees"};
  for (const auto& sets : {common_sets(), aimed_sets()})
    for (const SegmentSet& set : sets) names.emplace_back(set.name);
  command.add_option("--sets", options->sets, "Measure only these: queries, or the building of trees [all]")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  command.add_option("--segments", options->segments, "Of each common set")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--aimed", options->aimed_segments, "Segments of each set aimed at vertices and edges")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--points", options->points, "That are asked for containment")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--cgal", options->cgal_segments, "Segments of each set that CGAL's tree is asked")
      ->capture_default_str();
  command.add_option("--subdivide", options->subdivide, "Split every face of the meshes into four, this many times");
  command.add_option("--rounds", options->rounds, "Of which the median counts")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_out_option(command, options->out, "rays.md, rays.csv and ray_trees.csv");
  command.callback([options, &run] { run = [options] { return run_rays(*options); }; });
}

}  // namespace prohull::bench

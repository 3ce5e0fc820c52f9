#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "command.h"
#include "exact_reference.h"
#include "machine.h"
#include "models.h"
#include "prohull/enclosure.h"
#include "prohull/mesh_query.h"
#include "query_peers.h"
#include "segment_sets.h"
#include "table.h"

namespace prohull::bench {
namespace {

struct AimedOptions {
  ModelOptions models;
  std::vector<std::string> variants;  ///< none: all
  std::size_t count = 100000;
  std::filesystem::path out;
};

// What is done to the meshes.

TriangleMesh unchanged(TriangleMesh mesh) { return mesh; }

/// About z, then about x: no coordinate keeps its place.
TriangleMesh rotated(TriangleMesh mesh) {
  for (Vec3& p : mesh.positions) p = {-p.y, -p.z, p.x};
  return mesh;
}

TriangleMesh far_away(TriangleMesh mesh) {
  const double offset = 0x1p20 * bounding_box(mesh).diagonal();
  for (Vec3& p : mesh.positions) p += {offset, offset, offset};
  return mesh;
}

/// Every face in two and a sliver, at the rounded middle of its first edge.
TriangleMesh with_slivers(TriangleMesh mesh) {
  TriangleMesh result;
  result.positions = std::move(mesh.positions);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 &p = result.positions[a], &q = result.positions[b];
    const VertexId middle = result.positions.push_back(p * 0.5 + q * 0.5);
    for (const std::array<VertexId, 3>& t : {std::array{a, middle, c}, {middle, b, c}, {a, b, middle}})
      result.triangles.push_back(t);
  }
  return result;
}

/// The mesh, and a copy that is moved by a sixteenth of the diagonal.
TriangleMesh overlapping_itself(TriangleMesh mesh) {
  TriangleMesh result = mesh;
  const double shift = bounding_box(mesh).diagonal() / 16;
  const auto count = static_cast<std::uint32_t>(mesh.vertex_count());
  for (const Vec3& p : mesh.positions) result.positions.push_back(p + Vec3{shift, shift / 2, shift / 4});
  for (const auto& [a, b, c] : mesh.triangles)
    result.triangles.push_back({VertexId(index(a) + count), VertexId(index(b) + count), VertexId(index(c) + count)});
  return result;
}

struct AimedVariant {
  std::string_view name;
  TriangleMesh (*of)(TriangleMesh);
  double scale = 1;             ///< of mesh and segments, afterwards
  bool has_flat_faces = false;  ///< exactly flat
};
constexpr std::array kVariants{
    AimedVariant{"as it is", unchanged},
    AimedVariant{"rotated", rotated},
    AimedVariant{"times 2^-300", unchanged, 0x1p-300},
    AimedVariant{"times 2^300", unchanged, 0x1p300},
    AimedVariant{"far away", far_away},
    AimedVariant{"slivers", with_slivers, 1, true},
    AimedVariant{"overlapping", overlapping_itself},
};

// What is wrong.

constexpr double kNear = 1e-5;

using Truth = std::vector<ExactCrossing>;

struct Counts {
  std::size_t first = 0, any = 0, all = 0, parity = 0;

  Counts& operator+=(const Counts& other) {
    first += other.first, any += other.any, all += other.all, parity += other.parity;
    return *this;
  }
};

/// Whether `hit` is among the crossings at that place.
bool is_at(const Hit& hit, std::size_t place, const Truth& truth) {
  return std::ranges::any_of(truth, [&](const ExactCrossing& c) {
    return c.place == place && c.face == hit.face && c.entering == hit.entering;
  });
}

bool is_first(std::span<const Hit> found, const Truth& truth) {
  return found.size() == (truth.empty() ? 0 : 1) && (truth.empty() || is_at(found[0], 0, truth));
}

bool is_any(std::span<const Hit> found, const Truth& truth) {
  return found.size() == (truth.empty() ? 0 : 1) &&
         (truth.empty() || std::ranges::any_of(truth, [&](const auto& c) { return is_at(found[0], c.place, truth); }));
}

bool are_all(std::span<const Hit> found, const Truth& truth) {
  if (found.size() != truth.size()) return false;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto again = [&](const Hit& h) { return h.face == found[i].face; };
    if (!is_at(found[i], truth[i].place, truth) || std::ranges::any_of(found.first(i), again)) return false;
  }
  return true;
}

struct Case {
  std::string model;
  std::string_view variant, set;
  const TriangleMesh& mesh;
  Box box;
  bool intersects_itself;
  std::vector<Segment> segments;
  std::vector<Truth> truth;

  bool is_outside(const Vec3& p) const {
    Box point;
    point.extend(p);
    return !box.overlaps(point);
  }
  bool ends_outside(const Segment& s) const { return is_outside(s.a) && is_outside(s.b); }
};

/// Whether hits of a closed mesh enter and leave as often as they must, in turn if the mesh does not intersect itself.
bool is_balanced(std::span<const Hit> hits, const Segment& segment, const Case& c) {
  const auto entering = std::ranges::count(hits, true, &Hit::entering);
  if (c.ends_outside(segment) && 2 * entering != std::ssize(hits)) return false;
  if (c.intersects_itself) return true;
  if (!hits.empty() && c.is_outside(segment.a) && !hits[0].entering) return false;
  return std::ranges::adjacent_find(hits, {}, &Hit::entering) == hits.end();
}

Counts wrong_of_bvh(const Case& c) {
  const QueryIndex index(c.mesh, Engine::Bvh);
  const HitBatch first = find_hits(index, c.segments, HitMode::First), any = find_hits(index, c.segments, HitMode::Any),
                 all = find_hits(index, c.segments, HitMode::All);
  const std::vector<bool> crossed = crosses(index, c.segments);
  const auto of = [](const HitBatch& batch, std::size_t i) {
    return std::span(batch.hits).subspan(batch.offsets[i], batch.offsets[i + 1] - batch.offsets[i]);
  };
  Counts wrong;
  for (std::size_t i = 0; i < c.segments.size(); ++i) {
    const Truth& truth = c.truth[i];
    wrong.first += !is_first(of(first, i), truth);
    wrong.any += !is_any(of(any, i), truth) || crossed[i] == truth.empty();
    wrong.all += !are_all(of(all, i), truth);
    wrong.parity += !is_balanced(of(all, i), c.segments[i], c);
  }
  return wrong;
}

// Peers may count what is touched at the ends, so only crossings in between are compared, by t.
Counts wrong_of(QueryPeer& peer, const Case& c) {
  const auto is_between = [](const auto& hit) { return hit.t > kNear && hit.t < 1 - kNear; };
  Counts wrong;
  for (std::size_t i = 0; i < c.segments.size(); ++i) {
    const auto first = std::ranges::find_if(c.truth[i], is_between);
    const double true_t = first == c.truth[i].end() ? 1 : first->t;
    const auto found = peer.first_hit(c.segments[i]);
    wrong.first += (!found || found->t > kNear) && !(std::abs((found ? found->t : 1) - true_t) <= 2 * kNear);
    wrong.any += first != c.truth[i].end() && !peer.any_hit(c.segments[i]);
    const auto all = peer.all_hits(c.segments[i]);
    wrong.all += std::ranges::count_if(all, is_between) != std::ranges::count_if(c.truth[i], is_between);
    wrong.parity += c.ends_outside(c.segments[i]) && all.size() % 2 != 0;
  }
  return wrong;
}

struct EngineFacts {
  std::string_view engine;
  Counts wrong;
};

struct CaseFacts {
  std::string model;
  std::string_view variant, set;
  std::size_t faces, segments, crossings = 0;
  bool intersects_itself;
  std::vector<EngineFacts> engines = {};
};

constexpr std::string_view kOurs = "bvh", kEmbree = "Embree", kRobust = "Embree robust", kCgal = "CGAL AABB tree";

CaseFacts checked(const Case& c, std::span<const std::pair<std::string_view, std::unique_ptr<QueryPeer>>> peers) {
  CaseFacts facts{.model = c.model,
                  .variant = c.variant,
                  .set = c.set,
                  .faces = c.mesh.face_count(),
                  .segments = c.segments.size(),
                  .intersects_itself = c.intersects_itself};
  for (const Truth& truth : c.truth) facts.crossings += truth.size();
  facts.engines.push_back({kOurs, wrong_of_bvh(c)});
  for (const auto& [name, peer] : peers)
    if (peer) facts.engines.push_back({name, wrong_of(*peer, c)});
  return facts;
}

void check_variant(const std::string& model, const TriangleMesh& original, const AimedVariant& variant,
                   std::size_t count, std::vector<CaseFacts>& facts) {
  const TriangleMesh mesh = variant.of(original);
  TriangleMesh scaled = mesh;
  for (Vec3& p : scaled.positions) p = p * variant.scale;
  const ExactReference reference(scaled);
  const bool intersects_itself = count_self_intersections(mesh) > 0;
  std::vector<std::pair<std::string_view, std::unique_ptr<QueryPeer>>> peers;
  if (variant.scale == 1) {  // float32 holds no others
    peers.emplace_back(kEmbree, make_embree(mesh, false));
    peers.emplace_back(kRobust, make_embree(mesh, true));
    if (!variant.has_flat_faces) peers.emplace_back(kCgal, make_cgal_tree(mesh));  // it may not have them
  }
  for (const SegmentSet& set : aimed_sets()) {
    std::vector<Segment> segments = set.make(mesh, count, 1);
    for (Segment& s : segments) s = {s.a * variant.scale, s.b * variant.scale};
    auto truth = reference.crossings(segments);
    facts.push_back(checked({model, variant.name, set.name, scaled, bounding_box(scaled), intersects_itself,
                             std::move(segments), std::move(truth)},
                            peers));
    fmt::print(stderr, "  {}, {}\n", variant.name, set.name);
  }
}

/// Of all cases; nothing if the engine was not asked.
std::optional<Counts> total(std::span<const CaseFacts> cases, std::string_view engine) {
  std::optional<Counts> sum;
  for (const CaseFacts& f : cases)
    for (const EngineFacts& e : f.engines)
      if (e.engine == engine) (sum ? *sum : sum.emplace()) += e.wrong;
  return sum;
}

std::string summary(const std::vector<CaseFacts>& facts) {
  Table table({"model", "variant", "segments", "crossings", "bvh: wrong first", "any", "all", "parity",
               "Embree: wrong first", "all", "odd", "Embree robust: wrong first", "all", "odd", "CGAL: wrong first",
               "all", "odd"});
  for (auto next = facts.begin(); next != facts.end();) {
    const CaseFacts& f = *next;
    const auto is_other = [&](const CaseFacts& g) { return g.model != f.model || g.variant != f.variant; };
    const std::span sets(next, std::find_if(next, facts.end(), is_other));
    next += std::ssize(sets);
    std::size_t segments = 0, crossings = 0;
    for (const CaseFacts& set : sets) segments += set.segments, crossings += set.crossings;
    std::vector<std::string> row{f.model, std::string(f.variant), fmt::to_string(segments), fmt::to_string(crossings)};
    for (const std::string_view engine : {kOurs, kEmbree, kRobust, kCgal}) {
      const std::optional<Counts> wrong = total(sets, engine);
      for (const auto count : {&Counts::first, &Counts::any, &Counts::all, &Counts::parity})
        if (engine == kOurs || count != &Counts::any) row.push_back(wrong ? fmt::to_string((*wrong).*count) : "");
    }
    table.add(std::move(row));
  }
  return table.markdown();
}

std::string csv(const std::vector<CaseFacts>& facts) {
  Table table({"mesh", "faces", "intersects_itself", "variant", "set", "segments", "crossings", "engine", "wrong_first",
               "wrong_any", "wrong_all", "wrong_parity"});
  for (const CaseFacts& f : facts)
    for (const auto& [engine, wrong] : f.engines)
      table.add({f.model, fmt::to_string(f.faces), f.intersects_itself ? "yes" : "no", std::string(f.variant),
                 std::string(f.set), fmt::to_string(f.segments), fmt::to_string(f.crossings), std::string(engine),
                 fmt::to_string(wrong.first), fmt::to_string(wrong.any), fmt::to_string(wrong.all),
                 fmt::to_string(wrong.parity)});
  return table.csv();
}

int run_aimed(const AimedOptions& options) {
  std::vector<CaseFacts> facts;
  measure_each(options.models, [&](const ModelSource& source) {
    const TriangleMesh mesh = load(source);
    fmt::print(stderr, "{}: {} faces\n", source.name, mesh.face_count());
    const std::size_t count = source.is_record_sample ? std::min<std::size_t>(options.count, 1000) : options.count;
    for (const AimedVariant& variant : kVariants)
      if (options.variants.empty() || std::ranges::find(options.variants, variant.name) != options.variants.end())
        check_variant(source.name, mesh, variant, count, facts);
  });
  publish(
      options.out, "aimed",
      fmt::format(
          "# Segments aimed at vertices and edges\n\n{}; {} segments of each of {} sets: to a vertex, past "
          "one, to an edge, along an axis\nthrough a vertex, from vertex to vertex. Wrong against an exact reference; "
          "of peers, crossings near the ends do not count.\nparity: hits that do not enter and leave as "
          "they must; odd: segments between points outside with an odd number of hits.\n\n{}",
          machine(), options.count, aimed_sets().size(), summary(facts)),
      csv(facts));
  const bool is_right = std::ranges::all_of(facts, [](const CaseFacts& f) {
    const Counts& wrong = f.engines[0].wrong;
    return wrong.first + wrong.any + wrong.all + wrong.parity == 0;
  });
  return is_right ? kDone : kAnswerIsNo;
}

}  // namespace

void add_aimed(CLI::App& app, Run& run) {
  const auto options = std::make_shared<AimedOptions>();
  CLI::App& command = *app.add_subcommand("aimed", "Wrong answers to segments aimed exactly at vertices and edges");
  add_model_options(command, options->models);
  std::vector<std::string> names;
  for (const AimedVariant& variant : kVariants) names.emplace_back(variant.name);
  command.add_option("--variants", options->variants, "What is done to the meshes [all]")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  command.add_option("--count", options->count, "Segments of each set")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_out_option(command, options->out, "aimed.md and aimed.csv");
  command.callback([options, &run] { run = [options] { return run_aimed(*options); }; });
}

}  // namespace prohull::bench

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <random>

#include "command.h"
#include "machine.h"
#include "models.h"
#include "paper/engines.h"
#include "prohull/detail/random_segments.h"
#include "prohull/mesh_query.h"
#include "query_peers.h"
#include "query_section.h"
#include "strategies.h"
#include "subdivided.h"
#include "table.h"

namespace prohull::bench {
namespace {

// What an outer and an inner hull are worth to queries of the mesh: walks and filters against trees over the mesh.

struct QueryFiltersOptions {
  ModelOptions models{.folder = {}, .samples = {"pony"}, .sample_faces = 97000};
  std::size_t hull_faces = 2000, subdivisions = 0, segments = 100000, rounds = 3;
  std::filesystem::path out;
};

/// From the sides of a box twice as large to points of faces, and beyond by as much.
std::vector<Segment> aimed(const TriangleMesh& mesh, std::size_t count) {
  std::vector<Segment> segments = random_segments(bounding_box(mesh), count, 2);
  std::mt19937_64 random(3);
  for (Segment& s : segments) {
    const Triangle t = mesh.triangle(FaceId(static_cast<std::uint32_t>(random() % mesh.face_count())));
    s.b = (t.a + t.b + t.c) / 3;
    s.b = s.a + 2 * (s.b - s.a);
  }
  return segments;
}

/// The pixels of a square picture, from the side of the mesh, row by row; each goes beyond the mesh.
std::vector<Segment> camera(const TriangleMesh& mesh, std::size_t count) {
  const Box box = bounding_box(mesh);
  const double size = box.diagonal();
  const Vec3 eye = box.center() + Vec3{1.5 * size, 0.4 * size, 0.2 * size}, away = box.center() - eye;
  const Vec3 right = cross(away, {0, 0, 1}) / norm(cross(away, {0, 0, 1})), up = cross(right, away) / norm(away);
  const auto pixels = static_cast<std::size_t>(std::sqrt(static_cast<double>(count)));
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t j = 0; j < pixels; ++j) {
      const auto across = [&](std::size_t k) {
        return size * ((static_cast<double>(k) + 0.5) / static_cast<double>(pixels) - 0.5);
      };
      segments.push_back({eye, eye + 2 * (away + across(j) * right - across(i) * up)});
    }
  return segments;
}

struct Batch {
  const char* name;
  std::vector<Segment> segments;
};

struct FilterContestant {
  std::string engine, query;
  std::size_t bytes;  ///< of the index; 0: not known
  std::function<std::size_t(const Segment&)> ask;
};

void add_ours(std::vector<FilterContestant>& all, const QueryIndex& index) {
  const std::string engine(index.engine_name());
  const auto query = std::make_shared<MeshQuery>(index);
  const std::size_t bytes = index.memory_bytes();
  all.push_back({engine, "crosses", bytes, [query](const Segment& s) { return std::size_t{query->crosses(s)}; }});
  if (engine == "filter") return;  // hits are those of bvh
  all.push_back(
      {engine, "first", bytes, [query](const Segment& s) { return std::size_t{query->first_hit(s).has_value()}; }});
  all.push_back({engine, "all", bytes, [query](const Segment& s) { return query->all_hits(s).size(); }});
}

std::vector<FilterContestant> contestants(const TriangleMesh& mesh, const QueryFiltersOptions& options) {
  const HullOptions outer_options = hull_options(Strategy::Lazy, options.hull_faces);
  HullOptions inner_options = outer_options;
  inner_options.side = HullSide::Inner;
  const ProgressiveHull outer = build_hull(mesh, outer_options).hull, inner = build_hull(mesh, inner_options).hull;
  std::vector<FilterContestant> all;
  add_ours(all, QueryIndex(mesh));
  add_ours(all, QueryIndex(outer, inner, Engine::Filter));
  add_ours(all, prohull::index_called("walk", outer, inner));
  if (const std::shared_ptr<QueryPeer> embree = make_embree(mesh, true))
    all.push_back(
        {"Embree robust", "crosses", 0, [embree](const Segment& s) { return std::size_t{embree->any_hit(s)}; }});
  constexpr std::size_t kMostForCgal = 1000000;
  if (mesh.face_count() < kMostForCgal)
    if (const std::shared_ptr<QueryPeer> cgal = make_cgal_tree(mesh))
      all.push_back({"CGAL", "all", 0, [cgal](const Segment& s) { return cgal->all_hits(s).size(); }});
  return all;
}

void measure(const std::string& name, const TriangleMesh& mesh, const QueryFiltersOptions& options, Table& table) {
  const std::vector<FilterContestant> all = contestants(mesh, options);
  const Batch batches[] = {{"box", random_segments(bounding_box(mesh), options.segments, 1)},
                           {"aimed", aimed(mesh, options.segments)},
                           {"camera", camera(mesh, options.segments)}};
  for (const auto& [batch, segments] : batches) {
    std::vector<std::size_t> found(all.size());
    std::vector<std::function<void()>> work;
    for (std::size_t i = 0; i < all.size(); ++i)
      work.emplace_back([&, i, &asked = segments] {
        found[i] = 0;
        for (const Segment& s : asked) found[i] += all[i].ask(s);
      });
    const std::vector<double> seconds = best_seconds(options.rounds, work);
    for (std::size_t i = 0; i < all.size(); ++i)
      table.add(
          {name, fmt::to_string(mesh.face_count()), batch, all[i].engine, all[i].query,
           fmt::format("{:.0f}", 1e9 * seconds[i] / static_cast<double>(segments.size())), fmt::to_string(found[i]),
           all[i].bytes == 0
               ? ""
               : fmt::format("{:.0f}", static_cast<double>(all[i].bytes) / static_cast<double>(mesh.face_count()))});
  }
}

int run_filters(const QueryFiltersOptions& options) {
  Table table({"mesh", "faces", "segments", "engine", "query", "ns_per_segment", "found", "bytes_per_face"});
  for (const ModelSource& source : model_sources(options.models)) {
    TriangleMesh mesh = load(source);
    for (std::size_t level = 0; level <= options.subdivisions; ++level) {
      if (level > 0) mesh = subdivided(mesh);
      if (level > 0 && level < options.subdivisions) continue;
      fmt::print(stderr, "{}: {} faces\n", source.name, mesh.face_count());
      measure(source.name, mesh, options, table);
    }
  }
  const std::string text = fmt::format(
      "# Queries by an outer and an inner hull of {} faces\n\n{}; processor time of one thread, best of {}\n\n{}",
      options.hull_faces, machine(), options.rounds, table.markdown());
  publish(options.out, "filters", text, table.csv());
  return kDone;
}

}  // namespace

void add_filters(CLI::App& app, Run& run) {
  const auto options = std::make_shared<QueryFiltersOptions>();
  CLI::App& command = *app.add_subcommand("filters", "Queries that an outer and an inner hull help with");
  add_model_options(command, options->models);
  add_faces_option(command, options->hull_faces);
  command.add_option("--segments", options->segments, "Of each batch")->check(CLI::PositiveNumber);
  command
      .add_option("--subdivisions", options->subdivisions, "Also a mesh subdivided so often, to four times the faces")
      ->check(CLI::Range(0, 8))
      ->capture_default_str();
  add_rounds_option(command, options->rounds);
  add_out_option(command, options->out, "filters.md and filters.csv");
  command.callback([options, &run] { run = [options] { return run_filters(*options); }; });
}

}  // namespace prohull::bench

#include "paper/engines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "paper/kdop_index.h"
#include "paper/refinement_engine.h"
#include "paper/walk_engine.h"
#include "prohull/detail/refuse.h"
#include "query/engine.h"

namespace prohull {
namespace {

constexpr std::string_view kRefinement = "refinement", kPaperRefinement = "paper-refinement", kWalk = "walk";

bool refines(std::string_view engine) { return engine == kRefinement || engine == kPaperRefinement; }

Engine of_library(std::string_view engine) {
  if (const auto known = value_of(engine_names(), engine)) return *known;
  refuse(fmt::format("engine='{}': expected one of {}", engine, fmt::join(all_engine_names(), ", ")));
}

bool is_kdop(std::string_view engine) { return std::ranges::count(kdop_names(), engine) > 0; }

}  // namespace

std::span<const std::string_view> all_engine_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const auto& [name, engine] : engine_names()) all.push_back(name);
    all.insert(all.end(), {kRefinement, kPaperRefinement, kWalk});
    all.insert(all.end(), kdop_names().begin(), kdop_names().end());
    return all;
  }();
  return names;
}

std::span<const std::string_view> hull_engine_names() {
  return all_engine_names().first(all_engine_names().size() - kdop_names().size());
}

bool may_miss_hits(std::string_view engine, bool with_inner) {
  return engine == kPaperRefinement || (engine == kWalk && !with_inner);
}

QueryIndex index_called(std::string_view engine, TriangleMesh mesh) {
  if (refines(engine) || engine == kWalk) refuse("this engine needs a progressive hull, which a mesh is not");
  if (is_kdop(engine)) return kdop_index(std::move(mesh), engine);
  return QueryIndex(std::move(mesh), of_library(engine));
}

QueryIndex index_called(std::string_view engine, const ProgressiveHull& hull, const RefinementOptions& options) {
  if (options.queries_per_roll_back < 1) refuse("queries per roll back: at least 1");
  if (refines(engine)) {
    const bool is_published = engine == kPaperRefinement;
    return peer_index(hull.original(), is_published ? kPaperRefinement : kRefinement, [&](const TriangleMesh&) {
      return make_refinement_engine(hull, is_published ? Refine::WhereFacesMeet : Refine::WhereBoundsMeet, options);
    });
  }
  if (engine == kWalk) {
    if (hull.side() != HullSide::Outer) refuse("the engine walk needs an outer hull");
    return peer_index(hull.original(), kWalk,
                      [&](const TriangleMesh& mesh) { return make_walk_engine(mesh, hull, nullptr); });
  }
  if (is_kdop(engine)) return kdop_index(hull.original(), engine);
  return QueryIndex(hull, of_library(engine));
}

QueryIndex index_called(std::string_view engine, const ProgressiveHull& outer, const ProgressiveHull& inner) {
  if (value_of(engine_names(), engine)) return QueryIndex(outer, inner, of_library(engine));
  TriangleMesh original = original_of(outer, inner);
  if (engine != kWalk) return index_called(engine, outer);
  return peer_index(std::move(original), kWalk,
                    [&](const TriangleMesh& mesh) { return make_walk_engine(mesh, outer, &inner); });
}

}  // namespace prohull

// What the page teach.html asks for beside what index.d.ts lists (view/web/teach): the paper's figures.
#include <emscripten/bind.h>

#include "calls.h"
#include "levels.h"
#include "paper/collapse_study.h"
#include "paper/engines.h"
#include "paper/refine_along.h"
#include "prohull/hull_builder.h"

namespace prohull::js {
namespace {

std::size_t whole_of(double number, const std::string& name) {
  check_whole(number, name, 0);
  return static_cast<std::size_t>(number);
}

std::vector<double> so_many_numbers_of(const val& array, const std::string& name, std::size_t count) {
  std::vector<double> numbers = numbers_of(array, name);
  if (numbers.size() != count)
    throw InputError(Defect::InvalidOption, name + ": expected " + std::to_string(count) + " numbers");
  return numbers;
}

Segment segment_of(const val& array) {
  const auto n = so_many_numbers_of(array, "segment", 6);
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
}

/// The queue is the heap, which orders edges as the paper says.
HullOptions paper_options(const val& given) {
  return options_of(given, val::undefined(), [](const Given& named) {
    HullOptions read{.strategy = Strategy::Paper1, .queue = QueueKind::Heap};
    named.count("target_faces", read.target_faces, 4);
    named.choice("side", hull_side_names(), read.side);
    named.choice("strategy", strategy_names(), read.strategy);
    return read;
  });
}

/// The levels of a hull, and how many linear programs they took.
val record_of_hull(const val& mesh, const val& given) {
  const HullResult result = build_hull(mesh_of(mesh, "mesh"), paper_options(given));
  val object = object_of_levels(result.hull);
  object.set("linearPrograms", result.linear_programs);
  return object;
}

/// `place` has three numbers, or is null: that of the collapse.
val collapse_of(const val& levels, double i, const val& place) {
  std::optional<Vec3> at;
  if (!place.isNull()) {
    const auto n = so_many_numbers_of(place, "place", 3);
    at = {n[0], n[1], n[2]};
  }
  const StudiedCollapse study = study_collapse(levels_of(levels), whole_of(i, "collapse"), at);
  val object = val::object();
  object.set("star", object_of_mesh(study.star));
  object.set("made", array_of(study.made));
  object.set("optimum", array_of(study.optimum));
  object.set("optimalVolume", study.optimal_volume);
  object.set("steepest", array_of(study.steepest));
  object.set("sides", array_of(study.sides.data(), study.sides.size()));
  object.set("addedVolume", study.added_volume);
  return object;
}

/// Of each edge its two ends, its priority, why it is refused, and whether it was renewed.
val queue_of(const val& levels, double i, const val& given) {
  std::vector<std::uint32_t> ends;
  std::vector<double> priorities;
  std::vector<std::string> refusals;
  std::vector<std::uint8_t> renewed;
  for (const QueuedEdge& edge : queue_before(levels_of(levels), whole_of(i, "collapse"), paper_options(given))) {
    ends.insert(ends.end(), {index(edge.ends[0]), index(edge.ends[1])});
    priorities.push_back(edge.priority);
    refusals.emplace_back(edge.refusal ? name_of(refusal_names(), *edge.refusal) : "");
    renewed.push_back(edge.is_renewed);
  }
  val object = val::object();
  object.set("ends", array_of(ends.data(), ends.size()));
  object.set("priorities", array_of(priorities.data(), priorities.size()));
  object.set("refusals", strings_of(refusals));
  object.set("renewed", array_of(renewed.data(), renewed.size()));
  return object;
}

/// As `prohull render --refine` draws it.
val refined_along(const val& levels, const val& segment) {
  const RefinedAlong refined = refine_along(levels_of(levels), segment_of(segment));
  val object = object_of_mesh(refined.hull);
  object.set("found", array_of(refined.found.data(), refined.found.size()));
  object.set("missed", array_of(refined.missed.data(), refined.missed.size()));
  return object;
}

/// Where the segment crosses the mesh that both are hulls of, found by walking through the void.
val walk_hits(const val& outer, const val& inner, const val& segment) {
  const QueryIndex index = index_called("walk", levels_of(outer), levels_of(inner));
  std::vector<double> parameters;
  for (const Hit& hit : MeshQuery(index).all_hits(segment_of(segment))) parameters.push_back(hit.t);
  val object = val::object();
  object.set("t", array_of(parameters.data(), parameters.size()));
  return object;
}

}  // namespace

EMSCRIPTEN_BINDINGS(prohull_figures) {
  using emscripten::function;
  function("recordOfHull", &Guarded<record_of_hull>::call);
  function("collapseOf", &Guarded<collapse_of>::call);
  function("queueOf", &Guarded<queue_of>::call);
  function("refinedAlong", &Guarded<refined_along>::call);
  function("walkHits", &Guarded<walk_hits>::call);
}

}  // namespace prohull::js

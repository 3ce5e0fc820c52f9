#include <pybind11/stl.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "arrays.h"
#include "keywords.h"
#include "module.h"
#include "prohull/cage.h"
#include "prohull/closed_solid.h"
#include "prohull/detail/given_options.h"
#include "prohull/detail/mesh_part.h"
#include "prohull/detail/told_notes.h"
#include "prohull/enclosing_hull.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

py::dict dict_of(const RefusalCounts& counts) {
  py::dict result;
  for (const auto& [name, refusal] : refusal_names())
    if (counts[refusal] > 0) result[py::cast(name)] = counts[refusal];
  return result;
}

/// What a hull is judged by; hulls of one run share it.
class Judges {
 public:
  Judges(EnclosingHulls& made, const EnclosingOptions& options) {
    const bool is_closed = made.input.closed.has_value();
    const bool is_outer = options.hull.side == HullSide::Outer;
    const TriangleMesh every_triangle = made.input.with_caps();
    const SharedMesh closed = is_closed ? shared(std::move(made.input.closed->mesh)) : nullptr;
    given_ = closed && *closed == made.input.original ? closed : shared(std::move(made.input.original));
    original_ = is_closed ? closed : given_;
    for (const Solid& solid : made.solids) {
      TriangleMesh covered = is_closed ? TriangleMesh() : made.input.caps, all = every_triangle;
      append(covered, solid.doors);
      append(all, solid.doors);
      covered_.push_back(is_outer ? shared(std::move(covered)) : nullptr);
      measured_.push_back(all == *given_ ? given_ : shared(std::move(all)));
      bounded_.push_back(solid.source == Source::Mesh ? closed : measured_.back());
    }
  }

  /// The finite triangles that were given.
  SharedMesh given() const { return given_; }
  /// What it encloses, or covers if it is not closed.
  SharedMesh original() const { return original_; }
  /// The triangles that it has to cover beside.
  SharedMesh covered(const EnclosingHull& hull) const { return covered_[hull.solid]; }
  /// What its distance is told from: triangles_to_cover().
  SharedMesh measured(const EnclosingHull& hull) const { return measured_[hull.solid]; }
  /// What bounds that are asked for are about.
  SharedMesh bounded(const EnclosingHull& hull) const { return bounded_[hull.solid]; }

 private:
  static SharedMesh shared(TriangleMesh mesh) {
    return mesh.face_count() > 0 ? std::make_shared<TriangleMesh>(std::move(mesh)) : nullptr;
  }

  SharedMesh given_, original_;
  std::vector<SharedMesh> covered_, measured_, bounded_;  ///< by solid
};

py::dict facts_of(EnclosingHull hull, const Judges& judges, const EnclosingHulls& made,
                  const EnclosingOptions& options) {
  const Solid& solid = made.solids[hull.solid];
  py::dict facts;
  facts["_given"] = judges.given();
  facts["original"] = judges.original();
  facts["_covered"] = judges.covered(hull);
  facts["_measured"] = judges.measured(hull);
  facts["_volume_inside"] = std::isnan(hull.void_ratio) ? 0 : hull.volume_inside;
  if (options.bounds.any())
    facts["_bounds"] = py::make_tuple(judges.bounded(hull), hull.volume_inside > 0 ? hull.volume_inside : solid.volume,
                                      options.bounds.max_distance, options.bounds.max_void_ratio);
  facts["_replay_suffices"] =
      solid.source == Source::Mesh && solid.self_intersections == 0 && made.input.dropped.face_count() == 0;
  facts["source"] = name_of(source_names(), hull.source);
  facts["wrap_spacing"] = solid.wrap_spacing;
  facts["notes"] = told_notes(hull, made);
  if (hull.levels) hull.levels = hull.levels->with_finest_level(finest_level(made, hull));
  facts["_levels"] = std::move(hull.levels);
  facts["mesh"] = std::move(hull.mesh);
  facts["certified"] = hull.certified;
  facts["proof"] = hull.certified ? hull.verdict.proof : std::string_view();
  facts["gap"] = hull.padding;
  facts["_gap_asked"] = options.padding;
  facts["target_faces"] = hull.target_faces;
  facts["target_reached"] = hull.target_reached;
  facts["within_bounds"] = hull.within_bounds;
  facts["refusals"] = dict_of(hull.refusals);
  facts["blocked"] = dict_of(hull.blocked);
  facts["relaxed_guards"] = hull.relaxed_guards;
  facts["rounded_vertices"] = hull.rounded_vertices;
  facts["build_seconds"] = hull.build_seconds;
  facts["verify_seconds"] = hull.verify_seconds;
  facts["repairs"] = describe(made.input.repairs);
  facts["_open_shells"] = name_of(open_shells_names(), options.open_shells);
  return facts;
}

py::list facts_of(EnclosingHulls made, const EnclosingOptions& options) {
  const Judges judges(made, options);
  return list_of(made.hulls, [&](EnclosingHull& hull) { return facts_of(std::move(hull), judges, made, options); });
}

py::list build(const TriangleMesh& mesh, const std::vector<std::size_t>& targets, const py::object& progress,
               const py::dict& keywords) {
  const EnclosingOptions options = enclosing_options(Keywords(keywords));
  return facts_of(watched(progress, options, [&](const auto& how) { return enclosing_hulls(mesh, targets, how); }),
                  options);
}

py::dict facts_of(CageHull side) {
  EnclosingHull& hull = side.made.hulls.front();
  py::dict facts;
  hull.verdict.certified = hull.certified;
  facts["verdict"] = verdict_facts(hull.verdict);
  facts["is_disjoint"] = side.is_disjoint;
  facts["keeps_gap"] = side.keeps_gap;
  facts["void_ratio"] = hull.void_ratio;
  facts["target_reached"] = hull.target_reached;
  facts["smallest_angle_degrees"] = side.quality.smallest_angle * 180 / std::numbers::pi;
  facts["worst_aspect_ratio"] = side.quality.worst_aspect_ratio;
  facts["notes"] = hull.notes;
  facts["mesh"] = std::move(hull.mesh);
  return facts;
}

py::dict cage(const TriangleMesh& mesh, const py::object& progress, const py::dict& keywords) {
  Cage made =
      watched(progress, cage_options(Keywords(keywords)), [&](const auto& how) { return build_cage(mesh, how); });
  py::dict facts;
  facts["outer"] = facts_of(std::move(made.outer));
  facts["inner"] = made.inner ? py::object(facts_of(std::move(*made.inner))) : py::none();
  facts["gap"] = made.gap;
  facts["notes"] = made.notes;
  return facts;
}

py::dict repair(const TriangleMesh& mesh, const py::object& progress, const py::dict& keywords) {
  ClosedSolid made = watched(progress, closed_solid_options(Keywords(keywords)),
                             [&](const auto& how) { return closed_solid(mesh, how); });
  py::dict facts;
  facts["verdict"] = verdict_facts(made.verdict);
  facts["source"] = name_of(source_names(), made.source);
  facts["wrap_spacing"] = made.wrap_spacing;
  facts["repairs"] = describe(made.input.repairs);
  facts["obstacle"] = made.input.obstacle;
  facts["closed_openings"] = made.input.repairs.closed_openings;
  facts["largest_opening"] = made.input.repairs.largest_opening;
  facts["mesh"] = std::move(made.mesh);
  return facts;
}

Box box_of(const Array<double>& sides) {
  const Vec3* const rows = rows_of<Vec3>(sides);
  return {rows[0], rows[1]};
}

/// The own faces, and the numbers in the part of their first vertices.
py::tuple simplified_part(TriangleMesh mesh, std::size_t own_faces, const Array<double>& box,
                          const py::object& progress, const py::dict& keywords) {
  const Keywords given(keywords);
  HullOptions options;
  given.count("target_faces", options.target_faces);
  given.choice("side", hull_side_names(), options.side);
  given.flag("float32_coordinates", options.float32_coordinates);
  given.count("threads", options.threads);
  const MeshPart part{std::move(mesh), own_faces, box_of(box)};
  SimplifiedPart made = watched(progress, options, [&](const auto& how) { return simplify_part(part, how); });
  std::vector<std::uint32_t> kept;
  kept.reserve(made.kept.size());
  for (const VertexId v : made.kept) kept.push_back(index(v));
  const auto count = static_cast<py::ssize_t>(kept.size());
  return py::make_tuple(std::make_shared<TriangleMesh>(std::move(made.mesh)), array_of(std::move(kept), {count}));
}

}  // namespace

void bind_construction(py::module_& module) {
  module.def("build", &build);
  module.def("cage", &cage);
  module.def("repair", &repair);
  module.def("simplified_part", &simplified_part);
  module.attr("axes") = tuple_of(axis_names());
  module.attr("sides") = tuple_of(hull_side_names());
  module.attr("strategies") = tuple_of(strategy_names());
  module.attr("repairs") = tuple_of(repair_names());
  module.attr("open_shells") = tuple_of(open_shells_names());
  module.attr("sources") = tuple_of(source_names());
  module.attr("self_intersections") = tuple_of(self_intersections_names());
}

}  // namespace prohull::python

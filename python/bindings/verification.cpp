#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <type_traits>

#include "arrays.h"
#include "keywords.h"
#include "module.h"
#include "prohull/detail/closed_original.h"
#include "prohull/detail/float32_hull.h"
#include "prohull/detail/refuse.h"
#include "prohull/detail/summary.h"
#include "prohull/distance.h"
#include "prohull/enclosure.h"
#include "prohull/verification.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

using Release = py::call_guard<py::gil_scoped_release>;

py::dict facts_of(const Verification& found, double gap) {
  py::dict facts = verdict_facts(found);
  facts["encloses"] = found.encloses;
  facts["faces_outside"] = found.faces_outside;
  facts["worst"] = offenders_of(found.worst);
  facts["cavities"] = found.cavities;
  facts["faces_undecided"] = found.faces_undecided;
  facts["faces_beside_solid"] = found.faces_beside_solid;
  facts["self_intersections"] = has_failed_replay(found) ? py::object(py::none()) : py::int_(found.self_intersections);
  facts["original_volume"] = found.original_volume;
  facts["void_ratio"] = found.void_ratio;
  facts["notes"] = found.notes;
  facts["keeps_gap"] = gap > 0 && !found.is_gap_undecided() ? py::object(py::bool_(found.keeps_gap)) : py::none();
  facts["faces_too_near"] = found.faces_too_near;
  facts["least_distance"] = found.least_distance;
  facts["nearest"] = list_of(found.nearest, [](const NearFace& near) {
    return py::make_tuple(index(near.face), index(near.original_face), point_of(near.point), near.distance);
  });
  return facts;
}

HullSide side_called(const std::string& name) {
  if (const auto side = value_of(hull_side_names(), name)) return *side;
  refuse("side='" + name + "': expected one of " + joined(hull_side_names()));
}

template <class Hull>
py::dict verify(const Hull& hull, const TriangleMesh& original, const py::object& progress, const py::dict& keywords) {
  const Keywords given(keywords);
  VerificationOptions options;
  HullSide side = HullSide::Outer;
  OpenShells open_shells = OpenShells::Keep;
  given.choice("side", hull_side_names(), side);
  given.choice("open_shells", open_shells_names(), open_shells);
  given.flag("solid_only", options.solid_only);
  given.flag("finite_only", options.finite_only);
  given.not_negative("gap", options.gap);
  options.max_steps = keywords["steps"].cast<std::size_t>();  // 0: as many as usual
  const Verification found = watched(progress, options, [&](VerificationOptions how) {
    const std::optional<ClosedMesh> closed = closed_original(original, side, open_shells);
    how.closed = closed ? &closed->mesh : nullptr;
    if constexpr (std::is_same_v<Hull, TriangleMesh>)
      return verify_hull(hull, original, side, how);
    else
      return verify_hull(hull, original, how);
  });
  return facts_of(found, options.gap);
}

py::tuple distance(const TriangleMesh& from, const TriangleMesh& to, double relative_gap, double decides,
                   const py::object& progress) {
  const DistanceBounds bounds = watched(progress, DistanceOptions{.relative_gap = relative_gap, .decides = decides},
                                        [&](const auto& how) { return distance_bounds(from, to, how); });
  return py::make_tuple(bounds.lower, bounds.upper, point_of(bounds.farthest));
}

/// How it is proven that a hull does what it promises, which is to pass verify_hull about the mesh that was given, and
/// to cover `covered`; empty if it does not. `original` stands for a mesh that is not closed, if it is closed itself.
std::string proof_of(const TriangleMesh& hull, const TriangleMesh& given, const TriangleMesh& original,
                     const TriangleMesh* covered, const std::string& side) {
  return watched(py::none(), [&](Watch& watch) -> std::string {
    const Verification found = verify_hull(
        hull, given, side_called(side),
        {.closed = is_closed(original) ? &original : nullptr, .max_offenders = 0, .progress = watch.progress()});
    if (!found.encloses) return "";
    if (covered && !verify_cover(*covered, hull, {.max_offenders = 0, .progress = watch.progress()}).encloses)
      return "";
    return std::string(found.proof);
  });
}

bool is_within(const TriangleMesh& hull, const TriangleMesh& original, double volume, double max_distance,
               double max_void_ratio) {
  return watched(py::none(), [&](Watch& watch) {
    return HullBounds{max_distance, max_void_ratio}.hold(hull, original, volume, watch.progress());
  });
}

py::tuple float32_hull(const TriangleMesh& hull, const std::string& side) {
  Float32Hull rounded =
      watched(py::none(), [&](Watch&) { return with_float32_coordinates(hull, side_called(side), NoRoom::Round); });
  return py::make_tuple(std::move(rounded.mesh), rounded.rounded_vertices);
}

}  // namespace

void bind_verification(py::module_& module) {
  module.def("is_closed", &is_closed, Release());
  module.def("count_self_intersections", &count_self_intersections, Release());
  module.def(
      "solid_volume", [](const TriangleMesh& mesh) { return solid_volume(mesh).value_or(signed_volume(mesh)); },
      Release());
  module.def("verify", &verify<TriangleMesh>);
  module.def("verify", &verify<ProgressiveHull>);
  module.def("proof_of", &proof_of);
  module.def("is_within", &is_within);
  module.def("with_float32_coordinates", &float32_hull);
  module.def("distance", &distance);
}

}  // namespace prohull::python

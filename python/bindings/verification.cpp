#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "arrays.h"
#include "module.h"
#include "prohull/detail/closed_original.h"
#include "prohull/detail/float32_hull.h"
#include "prohull/distance.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/verification.h"
#include "verdicts.h"
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
  facts["self_intersections"] = found.self_intersections;
  facts["original_volume"] = found.original_volume;
  facts["void_ratio"] = found.void_ratio;
  facts["notes"] = found.notes;
  facts["keeps_gap"] = gap > 0 && !found.is_gap_undecided() ? py::object(py::bool_(found.keeps_gap)) : py::none();
  facts["faces_too_near"] = found.faces_too_near;
  facts["least_distance"] = found.least_distance;
  py::list nearest;
  for (const NearFace& near : found.nearest)
    nearest.append(py::make_tuple(index(near.face), index(near.original_face), point_of(near.point), near.distance));
  facts["nearest"] = nearest;
  return facts;
}

HullSide side_called(const std::string& name) {
  if (const auto side = value_of(hull_side_names(), name)) return *side;
  throw InputError(Defect::InvalidOption, "side='" + name + "': expected one of " + joined(hull_side_names()));
}

/// What is asked, beside the meshes.
struct Asked {
  bool solid_only;
  double gap;
  bool finite_only;
  std::string open_shells;
  std::size_t steps;  ///< 0: as many as usual
};

template <class Decide>
py::dict verified(const TriangleMesh& original, HullSide side, const Asked& asked, const py::object& progress,
                  Decide decide) {
  const auto open_shells = value_of(open_shells_names(), asked.open_shells);
  if (!open_shells)
    throw InputError(Defect::InvalidOption,
                     "open_shells='" + asked.open_shells + "': expected one of " + joined(open_shells_names()));
  const Verification found = watched(progress, [&](Watch& watch) {
    const std::optional<ClosedMesh> closed = closed_original(original, side, *open_shells);
    return decide(VerificationOptions{.solid_only = asked.solid_only,
                                      .gap = asked.gap,
                                      .finite_only = asked.finite_only,
                                      .closed = closed ? &closed->mesh : nullptr,
                                      .max_steps = asked.steps,
                                      .progress = watch.progress()});
  });
  return facts_of(found, asked.gap);
}

py::dict verified_mesh(const TriangleMesh& hull, const TriangleMesh& original, const std::string& side_name,
                       bool solid_only, double gap, bool finite_only, const std::string& open_shells, std::size_t steps,
                       const py::object& progress) {
  const HullSide side = side_called(side_name);
  return verified(original, side, {solid_only, gap, finite_only, open_shells, steps}, progress,
                  [&](const VerificationOptions& options) { return verify_hull(hull, original, side, options); });
}

py::dict verified_levels(const ProgressiveHull& hull, const TriangleMesh& original, bool solid_only, double gap,
                         bool finite_only, const std::string& open_shells, std::size_t steps,
                         const py::object& progress) {
  return verified(original, hull.side(), {solid_only, gap, finite_only, open_shells, steps}, progress,
                  [&](const VerificationOptions& options) { return verify_hull(hull, original, options); });
}

py::tuple distance(const TriangleMesh& from, const TriangleMesh& to, double relative_gap, const py::object& progress) {
  const DistanceBounds bounds = watched(progress, [&](Watch& watch) {
    return distance_bounds(from, to, {.relative_gap = relative_gap, .progress = watch.progress()});
  });
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
  module.def("verify_mesh", &verified_mesh);
  module.def("verify_levels", &verified_levels);
  module.def("proof_of", &proof_of);
  module.def("is_within", &is_within);
  module.def("with_float32_coordinates", &float32_hull);
  module.def("distance", &distance);
}

}  // namespace prohull::python

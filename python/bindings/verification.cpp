#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "arrays.h"
#include "module.h"
#include "prohull/distance.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/replay.h"
#include "prohull/verification.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

using Release = py::call_guard<py::gil_scoped_release>;

py::array point_of(const Vec3& p) { return array_of(std::vector<double>{p.x, p.y, p.z}, {3}); }

py::dict facts_of(const Verification& found) {
  py::list worst;
  for (const Offender& o : found.worst) worst.append(py::make_tuple(index(o.face), point_of(o.point), o.distance));
  py::dict facts;
  facts["encloses"] = found.encloses;
  facts["proof"] = found.proof;
  facts["side"] = name_of(hull_side_names(), found.side);
  facts["original_closed"] = found.original_closed;
  facts["every_triangle"] = found.every_triangle;
  facts["why_not"] = found.why_not;
  facts["faces_outside"] = found.faces_outside;
  facts["worst"] = worst;
  facts["cavities"] = found.cavities;
  facts["self_intersections"] = found.self_intersections;
  facts["void_ratio"] = found.void_ratio;
  facts["notes"] = found.notes;
  return facts;
}

template <class Decide>
py::dict verified(bool every_triangle, const py::object& progress, Decide decide) {
  return facts_of(watched(progress, [&](Watch& watch) {
    return decide(VerificationOptions{.every_triangle = every_triangle, .progress = watch.progress()});
  }));
}

py::dict verified_mesh(const TriangleMesh& hull, const TriangleMesh& original, const std::string& side_name,
                       bool every_triangle, const py::object& progress) {
  const auto side = value_of(hull_side_names(), side_name);
  if (!side)
    throw InputError(Defect::InvalidOption, "side='" + side_name + "': expected one of " + joined(hull_side_names()));
  return verified(every_triangle, progress,
                  [&](const VerificationOptions& options) { return verify_hull(hull, original, *side, options); });
}

py::dict verified_levels(const ProgressiveHull& hull, const TriangleMesh& original, bool every_triangle,
                         const py::object& progress) {
  return verified(every_triangle, progress,
                  [&](const VerificationOptions& options) { return verify_hull(hull, original, options); });
}

/// Why the levels prove nothing; empty if they do.
std::string replayed(const ProgressiveHull& levels, const py::object& progress) {
  return watched(progress, [&](Watch& watch) {
    const ReplayReport report = verify_replay(levels, levels.original(), watch.progress());
    return report.holds ? std::string() : report.why_not;
  });
}

py::tuple distance(const TriangleMesh& from, const TriangleMesh& to, double relative_gap, const py::object& progress) {
  const DistanceBounds bounds = watched(progress, [&](Watch& watch) {
    return distance_bounds(from, to, {.relative_gap = relative_gap, .progress = watch.progress()});
  });
  return py::make_tuple(bounds.lower, bounds.upper, point_of(bounds.farthest));
}

}  // namespace

void bind_verification(py::module_& module) {
  module.def("is_closed", &is_closed, Release());
  module.def("count_self_intersections", &count_self_intersections, Release());
  module.def("verify_mesh", &verified_mesh);
  module.def("verify_levels", &verified_levels);
  module.def("replayed", &replayed);
  module.def("distance", &distance);
}

}  // namespace prohull::python

#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "arrays.h"
#include "module.h"
#include "prohull/distance.h"
#include "prohull/enclosure.h"
#include "prohull/replay.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

using Release = py::call_guard<py::gil_scoped_release>;

py::array point_of(const Vec3& p) { return array_of(std::vector<double>{p.x, p.y, p.z}, {3}); }

py::dict facts_of(const EnclosureReport& report) {
  py::list worst;
  for (const Offender& o : report.worst) worst.append(py::make_tuple(index(o.face), point_of(o.point), o.distance));
  py::dict facts;
  facts["encloses"] = report.encloses;
  facts["faces_outside"] = report.faces_outside;
  facts["worst"] = worst;
  facts["cavities"] = report.cavities;
  facts["self_intersections"] = report.self_intersections;
  facts["inner_volume"] = report.inner_volume;
  facts["outer_volume"] = report.outer_volume;
  return facts;
}

using Verify = EnclosureReport (*)(const TriangleMesh&, const TriangleMesh&, const EnclosureOptions&);

template <Verify verify>
py::dict verified(const TriangleMesh& inner, const TriangleMesh& outer, const py::object& progress) {
  return facts_of(watched(progress, [&](Watch& watch) {
    return verify(inner, outer, {.progress = [&](double fraction) { return watch.go_on("verify", fraction); }});
  }));
}

/// Why the levels prove nothing; empty if they do.
std::string replayed(const ProgressiveHull& levels, const py::object& progress) {
  return watched(progress, [&](Watch& watch) {
    const ReplayReport report =
        verify_replay(levels, levels.original(), [&](double fraction) { return watch.go_on("verify", fraction); });
    return report.holds ? std::string() : report.why_not;
  });
}

py::tuple distance(const TriangleMesh& from, const TriangleMesh& to, double relative_gap, const py::object& progress) {
  const DistanceBounds bounds = watched(progress, [&](Watch& watch) {
    return distance_bounds(from, to, {.relative_gap = relative_gap, .progress = [&](double fraction) {
                                        return watch.go_on("measure", fraction);
                                      }});
  });
  return py::make_tuple(bounds.lower, bounds.upper, point_of(bounds.farthest));
}

}  // namespace

void bind_verification(py::module_& module) {
  module.def("is_closed", &is_closed, Release());
  module.def("turned_outwards", &turned_outwards, Release());
  module.def("count_self_intersections", &count_self_intersections, Release());
  module.def("verify_enclosure", &verified<verify_enclosure>);
  module.def("verify_cover", &verified<verify_cover>);
  module.def("replayed", &replayed);
  module.def("distance", &distance);
}

}  // namespace prohull::python

#include <cstdint>
#include <vector>

#include "arrays.h"
#include "module.h"
#include "prohull/detail/collision_levels.h"
#include "prohull/detail/inside_out.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

/// Of two arrays of shape (n, 16).
std::vector<PosePair> pose_pairs(const Array<double>& a, const Array<double>& b) {
  std::vector<PosePair> pairs;
  for (py::ssize_t i = 0; i < a.shape(0); ++i) pairs.push_back({pose_of(a.data(i, 0)), pose_of(b.data(i, 0))});
  return pairs;
}

py::array collides(const CollisionIndex& a, const CollisionIndex& b, const Array<double>& poses_a,
                   const Array<double>& poses_b, bool conservative, unsigned threads, const py::object& progress) {
  const std::vector<PosePair> poses = pose_pairs(poses_a, poses_b);
  return truths_of(watched(progress, CollisionOptions{threads}, [&](const auto& how) {
    return conservative ? may_collide(a, b, poses, how) : collide(a, b, poses, how);
  }));
}

py::tuple intersecting_faces_of(const CollisionIndex& a, const CollisionIndex& b, const Array<double>& poses_a,
                                const Array<double>& poses_b, unsigned threads, const py::object& progress) {
  const std::vector<PosePair> poses = pose_pairs(poses_a, poses_b);
  const FacePairBatch batch = watched(progress, CollisionOptions{threads},
                                      [&](const auto& how) { return intersecting_faces(a, b, poses, how); });
  std::vector<std::int64_t> faces;
  for (const FacePair& pair : batch.pairs) faces.insert(faces.end(), {index(pair.a), index(pair.b)});
  const auto count = static_cast<py::ssize_t>(batch.pairs.size());
  return py::make_tuple(offsets_of(batch.offsets), array_of(std::move(faces), {count, 2}));
}

/// Lower and upper bounds, points (n, 2, 3) and faces (n, 2).
py::tuple distances(const CollisionIndex& a, const CollisionIndex& b, const Array<double>& poses_a,
                    const Array<double>& poses_b, unsigned threads, const py::object& progress) {
  const std::vector<PosePair> poses = pose_pairs(poses_a, poses_b);
  const std::vector<Separation> found =
      watched(progress, CollisionOptions{threads}, [&](const auto& how) { return separation(a, b, poses, how); });
  std::vector<double> lower, upper, points;
  std::vector<std::int64_t> faces;
  for (const Separation& s : found) {
    lower.push_back(s.lower), upper.push_back(s.upper);
    for (const Vec3& p : {s.point_a, s.point_b}) points.insert(points.end(), {p.x, p.y, p.z});
    faces.insert(faces.end(), {index(s.face_a), index(s.face_b)});
  }
  const auto n = static_cast<py::ssize_t>(found.size());
  return py::make_tuple(array_of(std::move(lower), {n}), array_of(std::move(upper), {n}),
                        array_of(std::move(points), {n, 2, 3}), array_of(std::move(faces), {n, 2}));
}

/// No point of one surface is nearer to the other.
double surface_distance(const TriangleMesh& a, const TriangleMesh& b) {
  return separation(CollisionIndex(a, StandsFor::Surface), {}, CollisionIndex(b, StandsFor::Surface), {}).lower;
}

}  // namespace

void bind_collisions(py::module_& module) {
  py::class_<CollisionIndex>(module, "CollisionIndex")
      .def(py::init([](const TriangleMesh& mesh) {
        const py::gil_scoped_release released;
        const CollisionIndex as_given(mesh);
        if (!is_closed(mesh)) return as_given;
        const OutwardSolid solid = outward_solid(mesh, "the mesh");
        return solid.turned.empty() ? as_given : CollisionIndex(solid.mesh);
      }))
      .def(py::init([](const ProgressiveHull& levels, bool conservative) {
        const py::gil_scoped_release released;
        return collision_index(levels, conservative);
      }))
      .def_property_readonly("is_solid", &CollisionIndex::is_solid)
      .def("collides", &collides)
      .def("intersecting_faces", &intersecting_faces_of)
      .def("distances", &distances);
  module.def("surface_distance", &surface_distance, py::call_guard<py::gil_scoped_release>());
}

}  // namespace prohull::python

#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "prohull/collide.h"
#include "prohull/detail/names.h"
#include "prohull/detail/shapes.h"
#include "prohull/detail/verdict_parts.h"
#include "prohull/enclosure.h"
#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"

namespace prohull::python {

/// Python can change neither: it is shared with all views of it.
using SharedMesh = std::shared_ptr<TriangleMesh>;
using SharedLevels = std::shared_ptr<ProgressiveHull>;

template <class T>
using Array = pybind11::array_t<T, pybind11::array::c_style>;

// Numpy's rows of three are the library's values.
static_assert(sizeof(Vec3) == 3 * sizeof(double) && std::is_standard_layout_v<Vec3>);
static_assert(sizeof(VertexId) == sizeof(std::uint32_t) && sizeof(FaceId) == sizeof(std::uint32_t));

/// A read-only array of what `owner`, a std::shared_ptr, keeps; no copy.
template <class T, class Owner>
pybind11::array view_of(const Owner& owner, const T* data, std::vector<pybind11::ssize_t> shape) {
  const pybind11::capsule keep(new Owner(owner), [](void* kept) { delete static_cast<Owner*>(kept); });
  pybind11::array_t<T> view(std::move(shape), data, keep);
  view.attr("setflags")(pybind11::arg("write") = false);
  return view;
}

/// The values become the array; no copy.
template <class T>
pybind11::array array_of(std::vector<T> values, std::vector<pybind11::ssize_t> shape) {
  auto* const kept = new std::vector<T>(std::move(values));
  const pybind11::capsule keep(kept, [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  return pybind11::array_t<T>(std::move(shape), kept->data(), keep);
}

inline pybind11::array offsets_of(const std::vector<std::size_t>& offsets) {
  return array_of(std::vector<std::int64_t>(offsets.begin(), offsets.end()),
                  {static_cast<pybind11::ssize_t>(offsets.size())});
}

inline pybind11::array truths_of(const std::vector<bool>& truths) {
  pybind11::array_t<bool> array(static_cast<pybind11::ssize_t>(truths.size()));
  std::copy(truths.begin(), truths.end(), array.mutable_data());
  return array;
}

/// Shape (3,).
inline pybind11::array point_of(const Vec3& p) { return array_of(std::vector<double>{p.x, p.y, p.z}, {3}); }

/// Shape (n, 4): center and radius of each.
inline pybind11::array rows_of_balls(const std::vector<Ball>& balls) {
  std::vector<double> values;
  for (const Ball& b : balls) values.insert(values.end(), {b.center.x, b.center.y, b.center.z, b.radius});
  return array_of(std::move(values), {static_cast<pybind11::ssize_t>(balls.size()), 4});
}

/// make(x) of each x.
template <class Range, class Make>
pybind11::list list_of(Range&& range, Make make) {
  pybind11::list list;
  for (auto& each : range) list.append(make(each));
  return list;
}

/// Of each the face, the point and the distance.
inline pybind11::list offenders_of(const std::vector<Offender>& worst) {
  return list_of(worst,
                 [](const Offender& o) { return pybind11::make_tuple(index(o.face), point_of(o.point), o.distance); });
}

inline pybind11::array vertices_of(const SharedMesh& mesh) {
  return view_of(mesh, reinterpret_cast<const double*>(mesh->positions.data()),
                 {static_cast<pybind11::ssize_t>(mesh->vertex_count()), 3});
}

inline pybind11::array faces_of(const SharedMesh& mesh) {
  return view_of(mesh, reinterpret_cast<const std::uint32_t*>(mesh->triangles.data()),
                 {static_cast<pybind11::ssize_t>(mesh->face_count()), 3});
}

template <class T>
pybind11::tuple tuple_of(Names<T> names) {
  return pybind11::tuple(list_of(names, [](const auto& named) { return named.first; }));
}

/// Rows of a C-contiguous array as they lie in memory.
template <class Row, class T>
const Row* rows_of(const Array<T>& array) {
  static_assert(sizeof(Row) % sizeof(T) == 0 && std::is_standard_layout_v<Row>);
  return reinterpret_cast<const Row*>(array.data());
}

/// The upper three rows of a matrix of 4 x 4.
inline Pose pose_of(const double* m) {
  return {{Vec3{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}, {m[3], m[7], m[11]}};
}

/// Of rows of four numbers.
inline std::vector<Ball> balls_of(const Array<double>& rows) {
  static_assert(sizeof(Ball) == 4 * sizeof(double));
  const auto* const first = rows_of<Ball>(rows);
  return {first, first + rows.shape(0)};
}

inline pybind11::object object_of(bool value) { return pybind11::bool_(value); }
inline pybind11::object object_of(std::size_t value) { return pybind11::int_(value); }
inline pybind11::object object_of(double value) { return pybind11::float_(value); }
inline pybind11::object object_of(std::string_view text) { return pybind11::str(std::string(text)); }
inline pybind11::object object_of(const DistanceBounds& bounds) {
  return pybind11::make_tuple(bounds.lower, bounds.upper);
}
template <class Value>
pybind11::object object_of(const std::optional<Value>& value) {
  return value ? object_of(*value) : pybind11::none();
}

/// The keywords of the class Verdict in Python.
inline pybind11::dict verdict_facts(const Verdict& verdict) {
  pybind11::dict facts;
  visit_fields(verdict, [&](const char* name, const auto& value) { facts[name] = object_of(value); });
  return facts;
}

}  // namespace prohull::python

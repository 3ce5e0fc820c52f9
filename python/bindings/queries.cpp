#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "arrays.h"
#include "module.h"
#include "prohull/error.h"
#include "prohull/mesh_query.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

Engine engine_called(const std::string& name) {
  std::string known;
  for (const auto& [text, engine] : engine_names()) {
    if (text == name) return engine;
    known += (known.empty() ? "" : ", ") + std::string(text);
  }
  throw InputError(Defect::InvalidOption, "engine='" + name + "': expected one of " + known);
}

RefinementOptions refinement_of(bool coarsen, unsigned queries_per_roll_back) {
  return {coarsen ? BetweenQueries::Coarsen : BetweenQueries::RollBack, queries_per_roll_back};
}

template <class Query>
std::span<const Query> queries_of(const Array<double>& rows) {
  return {rows_of<Query>(rows), static_cast<std::size_t>(rows.shape(0))};
}

BatchOptions batch_options(Watch& watch, unsigned threads) {
  return {threads, [&watch](double fraction) { return watch.go_on("query", fraction); }};
}

/// `rows` of shape (n, 6).
template <class Query>
HitBatch hits_of(const QueryIndex& index, const Array<double>& rows, HitMode mode, unsigned threads) {
  return watched(py::none(), [&](Watch& watch) {
    return hits(index, queries_of<Query>(rows), mode, batch_options(watch, threads));
  });
}

HitBatch hits_of(const QueryIndex& index, const Array<double>& rows, bool are_rays, HitMode mode, unsigned threads) {
  return are_rays ? hits_of<Ray>(index, rows, mode, threads) : hits_of<Segment>(index, rows, mode, threads);
}

/// The columns of hits.
struct Columns {
  explicit Columns(std::size_t n, std::int64_t no_face, double no_number)
      : face(n, no_face), t(n, no_number), position(3 * n, no_number), entering(n, 0) {}

  void set(std::size_t i, const Hit& hit) {
    face[i] = index(hit.face), t[i] = hit.t, entering[i] = hit.entering;
    for (int axis = 0; axis < 3; ++axis) position[3 * i + static_cast<std::size_t>(axis)] = hit.position[axis];
  }
  void append_to(py::list& result) && {
    const auto n = static_cast<py::ssize_t>(face.size());
    result.append(array_of(std::move(face), {n}));
    result.append(array_of(std::move(t), {n}));
    result.append(array_of(std::move(position), {n, 3}));
    result.append(array_of(std::move(entering), {n}).attr("view")("bool"));
  }

  std::vector<std::int64_t> face;
  std::vector<double> t, position;
  std::vector<std::uint8_t> entering;
};

py::list first_hits(const QueryIndex& index, const Array<double>& rows, bool are_rays, unsigned threads) {
  const HitBatch batch = hits_of(index, rows, are_rays, HitMode::First, threads);
  const std::size_t n = batch.offsets.size() - 1;
  Columns columns(n, -1, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < n; ++i)
    if (batch.offsets[i] < batch.offsets[i + 1]) columns.set(i, batch.hits[batch.offsets[i]]);
  py::list result;
  std::move(columns).append_to(result);
  return result;
}

py::array any_hits(const QueryIndex& index, const Array<double>& rows, bool are_rays, unsigned threads) {
  const HitBatch batch = hits_of(index, rows, are_rays, HitMode::Any, threads);
  std::vector<std::uint8_t> is_hit(batch.offsets.size() - 1);
  for (std::size_t i = 0; i < is_hit.size(); ++i) is_hit[i] = batch.offsets[i] < batch.offsets[i + 1];
  return array_of(std::move(is_hit), {rows.shape(0)}).attr("view")("bool");
}

py::array offsets_of(const std::vector<std::size_t>& offsets) {
  return array_of(std::vector<std::int64_t>(offsets.begin(), offsets.end()),
                  {static_cast<py::ssize_t>(offsets.size())});
}

py::list all_hits(const QueryIndex& index, const Array<double>& rows, bool are_rays, unsigned threads) {
  const HitBatch batch = hits_of(index, rows, are_rays, HitMode::All, threads);
  Columns columns(batch.hits.size(), -1, 0);
  for (std::size_t i = 0; i < batch.hits.size(); ++i) columns.set(i, batch.hits[i]);
  py::list result;
  result.append(offsets_of(batch.offsets));
  std::move(columns).append_to(result);
  return result;
}

/// `rows` of shape (n, 9).
py::tuple triangles_met(const QueryIndex& index, const Array<double>& rows, unsigned threads) {
  const FaceBatch batch = watched(py::none(), [&](Watch& watch) {
    return faces_met(index, queries_of<Triangle>(rows), batch_options(watch, threads));
  });
  std::vector<std::int64_t> faces(batch.faces.size());
  std::ranges::transform(batch.faces, faces.begin(), [](FaceId f) { return prohull::index(f); });
  const auto n = static_cast<py::ssize_t>(faces.size());
  return py::make_tuple(offsets_of(batch.offsets), array_of(std::move(faces), {n}));
}

/// How often a closed mesh winds around the start of a ray that has these hits.
long winding_number(std::span<const Hit> hits) {
  long winding = 0;
  for (const Hit& hit : hits) winding += hit.entering ? -1 : 1;
  return winding;
}

/// `points` of shape (n, 3); the mesh must be closed.
py::array contains(const QueryIndex& index, const Array<double>& points, unsigned threads) {
  const std::span<const Vec3> all(rows_of<Vec3>(points), static_cast<std::size_t>(points.shape(0)));
  std::vector<std::uint8_t> inside = watched(py::none(), [&](Watch& watch) {
    constexpr std::size_t kAtOnce = 1 << 16;  // a ray may have many hits, 48 bytes each
    std::vector<std::uint8_t> result;
    std::vector<Ray> rays;
    for (std::size_t first = 0; first < all.size(); first += kAtOnce) {
      rays.clear();
      for (const Vec3& p : all.subspan(first, std::min(kAtOnce, all.size() - first))) rays.push_back({p, {1, 0, 0}});
      const HitBatch batch = hits(index, rays, HitMode::All, batch_options(watch, threads));
      for (std::size_t i = 0; i < rays.size(); ++i)
        result.push_back(
            winding_number(std::span(batch.hits).subspan(batch.offsets[i], batch.offsets[i + 1] - batch.offsets[i])) >
            0);
    }
    return result;
  });
  return array_of(std::move(inside), {points.shape(0)}).attr("view")("bool");
}

}  // namespace

void bind_queries(py::module_& module) {
  py::class_<QueryIndex>(module, "Index")
      .def(py::init([](const TriangleMesh& mesh, const std::string& engine) {
        const Engine chosen = engine_called(engine);
        const py::gil_scoped_release released;
        return QueryIndex(mesh, chosen);
      }))
      .def(py::init([](const ProgressiveHull& levels, const std::string& engine, bool coarsen, unsigned per_roll_back) {
        const Engine chosen = engine_called(engine);
        const py::gil_scoped_release released;
        return QueryIndex(levels, chosen, refinement_of(coarsen, per_roll_back));
      }))
      .def("first_hits", &first_hits)
      .def("any_hits", &any_hits)
      .def("all_hits", &all_hits)
      .def("triangles_met", &triangles_met)
      .def("contains", &contains);
  std::vector<std::string> names;
  for (const auto& [name, engine] : engine_names()) names.emplace_back(name);
  module.attr("engines") = py::tuple(py::cast(names));
}

}  // namespace prohull::python

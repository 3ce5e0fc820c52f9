#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <mutex>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "module.h"
#include "paper/engines.h"
#include "prohull/mesh_query.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

RefinementOptions refinement_of(bool coarsen, unsigned queries_per_roll_back) {
  return {coarsen ? BetweenQueries::Coarsen : BetweenQueries::RollBack, queries_per_roll_back};
}

template <class Query>
std::span<const Query> queries_of(const Array<double>& rows) {
  return {rows_of<Query>(rows), static_cast<std::size_t>(rows.shape(0))};
}

/// Hands the hits of `rows`, of shape (n, 6), to `take` in chunks.
template <class Query>
void take_hits(const QueryIndex& index, const Array<double>& rows, HitMode mode, unsigned threads,
               const py::object& progress, const TakeHits& take) {
  watched(progress, BatchOptions{threads},
          [&](const auto& how) { return find_hits_in_chunks(index, queries_of<Query>(rows), mode, take, how); });
}

void take_hits(const QueryIndex& index, const Array<double>& rows, bool are_rays, HitMode mode, unsigned threads,
               const py::object& progress, const TakeHits& take) {
  are_rays ? take_hits<Ray>(index, rows, mode, threads, progress, take)
           : take_hits<Segment>(index, rows, mode, threads, progress, take);
}

/// A column of n rows, which belongs to numpy: not touched before rows are set, which needs no GIL.
template <class T>
struct Column {
  explicit Column(std::size_t n) : array(static_cast<py::ssize_t>(n)), rows(array.mutable_data()) {}
  py::array_t<T> array;
  T* rows;
};
template <>
struct Column<Vec3> {
  explicit Column(std::size_t n)
      : array({static_cast<py::ssize_t>(n), py::ssize_t{3}}), rows(reinterpret_cast<Vec3*>(array.mutable_data())) {}
  py::array_t<double> array;
  Vec3* rows;
};

template <class... T>
class Columns {
 public:
  explicit Columns(std::size_t n) : columns_(Column<T>(n)...) {}
  void set(std::size_t row, const T&... values) {
    std::apply([&](auto&... column) { ((column.rows[row] = values), ...); }, columns_);
  }
  py::tuple arrays() const {
    return std::apply([](const auto&... column) { return py::make_tuple(column.array...); }, columns_);
  }

 private:
  std::tuple<Column<T>...> columns_;
};

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr Vec3 kNowhere{kNone, kNone, kNone};

/// Face, t, position, and whether it enters.
using HitColumns = Columns<std::int64_t, double, Vec3, bool>;
void set(HitColumns& columns, std::size_t row, const Hit& hit) {
  columns.set(row, index(hit.face), hit.t, hit.position, hit.entering);
}

bool is_answered(const HitBatch& batch, std::size_t i) { return batch.offsets[i] < batch.offsets[i + 1]; }

py::tuple first_hits(const QueryIndex& index, const Array<double>& rows, bool are_rays, unsigned threads,
                     const py::object& progress) {
  HitColumns columns(static_cast<std::size_t>(rows.shape(0)));
  take_hits(index, rows, are_rays, HitMode::First, threads, progress, [&](std::size_t first, const HitBatch& chunk) {
    for (std::size_t i = 0; i + 1 < chunk.offsets.size(); ++i)
      is_answered(chunk, i) ? set(columns, first + i, chunk.hits[chunk.offsets[i]])
                            : columns.set(first + i, -1, kNone, kNowhere, false);
  });
  return columns.arrays();
}

py::array any_hits(const QueryIndex& index, const Array<double>& rows, bool are_rays, unsigned threads,
                   const py::object& progress) {
  return truths_of(watched(progress, BatchOptions{threads}, [&](const auto& how) {
    return are_rays ? crosses(index, queries_of<Ray>(rows), how) : crosses(index, queries_of<Segment>(rows), how);
  }));
}

struct Chunk {
  std::size_t first;
  HitBatch batch;
};

/// By the numbers of their queries.
std::vector<Chunk> all_chunks(const QueryIndex& index, const Array<double>& rows, bool are_rays, unsigned threads,
                              const py::object& progress) {
  std::vector<Chunk> chunks;
  std::mutex mutex;
  take_hits(index, rows, are_rays, HitMode::All, threads, progress, [&](std::size_t first, HitBatch batch) {
    const std::scoped_lock lock(mutex);
    chunks.push_back({first, std::move(batch)});
  });
  std::ranges::sort(chunks, {}, &Chunk::first);
  return chunks;
}

py::tuple all_hits(const QueryIndex& index, const Array<double>& rows, bool are_rays, unsigned threads,
                   const py::object& progress) {
  const std::vector<Chunk> chunks = all_chunks(index, rows, are_rays, threads, progress);
  std::size_t count = 0;
  for (const Chunk& chunk : chunks) count += chunk.batch.hits.size();
  HitColumns columns(count);
  py::array_t<std::int64_t> offsets(rows.shape(0) + 1);
  std::int64_t* offset = offsets.mutable_data();
  *offset = 0;
  std::size_t row = 0;
  for (const auto& [first, batch] : chunks) {
    for (std::size_t i = 1; i < batch.offsets.size(); ++i)
      offset[first + i] = static_cast<std::int64_t>(row + batch.offsets[i]);
    for (const Hit& hit : batch.hits) set(columns, row++, hit);
  }
  return py::make_tuple(offsets) + columns.arrays();
}

/// `rows` of shape (n, 9).
py::tuple triangles_met(const QueryIndex& index, const Array<double>& rows, unsigned threads,
                        const py::object& progress) {
  const FaceBatch batch = watched(progress, BatchOptions{threads}, [&](const auto& how) {
    return find_faces_met(index, queries_of<Triangle>(rows), how);
  });
  std::vector<std::int64_t> faces(batch.faces.size());
  std::ranges::transform(batch.faces, faces.begin(), [](FaceId f) { return prohull::index(f); });
  const auto n = static_cast<py::ssize_t>(faces.size());
  return py::make_tuple(offsets_of(batch.offsets), array_of(std::move(faces), {n}));
}

/// `points` of shape (n, 3).
py::array points_inside(const QueryIndex& index, const Array<double>& points, unsigned threads,
                        const py::object& progress) {
  return truths_of(watched(progress, BatchOptions{threads},
                           [&](const auto& how) { return contains(index, queries_of<Vec3>(points), how); }));
}

/// Face, position, distance, and its bounds.
using ClosestColumns = Columns<std::int64_t, Vec3, double, double, double>;
void set(ClosestColumns& columns, std::size_t row, const ClosestPoint& p) {
  columns.set(row, index(p.face), p.position, p.distance, p.lower, p.upper);
}

/// `points` of shape (n, 3).
py::tuple points_closest(const QueryIndex& index, const Array<double>& points, double max_distance, unsigned threads,
                         const py::object& progress) {
  const auto found = watched(progress, BatchOptions{threads}, [&](const auto& how) {
    return closest_points(index, queries_of<Vec3>(points), max_distance, how);
  });
  ClosestColumns columns(found.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    found[i] ? set(columns, i, *found[i]) : columns.set(i, -1, kNowhere, kNone, kNone, kNone);
  return columns.arrays();
}

/// `points` of shape (n, 3).
py::tuple points_signed(const QueryIndex& index, const Array<double>& points, unsigned threads,
                        const py::object& progress) {
  const auto found = watched(progress, BatchOptions{threads},
                             [&](const auto& how) { return signed_distances(index, queries_of<Vec3>(points), how); });
  ClosestColumns columns(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) set(columns, i, found[i]);
  return columns.arrays();
}

}  // namespace

void bind_queries(py::module_& module) {
  py::class_<QueryIndex>(module, "Index")
      .def(py::init([](const TriangleMesh& mesh, const std::string& engine) {
        const py::gil_scoped_release released;
        return index_called(engine, mesh);
      }))
      .def(py::init([](const ProgressiveHull& levels, const std::string& engine, bool coarsen, unsigned per_roll_back) {
        const py::gil_scoped_release released;
        return index_called(engine, levels, refinement_of(coarsen, per_roll_back));
      }))
      .def(py::init([](const ProgressiveHull& outer, const ProgressiveHull& inner, const std::string& engine) {
        const py::gil_scoped_release released;
        return index_called(engine, outer, inner);
      }))
      .def("first_hits", &first_hits)
      .def("any_hits", &any_hits)
      .def("all_hits", &all_hits)
      .def("triangles_met", &triangles_met)
      .def("contains", &points_inside)
      .def("closest", &points_closest)
      .def("signed_distances", &points_signed);
  module.attr("engines") =
      py::tuple(py::cast(std::vector<std::string_view>(hull_engine_names().begin(), hull_engine_names().end())));
}

}  // namespace prohull::python

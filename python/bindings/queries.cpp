#include <pybind11/stl.h>

#include <algorithm>
#include <array>
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

BatchOptions batch_options(Watch& watch, unsigned threads) { return {threads, watch.progress()}; }

/// Hands the hits of `rows`, of shape (n, 6), to `take` in chunks.
template <class Query>
void take_hits(const QueryIndex& index, const Array<double>& rows, HitMode mode, unsigned threads,
               const py::object& progress, const TakeHits& take) {
  watched(progress, [&](Watch& watch) {
    return find_hits_in_chunks(index, queries_of<Query>(rows), mode, take, batch_options(watch, threads));
  });
}

void take_hits(const QueryIndex& index, const Array<double>& rows, bool are_rays, HitMode mode, unsigned threads,
               const py::object& progress, const TakeHits& take) {
  are_rays ? take_hits<Ray>(index, rows, mode, threads, progress, take)
           : take_hits<Segment>(index, rows, mode, threads, progress, take);
}

/// The columns of n hits, which belong to numpy: not touched before rows are set, which needs no GIL.
class Columns {
 public:
  explicit Columns(std::size_t n)
      : columns_(py::array_t<std::int64_t>(length(n)), py::array_t<double>(length(n)),
                 py::array_t<double>({length(n), py::ssize_t{3}}), py::array_t<bool>(length(n))),
        face_(std::get<0>(columns_).mutable_data()),
        t_(std::get<1>(columns_).mutable_data()),
        position_(std::get<2>(columns_).mutable_data()),
        entering_(std::get<3>(columns_).mutable_data()) {}

  void set(std::size_t row, const Hit& hit) { set(row, index(hit.face), hit.t, hit.position, hit.entering); }
  void set_none(std::size_t row) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    set(row, -1, kNone, {kNone, kNone, kNone}, false);
  }
  void append_to(py::list& result) const {
    std::apply([&](const auto&... column) { (result.append(column), ...); }, columns_);
  }

 private:
  static py::ssize_t length(std::size_t n) { return static_cast<py::ssize_t>(n); }

  void set(std::size_t row, std::int64_t face, double t, const Vec3& position, bool entering) {
    face_[row] = face, t_[row] = t, entering_[row] = entering;
    for (int axis = 0; axis < 3; ++axis) position_[3 * row + static_cast<std::size_t>(axis)] = position[axis];
  }

  std::tuple<py::array_t<std::int64_t>, py::array_t<double>, py::array_t<double>, py::array_t<bool>> columns_;
  std::int64_t* face_;
  double *t_, *position_;
  bool* entering_;
};

bool is_answered(const HitBatch& batch, std::size_t i) { return batch.offsets[i] < batch.offsets[i + 1]; }

py::list first_hits(const QueryIndex& index, const Array<double>& rows, bool are_rays, unsigned threads,
                    const py::object& progress) {
  Columns columns(static_cast<std::size_t>(rows.shape(0)));
  take_hits(index, rows, are_rays, HitMode::First, threads, progress, [&](std::size_t first, const HitBatch& chunk) {
    for (std::size_t i = 0; i + 1 < chunk.offsets.size(); ++i)
      is_answered(chunk, i) ? columns.set(first + i, chunk.hits[chunk.offsets[i]]) : columns.set_none(first + i);
  });
  py::list result;
  columns.append_to(result);
  return result;
}

py::array any_hits(const QueryIndex& index, const Array<double>& rows, bool are_rays, unsigned threads,
                   const py::object& progress) {
  return truths_of(watched(progress, [&](Watch& watch) {
    const BatchOptions options = batch_options(watch, threads);
    return are_rays ? crosses(index, queries_of<Ray>(rows), options)
                    : crosses(index, queries_of<Segment>(rows), options);
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

py::list all_hits(const QueryIndex& index, const Array<double>& rows, bool are_rays, unsigned threads,
                  const py::object& progress) {
  const std::vector<Chunk> chunks = all_chunks(index, rows, are_rays, threads, progress);
  std::size_t count = 0;
  for (const Chunk& chunk : chunks) count += chunk.batch.hits.size();
  Columns columns(count);
  py::array_t<std::int64_t> offsets(rows.shape(0) + 1);
  std::int64_t* offset = offsets.mutable_data();
  *offset = 0;
  std::size_t row = 0;
  for (const auto& [first, batch] : chunks) {
    for (std::size_t i = 1; i < batch.offsets.size(); ++i)
      offset[first + i] = static_cast<std::int64_t>(row + batch.offsets[i]);
    for (const Hit& hit : batch.hits) columns.set(row++, hit);
  }
  py::list result;
  result.append(offsets);
  columns.append_to(result);
  return result;
}

/// `rows` of shape (n, 9).
py::tuple triangles_met(const QueryIndex& index, const Array<double>& rows, unsigned threads,
                        const py::object& progress) {
  const FaceBatch batch = watched(progress, [&](Watch& watch) {
    return find_faces_met(index, queries_of<Triangle>(rows), batch_options(watch, threads));
  });
  std::vector<std::int64_t> faces(batch.faces.size());
  std::ranges::transform(batch.faces, faces.begin(), [](FaceId f) { return prohull::index(f); });
  const auto n = static_cast<py::ssize_t>(faces.size());
  return py::make_tuple(offsets_of(batch.offsets), array_of(std::move(faces), {n}));
}

/// `points` of shape (n, 3).
py::array points_inside(const QueryIndex& index, const Array<double>& points, unsigned threads,
                        const py::object& progress) {
  return truths_of(watched(progress, [&](Watch& watch) {
    return contains(index, queries_of<Vec3>(points), batch_options(watch, threads));
  }));
}

/// Columns of n closest points.
class ClosestColumns {
 public:
  explicit ClosestColumns(std::size_t n)
      : face_(static_cast<py::ssize_t>(n)), position_({static_cast<py::ssize_t>(n), py::ssize_t{3}}) {
    for (py::array_t<double>& column : numbers_) column = py::array_t<double>(static_cast<py::ssize_t>(n));
  }

  void set(std::size_t row, const ClosestPoint& p) {
    set(row, index(p.face), p.position, p.distance, p.lower, p.upper);
  }
  void set_none(std::size_t row) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    set(row, -1, {kNone, kNone, kNone}, kNone, kNone, kNone);
  }
  py::tuple all() const { return py::make_tuple(face_, position_, numbers_[0], numbers_[1], numbers_[2]); }

 private:
  void set(std::size_t row, std::int64_t face, const Vec3& position, double distance, double lower, double upper) {
    face_.mutable_data()[row] = face;
    for (int axis = 0; axis < 3; ++axis)
      position_.mutable_data()[3 * row + static_cast<std::size_t>(axis)] = position[axis];
    numbers_[0].mutable_data()[row] = distance;
    numbers_[1].mutable_data()[row] = lower;
    numbers_[2].mutable_data()[row] = upper;
  }

  py::array_t<std::int64_t> face_;
  py::array_t<double> position_;
  std::array<py::array_t<double>, 3> numbers_;  ///< distance, lower, upper
};

/// `points` of shape (n, 3).
py::tuple points_closest(const QueryIndex& index, const Array<double>& points, double max_distance, unsigned threads,
                         const py::object& progress) {
  const auto found = watched(progress, [&](Watch& watch) {
    return closest_points(index, queries_of<Vec3>(points), max_distance, batch_options(watch, threads));
  });
  ClosestColumns columns(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) found[i] ? columns.set(i, *found[i]) : columns.set_none(i);
  return columns.all();
}

/// `points` of shape (n, 3).
py::tuple points_signed(const QueryIndex& index, const Array<double>& points, unsigned threads,
                        const py::object& progress) {
  const auto found = watched(progress, [&](Watch& watch) {
    return signed_distances(index, queries_of<Vec3>(points), batch_options(watch, threads));
  });
  ClosestColumns columns(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) columns.set(i, found[i]);
  return columns.all();
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

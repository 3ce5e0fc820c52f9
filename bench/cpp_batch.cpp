// The module prohull_cpp_batch, for python_batch.py: what a batch costs in C++, in the process that asks by Python.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include <map>
#include <span>
#include <string>

#include "machine.h"
#include "paper/engines.h"
#include "prohull/hull_file.h"
#include "prohull/mesh_io.h"
#include "prohull/mesh_query.h"

namespace py = pybind11;

namespace prohull::bench {
namespace {

using Rows = py::array_t<double, py::array::c_style>;

std::span<const Segment> segments_of(const Rows& rows) {
  static_assert(sizeof(Segment) == 6 * sizeof(double));
  return {reinterpret_cast<const Segment*>(rows.data()), static_cast<std::size_t>(rows.shape(0))};
}

HitMode mode_called(const std::string& name) {
  static const std::map<std::string, HitMode> modes{
      {"first_hit", HitMode::First}, {"any_hit", HitMode::Any}, {"all_hits", HitMode::All}};
  return modes.at(name);
}

QueryIndex index_of(const std::filesystem::path& path, const std::string& engine) {
  return is_hull_file(path) ? index_called(engine, load_hull(path)) : index_called(engine, read_mesh(path));
}

/// Seconds of the call alone, and how many hits it found. `rows` of shape (n, 6), both ends of segments.
py::tuple timed(const QueryIndex& index, const Rows& rows, const std::string& mode, unsigned threads) {
  const auto segments = segments_of(rows);
  const HitMode asked = mode_called(mode);
  HitBatch batch;
  double seconds = 0;
  {
    const py::gil_scoped_release released;
    seconds = elapsed_seconds_of([&] { batch = find_hits(index, segments, asked, {.threads = threads}); });
  }
  return py::make_tuple(seconds, batch.hits.size());
}

}  // namespace
}  // namespace prohull::bench

PYBIND11_MODULE(prohull_cpp_batch, module) {
  using namespace prohull::bench;
  // Local to the module: the Python package has classes of the same types.
  py::class_<prohull::QueryIndex>(module, "Index", py::module_local()).def(py::init(&index_of)).def("timed", &timed);
}

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "arrays.h"
#include "module.h"
#include "prohull/detail/openings.h"
#include "prohull/error.h"
#include "prohull/hull_file.h"
#include "prohull/mesh_io.h"
#include "prohull/mesh_report.h"
#include "prohull/progressive_hull.h"
#include "prohull/sample.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

using Release = py::call_guard<py::gil_scoped_release>;

template <class Row, class T>
std::vector<Row> copied(const Array<T>& rows) {
  const Row* const first = rows_of<Row>(rows);
  return {first, first + static_cast<std::size_t>(rows.size()) * sizeof(T) / sizeof(Row)};
}

/// `vertices` of shape (n, 3), `faces` of shape (m, 3).
SharedMesh mesh_of(const Array<double>& vertices, const Array<std::int64_t>& faces) {
  std::vector<std::array<VertexId, 3>> triangles(static_cast<std::size_t>(faces.shape(0)));
  const auto corner = faces.unchecked<2>();
  for (py::ssize_t f = 0; f < corner.shape(0); ++f)
    for (py::ssize_t c = 0; c < 3; ++c) {
      if (corner(f, c) < 0 || corner(f, c) >= vertices.shape(0))
        throw InputError(Defect::Malformed, "faces[" + std::to_string(f) + "] names vertex " +
                                                std::to_string(corner(f, c)) + ", but there are " +
                                                std::to_string(vertices.shape(0)) + " vertices");
      triangles[static_cast<std::size_t>(f)][static_cast<std::size_t>(c)] =
          VertexId(static_cast<std::uint32_t>(corner(f, c)));
    }
  return std::make_shared<TriangleMesh>(
      TriangleMesh{PerVertex<Vec3>(copied<Vec3>(vertices)), PerFace<std::array<VertexId, 3>>(std::move(triangles))});
}

TriangleMesh read(const std::filesystem::path& path, bool keep_non_finite, double scale) {
  return watched(py::none(), [&](Watch& watch) {
    return read_mesh(path, {.non_finite = keep_non_finite ? NonFinite::Keep : NonFinite::Refuse,
                            .scale = scale,
                            .progress = watch.progress()});
  });
}

py::dict facts_of(const TriangleMesh& mesh) {
  MeshReport report;
  std::vector<Opening> openings;
  {
    const py::gil_scoped_release released;
    report = inspect(mesh);
    openings = find_openings(mesh);
  }
  py::dict facts;
  facts["faces"] = report.faces;
  facts["vertices"] = report.vertices;
  facts["components"] = report.components;
  facts["closed_manifold"] = report.is_closed_manifold();
  facts["euler_characteristic"] = report.euler_characteristic;
  facts["volume"] = report.volume;
  for (const DefectCount& defect : defect_counts(report))
    facts[py::str(defect.name.data(), defect.name.size())] = defect.count;
  facts["first_defect"] = report.first_defect;
  facts["openings"] = list_of(openings, [](const Opening& opening) { return opening.diameter; });
  return facts;
}

constexpr py::ssize_t kSplitFields = 6;
static_assert(sizeof(VertexSplit) == kSplitFields * sizeof(std::uint32_t));

py::tuple parts_of(const SharedLevels& levels) {
  const auto rows = [](std::size_t n) { return static_cast<py::ssize_t>(n); };
  return py::make_tuple(levels->side() == HullSide::Inner, levels->original_vertex_count(),
                        view_of(levels, reinterpret_cast<const double*>(levels->positions().data()),
                                {rows(levels->positions().size()), 3}),
                        view_of(levels, reinterpret_cast<const std::uint32_t*>(levels->base_corners().data()),
                                {rows(levels->base_corners().size())}),
                        view_of(levels, reinterpret_cast<const std::uint32_t*>(levels->splits().data()),
                                {rows(levels->splits().size()), kSplitFields}),
                        static_cast<int>(levels->finest_level()));
}

ProgressiveHull levels_of_parts(const py::tuple& parts) {
  ProgressiveHull levels(parts[0].cast<bool>() ? HullSide::Inner : HullSide::Outer, parts[1].cast<std::size_t>(),
                         PerVertex<Vec3>(copied<Vec3>(parts[2].cast<Array<double>>())),
                         copied<VertexId>(parts[3].cast<Array<std::uint32_t>>()),
                         copied<VertexSplit>(parts[4].cast<Array<std::uint32_t>>()));
  if (const auto defect = first_defect(levels)) throw InputError(Defect::Malformed, "pickled hull: " + *defect);
  const FinestLevel finest{parts[5].cast<int>()};
  if (std::ranges::none_of(finest_level_names(), [&](const auto& named) { return named.second == finest; }))
    throw InputError(Defect::Malformed, "pickled hull: there is no such finest level");
  return levels.with_finest_level(finest);
}

}  // namespace

void bind_meshes(py::module_& module) {
  py::class_<TriangleMesh, SharedMesh>(module, "Mesh")
      .def(py::init(&mesh_of))
      .def_property_readonly("vertices", &vertices_of)
      .def_property_readonly("faces", &faces_of)
      .def_property_readonly("volume", &signed_volume, Release())
      .def_property_readonly(
          "diagonal", [](const TriangleMesh& mesh) { return finite_bounding_box(mesh).diagonal(); }, Release())
      .def("report", &facts_of)
      .def(
          "is_symmetric",
          [](const TriangleMesh& mesh, const std::string& mirror) {
            return inspect_symmetry(mesh, value_of(axis_names(), mirror).value()).is_symmetric();
          },
          Release())
      .def(
          "write", [](const TriangleMesh& mesh, const std::filesystem::path& path) { write_mesh(path, mesh); },
          Release())
      .def("__reduce__", [](const SharedMesh& mesh) {
        return py::make_tuple(py::type::of<TriangleMesh>(), py::make_tuple(vertices_of(mesh), faces_of(mesh)));
      });

  py::class_<ProgressiveHull, SharedLevels>(module, "Levels")
      .def_property_readonly("is_inner", [](const ProgressiveHull& levels) { return levels.side() == HullSide::Inner; })
      .def_property_readonly("finest_level",
                             [](const ProgressiveHull& levels) {
                               return std::string(name_of(finest_level_names(), levels.finest_level()));
                             })
      .def_property_readonly("base_face_count", &ProgressiveHull::base_face_count)
      .def_property_readonly("original_face_count", &ProgressiveHull::original_face_count)
      .def("level", &ProgressiveHull::level, Release())
      .def(
          "symmetric_faces",
          [](const ProgressiveHull& levels, const std::string& mirror, std::size_t faces) {
            return symmetric_faces(levels, value_of(axis_names(), mirror).value(), faces);
          },
          Release())
      .def(
          "save", [](const ProgressiveHull& levels, const std::filesystem::path& path) { save_hull(path, levels); },
          Release())
      .def(py::init(&levels_of_parts))
      .def("__reduce__", [](const SharedLevels& levels) {
        return py::make_tuple(py::type::of<ProgressiveHull>(), py::make_tuple(parts_of(levels)));
      });

  module.def("read", &read);
  module.def("stores_float32", [](const std::filesystem::path& path) { return stores_float32(mesh_format(path)); });
  module.def("is_hull_file", [](const std::filesystem::path& path) { return is_hull_file(path); });
  module.def(
      "load", [](const std::filesystem::path& path) { return load_hull(path); }, Release());
  module.def(
      "sample", [](const std::string& name, std::size_t faces) { return make_sample(name, faces); }, Release());
}

}  // namespace prohull::python

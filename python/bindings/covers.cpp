#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.h"
#include "keywords.h"
#include "module.h"
#include "prohull/convex_cover.h"
#include "prohull/detail/given_options.h"
#include "prohull/detail/told_notes.h"
#include "prohull/mesh_io.h"
#include "prohull/sphere_cover.h"
#include "prohull/union_verification.h"
#include "robot/files/piece_files.h"
#include "robot/files/sphere_file.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

/// The name of its class in Python, and the values of its fields; None if the piece is none of them.
struct PrimitiveFacts {
  py::object operator()(std::monostate) const { return py::none(); }
  py::object operator()(const OrientedBox& box) const {
    std::vector<double> axes;
    for (const Vec3& axis : box.axes) axes.insert(axes.end(), {axis.x, axis.y, axis.z});
    return py::make_tuple("box", point_of(box.center), array_of(std::move(axes), {3, 3}), point_of(box.half_sizes));
  }
  py::object operator()(const Capsule& c) const {
    return py::make_tuple("capsule", point_of(c.a), point_of(c.b), c.radius);
  }
  py::object operator()(const Ball& ball) const { return py::make_tuple("sphere", point_of(ball.center), ball.radius); }
};

/// What both kinds of covers tell.
template <class Cover>
py::dict common_facts_of(const Cover& cover) {
  py::dict facts;
  facts["verdict"] = verdict_facts(cover.verdict);
  facts["volume"] = cover.volume;
  facts["original_volume"] = cover.original_volume;
  facts["within_bounds"] = cover.within_bounds;
  facts["notes"] = told_notes(cover);
  facts["seconds"] = cover.seconds;
  facts["verify_seconds"] = cover.verify_seconds;
  return facts;
}

py::dict convex_pieces(const TriangleMesh& mesh, const py::object& progress, const py::dict& keywords) {
  ConvexCover cover = watched(progress, convex_cover_options(Keywords(keywords)),
                              [&](const auto& how) { return convex_cover(mesh, how); });
  py::dict facts = common_facts_of(cover);
  facts["pieces"] = list_of(cover.pieces, [](ConvexPiece& piece) {
    return py::make_tuple(std::move(piece.mesh), std::visit(PrimitiveFacts(), piece.primitive));
  });
  return facts;
}

py::dict spheres(const TriangleMesh& mesh, const py::object& progress, const py::dict& keywords) {
  const SphereCover cover = watched(progress, sphere_cover_options(Keywords(keywords)),
                                    [&](const auto& how) { return sphere_cover(mesh, how); });
  py::dict facts = common_facts_of(cover);
  facts["balls"] = rows_of_balls(cover.balls);
  return facts;
}

py::dict facts_of(const UnionVerification& found) {
  py::dict facts = verdict_facts(found);
  facts["faces_outside"] = found.faces_outside;
  facts["worst"] = offenders_of(found.worst);
  facts["faces_undecided"] = found.faces_undecided;
  facts["inside_undecided"] = found.inside_undecided;
  facts["holes"] = found.holes;
  facts["turned_pieces"] = found.turned_pieces;
  facts["union_volume"] = found.union_volume;
  facts["original_volume"] = found.original_volume;
  facts["void_ratio"] = found.void_ratio;
  facts["notes"] = found.notes;
  return facts;
}

py::dict verify_pieces(const std::vector<TriangleMesh>& pieces, const TriangleMesh& original, bool solid_only,
                       bool finite_only, std::size_t steps, const py::object& progress) {
  const VerificationOptions options{.solid_only = solid_only, .finite_only = finite_only, .max_steps = steps};
  return facts_of(watched(progress, options, [&](const auto& how) { return verify_union(pieces, original, how); }));
}

py::dict verify_balls(const Array<double>& rows, const TriangleMesh& original, bool inside, bool solid_only,
                      bool finite_only, std::size_t steps, const py::object& progress) {
  const std::vector<Ball> balls = balls_of(rows);
  const VerificationOptions options{.solid_only = solid_only, .finite_only = finite_only, .max_steps = steps};
  return facts_of(
      watched(progress, options, [&](const auto& how) { return verify_union(balls, original, inside, how); }));
}

void write_pieces(const std::filesystem::path& path, const std::vector<TriangleMesh>& pieces) {
  write_meshes(path, pieces, robot::piece_names(path.stem().string(), pieces.size()));
}

std::string sphere_file(const std::string& link, const Array<double>& rows) {
  const robot::LinkBalls balls{link, balls_of(rows)};
  return robot::sphere_file({&balls, 1});
}

}  // namespace

void bind_covers(py::module_& module) {
  module.def("convex_pieces", &convex_pieces);
  module.def("spheres", &spheres);
  module.def("verify_pieces", &verify_pieces);
  module.def("verify_balls", &verify_balls);
  module.def("write_pieces", &write_pieces, py::call_guard<py::gil_scoped_release>());
  module.def("sphere_file", &sphere_file);
  module.attr("piece_shapes") = tuple_of(piece_shape_names());
}

}  // namespace prohull::python

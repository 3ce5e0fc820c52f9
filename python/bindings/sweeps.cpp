#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "keywords.h"
#include "module.h"
#include "prohull/detail/given_options.h"
#include "prohull/detail/query_io.h"
#include "prohull/error.h"
#include "prohull/sweep.h"
#include "robot/files/robot_file.h"
#include "robot/motion/kinematics.h"
#include "robot/motion/path_sweep.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

using Motions = std::vector<RigidMotion>;

py::dict facts_of(Sweep sweep) {
  py::dict facts;
  facts["pieces"] = list_of(sweep.pieces, [](TriangleMesh& piece) { return std::move(piece); });
  facts["verdict"] = verdict_facts(sweep.verdict);
  facts["fills_cavities"] = sweep.fills_cavities;
  facts["cover_pieces"] = sweep.cover_pieces;
  facts["notes"] = sweep.notes;
  return facts;
}

using Numbers = std::array<double, 3>;
Vec3 vector_of(const Numbers& n) { return {n[0], n[1], n[2]}; }

Motions turn(const Numbers& axis, const Numbers& through, double angle, const Numbers& shift) {
  return {{.through = vector_of(through), .axis = vector_of(axis), .angle = angle, .shift = vector_of(shift)}};
}

using MotionsAndNotes = std::pair<Motions, std::vector<std::string>>;

/// Of matrices, shape (n, 16).
MotionsAndNotes motions_of(const Array<double>& rows) {
  std::vector<Pose> poses;
  robot::Correction correction;
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) poses.push_back(correction(pose_of(rows.data(i, 0))));
  return {robot::motions_between(poses), correction.notes()};
}

MotionsAndNotes read_motions(const std::string& text, const std::string& file) {
  robot::Correction correction;
  const std::vector<Pose> poses = read_poses(text, file, std::ref(correction));
  if (poses.empty()) throw InputError(Defect::Malformed, file + ": there are no poses");
  return {robot::motions_between(poses), correction.notes()};
}

py::dict sweep_mesh(const TriangleMesh& mesh, const Motions& motions, const py::object& progress,
                    const py::dict& keywords) {
  SweepOptions options = sweep_options(Keywords(keywords));
  Sweep made = watched(progress, options, [&](const auto& how) { return sweep(mesh, motions, how); });
  const double volume = made.volume, volume_error = made.volume_error;
  py::dict facts = facts_of(std::move(made));
  facts["volume"] = volume;
  facts["volume_error"] = volume_error;
  return facts;
}

/// (name of the link, facts) of each.
py::list facts_of(std::vector<robot::LinkSweep> made) {
  return list_of(made,
                 [](robot::LinkSweep& link) { return py::make_tuple(link.link, facts_of(std::move(link.sweep))); });
}

robot::Geometry geometry(bool visual) { return visual ? robot::Geometry::Visual : robot::Geometry::Collision; }

py::list sweep_robot(const robot::RobotFile& file, robot::PathRows rows, const std::vector<std::size_t>& links,
                     bool visual, const py::object& progress, const py::dict& keywords) {
  SweepOptions options = sweep_options(Keywords(keywords));
  const robot::JointPath path(file.robot, std::move(rows));
  return facts_of(watched(
      progress, options, [&](const auto& how) { return sweep_links(file.robot, path, links, geometry(visual), how); }));
}

py::list sweep_workspace(const robot::RobotFile& file, const std::vector<std::size_t>& links, bool visual,
                         const py::object& progress, const py::dict& keywords) {
  SweepOptions options = sweep_options(Keywords(keywords));
  return facts_of(watched(progress, options, [&](const auto& how) {
    return robot::sweep_workspace(file.robot, links, geometry(visual), how);
  }));
}

}  // namespace

void bind_sweeps(py::module_& module) {
  py::class_<RigidMotion>(module, "RigidMotion");
  module.def("turn", &turn);
  module.def("motions_of", &motions_of);
  module.def("read_motions", &read_motions);
  module.def("sweep", &sweep_mesh);
  module.def("sweep_robot", &sweep_robot);
  module.def("sweep_workspace", &sweep_workspace);
}

}  // namespace prohull::python

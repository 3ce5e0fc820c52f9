#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "module.h"
#include "prohull/detail/refuse.h"
#include "robot/files/robot_file.h"
#include "robot/motion/kinematics.h"
#include "robot/motion/motion.h"
#include "robot/motion/path_proof.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

using namespace prohull::robot;

/// The bodies of a robot and its world, ready for paths.
struct PathChecker {
  std::shared_ptr<RobotFile> file;
  PathBodies made;
  std::vector<BodyPair> pairs;
};

using Names = std::vector<std::pair<std::string, std::string>>;

std::shared_ptr<PathChecker> checker_of(const std::shared_ptr<RobotFile>& file,
                                        const std::vector<std::pair<std::string, SharedMesh>>& world,
                                        const std::string& geometry, const std::string& srdf,
                                        const std::string& srdf_name, const Names& ignored) {
  return watched(py::none(), [&](Watch& watch) {
    std::vector<WorldMesh> meshes;
    for (const auto& [name, mesh] : world) meshes.push_back({name, *mesh});
    const Geometry which = geometry == "visual" ? Geometry::Visual : Geometry::Collision;
    auto checker =
        std::make_shared<PathChecker>(PathChecker{file, path_bodies(file->robot, which, meshes, watch.progress()), {}});
    Srdf read;
    if (!srdf_name.empty()) read = read_srdf(file->robot, srdf, srdf_name);
    checker->made.notes.insert(checker->made.notes.end(), read.notes.begin(), read.notes.end());
    checker->pairs = pairs_on_path(file->robot, checker->made.bodies, read.pairs(), ignored);
    return checker;
  });
}

py::dict facts_of(const PathChecker& checker, const JointPath& path, const PathPairProof& pair) {
  py::dict positions, facts;
  for (const auto& [name, position] : named_positions(checker.file->robot, pair.positions))
    positions[py::str(name)] = position;
  facts["a"] = checker.made.bodies[pair.a].name;
  facts["b"] = checker.made.bodies[pair.b].name;
  facts["verdict"] = std::string(name_of(pair.verdict));
  facts["why"] = pair.why;
  facts["begin"] = path.time_at(pair.begin);
  facts["end"] = path.time_at(pair.end);
  facts["positions"] = positions;
  facts["faces"] = py::make_tuple(index(pair.faces.a), index(pair.faces.b));
  return facts;
}

py::object facts_of(const Robot& robot, const std::optional<BeyondLimits>& beyond) {
  if (!beyond) return py::none();
  return py::make_tuple(beyond->row(), robot.joints[beyond->joint].name, beyond->position);
}

py::object beyond_limits(const RobotFile& file, PathRows rows) {
  return facts_of(file.robot, first_beyond_limits(file.robot, JointPath(file.robot, std::move(rows))));
}

py::dict facts_of(const PathChecker& checker, const JointPath& path, const PathProof& proof) {
  py::list pairs;
  for (const PathPairProof& pair : proof.pairs)
    if (pair.verdict != PathVerdict::Free) pairs.append(facts_of(checker, path, pair));
  std::vector<double> times, distances;
  for (const DistanceBound& part : proof.curve) {
    times.insert(times.end(), {path.time_at(part.begin), path.time_at(part.end)});
    distances.push_back(part.distance);
  }
  const auto parts = static_cast<py::ssize_t>(distances.size());
  py::dict facts;
  facts["verdict"] = std::string(name_of(proof.verdict()));
  facts["free_until"] = path.time_at(proof.free_until());
  facts["pairs"] = pairs;
  facts["beyond_limits"] = facts_of(checker.file->robot, first_beyond_limits(checker.file->robot, path));
  facts["cells"] = proof.cells();
  facts["intervals"] = array_of(std::move(times), {parts, 2});
  facts["distances"] = array_of(std::move(distances), {parts});
  return facts;
}

py::dict proof_of(const PathChecker& checker, PathRows rows, const PathProofOptions& options,
                  const py::object& progress) {
  if (checker.pairs.empty()) refuse("there is no pair of bodies that could meet: all are adjacent, or ignored");
  const JointPath path(checker.file->robot, std::move(rows));
  const std::vector<PathProof> proofs = watched(progress, options, [&](const auto& how) {
    return prove_paths(checker.file->robot, {&path, 1}, checker.made.bodies, checker.pairs, how);
  });
  return facts_of(checker, path, proofs.front());
}

}  // namespace

void bind_paths(py::module_& module) {
  py::class_<PathRows>(module, "PathRows")
      .def(py::init([](std::vector<std::string> joints, std::vector<std::vector<double>> positions,
                       std::vector<double> times, std::vector<std::vector<double>> velocities,
                       std::vector<std::vector<double>> accelerations) {
        PathRows rows{std::move(joints), std::move(times), std::move(positions), std::move(velocities),
                      std::move(accelerations)};
        rows.file = "path";
        return rows;
      }));
  module.def("beyond_limits", &beyond_limits);
  py::class_<PathChecker, std::shared_ptr<PathChecker>>(module, "PathChecker")
      .def(py::init(&checker_of))
      .def_property_readonly("notes", [](const PathChecker& checker) { return checker.made.notes; })
      .def_property_readonly("pairs",
                             [](const PathChecker& checker) {
                               Names names;
                               for (const auto& [a, b] : checker.pairs)
                                 names.emplace_back(checker.made.bodies[a].name, checker.made.bodies[b].name);
                               return names;
                             })
      .def("prove", [](const PathChecker& checker, const PathRows& rows, double gap, std::size_t cells, bool distances,
                       unsigned threads, const py::object& progress) {
        return proof_of(checker, rows, {.gap = gap, .cells = cells, .distances = distances, .threads = threads},
                        progress);
      });
  module.def("read_path_rows", &read_path_rows);
}

}  // namespace prohull::python

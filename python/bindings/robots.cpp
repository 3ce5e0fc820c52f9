#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "module.h"
#include "prohull/detail/refuse.h"
#include "robot/check/check.h"
#include "robot/check/disabled_pairs.h"
#include "robot/files/robot_file.h"
#include "robot/hulls/budgets.h"
#include "robot/hulls/link_hulls.h"
#include "robot/hulls/write_robot.h"
#include "robot/motion/bodies.h"
#include "robot/motion/kinematics.h"
#include "robot/motion/motion.h"
#include "robot/motion/mujoco_files.h"
#include "robot/report/pictures.h"
#include "robot/report/report.h"
#include "view/shown_robot.h"
#include "watch.h"

namespace py = pybind11;

namespace prohull::python {
namespace {

using namespace prohull::robot;

using SharedFile = std::shared_ptr<RobotFile>;

SharedMesh shared(TriangleMesh mesh) { return std::make_shared<TriangleMesh>(std::move(mesh)); }

/// Matrices of 4 x 4.
py::array matrices(const std::vector<Pose>& poses) {
  std::vector<double> values;
  for (const Pose& pose : poses) {
    for (int i = 0; i < 3; ++i) {
      const Vec3& row = pose.rotation[std::size_t(i)];
      values.insert(values.end(), {row.x, row.y, row.z, pose.translation[i]});
    }
    values.insert(values.end(), {0, 0, 0, 1});
  }
  return array_of(std::move(values), {static_cast<py::ssize_t>(poses.size()), 4, 4});
}

py::object matrix(const Pose& pose) { return matrices({pose})[py::int_(0)]; }

Geometry geometry_called(const std::string& name) {
  if (const auto geometry = value_of(geometry_names(), name)) return *geometry;
  refuse("geometry '" + name + "': expected visual or collision");
}

SharedFile read(const std::filesystem::path& path, std::vector<std::filesystem::path> package_paths) {
  return watched(py::none(), [&](Watch&) {
    return std::make_shared<RobotFile>(read_robot(path, {.package_paths = std::move(package_paths)}));
  });
}

py::list joints_of(const RobotFile& file) {
  return list_of(file.robot.joints, [&](const Joint& joint) {
    py::dict facts;
    facts["name"] = joint.name;
    facts["type"] = prohull::name_of(joint_type_names(), joint.type);
    facts["parent"] = file.robot.links[joint.parent].name;
    facts["child"] = file.robot.links[joint.child].name;
    facts["origin"] = matrix(joint.origin);
    facts["axis"] = py::make_tuple(joint.axis.x, joint.axis.y, joint.axis.z);
    facts["lower"] = joint.lower;
    facts["upper"] = joint.upper;
    facts["mimics"] = joint.mimic ? py::object(py::str(file.robot.joints[joint.mimic->joint].name)) : py::none();
    return facts;
  });
}

std::vector<std::string> link_names(const RobotFile& file) {
  std::vector<std::string> names;
  for (const Link& link : file.robot.links) names.push_back(link.name);
  return names;
}

SharedMesh link_mesh(const RobotFile& file, std::size_t link, const std::string& which) {
  return watched(py::none(), [&](Watch&) {
    return shared(link_triangles(shapes(file.robot.links.at(link), geometry_called(which)), Frame{}));
  });
}

py::array poses_of(const RobotFile& file, const std::vector<double>& positions) {
  return matrices(link_poses(file.robot, positions));
}

/// Hulls of a robot, and what they were made with.
struct RobotHulls {
  SharedFile file;
  LinkHullOptions options;
  std::vector<LinkHulls> links;
};

LinkHullOptions options_of(const Robot& robot, const py::dict& given) {
  LinkHullOptions options;
  options.from = geometry_called(given["from"].cast<std::string>());
  options.budget.collision = *value_of(collision_names(), given["collision"].cast<std::string>());
  options.budget.faces = given["faces"].cast<std::vector<std::size_t>>();
  options.budget.pieces = given["pieces"].cast<std::size_t>();
  options.budget.vertices = given["vertices"].cast<std::size_t>();
  options.budget.spheres = given["spheres"].cast<std::size_t>();
  options.budget.max_distance = given["max_distance"].cast<double>();
  options.budget.padding = given["gap"].cast<double>();
  options.tight = given["tight"].cast<bool>();
  options.skip_missing = given["skip_missing"].cast<bool>();
  options.threads = given["threads"].cast<unsigned>();
  if (!given["cache"].is_none()) options.cache = given["cache"].cast<std::filesystem::path>();
  if (!given["budgets"].is_none())
    read_budgets(given["budgets"].cast<std::string>(), given["budgets_name"].cast<std::string>(), robot, options);
  return options;
}

std::shared_ptr<RobotHulls> hulls_of(const SharedFile& file, const py::dict& given, const py::object& progress) {
  auto made = std::make_shared<RobotHulls>(RobotHulls{file, options_of(file->robot, given), {}});
  made->links = watched(progress, made->options, [&](const auto& how) { return link_hulls(file->robot, how); });
  return made;
}

py::dict facts_of(const LinkHull& hull, const LinkHulls& link) {
  py::dict facts;
  facts["target_faces"] = hull.target_faces;
  facts["mesh"] = shared(hull.mesh);
  facts["pieces"] = list_of(hull.pieces, shared);
  facts["spheres"] = rows_of_balls(hull.balls);
  facts["origin"] = matrix(link.frame.in_link);
  facts["verdict"] = verdict_facts(hull.verdict);
  facts["target_reached"] = hull.target_reached;
  facts["within_bounds"] = hull.within_bounds;
  facts["source"] = hull.source;
  facts["volume_ratio"] = link.sealed_volume > 0 ? hull.volume / link.sealed_volume : NAN;
  facts["volume_ratio_is_estimated"] = link.is_estimated;
  facts["self_intersections"] = hull.self_intersections;
  facts["notes"] = hull.notes;
  return facts;
}

py::list facts_of(const RobotHulls& hulls) {
  return list_of(hulls.links, [&](const LinkHulls& link) {
    py::dict facts;
    facts["name"] = hulls.file->robot.links[link.link].name;
    facts["status"] = std::string(name_of(link.status));
    facts["why"] = link.why;
    facts["hulls"] = list_of(link.hulls, [&](const LinkHull& hull) { return facts_of(hull, link); });
    facts["repairs"] = link.repairs;
    facts["non_finite_faces"] = link.non_finite_faces;
    facts["seconds"] = link.seconds;
    facts["from_cache"] = link.from_cache;
    return facts;
  });
}

/// (path, a function that writes the file to a path) of each file.
py::list files_of(const std::shared_ptr<RobotHulls>& hulls, const std::filesystem::path& folder,
                  const std::string& format, const std::string& package, bool to_mjcf) {
  const WriteOptions how{.faces = hulls->options.budget.faces,
                         .from = hulls->options.from,
                         .format = format,
                         .package = package,
                         .to_mjcf = to_mjcf};
  const RobotFiles made = output_files(*hulls->file, hulls->links, folder, how);
  std::vector<OutputFile> all = made.files;
  if (to_mjcf)
    std::ranges::move(mujoco_files(*hulls->file, made, adjacent_pairs(hulls->file->robot)).files,
                      std::back_inserter(all));
  return list_of(all, [&](const OutputFile& file) {
    return py::make_tuple(file.path, py::cpp_function([hulls, write = file.write](const std::filesystem::path& to) {
                            const py::gil_scoped_release released;
                            write(to);
                          }));
  });
}

py::dict facts_of(const RobotFile& file, const LinkCheck& check, double allow) {
  py::dict facts;
  facts["name"] = file.robot.links[check.link].name;
  facts["verdict"] = std::string(name_of(check.verdict));
  facts["passes"] = passes(check, allow);
  facts["sticks_out_at_least"] = check.sticks_out_at_least;
  facts["sticks_out_at_most"] = check.sticks_out_at_most;
  facts["worst_point"] = py::none();
  if (const Vec3& p = check.worst_point; check.sticks_out_at_least > 0)
    facts["worst_point"] = py::make_tuple(p.x, p.y, p.z);
  facts["faces_outside"] = check.faces_outside;
  facts["volume_ratio"] = check.visual_volume > 0 ? check.collision_volume / check.visual_volume : NAN;
  facts["volume_ratio_is_estimated"] = check.is_estimated;
  facts["distance_bound"] = check.reach.upper;
  facts["mean_distance"] = check.mean_distance;
  facts["notes"] = check.notes;
  return facts;
}

struct RobotChecks {
  std::vector<LinkCheck> links;
};

/// The checks themselves for reports, and their facts.
py::tuple check_of(const SharedFile& file, double allow, unsigned threads, const py::object& progress) {
  auto checks = std::make_shared<RobotChecks>(RobotChecks{watched(
      progress, CheckOptions{.threads = threads}, [&](const auto& how) { return check_links(file->robot, how); })});
  return py::make_tuple(checks,
                        list_of(checks->links, [&](const LinkCheck& check) { return facts_of(*file, check, allow); }));
}

py::tuple facts_of(const Robot& robot, const PairProof& proof) {
  py::dict positions;
  for (const auto& [name, position] : named_positions(robot, proof.positions)) positions[py::str(name)] = position;
  return py::make_tuple(std::string(name_of(proof.verdict)), proof.why, proof.proven_free, proof.cells, positions);
}

py::object facts_of(const Robot& robot, const MotionPair& pair) {
  if (!pair.proof) return py::none();
  return facts_of(robot, *pair.proof) + py::make_tuple(pair.visual_meets_at_witness);
}

/// Notes, and (link1, link2, reason, line, whether it is refuted, what is proven of the collision geometry, of the
/// visual one) of each row.
py::tuple disabled_pairs_of(const RobotFile& file, const std::string& srdf, const std::string& name, std::size_t cells,
                            unsigned threads, const py::object& progress) {
  const Srdf read = read_srdf(file.robot, srdf, name);
  const std::vector<DisabledCheck> checks = watched(progress, [&](Watch& watch) {
    return check_disabled_pairs(file.robot, read.rows,
                                {.cells = cells, .threads = threads, .progress = watch.progress()});
  });
  return py::make_tuple(read.notes, list_of(checks, [&](const DisabledCheck& check) {
                          return py::make_tuple(check.row.link1, check.row.link2, check.row.reason, check.row.line,
                                                check.is_refuted(), facts_of(file.robot, check.collision),
                                                facts_of(file.robot, check.visual));
                        }));
}

py::tuple motion_of(const RobotHulls& hulls, std::size_t configurations, std::uint64_t seed, bool sampled_pairs,
                    std::size_t prove, unsigned threads, const py::object& progress) {
  const Robot& robot = hulls.file->robot;
  const auto motion = watched(progress, [&](Watch& watch) {
    const Bodies bodies = bodies_of(robot, hulls.links, hulls.options.from);
    auto result = std::make_shared<MotionResult>(check_motion(
        robot, bodies,
        {.configurations = configurations, .seed = seed, .threads = threads, .progress = watch.progress()}));
    if (prove > 0)
      add_proofs(robot, bodies, {.cells = prove, .threads = threads, .progress = watch.progress()}, *result);
    return result;
  });
  const py::list pairs = list_of(motion->pairs, [&](const MotionPair& pair) {
    return py::make_tuple(robot.links[pair.a].name, robot.links[pair.b].name, std::string(name_of(pair.kind)),
                          pair.visual, pair.hull, pair.convex, pair.false_hull, pair.false_convex, pair.missed,
                          facts_of(robot, pair));
  });
  return py::make_tuple(motion, pairs, srdf_of(robot, *motion, sampled_pairs));
}

std::string html_of(const RobotHulls& hulls, const RobotChecks* shipped, double allow, const MotionResult* motion,
                    unsigned threads, const py::object& progress) {
  ReportInput input{.file = *hulls.file,
                    .hulls = hulls.links,
                    .shipped = {},
                    .motion = {},
                    .allow = allow,
                    .version = PROHULL_VERSION,
                    .from = hulls.options.from};
  if (shipped) input.shipped = shipped->links;
  if (motion) input.motion = *motion;
  sign(input);
  return watched(progress, PageOptions{.threads = threads}, [&](const auto& how) { return report_html(input, how); });
}

using SharedShown = std::shared_ptr<view::ShownRobot>;

SharedShown shown_as_shipped(const RobotFile& file) {
  return watched(py::none(), [&](Watch& watch) {
    return std::make_shared<view::ShownRobot>(view::as_shipped(file.robot, watch.progress()));
  });
}

SharedShown shown_with_hulls(const RobotHulls& hulls) {
  return watched(py::none(), [&](Watch& watch) {
    return std::make_shared<view::ShownRobot>(
        view::with_hulls(hulls.file->robot, hulls.links, hulls.options.from, watch.progress()));
  });
}

void add(TriangleMesh& mesh, TriangleMesh part, const Pose& pose) { append(mesh, placed(pose, std::move(part))); }

/// The robot in a pose: its geometry, within its hulls if there are any.
py::bytes picture_of(const RobotFile& file, const RobotHulls* hulls, const std::vector<double>& positions, int width,
                     int height) {
  return watched(py::none(), [&](Watch& watch) {
    const Robot& robot = file.robot;
    const std::vector<Pose> poses = link_poses(robot, positions);
    Picture picture;
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      if (hulls) {
        const LinkHulls& link = hulls->links[i];
        const Pose at = poses[i];
        add(picture.inside, placed(link.frame.in_link, link.triangles), at);
        if (!link.hulls.empty()) add(picture.around, placed(link.frame.in_link, link.hulls[0].mesh), at);
      } else {
        std::vector<Shape> found;
        for (const Shape& shape : robot.links[i].visual)
          if (!shape.mesh() || !shape.mesh()->path.empty()) found.push_back(shape);
        add(picture.inside, link_triangles(found, Frame{}), poses[i]);
      }
    }
    return draw_pictures({&picture, 1}, {.width = width, .height = height, .progress = watch.progress()})[0];
  });
}

}  // namespace

void bind_robots(py::module_& module) {
  py::class_<RobotFile, SharedFile>(module, "Robot")
      .def_property_readonly("name", [](const RobotFile& file) { return file.robot.name; })
      .def_property_readonly("notes", [](const RobotFile& file) { return file.notes; })
      .def_property_readonly("link_names", &link_names)
      .def_property_readonly("joints", &joints_of)
      .def("link_mesh", &link_mesh)
      .def("has_shape",
           [](const RobotFile& file, std::size_t link) {
             return !file.robot.links[link].visual.empty() || !file.robot.links[link].collision.empty();
           })
      .def("poses", &poses_of)
      .def("hulls", &hulls_of)
      .def("check", &check_of)
      .def("disabled_pairs", &disabled_pairs_of)
      .def("shown", &shown_as_shipped)
      .def("picture", [](const RobotFile& file, const std::vector<double>& positions, int width, int height) {
        return picture_of(file, nullptr, positions, width, height);
      });
  py::class_<RobotHulls, std::shared_ptr<RobotHulls>>(module, "RobotHulls")
      .def_property_readonly("links", [](const RobotHulls& hulls) { return facts_of(hulls); })
      .def("files", &files_of)
      .def("motion", &motion_of)
      .def("report_html", &html_of)
      .def("shown", &shown_with_hulls)
      .def("picture", [](const RobotHulls& hulls, const std::vector<double>& positions, int width, int height) {
        return picture_of(*hulls.file, &hulls, positions, width, height);
      });
  py::class_<RobotChecks, std::shared_ptr<RobotChecks>>(module, "RobotChecks");
  py::class_<MotionResult, std::shared_ptr<MotionResult>>(module, "RobotMotion");
  module.def("read_robot", &read);
  module.def("is_robot_file", &is_robot_file);
}

}  // namespace prohull::python

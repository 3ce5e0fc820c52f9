#include "prohull/sweep.h"
#include "prohull/detail/rounded.h"
#include "prohull/detail/verdict_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "command.h"
#include "prohull/detail/query_io.h"
#include "prohull/enclosing_hull.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "robot/files/piece_files.h"
#include "robot/motion/kinematics.h"
#include "robot/motion/path_sweep.h"
#include "robot_summary.h"
#include "verdict.h"

namespace prohull::cli {
namespace {

using namespace prohull::robot;
using std::filesystem::path;

struct SweepRunOptions {
  path in, joint_path, out, report, poses;
  std::string out_format, axis, through, move, links;
  std::optional<double> degrees;
  std::size_t faces = 0;  ///< 0: pieces
  Length max_distance;
  InputOptions input;
  robot::FileOptions file;
  Geometry geometry = Geometry::Collision;
  bool workspace = false;
  SweepOptions sweep;
};

/// What was swept, and what encloses it.
struct SweptZone {
  std::vector<LinkSweep> sweeps;  ///< of a mesh one, without a name
  std::optional<EnclosingHull> hull;
  Verdict verdict;                         ///< of all together, as the file holds it
  nlohmann::json input;                    ///< facts of what was read
  nlohmann::json beyond_limits = nullptr;  ///< of the path of a robot
  double read_seconds = 0, seconds = 0;

  std::vector<TriangleMesh> pieces() const {
    std::vector<TriangleMesh> all;
    for (const LinkSweep& link : sweeps) all.insert(all.end(), link.sweep.pieces.begin(), link.sweep.pieces.end());
    return all;
  }
  bool fills_cavities() const {
    return std::ranges::any_of(sweeps, [](const LinkSweep& link) { return link.sweep.fills_cavities; });
  }
};

/// Of all sweeps together, and of the hull if there is one.
Verdict verdict_of(const SweptZone& zone, const TriangleMesh& pieces) {
  Verdict verdict = zone.sweeps[0].sweep.verdict;
  for (std::size_t i = 1; i < zone.sweeps.size(); ++i) verdict = both(std::move(verdict), zone.sweeps[i].sweep.verdict);
  if (!zone.hull) return verdict;
  verdict.certified = zone.hull->certified;
  return farther_by(std::move(verdict), distance_bounds(zone.hull->mesh, pieces).upper);
}

Vec3 axis_of(const std::string& text) {
  constexpr Vec3 kAxes[]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto named = value_of(axis_names(), text);
  return named ? kAxes[static_cast<std::size_t>(*named)] : vector_of(text, "axis");
}

std::vector<RigidMotion> motions_of(const SweepRunOptions& options, Correction& correction) {
  if (!options.poses.empty())
    return motions_between(
        require_some(read_poses(read_bytes(options.poses), input_name(options.poses), std::ref(correction)), "poses",
                     options.poses));
  const double degrees = options.degrees.value_or(0);
  if (!options.degrees && options.move.empty()) refuse("how does it move? Say --angle, --move or --poses");
  RigidMotion motion{.angle = degrees * kDegree};
  if (!options.axis.empty()) motion.axis = axis_of(options.axis);
  if (!options.through.empty()) motion.through = vector_of(options.through, "point");
  if (!options.move.empty()) motion.shift = vector_of(options.move, "vector");
  if (degrees == 0 && motion.shift == Vec3{})
    refuse(fmt::format("with {} it does not move", options.move.empty() ? "--angle 0" : "--move " + options.move));
  return {motion};
}

LinkSweep sweep_of_mesh(const SweepRunOptions& options, SweepOptions how, SweptZone& zone) {
  Correction correction;
  const std::vector<RigidMotion> motions = motions_of(options, correction);
  InputMesh in = read_given(options.in, options.input);
  zone.read_seconds = in.seconds;
  zone.input = {{"faces", in.mesh.face_count()}, {"diagonal", finite_bounding_box(in.mesh).diagonal()}};
  in.unit.set(how.max_distance, options.max_distance, "--max-distance");
  return naming(options.in, [&] {
    LinkSweep made{"", sweep(std::move(in.mesh), motions, how)};
    for (std::string& note : correction.notes()) made.sweep.notes.push_back(std::move(note));
    return made;
  });
}

std::vector<std::size_t> links_of(const Robot& robot, const std::string& names) {
  std::vector<std::size_t> links(robot.links.size());
  std::iota(links.begin(), links.end(), std::size_t{0});
  if (names.empty()) return links;
  links.clear();
  for (const std::string& name : CLI::detail::split(names, ',')) {
    const auto found = std::ranges::find(robot.links, name, &Link::name);
    if (found == robot.links.end()) refuse(fmt::format("--links: the robot has no link '{}'", name));
    if (found->visual.empty() && found->collision.empty()) refuse(fmt::format("--links: '{}' has no shape", name));
    links.push_back(static_cast<std::size_t>(found - robot.links.begin()));
  }
  return links;
}

std::vector<LinkSweep> sweeps_of_robot(const SweepRunOptions& options, SweepOptions how, SweptZone& zone) {
  if (options.joint_path.empty() && !options.workspace)
    refuse("a robot needs a PATH of its joints, as in prohull sweep ROBOT PATH -o OUT, or --workspace");
  const Stopwatch reading;
  const RobotFile file = read_robot(options.in, options.file);
  std::optional<JointPath> path;
  if (!options.workspace)
    path.emplace(file.robot, read_path_rows(read_bytes(options.joint_path), input_name(options.joint_path)));
  zone.read_seconds = reading.seconds();
  zone.input = {{"robot", file.robot.name}};
  const Length& most = options.max_distance;
  if (most.unit == "%") refuse("--max-distance of a robot is in metres, or has a unit: 5mm");
  if (most.number > 0) how.max_distance = most.of(0);
  const std::vector<std::size_t> links = links_of(file.robot, options.links);
  std::vector<LinkSweep> sweeps = path ? sweep_links(file.robot, *path, links, options.geometry, how)
                                       : sweep_workspace(file.robot, links, options.geometry, how);
  if (sweeps.empty()) throw InputError(Defect::EmptyMesh, fmt::format("{}: no link has a shape", options.in.string()));
  if (path) zone.beyond_limits = beyond_facts(file.robot, *path);
  say_robot(file);
  say("{}", frame_text(file, "the zone"));
  if (const std::string beyond = path ? beyond_text(file.robot, *path) : ""; !beyond.empty()) say("  {}\n", beyond);
  return sweeps;
}

void add_hull(const SweepRunOptions& options, bool float32, SweptZone& zone) {
  ProgressLine line;
  zone.hull = enclosing_hull(
      together(zone.pieces()), options.faces,
      {.hull = {.float32_coordinates = float32, .threads = options.sweep.threads}, .progress = std::ref(line)});
}

bool write(const SweepRunOptions& options, const std::string& suffix, const SweptZone& zone, Outputs& outputs) {
  const std::vector<TriangleMesh> pieces = zone.hull ? std::vector<TriangleMesh>{zone.hull->mesh} : zone.pieces();
  const TriangleMesh all = together(pieces);
  return outputs.add(options.out, suffix, [&](const path& file) {
    if (!zone.hull && holds_several_meshes(mesh_format(file)))
      write_meshes(file, pieces, piece_names("piece", pieces.size()));
    else
      write_mesh(file, all);
    return holds_triangles_of(file, all);
  });
}

std::string certificate_of(const SweptZone& zone, const SweepRunOptions& options) {
  const std::string what = zone.hull ? "the hull as written" : "the union of the pieces as written";
  const std::string of_what = is_robot_file(options.in) ? "the links" : "the mesh";
  return certificate_of(zone.verdict, what, of_what) + (!zone.verdict.certified ? ""
                                                        : options.workspace
                                                            ? ", wherever the joints are within their limits"
                                                            : ", at every moment of the motion");
}

/// "arm", or in a workspace "arm, hand in the frame of base"
std::string whose(const LinkSweep& sweep) {
  if (sweep.links.empty()) return sweep.link;
  return fmt::format("{} in the frame of {}", fmt::join(sweep.links, ", "), sweep.link);
}

/// At most three digits of the volume, the last of which two standard errors change by half at most.
std::string known_digits(const Sweep& sweep) {
  const double last = sweep.volume_error > 0 ? std::ceil(std::log10(4 * sweep.volume_error)) : -400;
  const double digits = std::clamp(std::floor(std::log10(sweep.volume)) - last + 1, 1., 3.);
  return fmt::format("{:.{}g}", sweep.volume, static_cast<int>(digits));
}

void print_summary(const SweepRunOptions& options, const SweptZone& zone) {
  const bool is_robot = is_robot_file(options.in);
  const auto pieces = [](const LinkSweep& link) { return counted(link.sweep.pieces.size(), "convex piece"); };
  for (const LinkSweep& link : zone.sweeps) {
    for (const std::string& note : link.sweep.notes) say("  {}{}\n", link.link.empty() ? "" : link.link + ": ", note);
    if (is_robot)
      say("  {}: {}, at most {:.4g} mm from what {} pass{}\n", whose(link), pieces(link),
          rounded_up(1e3 * link.sweep.verdict.distance().upper, 4), link.links.size() > 1 ? "they" : "it",
          link.links.size() > 1 ? "" : "es");
  }
  if (zone.hull)
    say("{}: hull of {}, volume {:.4g}", output_name(options.out), counted(zone.hull->mesh.face_count(), "face"),
        volume_of(*zone.hull));
  else if (is_robot)
    say("{}: {}", output_name(options.out), counted(zone.pieces().size(), "convex piece"));
  else
    say("{}: {}, volume about {}", output_name(options.out), pieces(zone.sweeps[0]),
        known_digits(zone.sweeps[0].sweep));
  say(", at most {:.4g} from what {} passes{}\n", rounded_up(zone.verdict.distance().upper, 4),
      is_robot ? "the robot" : "the mesh", zone.fills_cavities() ? " with cavities filled" : "");
  say("  certified: {}\n", certificate_of(zone, options));
  say("  read {:.2f} s, sweep {:.2f} s\n", zone.read_seconds, zone.seconds);
}

nlohmann::json name_or_null(const path& file) {
  return file.empty() ? nlohmann::json() : nlohmann::json(file.string());
}

/// All files that were read, and how the mesh or the robot moved.
nlohmann::json sources_of(const SweepRunOptions& options, const SweptZone& zone) {
  nlohmann::json in = zone.input;
  in["path"] = options.in.string();
  return {{"input", in},
          {"joint_path", name_or_null(options.joint_path)},
          {"poses", name_or_null(options.poses)},
          {"options",
           {{"scale", options.input.factor()},
            {"pieces", options.sweep.max_pieces},
            {"faces", options.faces > 0 ? nlohmann::json(options.faces) : nlohmann::json()},
            {"workspace", options.workspace},
            {"axis", options.axis},
            {"through", options.through},
            {"move", options.move},
            {"angle_degrees", options.degrees ? nlohmann::json(*options.degrees) : nlohmann::json()}}}};
}

/// The volume of pieces is estimated of a mesh only: pieces of a robot have none of these keys.
nlohmann::json volume_facts(const SweepRunOptions& options, const SweptZone& zone) {
  if (zone.hull)
    return {{"volume", volume_of(*zone.hull)},
            {"volume_error", nullptr},
            {"volume_is_estimated", std::isnan(zone.hull->verdict.hull_volume)}};
  if (is_robot_file(options.in)) return nlohmann::json::object();
  const Sweep& made = zone.sweeps[0].sweep;
  return {{"volume", made.volume}, {"volume_error", made.volume_error}, {"volume_is_estimated", true}};
}

nlohmann::json sweep_facts(const LinkSweep& link) {
  const bool is_of_workspace = !link.links.empty();
  return {{"link", link.link.empty() || is_of_workspace ? nlohmann::json() : nlohmann::json(link.link)},
          {"links", link.links},
          {"frame", is_of_workspace ? nlohmann::json(link.link) : nlohmann::json()},
          {"pieces", link.sweep.pieces.size()},
          {"cover_pieces", link.sweep.cover_pieces},
          {"verdict", facts(link.sweep.verdict)},
          {"fills_cavities", link.sweep.fills_cavities},
          {"notes", link.sweep.notes}};
}

nlohmann::json report_of(const SweepRunOptions& options, const SweptZone& zone) {
  nlohmann::json report = sources_of(options, zone);
  report.update(
      nlohmann::json{{"path", options.out.string()},
                     {"pieces", zone.pieces().size()},
                     {"hull_faces", zone.hull ? nlohmann::json(zone.hull->mesh.face_count()) : nlohmann::json()},
                     {"beyond_limits", zone.beyond_limits},
                     {"verdict", facts(zone.verdict)},
                     {"sweeps", json_list(zone.sweeps, sweep_facts)},
                     {"seconds", {{"read", zone.read_seconds}, {"sweep", zone.seconds}}}});
  report.update(volume_facts(options, zone));
  return report;
}

void check_options(const SweepRunOptions& options) {
  const bool has_turn = !options.axis.empty() || !options.through.empty() || options.degrees;
  const bool moves = has_turn || !options.move.empty() || !options.poses.empty();
  if (is_robot_file(options.in) && moves) refuse("a robot moves by its PATH: leave --angle, --move and --poses out");
  const bool has_unit = options.input.unit > 0 || options.input.scale != 1;
  if (is_robot_file(options.in) && has_unit) refuse("a robot is in metres: leave --unit and --scale out");
  if (is_robot_file(options.in)) return;
  if (!options.joint_path.empty()) refuse("PATH is of the joints of a robot: URDF, SDF or MJCF");
  if (!options.links.empty()) refuse("--links is for robots");
  if (options.workspace) refuse("--workspace is for robots");
}

int run_sweep(const SweepRunOptions& options) {
  const std::string suffix = output_suffix(options.out, mesh_outputs(), options.out_format);
  check_options(options);
  check_files({options.in, options.joint_path, options.poses}, {options.out, options.report});
  const bool float32 = stores_float32(mesh_format("x" + suffix));
  SweptZone zone;
  const Stopwatch watch;
  {
    ProgressLine line;
    SweepOptions how = options.sweep;
    how.progress = std::ref(line);
    how.float32_coordinates = float32;
    if (is_robot_file(options.in))
      zone.sweeps = sweeps_of_robot(options, how, zone);
    else
      zone.sweeps.push_back(sweep_of_mesh(options, how, zone));
  }
  if (options.faces > 0) add_hull(options, float32, zone);
  zone.seconds = watch.seconds() - zone.read_seconds;
  Outputs outputs, report;
  zone.verdict = verdict_of(zone, together(zone.pieces()));
  const bool holds_bits = zone.verdict.certified && write(options, suffix, zone, outputs);
  zone.verdict = as_written(std::move(zone.verdict), holds_bits);
  report.add_report(options.report, report_of(options, zone));
  if (zone.verdict.certified) outputs.commit();
  report.commit();
  print_summary(options, zone);
  return zone.verdict.certified ? kDone : kAnswerIsNo;
}

void add_motion_options(CLI::App& command, SweepRunOptions& options) {
  const Heading heading(command, "How a mesh moves");
  add_value(command, "--axis", options.axis, "AXIS",
            "Direction of the axis about which the mesh turns: x, y, z or X,Y,Z. The default is z.");
  add_value(
      command, "--through", options.through, "X,Y,Z",
      "A point of the axis at the beginning, in the unit of the mesh as it is read. The default is the origin, 0,0,0.");
  add_optional_number(command, "--angle", options.degrees, {-1e7, 1e7},
                      "Angle by which the mesh turns, in degrees, counter-clockwise if one looks against the axis.")
      ->type_name("DEGREES");
  CLI::Option* const move = add_value(command, "--move", options.move, "X,Y,Z",
                                      "Move the mesh straight by this vector, in the unit of the mesh as it is read, "
                                      "after --scale and --unit. With --angle it turns meanwhile, as a screw does.");
  CLI::Option* const poses = add_value(command, "--poses", options.poses, "FILE",
                                       "File of poses, one a row, .npy, .npz or .csv: x, y, z and the quaternion w, x, "
                                       "y, z, or the 12 or 16 numbers of a matrix. From one pose to the next the "
                                       "origin goes straight, and the mesh turns about one axis the shorter way "
                                       "round.");
  for (const char* const name : {"--axis", "--through", "--angle"}) poses->excludes(command.get_option(name));
  poses->excludes(move);
}

void add_robot_options(CLI::App& command, SweepRunOptions& options) {
  add_robot_file_options(command, options.file);
  const Heading heading(command, "Robots");
  add_value(command, "--links", options.links, "A,B",
            "Links to sweep, as in link1,link2. Without it, all links are swept.");
  command
      .add_flag("--workspace", options.workspace,
                "In place of a PATH: with each joint anywhere within its limits, all that the robot may ever reach.")
      ->excludes(command.get_option("PATH"));
  add_geometry_option(command, options.geometry);
}

}  // namespace

void add_sweep(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<SweepRunOptions>(
      app, run, "sweep",
      "Encloses all positions of a mesh along a motion, or of a robot along a path: the swept "
      "volume, as a zone to keep free. It is proven for every moment, not sampled. The result is a "
      "union of convex pieces, or with --faces one closed mesh around them.",
      run_sweep);
  add_mesh_input(command, options.in, options.input, "Mesh to move, or a robot: URDF, SDF or MJCF.");
  add_value(command, "PATH", options.joint_path, "PATH",
            "Of a robot, the path of its joints: CSV or JSON, as `prohull motion` reads it.");
  add_mesh_output_options(command, options.out, options.out_format, "the zone");
  add_optional_number(
      command, "--faces", options.faces, {4, 1e10},
      "Write one closed mesh of at most this number of faces, which encloses all pieces, in place of the pieces.");
  add_number(command, "--pieces", options.sweep.max_pieces, {1, 1000},
             "Largest number of convex pieces by which the mesh, or each link, is covered before it moves.");
  add_length(command, "--max-distance", options.max_distance,
             "How far slices of the motion may add to the distance of the pieces from what is passed. Less takes more "
             "slices. The default is 2 % of the diagonal of the mesh, or of each link. A robot takes metres or a unit, "
             "and no per cent.");
  add_threads_option(command, options.sweep.threads, "The pieces are the same for any number.");
  add_report_option(command, options.report);
  add_motion_options(command, options);
  add_robot_options(command, options);
  add_examples(command, {"prohull sweep door.stl --axis z --through 0,1,0 --angle 90 -o zone.stl",
                         "prohull sweep tool.stl --move 0,0,-50 -o zone.obj",
                         "prohull sweep tool.stl --poses path.csv --faces 500 -o zone.stl --report zone.json",
                         "prohull sweep arm.urdf pick.csv --links link5,link6 -o zone.glb",
                         "prohull sweep arm.urdf --workspace --faces 1000 -o workspace.stl"});
}

}  // namespace prohull::cli

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "command.h"
#include "prohull/error.h"
#include "prohull/sphere_cover.h"
#include "robot/check/check.h"
#include "robot/files/robot_file.h"
#include "robot/hulls/budgets.h"
#include "robot/hulls/cache.h"
#include "robot/hulls/certificates.h"
#include "robot/hulls/package_files.h"
#include "robot/hulls/write_robot.h"
#include "robot/motion/bodies.h"
#include "robot/motion/joint_limits.h"
#include "robot/motion/motion.h"
#include "robot/motion/mujoco_files.h"
#include "robot/motion/planner_files.h"
#include "robot/report/report.h"
#include "robot_folder.h"
#include "robot_summary.h"
#include "view/shown_robot.h"

namespace prohull::cli {
namespace {

using namespace prohull::robot;
using std::filesystem::path;

struct UrdfOptions {
  path in, out, budgets, write_budgets, cache, report, junit, html, srdf;
  FileOptions file;
  LinkHullOptions hulls;
  std::string max_distance = "0", gap = "0", allow = "0", package, to,
              format = "stl";  ///< as WriteOptions::format
  bool certificate = false, check = false, dry_run = false, no_cache = false, no_pictures = false,
       sampled_pairs = false;
  MotionOptions motion{.configurations = 1000};
  ProofOptions proof;
  unsigned threads = 0;
  std::vector<std::pair<const CLI::Option*, Collision>> sizes;  ///< options that one kind of collision geometry has
};

path default_cache() {
  if (const char* const folder = std::getenv("XDG_CACHE_HOME"); folder && *folder) return path(folder) / "prohull";
  if (const char* const home = std::getenv("HOME"); home && *home) return path(home) / ".cache" / "prohull";
  return {};
}

void complete(UrdfOptions& options) {
  Budget& budget = options.hulls.budget;
  budget.max_distance = length_of(options.max_distance, "--max-distance");
  budget.padding = length_of(options.gap, "--gap");
  if (!options.no_cache) options.hulls.cache = options.cache.empty() ? default_cache() : options.cache;
  options.hulls.threads = options.motion.threads = options.proof.threads = options.threads;
}

/// Tells how the shipped collision geometry lies to the visual one.
int run_check(const UrdfOptions& options, const RobotFile& file) {
  const Stopwatch watch;
  const double allow = length_of(options.allow, "--allow");
  check_files({options.in, options.srdf}, {options.report, options.junit, options.html});
  Srdf srdf;
  if (!options.srdf.empty()) srdf = read_srdf(file.robot, read_bytes(options.srdf), input_name(options.srdf));
  ReportInput facts{.file = file, .hulls = {}, .shipped = {}, .motion = {}, .allow = allow, .version = PROHULL_VERSION};
  facts.srdf_notes = srdf.notes;
  {
    ProgressLine line;
    facts.shipped = check_links(file.robot, {.threads = options.threads, .progress = std::ref(line)});
    ProofOptions proof = options.proof;
    proof.progress = std::ref(line);
    facts.disabled = check_disabled_pairs(file.robot, srdf.rows, proof);
  }
  facts.seconds = watch.seconds();
  sign(facts, {options.srdf});
  Outputs outputs;
  outputs.add_report(options.report, report_json(facts));
  if (!options.junit.empty()) outputs.add(options.junit, report_junit(facts));
  if (!options.html.empty()) {
    ProgressLine line;
    outputs.add(options.html, report_html(facts, {.threads = options.threads, .progress = std::ref(line)}));
  }
  outputs.commit();
  say_check(file, facts.shipped, allow);
  for (const std::string& note : srdf.notes) say("  {}\n", note);
  if (!options.srdf.empty()) say_disabled(file.robot, input_name(options.srdf), facts.disabled);
  const bool all = std::ranges::all_of(facts.shipped, [&](const LinkCheck& check) { return passes(check, allow); }) &&
                   std::ranges::none_of(facts.disabled, &DisabledCheck::is_refuted);
  return all ? kDone : kAnswerIsNo;
}

int run_write_budgets(const UrdfOptions& options, const RobotFile& file) {
  check_files({options.in, options.budgets}, {options.write_budgets});
  Outputs outputs;
  outputs.add(options.write_budgets, budgets_text(file.robot, options.hulls));
  outputs.commit();
  say("{}: budgets of {}; change them, and give the file to --budgets\n", output_name(options.write_budgets),
      counted(file.robot.links.size(), "link"));
  return kDone;
}

/// The triangles of all shapes, as this run reads them.
void add_shapes(std::span<const Shape> all, Fingerprint& key) {
  for (const Shape& shape : all) try {
      key.add(link_triangles({&shape, 1}, {}));
    } catch (const InputError& error) {  // check_links tells of it
      key.add(error.what());
    }
}

/// Equal for two runs that make the same files.
std::string run_key(const UrdfOptions& options, const RobotFile& file, std::span<const LinkHulls> hulls) {
  Fingerprint key;
  key.add(file.text);
  key.add(std::filesystem::absolute(options.in).string());  // relative paths of the robot depend on both
  key.add(std::filesystem::absolute(options.out).string());
  for (const LinkHulls& made : hulls) {
    const Link& link = file.robot.links[made.link];
    const Budget& budget = options.hulls.budget_of(link.name);
    key.add(key_of(made.triangles, budget, options.hulls));
    for (const Geometry which : {Geometry::Visual, Geometry::Collision}) {
      // The text has the primitives.
      if (which != options.hulls.from || made.status != LinkStatus::Hulled) add_shapes(shapes(link, which), key);
      for (const Shape& shape : shapes(link, which))
        if (const MeshFile* const mesh = shape.mesh()) key.add(mesh->path.string());
    }
    key.add(std::size_t(budget.skip));
  }
  key.add(std::size_t(options.hulls.from)), key.add(std::size_t(options.hulls.skip_missing)), key.add(options.package),
      key.add(options.format);
  key.add(std::size_t(options.certificate)), key.add(std::size_t(options.no_pictures)),
      key.add(std::size_t(view::has_page())), key.add(options.motion.configurations), key.add(options.proof.cells);
  key.add(std::size_t(options.motion.seed)), key.add(std::size_t(options.sampled_pairs)), key.add(options.to);
  return key.text();
}

/// What the report says beside the hulls.
void look_at_the_rest(const UrdfOptions& options, ReportInput& facts) {
  ProgressLine line;
  const Progress progress = std::ref(line);
  const Robot& robot = facts.file.robot;
  facts.shipped = check_links(robot, {.threads = options.threads, .progress = progress});
  if (options.motion.configurations > 0 && !robot.joints.empty()) {
    MotionOptions motion = options.motion;
    motion.progress = progress;
    const Bodies bodies = bodies_of(robot, facts.hulls, options.hulls.from);
    facts.motion = check_motion(robot, bodies, motion);
    ProofOptions proof = options.proof;
    proof.progress = progress;
    proof.keep_trees = options.certificate;
    if (proof.cells > 0) add_proofs(robot, bodies, proof, *facts.motion);
  }
}

std::vector<LinkHulls> make_hulls(const UrdfOptions& options, const Robot& robot) {
  ProgressLine line;
  LinkHullOptions hulls = options.hulls;
  hulls.progress = std::ref(line);
  return link_hulls(robot, hulls);
}

/// The collision geometry that the robot ships with, alone.
view::ShownRobot shipped(const ReportInput& facts) {
  view::ShownRobot shown{facts.file.robot, std::vector<TriangleMesh>(facts.shipped.size()), {}};
  for (const LinkCheck& check : facts.shipped) shown.collision.push_back(check.collision);
  return shown;
}

/// The robot within its hulls, and what it ships with, if it has any collision geometry.
std::string view_page(const UrdfOptions& options, const ReportInput& facts, const Progress& progress) {
  const Robot& robot = facts.file.robot;
  const auto has_collision = [](const LinkCheck& check) { return check.collision.face_count() > 0; };
  std::vector<view::Shown> shown{
      {robot.name + " with hulls", view::with_hulls(robot, facts.hulls, facts.from, progress)}};
  if (std::ranges::any_of(facts.shipped, has_collision)) shown.push_back({robot.name + " as shipped", shipped(facts)});
  return view::page(shown, std::nullopt,
                    {.unit = "m", .version = PROHULL_VERSION, .threads = options.threads, .progress = progress});
}

void write_certificates(const UrdfOptions& options, ReportInput& facts, const RobotFiles& files, RobotFolder& folder) {
  ProgressLine line;
  LinkHullOptions how = options.hulls;
  how.progress = std::ref(line);
  LinkCertificates made = link_certificates(facts.file.robot, facts.hulls, files, folder.get(), how);
  for (const OutputFile& file : made.files) folder.add(file.path, file.write);
  facts.certificates = std::move(made.certificates);
}

/// Writes the certificate of the pairs that never meet.
void write_motion_certificate(ReportInput& facts, const RobotFiles& files, RobotFolder& folder) {
  std::vector<PairProof> proofs;
  for (const MotionPair& pair : facts.motion->pairs)
    if (pair.proof) proofs.push_back(*pair.proof);
  MotionCertificate made = pairs_certificate(
      facts.file.robot, certified_bodies(facts.file.robot, facts.hulls, files.hulls, facts.from), proofs);
  if (made.pairs == 0) return;
  facts.motion_certificate = {robot_stem(facts.file) + ".phmotion", made.pairs};
  folder.add(facts.motion_certificate.file, made.text);
}

/// What planners read beside the robot's own file.
void write_pairs(const UrdfOptions& options, const ReportInput& facts, const RobotFiles& files, RobotFolder& folder) {
  const std::string stem = robot_stem(facts.file);
  folder.add(stem + ".srdf", srdf_of(facts.file.robot, *facts.motion, options.sampled_pairs));
  if (files.balls.empty() || facts.file.format != RobotFormat::Urdf) return;
  const PlannerRobot planned{facts.file.robot, files.balls, facts.motion->pairs, files.robots[0].first.string()};
  folder.add(stem + "_curobo.yml", curobo_file(planned));
  folder.add(stem + ".xrdf", xrdf_file(planned));
}

/// The robot for MuJoCo, without contacts of the pairs of the SRDF. Returns sentences for the user.
std::string write_mjcf(const UrdfOptions& options, const ReportInput& facts, const RobotFiles& files,
                       RobotFolder& folder) {
  const Robot& robot = facts.file.robot;
  const MujocoFiles made = mujoco_files(
      facts.file, files, facts.motion ? pairs_left_out(*facts.motion, options.sampled_pairs) : adjacent_pairs(robot));
  for (const OutputFile& file : made.files) folder.add(file.path, file.write);
  return mujoco_text(made, facts.hulls);
}

void write_report(const UrdfOptions& options, ReportInput& facts, const RobotFiles& files, RobotFolder& folder) {
  if (facts.motion) write_pairs(options, facts, files, folder);
  ProgressLine line;
  PageOptions page{.pictures = !options.no_pictures,
                   .threads = options.threads,
                   .progress = std::ref(line),
                   .cache = options.hulls.cache};
  if (page.pictures && view::has_page()) {
    folder.add("view.html", view_page(options, facts, page.progress));
    page.view = "view.html#x=2";  // what it ships with, the third thing on the page, is not drawn at first
  }
  for (const auto& [name, hash] : folder.added()) facts.written.push_back({name, hash});
  folder.add("report.html", report_html(facts, page));
}

bool is_as_asked(const LinkHulls& link) {
  return link.status != LinkStatus::Unread && is_certified(link) &&
         std::ranges::all_of(link.hulls, &LinkHull::within_bounds);
}

/// What a package has of the robot's files, and what it needs beside its folder.
std::string package_text(const std::map<path, path>& copies, const std::set<std::string>& left) {
  std::set<path> made;
  for (const auto& [source, copy] : copies) made.insert(copy);
  std::string text = fmt::format("  copies for the package: {} that the robot names\n", counted(made.size(), "file"));
  if (!left.empty()) text += fmt::format("  not copied, and named as before: {}\n", first_of(left));
  return text;
}

WriteOptions write_options(const UrdfOptions& options) {
  return {.faces = options.hulls.budget.faces,
          .from = options.hulls.from,
          .format = options.format,
          .package = options.package,
          .to_mjcf = !options.to.empty()};
}

/// Says what would be copied, if all links that may get hulls get them.
void say_package_plan(const UrdfOptions& options, const RobotFile& file) {
  if (options.package.empty()) return;
  std::vector<NewCollision> hulls;
  for (std::size_t i = 0; i < file.robot.links.size(); ++i) {
    const Link& link = file.robot.links[i];
    if (!options.hulls.budget_of(link.name).skip && !shapes(link, options.hulls.from).empty())
      hulls.push_back({.link = i, .from = options.hulls.from, .hulls = {"hull"}});
  }
  PackageFiles package(file, options.package);
  with_collisions(file, hulls, options.out, [&](const std::string& uri) { return package.uri_of(uri); });
  say("{}", package_text(package.copies(), package.left()));
}

int run_dry(const UrdfOptions& options, const RobotFile& file) {
  check_options(file, write_options(options));
  const bool is_possible = say_plan(file, options.hulls);
  say_package_plan(options, file);
  if (!options.to.empty()) {
    RobotFiles as_read;
    as_read.robots.emplace_back(file.path.filename(), file.robot);
    say("{}", mujoco_text(mujoco_files(file, as_read, {}), {}));
  }
  say("nothing was written: --dry-run\n");
  return is_possible ? kDone : kBadInput;
}

int run_build(const UrdfOptions& options, const RobotFile& file) {
  const Stopwatch watch;
  if (options.sampled_pairs && options.motion.configurations == 0)
    refuse("--sampled-pairs needs --configurations greater than 0");
  if (options.out.empty())
    refuse("say by -o which folder the robot goes to; or use --check, --dry-run or --write-budgets");
  RobotFolder folder(options.out, file.robot.name);
  const WriteOptions how = write_options(options);
  check_options(file, how);
  if (options.certificate) check_certified_format(how.format);
  ReportInput facts{.file = file,
                    .hulls = make_hulls(options, file.robot),
                    .shipped = {},
                    .motion = {},
                    .version = PROHULL_VERSION,
                    .from = options.hulls.from};
  const RobotFiles files = output_files(file, facts.hulls, folder.get(), how);
  if (!files.balls.empty()) facts.without_spheres = links_without_spheres(file.robot, files.balls);
  for (const OutputFile& output : files.files) folder.add(output.path, output.write);
  const bool is_covered = std::ranges::all_of(facts.hulls, is_as_asked);
  const std::string key = run_key(options, file, facts.hulls);
  if (const auto earlier = folder.earlier_run(key)) {
    say("{}{}: up to date; nothing has changed since the last run\n",
        robot_summary(options.out, facts, options.sampled_pairs), options.out.string());
    return is_covered ? *earlier : kAnswerIsNo;
  }
  if (options.certificate) write_certificates(options, facts, files, folder);
  look_at_the_rest(options, facts);
  if (options.certificate && facts.motion) write_motion_certificate(facts, files, folder);
  facts.seconds = watch.seconds();
  sign(facts, {options.budgets});
  const bool is_done = is_covered && (!facts.motion || facts.motion->missed() == 0);
  const std::string mjcf = options.to.empty() ? "" : write_mjcf(options, facts, files, folder);
  write_report(options, facts, files, folder);
  folder.commit(report_json(facts), key, is_done ? kDone : kAnswerIsNo);
  say("{}{}{}  {:.1f} s\n", robot_summary(options.out, facts, options.sampled_pairs),
      options.package.empty() ? "" : package_text(files.copies, files.left), mjcf, watch.seconds());
  return is_done ? kDone : kAnswerIsNo;
}

/// An option that no link heeds would be a surprise.
void check_sizes(const UrdfOptions& options, const Robot& robot) {
  for (const auto& [option, kind] : options.sizes) {
    const Collision needed = kind;
    const auto heeds = [&](const Link& link) { return options.hulls.budget_of(link.name).collision == needed; };
    if (option->count() > 0 && std::ranges::none_of(robot.links, heeds))
      refuse(fmt::format("{} needs --collision {}, or a link with it in --budgets", option->get_name(),
                         prohull::name_of(collision_names(), kind)));
  }
}

int run_urdf(UrdfOptions options) {
  complete(options);
  const RobotFile file = read_robot(options.in, options.file);
  if (!options.budgets.empty())
    read_budgets(read_bytes(options.budgets), input_name(options.budgets), file.robot, options.hulls);
  if (!options.check) check_sizes(options, file.robot), check_budgets(file.robot, options.hulls);
  say_robot(file);
  for (const std::string& note : cut_notes(file.robot)) say("  {}\n", note);
  if (!options.write_budgets.empty()) return run_write_budgets(options, file);
  if (options.check) return run_check(options, file);
  if (options.dry_run) return run_dry(options, file);
  return run_build(options, file);
}

/// What each kind of collision geometry has a number of.
void add_sizes(CLI::App& command, UrdfOptions& options) {
  Budget& budget = options.hulls.budget;
  const auto is_for = [&](Collision kind, CLI::Option* option) {
    option->capture_default_str();
    options.sizes.emplace_back(option, kind);
  };
  is_for(Collision::Hull,
         add_optional_number(
             command, "--faces", budget.faces, {4, 1e9},
             "Number of faces of each hull, at least 4. Several numbers, as in 500,100, make a robot each.")
             ->delimiter(',')
             ->allow_extra_args(false)
             ->type_name("N[,N...]"));
  is_for(Collision::Convex,
         add_optional_number(command, "--pieces", budget.pieces, {1, 1e9},
                             "Largest number of convex pieces of each link, with --collision convex."));
  is_for(Collision::Convex, add_optional_number(command, "--vertices", budget.vertices, {4, 1e9},
                                                "Largest number of vertices of each convex piece, at least 4."));
  is_for(Collision::Spheres, add_optional_number(command, "--spheres", budget.spheres, {1, double{kMostCoverBalls}},
                                                 "Largest number of spheres of each link, with --collision spheres."));
}

/// Returns --write-budgets.
CLI::Option* add_budgets(CLI::App& command, UrdfOptions& options) {
  const Heading heading(command, "Budgets");
  add_sizes(command, options);
  add_value(command, "--max-distance", options.max_distance, "LENGTH",
            "Largest allowed distance of any point of a hull from the geometry, in metres or with a unit: 2mm. Hulls "
            "then have the fewest faces found to keep it, but at least --faces. Convex pieces and spheres are then as "
            "few as are found to keep it, but at most --pieces and --spheres. It must be greater than --gap. The exit "
            "code is 1 if a hull cannot keep it.");
  add_value(command, "--gap", options.gap, "LENGTH",
            "Least distance that the hulls keep from the geometry, in metres or with a unit: 5mm. Not for convex "
            "pieces and spheres.");
  add_value(command, "--budgets", options.budgets, "FILE.yaml",
            "YAML file with collision, faces, pieces, vertices, spheres, max_distance, gap and skip for each link; see "
            "--write-budgets.");
  return add_value(command, "--write-budgets", options.write_budgets, "FILE.yaml",
                   "Write a file for --budgets with all links of the robot, as a start, and do nothing else.");
}

/// Returns --check.
CLI::Option* add_check(CLI::App& command, UrdfOptions& options) {
  const Heading heading(command, "Check what the robot ships with");
  CLI::Option* const check =
      command.add_flag("--check", options.check,
                       "Decide for each link whether its own collision geometry covers its visual "
                       "geometry, exactly. Nothing is built. The exit code is 1 if a link leaks.");
  add_value(command, "--allow", options.allow, "LENGTH",
            "How far the visual geometry may stick out, in metres or with a unit: 0.5mm.")
      ->needs(check);
  add_value(command, "--srdf", options.srdf, "FILE.srdf",
            "Also decide for each pair of links that this SRDF file disables: proven never to meet, or where the two "
            "meet. The exit code is 1 if a pair meets, unless its reason is Adjacent, Always, Default or User.")
      ->needs(check);
  add_value(command, "--junit", options.junit, "FILE.xml",
            "Also write the verdicts as JUnit XML, which CI services show.")
      ->needs(check);
  add_value(command, "--html", options.html, "FILE.html", "Also write a page with pictures.")->needs(check);
  add_value(command, "--report", options.report, "FILE.json", "Also write what was found as JSON.")->needs(check);
  return check;
}

void add_motion(CLI::App& command, UrdfOptions& options) {
  const Heading heading(command, "Motion");
  add_number(command, "--configurations", options.motion.configurations, {0, 1e7},
             "Number of random positions of all joints in which pairs of links are compared: how often hulls collide "
             "where the geometry does not. With 0 this is left out.");
  add_number(command, "--seed", options.motion.seed, kSeed, "Number that the positions depend on.");
  add_number(command, "--prove", options.proof.cells, {0, 1e9},
             "Largest number of cells into which the positions of the joints are divided, for each pair of links that "
             "no joint connects: to prove that their hulls never meet within the limits, or to find where they do. "
             "Proven pairs go into the SRDF. With 0 nothing is proven.");
  command.add_flag("--sampled-pairs", options.sampled_pairs,
                   "Also write pairs of links to the SRDF that were never, or always, in collision in these positions. "
                   "Their reason is \"sampled\": no proof, since they may collide in another position.");
}

}  // namespace

void add_urdf(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<UrdfOptions>(
      app, run, "urdf",
      "Gives every link of a robot certified collision geometry. Reads URDF, SDF and MJCF, and writes a copy of the "
      "robot with its meshes, a report with pictures, and an SRDF of the links that joints connect or that provably "
      "never meet. With --check, it decides whether the collision geometry that the robot ships with covers the robot. "
      "The exit code is 1 if a link is not covered, unless --skip-missing or its budget says to leave it as it is.",
      run_urdf);
  add_robot_input(command, options.in);
  CLI::Option* const out =
      add_value(command, "-o,--out", options.out, "DIR",
                "Folder for the robot and its hulls. It is made if it is not there. A folder that has "
                "files but no report.json of an earlier run is refused, and a file that no run "
                "has written is not overwritten.");
  add_robot_file_options(command, options.file);
  add_choice(
      command, "--collision", options.hulls.budget.collision, collision_names(),
      "What covers each link: one hull, which may be concave; convex pieces, for engines that take only these; or "
      "spheres, for planners that take only these. Spheres also go into ROBOT_spheres.yaml, as cuRobo reads them.");
  add_choice(command, "--from", options.hulls.from, geometry_names(), "Geometry of each link that the hulls enclose.");
  add_value(command, "--format", options.format, "stl|obj|glb", "Format of the hulls.")
      ->transform(one_of("--format", {"stl", "obj", "glb"}))
      ->capture_default_str();
  add_value(command, "--package", options.package, "NAME",
            "Make the folder a ROS package of this name, which alone is the robot: with package.xml, copies of the "
            "meshes, textures and other files that the robot names, and package:// URIs. What is not found stays as it "
            "is, and the summary names it.")
      ->check([](const std::string& name) { return name.empty() ? std::string("--package needs a name") : ""; });
  CLI::Option* const to =
      add_value(command, "--to", options.to, "mjcf",
                "Also write the robot, a URDF file, as MJCF: ROBOT.xml, for MuJoCo. It has the masses, joints and "
                "colours of the file, the new collision geometry, its visual meshes as STL or OBJ files in "
                "meshes/visual, and no "
                "contacts between the pairs of links in the SRDF.")
          ->transform(one_of("--to", {"mjcf"}));
  command.add_flag("--tight", options.hulls.tight, "Build tight hulls: least volume, but some 4 times as slow.");
  command.add_flag("--skip-missing", options.hulls.skip_missing,
                   "Leave links whose mesh files are not found as they are: nothing is proven of them, and the exit "
                   "code does not tell. Otherwise missing files are an error.");
  CLI::Option* const certificate =
      command.add_flag("--certificate", options.certificate,
                       "Also write a certificate beside each hull, or the pieces or spheres of a link: a file with "
                       "which prohull_check, a program of one C file that shares nothing with this one, decides again "
                       "what is proven (docs/certificate.md). It is about the mesh file that the robot names, or else "
                       "about a copy of the link's triangles in the folder, which report.json names. ROBOT.phmotion is "
                       "the certificate of the pairs of links that never meet, for prohull_check_motion.");
  CLI::Option* const dry_run =
      command.add_flag("--dry-run", options.dry_run, "Say what would be done with each link, and write nothing.");
  command.add_flag("--no-pictures", options.no_pictures,
                   "Write the report without pictures, and no view.html, which is faster.");
  add_value(command, "--cache", options.cache, "DIR",
            "Folder that keeps hulls for the next run. Otherwise this is prohull in the user's folder for caches.");
  command.add_flag("--no-cache", options.no_cache, "Build all hulls anew, and keep none.");
  add_threads_option(command, options.threads, "The result is the same for any number.");
  CLI::Option* const write_budgets = add_budgets(command, options);
  add_motion(command, options);
  CLI::Option* const check = add_check(command, options);
  check->excludes(out)->excludes(dry_run)->excludes(write_budgets)->excludes(certificate)->excludes(to);
  write_budgets->excludes(out)->excludes(dry_run);
  add_examples(
      command,
      {"prohull urdf arm.urdf -o arm_safe", "prohull urdf arm.urdf -o arm_safe --faces 500,100 --gap 5mm",
       "prohull urdf arm.xml -o arm_convex --collision convex --pieces 16",
       "prohull urdf arm.urdf -o arm_spheres --collision spheres --spheres 64",
       "prohull urdf arm.urdf -o arm_mujoco --to mjcf --collision convex",
       "prohull urdf arm.urdf -o arm_safe --certificate",
       "prohull urdf arm.urdf -o arm_safe --package arm_safe --package-path ~/ws/src",
       "prohull urdf arm.urdf --write-budgets budgets.yaml", "prohull urdf arm.urdf -o arm_safe --budgets budgets.yaml",
       "prohull urdf arm.urdf --check --allow 0.5mm --junit leaks.xml", "prohull urdf arm.urdf --check --srdf arm.srdf",
       "prohull urdf model.sdf -o model_safe --format obj"});
}

}  // namespace prohull::cli

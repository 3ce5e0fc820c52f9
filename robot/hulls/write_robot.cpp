#include "robot/hulls/write_robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "prohull/detail/refuse.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "robot/files/packages.h"
#include "robot/files/xml.h"

namespace prohull::robot {
namespace {

using std::filesystem::path;

[[noreturn]] void fail_to_write(const path& file) {
  throw InputError(
      Defect::CannotWrite,
      fmt::format("{}: the file does not hold what was certified; choose another --format", file.string()));
}

bool is_same_shape(const Shape& a, const Shape& b) { return a.form == b.form && a.origin == b.origin; }

/// The robot that with_collisions writes. Meshes of hulls have no path, because they are not written yet.
Robot with_new_shapes(Robot robot, std::span<const NewCollision> collisions) {
  for (const NewCollision& collision : collisions) {
    Link& link = robot.links[collision.link];
    const std::vector<Shape> from = shapes(link, collision.from);
    const Pose origin = collision.same_origin_as ? from[*collision.same_origin_as].origin : Pose{};
    link.collision.clear();
    for (const std::string& hull : collision.hulls) link.collision.push_back({MeshFile{.uri = hull}, origin});
    for (const Ball& ball : collision.balls)
      link.collision.push_back({SphereForm{ball.radius}, {.translation = ball.center}});
    for (const std::size_t kept : collision.kept) link.collision.push_back(from[kept]);
  }
  return robot;
}

bool is_package_name(const std::string& name) {
  const auto is_known = [](unsigned char c) { return std::islower(c) || std::isdigit(c) || c == '_' || c == '-'; };
  return std::islower(static_cast<unsigned char>(name[0])) && std::ranges::all_of(name, is_known);
}

/// `left`: what the robot names outside of the package.
std::string package_xml(const std::string& package, const Robot& robot, const std::set<std::string>& left) {
  std::set<std::string> others;
  for (const std::string& uri : left) others.emplace(package_of(uri));
  others.erase(""), others.erase(package);
  std::string depends;
  for (const std::string& other : others)
    depends += fmt::format("  <exec_depend>{}</exec_depend>\n", xml_escaped(other));
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<package format=\"3\">\n  <name>{}</name>\n  <version>0.1.0</version>\n"
      "  <description>{} with certified collision meshes</description>\n"
      "  <maintainer email=\"maintainer@example.com\">maintainer</maintainer>\n  <license>see the original</license>\n"
      "  <buildtool_depend>ament_cmake</buildtool_depend>\n{}"
      "  <export>\n    <build_type>ament_cmake</build_type>\n  </export>\n</package>\n",
      package, xml_escaped(robot.name), depends);
}

/// Installs what is in the folder, as description packages of ROS 2 do.
std::string package_cmake(const std::string& package) {
  return fmt::format(
      "cmake_minimum_required(VERSION 3.8)\nproject({} NONE)\nfind_package(ament_cmake REQUIRED)\n"
      "install(DIRECTORY . DESTINATION share/${{PROJECT_NAME}})\nament_package()\n",
      package);
}

/// The robot with one set of hulls.
class RobotSet {
 public:
  RobotSet(const RobotFile& file, const WriteOptions& options, std::size_t set, NewUri new_uri)
      : file_(file),
        options_(options),
        set_(set),
        suffix_(set == 0 ? "" : fmt::format("_{}", options.faces[set])),
        new_uri_(std::move(new_uri)) {}

  void add(const LinkHulls& link) {
    NewCollision collision;
    collision.link = link.link, collision.from = options_.from, collision.kept = link.primitives;
    if (link.status == LinkStatus::Hulled) {
      const std::string name = names_.of(file_.robot.links[link.link].name);  // the same in all sets
      if (!link.hulls[set_].certified()) return;
      add_hull(link.hulls[set_], name, collision);
    } else if (link.status != LinkStatus::Primitives) {
      return;
    }
    if (!collision.hulls.empty()) collision.same_origin_as = link.frame.same_origin_as;
    if (link.collision == Collision::Spheres) add_balls(collision);
    collisions_.push_back(std::move(collision));
  }

  void add_to(RobotFiles& all, const path& folder) {
    const path name = fmt::format("{}{}{}", robot_stem(file_), suffix_, extension());
    std::string text = with_collisions(file_, collisions_, folder, new_uri_);
    Robot robot = with_new_shapes(file_.robot, collisions_);
    require_shapes(text, folder / name, robot);
    files_.push_back(text_file(name, std::move(text)));
    if (!balls_.empty()) files_.push_back(text_file(robot_stem(file_) + "_spheres.yaml", sphere_file(balls_)));
    if (set_ == 0) all.balls = balls_;
    all.robots.emplace_back(name, std::move(robot));
    std::ranges::move(files_, std::back_inserter(all.files));
    std::ranges::move(hulls_, std::back_inserter(all.hulls));
  }

 private:
  void add_hull(const LinkHull& hull, const std::string& name, NewCollision& collision) {
    hulls_.push_back({collision.link, set_, folder() / name});
    if (hull.pieces.empty() && hull.balls.empty()) collision.hulls.push_back(add_mesh(name, hull.mesh));
    for (std::size_t i = 0; i < hull.pieces.size(); ++i)
      collision.hulls.push_back(add_mesh(names_.of(fmt::format("{}_{:02}", name, i + 1)), hull.pieces[i]));
    collision.balls = hull.balls;
  }

  path folder() const { return path("meshes") / ("collision" + suffix_); }

  /// Returns its URI.
  std::string add_mesh(const std::string& name, const TriangleMesh& mesh) {
    const path file = folder() / (name + "." + options_.format);
    hulls_.back().meshes.push_back(file);
    files_.push_back({file, [&mesh](const path& target) { write_certified(target, mesh); }});
    return options_.package.empty() ? file.generic_string()
                                    : "package://" + options_.package + "/" + file.generic_string();
  }

  /// The text has to say what was certified, bit for bit, and nothing else.
  void require_shapes(const std::string& text, const path& target, const Robot& certified) const {
    const Robot written = read_robot(text, target).robot;
    for (const NewCollision& collision : collisions_) {
      const std::vector<Shape>& wanted = certified.links[collision.link].collision;
      const std::vector<Shape>& read = written.links.at(collision.link).collision;
      if (!std::is_permutation(wanted.begin(), wanted.end(), read.begin(), read.end(), is_same_shape))
        fail_to_write(target);
    }
  }

  /// Adds the balls of the cover, and spheres that are kept.
  void add_balls(const NewCollision& collision) {
    const Link& link = file_.robot.links[collision.link];
    LinkBalls all{link.name, collision.balls};
    for (const std::size_t kept : collision.kept) {
      const Shape& shape = shapes(link, options_.from)[kept];
      all.balls.push_back({shape.origin.translation, std::get<SphereForm>(shape.form).radius});
    }
    balls_.push_back(std::move(all));
  }

  std::string extension() const {
    const std::string own = file_.path.extension().string();
    return own.empty() || own == ".xacro" ? fmt::format(".{}", prohull::name_of(robot_format_names(), file_.format))
                                          : own;
  }

  const RobotFile& file_;
  const WriteOptions& options_;
  const std::size_t set_;
  const std::string suffix_;
  const NewUri new_uri_;
  FileNames names_;
  std::vector<NewCollision> collisions_;
  std::vector<LinkBalls> balls_;
  std::vector<OutputFile> files_;
  std::vector<HullFiles> hulls_;
};

}  // namespace

void write_text(const path& file, std::string_view text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out)
    throw InputError(Defect::CannotWrite,
                     fmt::format("{}: cannot write: {}", file.string(), std::generic_category().message(errno)));
}

OutputFile text_file(path name, std::string text) {
  return {std::move(name), [text = std::move(text)](const path& target) { write_text(target, text); }};
}

void write_certified(const path& target, const TriangleMesh& mesh) {
  write_mesh(target, mesh);
  if (!has_triangles_of(read_mesh(target), mesh)) fail_to_write(target);
}

std::string robot_stem(const RobotFile& file) {
  const path own = file.path.stem();
  return file.path.extension() == ".xacro" && own.has_extension() ? own.stem().string() : own.string();
}

void check_options(const RobotFile& file, const WriteOptions& options) {
  if (!options.package.empty() && !is_package_name(options.package))
    refuse(
        fmt::format("'{}' is no name of a package: it begins with a lower-case letter, and has lower-case "
                    "letters, digits, _ and - only",
                    options.package));
  if (options.to_mjcf && file.format != RobotFormat::Urdf)
    refuse(fmt::format("{}: only URDF becomes MJCF", file.path.string()));
  if (file.format != RobotFormat::Mjcf && !options.to_mjcf) return;
  if (options.format == "stl" && std::ranges::max(options.faces) > kMostMujocoStlFaces)
    refuse(
        fmt::format("MuJoCo reads no STL files of more than {} faces; choose obj "
                    "as the format, or fewer faces",
                    kMostMujocoStlFaces));
  if (options.format == "glb") refuse("MuJoCo does not read GLB files; choose stl or obj as the format");
  if (!options.package.empty()) refuse("MuJoCo does not know packages; leave the name of the package out");
}

RobotFiles output_files(const RobotFile& file, std::span<const LinkHulls> links, const path& folder,
                        const WriteOptions& options) {
  check_options(file, options);
  RobotFiles all;
  PackageFiles package(file, options.package);
  NewUri new_uri;
  if (!options.package.empty()) new_uri = [&](const std::string& uri) { return package.uri_of(uri); };
  for (std::size_t set = 0; set < options.faces.size(); ++set) {
    RobotSet robot(file, options, set, new_uri);
    for (const LinkHulls& link : links) robot.add(link);
    robot.add_to(all, folder);
  }
  if (options.package.empty()) return all;
  all.copies = package.copies(), all.left = package.left();
  all.files.insert(all.files.end(), package.files().begin(), package.files().end());
  all.files.push_back(text_file("package.xml", package_xml(options.package, file.robot, all.left)));
  all.files.push_back(text_file("CMakeLists.txt", package_cmake(options.package)));
  return all;
}

}  // namespace prohull::robot

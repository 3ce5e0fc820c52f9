#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "command.h"
#include "paper/refine_along.h"
#include "prohull/error.h"
#include "render/compose.h"
#include "render/draw.h"
#include "render/marks.h"
#include "render/mesh_table.h"
#include "render/pieces.h"
#include "robot/files/robot_file.h"
#include "robot/files/sphere_file.h"
#include "robot/json.h"
#include "robot/motion/bodies.h"

namespace prohull::cli {
namespace {

using render::MeshTable;
using render::PanelPlan;
using render::Rgb;

struct RenderOptions {
  std::vector<std::filesystem::path> in;
  std::filesystem::path out, report;
  std::vector<std::string> over, split, colors, faces, centers, explosions;
  std::vector<double> zooms, line_widths;
  std::string segment;
  bool refine = false, wireframe = false, palette = false;
  std::optional<double> crease_degrees;
  double azimuth_degrees = 35, elevation_degrees = 20, field_of_view_degrees = 25;
  render::Look look;
  std::string size = "1024x768", background = "white";
  int samples = 4;
  unsigned threads = 0;
  InputOptions input;
  robot::FileOptions robots;
};

constexpr std::string_view kOriginal = "original", kNone = "none", kTransparent = "transparent";

double radians(double degrees) { return degrees * kDegree; }

Rgb color_of(const std::string& text) {
  if (const auto color = render::parse_color(text)) return *color;
  refuse(fmt::format("'{}' is no colour; say #rrggbb, or one of {}", text, render::color_names()));
}

struct Size {
  int width = 0, height = 0;
};

Size size_of(const std::string& text) {
  constexpr int kMax = render::Image::kMaxSide;
  const std::size_t cross = std::min(text.find('x'), text.size());
  const auto side = [&](std::string_view part) { return parsed<int>(part).value_or(0); };
  const std::string_view all = text;
  const Size size{side(all.substr(0, cross)), side(all.substr(std::min(cross + 1, all.size())))};
  if (std::min(size.width, size.height) < 1 || std::max(size.width, size.height) > kMax)
    refuse(fmt::format("'{}' is no size; say WIDTHxHEIGHT in pixels, as 1024x768, at most {} each", text, kMax));
  return size;
}

std::size_t level_of(const std::string& text) {
  if (text == kOriginal) return MeshTable::kFinest;
  constexpr double kMost = 1e10;
  const auto faces = parsed<double>(text);  // as other commands take it: 1e6, too
  if (!faces || !(*faces >= 0 && *faces <= kMost) || *faces != std::floor(*faces))
    refuse(fmt::format("'{}' is no level; say a number of faces, or {}", text, kOriginal));
  return static_cast<std::size_t>(*faces);
}

double explosion_of(const std::string& text) {
  constexpr double kMost = 100;
  const auto factor = parsed<double>(text);
  if (!factor || !(*factor >= 0 && *factor <= kMost))
    refuse(fmt::format("--explode takes a number between 0 and {}, or {}, but not '{}'", kMost, kNone, text));
  return *factor;
}

Segment segment_of(const std::string& text) {
  const std::vector<double> numbers = numbers_of(text, 6, "segment");
  const Segment segment{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
  if (segment.a == segment.b) refuse(fmt::format("'{}': the ends of the segment are the same", text));
  return segment;
}

/// The value for panel `i` of an option that is given once, for all panels, or once for each.
template <class Value>
std::optional<Value> for_panel(const std::vector<Value>& values, std::size_t i) {
  if (values.empty()) return std::nullopt;
  return values[values.size() == 1 ? 0 : i];
}

/// All spheres of a file where the robot has its links at rest. Throws InputError that names `path`.
std::vector<Ball> posed(const std::vector<robot::LinkBalls>& links, const robot::Robot& robot,
                        const std::filesystem::path& path) {
  const std::vector<Pose> poses = robot::link_poses(robot, robot::rest_positions(robot));
  std::vector<Ball> balls;
  for (const robot::LinkBalls& link : links) {
    const auto found = std::ranges::find(robot.links, link.link, &robot::Link::name);
    if (found == robot.links.end())
      throw InputError(Defect::Malformed,
                       fmt::format("{}: the robot '{}' has no link '{}'", path.string(), robot.name, link.link));
    const Pose& pose = poses[static_cast<std::size_t>(found - robot.links.begin())];
    for (const Ball& ball : link.balls) balls.push_back({placed(pose, ball.center), ball.radius});
  }
  return balls;
}

/// The geometry of all links, posed as in the report of a robot. Throws InputError that names `path`.
TriangleMesh robot_mesh(const robot::Robot& robot, robot::Geometry which, const std::filesystem::path& path) {
  std::vector<TriangleMesh> links;
  for (const robot::Link& link : robot.links) links.push_back(robot::link_triangles(shapes(link, which), {}));
  TriangleMesh whole = robot::at_rest(robot, links);
  if (whole.face_count() > 0) render::require_drawable(whole, path);
  return whole;
}

/// A panel for each mesh, for each robot, and for each level that is asked for of each .phull file.
class Planner {
 public:
  Planner(const RenderOptions& options, MeshTable& table) : options_(options), table_(table) {
    std::vector<std::pair<std::filesystem::path, std::size_t>> shown;
    for (const auto& path : options.in)
      for (const std::size_t level : levels(path)) shown.emplace_back(path, level);
    require_fit(shown.size());
    for (const auto& [path, level] : shown) add(path, level);
  }
  const std::vector<PanelPlan>& plans() const { return plans_; }
  /// Of levels that are coarser than any of the file.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void require_fit(std::size_t panels) {
    const auto once_or_for_each = [panels](std::string_view option, std::size_t count) {
      if (count > 1 && count != panels)
        refuse(fmt::format("{} is given {} times; say it once, or for each of the {} panels", option, count, panels));
    };
    once_or_for_each("--over", options_.over.size());
    once_or_for_each("--split", options_.split.size());
    once_or_for_each("--color", options_.colors.size());
    once_or_for_each("--line-width", options_.line_widths.size());
    once_or_for_each("--zoom", options_.zooms.size());
    once_or_for_each("--center", options_.centers.size());
    once_or_for_each("--explode", options_.explosions.size());
    const auto is_hull = [&](const auto& path) { return is_mesh(path) && table_.is_hull(path); };
    if (!options_.faces.empty() && std::ranges::none_of(options_.in, is_hull))
      refuse("--faces is for .phull files; a mesh file has one level only");
  }

  /// A mesh or .phull file.
  static bool is_mesh(const std::filesystem::path& path) { return !is_robot_file(path) && !is_sphere_file(path); }

  std::vector<std::size_t> levels(const std::filesystem::path& path) {
    if (!is_mesh(path) || !table_.is_hull(path)) return {MeshTable::kFinest};
    if (options_.faces.empty()) return {0};
    std::vector<std::size_t> levels;
    for (const std::string& text : options_.faces) levels.push_back(level_of(text));
    return levels;
  }

  void add(const std::filesystem::path& path, std::size_t level) {
    PanelPlan plan;
    if (is_robot_file(path)) return add_robot(path, std::move(plan));
    if (is_sphere_file(path)) return add_spheres(path, std::move(plan));
    plan.inside = companion(options_.over, path);
    plan.right = companion(options_.split, path);
    if (options_.refine) {
      add_refined(path, level, plan);
    } else {
      plan.shown = table_.add(path, level);
      if (const std::size_t faces = table_.meshes()[plan.shown].face_count(); level > 0 && faces > level)
        notes_.push_back(fmt::format("{}: no level has {} faces or fewer; the coarsest one, of {}, is drawn",
                                     input_name(path), grouped(level), grouped(faces)));
    }
    add(std::move(plan), plan.inside || plan.right || level != MeshTable::kFinest);
  }

  void add(PanelPlan plan, bool is_hull) {
    const std::size_t i = plans_.size();
    if (!options_.segment.empty() && !plan.segment) plan.segment = crossings(plan.inside.value_or(plan.shown));
    if (const auto factor = for_panel(options_.explosions, i); factor && *factor != kNone)
      explode(plan, explosion_of(*factor));
    plan.color = color_of(for_panel(options_.colors, i).value_or(is_hull ? "blue" : "clay"));
    if (options_.wireframe) plan.line_width = for_panel(options_.line_widths, i).value_or(1);
    plan.zoom = for_panel(options_.zooms, i).value_or(1);
    if (const auto center = for_panel(options_.centers, i); center && *center != kNone)
      plan.center = vector_of(*center, "point");
    plans_.push_back(std::move(plan));
    stop_if_interrupted();
  }

  /// The visual geometry within the collision geometry; or what there is of the two.
  void add_robot(const std::filesystem::path& path, PanelPlan plan) {
    const auto is_asked = [&](const auto& names) { return for_panel(names, plans_.size()).value_or("none") != kNone; };
    if (options_.refine || is_asked(options_.over) || is_asked(options_.split))
      refuse(
          fmt::format("{}: a robot is drawn within its own collision geometry; leave out --refine, and say --over none "
                      "or --split none of its panel",
                      path.string()));
    const robot::Robot robot = robot::read_robot(path, options_.robots).robot;
    TriangleMesh visual = robot_mesh(robot, robot::Geometry::Visual, path);
    TriangleMesh collision = robot_mesh(robot, robot::Geometry::Collision, path);
    const bool has_collision = collision.face_count() > 0;
    if (has_collision && visual.face_count() > 0) plan.inside = table_.add(std::move(visual));
    plan.inside_color = render::parse_color("grey");
    plan.shown = table_.add(std::move(has_collision ? collision : visual));
    if (table_.meshes()[plan.shown].face_count() == 0)
      throw InputError(Defect::EmptyMesh, path.string() + ": the robot has no geometry to draw");
    add(std::move(plan), has_collision);
  }

  /// The spheres of one link over its mesh, or those of all links over the robot.
  void add_spheres(const std::filesystem::path& path, PanelPlan plan) {
    if (options_.refine || for_panel(options_.split, plans_.size()).value_or("none") != kNone)
      refuse(fmt::format("{}: spheres are drawn --over a mesh or a robot; leave out --refine, and say --split none",
                         path.string()));
    const std::vector<robot::LinkBalls> links = robot::read_sphere_file(read_bytes(path), path);
    const std::filesystem::path over = for_panel(options_.over, plans_.size()).value_or(std::string(kNone));
    std::vector<Ball> balls;
    if (is_robot_file(over)) {
      const robot::Robot robot = robot::read_robot(over, options_.robots).robot;
      balls = posed(links, robot, path);
      TriangleMesh visual = robot_mesh(robot, robot::Geometry::Visual, over);
      if (visual.face_count() > 0) plan.inside = table_.add(std::move(visual));
    } else if (links.size() > 1) {
      refuse(fmt::format("{}: it has spheres of {} links; say --over ROBOT.urdf, so that they have a place",
                         path.string(), links.size()));
    } else {
      if (!links.empty()) balls = links[0].balls;
      if (over != kNone) plan.inside = table_.add(over, MeshTable::kFinest);
    }
    if (balls.empty()) throw InputError(Defect::EmptyMesh, path.string() + ": there are no spheres to draw");
    TriangleMesh spheres = render::spheres(balls);
    render::require_drawable(spheres, path);
    plan.shown = table_.add(std::move(spheres));
    add(std::move(plan), true);
  }

  void explode(PanelPlan& plan, double factor) {
    render::Exploded apart = render::exploded(table_.meshes()[plan.shown], factor);
    render::require_drawable(apart.mesh, fmt::format("--explode {}", factor));
    plan.face_colors = std::move(apart.colors);
    plan.shown = table_.add(std::move(apart.mesh));
  }

  void add_refined(const std::filesystem::path& path, std::size_t level, PanelPlan& plan) {
    if (!table_.is_hull(path)) refuse(fmt::format("{}: only .phull files can be refined", path.string()));
    const Segment segment = segment_of(options_.segment);
    RefinedAlong refined = refine_along(table_.hull(path).with_base(level), segment);
    plan.shown = table_.add(std::move(refined.hull));
    plan.segment = {segment, std::move(refined.found), std::move(refined.missed)};
  }

  render::MarkedSegment crossings(std::size_t mesh) const {
    render::MarkedSegment marked{segment_of(options_.segment), {}, {}};
    for (const Hit& hit : MeshQuery(QueryIndex(table_.meshes()[mesh])).all_hits(marked.segment))
      marked.found.push_back(hit.t);
    return marked;
  }

  std::optional<std::size_t> companion(const std::vector<std::string>& names, const std::filesystem::path& of) {
    const auto name = for_panel(names, plans_.size());
    if (!name || *name == kNone) return std::nullopt;
    if (is_robot_file(*name)) return robot_as_shown(*name);
    return table_.add(*name == kOriginal ? of : std::filesystem::path(*name), MeshTable::kFinest);
  }

  /// The visual geometry of the robot at rest; nothing if it has none.
  std::optional<std::size_t> robot_as_shown(const std::filesystem::path& path) const {
    TriangleMesh visual = robot_mesh(robot::read_robot(path, options_.robots).robot, robot::Geometry::Visual, path);
    if (visual.face_count() == 0) return std::nullopt;
    return table_.add(std::move(visual));
  }

  const RenderOptions& options_;
  MeshTable& table_;
  std::vector<PanelPlan> plans_;
  std::vector<std::string> notes_;
};

render::Look look_of(const RenderOptions& options) {
  render::Look look = options.look;
  if (options.crease_degrees) look.crease_angle = radians(*options.crease_degrees);
  look.view.azimuth = radians(options.azimuth_degrees);
  look.view.elevation = radians(options.elevation_degrees);
  look.view.field_of_view = radians(options.field_of_view_degrees);
  return look;
}

void require_sound(const RenderOptions& options) {
  output_suffix(options.out, {"pictures", {".png"}}, is_standard_stream(options.out) ? "png" : "");
  std::vector<std::filesystem::path> inputs = options.in;
  for (const auto& names : {options.over, options.split})
    for (const std::string& name : names)
      if (name != kOriginal && name != kNone) inputs.emplace_back(name);
  std::ranges::sort(inputs);  // each is read once
  inputs.erase(std::unique(inputs.begin(), inputs.end()), inputs.end());
  check_files(inputs, {options.out, options.report});
  if (options.refine && options.segment.empty()) refuse("--refine needs the --segment to refine along");
}

/// "200" or "96,966 + 2,000 + 200"
std::string face_counts(const std::vector<PanelPlan>& plans, const MeshTable& table) {
  std::string text;
  for (const PanelPlan& plan : plans)
    text += (text.empty() ? "" : " + ") + grouped(table.meshes()[plan.shown].face_count());
  return text + (text == "1" ? " face" : " faces");
}

nlohmann::json facts_of(const PanelPlan& plan, const MeshTable& table) {
  nlohmann::json panel{{"faces", table.meshes()[plan.shown].face_count()}};
  if (plan.inside) panel["faces_inside"] = table.meshes()[*plan.inside].face_count();
  if (plan.segment) panel["crossings"] = {{"found", plan.segment->found}, {"missed", plan.segment->missed}};
  if (plan.right) panel["faces_right"] = table.meshes()[*plan.right].face_count();
  return panel;
}

render::Image drawn(const std::vector<render::Panel>& panels, const Size& size, const RenderOptions& options) {
  ProgressLine line;
  render::DrawOptions draw_options{
      .samples = options.samples, .background = {}, .threads = static_cast<int>(options.threads)};
  if (options.background != kTransparent) draw_options.background = color_of(options.background);
  draw_options.progress = std::ref(line);
  return render::draw(size.width, size.height, panels, draw_options);
}

int run_render(const RenderOptions& options) {
  const Stopwatch watch;
  require_sound(options);
  const Size size = size_of(options.size);
  const render::Look look = look_of(options);
  if (options.background != kTransparent) color_of(options.background);

  MeshTable table([&](const std::filesystem::path& path) { return read_mesh_or_hull(path, options.input); });
  const Planner planner(options, table);
  const std::vector<PanelPlan>& plans = planner.plans();
  if (static_cast<std::size_t>(size.width) < plans.size())
    refuse(fmt::format("{} panels do not fit into {} pixels", plans.size(), size.width));
  const double read_seconds = watch.seconds();
  const auto panels = render::compose(plans, table.meshes(), look, size.width, size.height);
  stop_if_interrupted();
  const render::Image image = drawn(panels, size, options);
  const double draw_seconds = watch.seconds() - read_seconds;
  const std::string png = options.palette ? render::encode_small_png(image) : render::encode_png(image);
  Outputs outputs;
  outputs.add(options.out, png);
  outputs.add_report(options.report,
                     {{"path", options.out.string()},
                      {"width", size.width},
                      {"height", size.height},
                      {"panels", json_list(plans, [&](const PanelPlan& plan) { return facts_of(plan, table); })},
                      {"bytes", png.size()},
                      {"seconds", watch.seconds()}});
  outputs.commit();
  say("{}: {} x {}, {}, {:.1f} s\n", output_name(options.out), size.width, size.height, face_counts(plans, table),
      watch.seconds());
  for (const std::string& note : planner.notes()) say("  {}\n", note);
  say_more("  {} bytes; read {:.2f} s, draw {:.2f} s, write {:.2f} s\n", grouped(png.size()), read_seconds,
           draw_seconds, watch.seconds() - read_seconds - draw_seconds);
  return kDone;
}

/// What is said of options that are given once, for all panels, or once for each.
constexpr const char* kForPanels = " Given once, for all panels, or once for each.";

void add_content_options(CLI::App& command, RenderOptions& options) {
  const Heading heading(command, "What is drawn");
  add_value(command, "--faces", options.faces, "N[,N...]",
            "Levels of .phull files to draw, each in a panel: numbers of faces, or original for the original mesh. "
            "Without this option the coarsest level is drawn.")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_value(command, "--over", options.over, "MESH",
            std::string("Draw IN translucent over this mesh or robot, or over its own original mesh, if that is "
                        "original and IN is a .phull file; none draws it over nothing.") +
                kForPanels)
      ->allow_extra_args(false);
  add_value(command, "--split", options.split, "MESH",
            std::string("Draw IN in the left half of its panel and this mesh in the right half. original and none mean "
                        "the same as with --over.") +
                kForPanels)
      ->allow_extra_args(false);
  add_value(command, "--explode", options.explosions, "FACTOR",
            std::string("Draw each part of IN in a colour of its own, and move it away from the middle by this factor, "
                        "0 to 100; 0 moves nothing, and none draws one mesh of one colour. Parts are what shared "
                        "vertices connect, such as the pieces of `prohull convex`.") +
                kForPanels)
      ->allow_extra_args(false);
  add_value(command, "--segment", options.segment, "X,Y,Z,X,Y,Z",
            "Draw this segment, and a mark where it crosses IN, or the mesh that IN is drawn over.");
  command.add_flag("--refine", options.refine,
                   "Refine the hull of a .phull file where the --segment meets it, as Platis and Theoharis (2003) do. "
                   "Crossings that this finds are green, others are red.");
}

void add_look_options(CLI::App& command, RenderOptions& options) {
  const Heading heading(command, "Look");
  command.add_flag("--wireframe", options.wireframe, "Draw the edges of IN.");
  add_optional_number(command, "--line-width", options.line_widths, {0, 100},
                      std::string("Width of the edges, in pixels.") + kForPanels)
      ->allow_extra_args(false)
      ->default_str("1")
      ->type_name("WIDTH");
  add_optional_number(command, "--crease", options.crease_degrees, {0, 180},
                      "Faces look smooth where their directions differ by less than this angle, 0 to 180 degrees. "
                      "Without this option it is 40 for meshes of 10,000 faces or more, and 0 for others.")
      ->type_name("DEGREES");
  add_value(
      command, "--color", options.colors, "COLOR",
      fmt::format(
          "Colour of IN: #rrggbb, {}.{} Without this option hulls are blue, and other meshes have the colour of clay.",
          render::color_names(), kForPanels))
      ->allow_extra_args(false);
  add_number(command, "--opacity", options.look.opacity, {0, 1},
             "Opacity of IN where it is drawn --over a mesh, 0 to 1.")
      ->type_name("OPACITY");
  command.add_flag("--ground", options.look.ground, "Draw a ground below the meshes, on which shadows fall.");
  add_value(command, "--background", options.background, "COLOR", "Colour of the background, or transparent.")
      ->capture_default_str();
}

void add_view_options(CLI::App& command, RenderOptions& options) {
  const Heading heading(command, "View");
  static constexpr std::array<std::pair<std::string_view, int>, 3> kAxes{{{"x", 0}, {"y", 1}, {"z", 2}}};
  add_choice(command, "--up", options.look.view.up, kAxes, "Axis that points up.");
  add_number(command, "--azimuth", options.azimuth_degrees, {-360, 360},
             "Degrees by which the camera goes around that axis. 0 shows the front, 90 the right side.")
      ->type_name("DEGREES");
  add_number(command, "--elevation", options.elevation_degrees, {-90, 90},
             "Degrees by which the camera is above the horizon, -90 to 90.")
      ->type_name("DEGREES");
  add_optional_number(
      command, "--zoom", options.zooms, {0.01, 1000},
      std::string("Magnification. At 1 all of the meshes is seen, at 2 the middle half of the picture.") + kForPanels)
      ->allow_extra_args(false)
      ->default_str("1")
      ->type_name("FACTOR");
  add_value(
      command, "--center", options.centers, "X,Y,Z",
      std::string("Point that is in the middle of the picture, or none for the middle of the meshes.") + kForPanels)
      ->allow_extra_args(false);
  add_number(command, "--fov", options.field_of_view_degrees, {1, 120},
             "Angle that the camera sees across the shorter side of a panel, in degrees, 1 to 120.")
      ->type_name("DEGREES");
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<RenderOptions>(
      app, run, "render",
      "Draws meshes, hulls and robots as a PNG picture. Each of them has a panel of its own, side by side.",
      run_render);
  add_value(command, "in", options.in, "IN",
            std::string("Meshes, .phull files, robots (.urdf, .xacro, .sdf, .mjcf, .xml) or spheres (.yaml) to draw. "
                        "Robots are drawn within their collision geometry, and spheres --over a mesh or a robot. ") +
                kMeshFiles)
      ->required();
  add_value(command, "-o,--out", options.out, "OUT.png",
            "File for the picture, .png. With - it goes to standard output.")
      ->required();
  add_format_option(command, options.input);
  add_package_path_option(command, options.robots.package_paths);
  add_value(command, "--size", options.size, "WIDTHxHEIGHT", "Size of the picture, in pixels.")->capture_default_str();
  add_number(command, "--samples", options.samples, {1, 256},
             "Number of samples in each pixel, 1 to 256. More of them make smoother edges.");
  command.add_flag("--palette", options.palette,
                   "Use at most 256 colours, so that the file is less than half as large.");
  add_threads_option(command, options.threads, "The picture is the same for any number.");
  add_report_option(command, options.report);
  add_content_options(command, options);
  add_look_options(command, options);
  add_view_options(command, options);
  add_examples(command,
               {"prohull render horse.ply -o horse.png --ground",
                "prohull render hull.ply --over horse.ply --wireframe -o both.png",
                "prohull render hull.stl --split horse.ply --wireframe -o halves.png",
                "prohull render horse.phull --faces original,2000,200 --wireframe -o levels.png --size 1200x400",
                "prohull render horse.ply horse_pieces.obj --explode none --explode 0.3 -o pieces.png",
                "prohull render arm_spheres.yaml --over arm.urdf -o spheres.png",
                "prohull render zone.stl --over arm.urdf -o zone.png",
                "prohull render arm.urdf arm_safe/arm.urdf --color orange --color blue -o arm.png",
                "prohull render pump.stl -o pump.png --up y --azimuth 120 --background transparent"});
}

}  // namespace prohull::cli

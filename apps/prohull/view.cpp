#include "view/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "command.h"
#include "prohull/error.h"
#include "robot/files/robot_file.h"
#include "robot/hulls/write_robot.h"
#include "union_files.h"
#include "view/shown_robot.h"

namespace prohull::cli {
namespace {

struct ViewOptions {
  std::vector<std::filesystem::path> in;
  std::filesystem::path out, original;
  HullSide side = HullSide::Outer;
  bool solid_only = false, is_union = false;
  unsigned threads = 0;
  InputOptions input, original_input;
  robot::FileOptions robots;
};

/// The page names files without their folders, but for the last one where several have the same name.
std::string shown_name(const std::filesystem::path& path, const ViewOptions& options) {
  if (is_standard_stream(path)) return input_name(path);
  const auto is_called_so = [&](const auto& other) { return other.filename() == path.filename(); };
  if (std::ranges::count_if(options.in, is_called_so) < 2) return path.filename().string();
  return (path.parent_path().filename() / path.filename()).string();
}

/// What the SRDF file beside a robot disables, such as `prohull urdf` writes it.
std::optional<std::vector<robot::LinkPair>> disabled_beside(const robot::RobotFile& file) {
  const std::filesystem::path path = file.path.parent_path() / (robot_stem(file) + ".srdf");
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  return disabled_pairs(file.robot, {std::istreambuf_iterator<char>(in), {}}, path.string());
}

bool goes_on(std::string_view, double) { return !interrupted(); }

view::ShownRobot read_robot(const ViewOptions& options, const std::filesystem::path& path) {
  const robot::RobotFile file = robot::read_robot(path, options.robots);
  view::ShownRobot shown = view::as_shipped(file.robot, goes_on);
  shown.disabled = disabled_beside(file);
  return shown;
}

/// All files together.
view::Shown read_parts(const ViewOptions& options) {
  std::string name = shown_name(options.in.front(), options);
  if (options.in.size() > 1) name += fmt::format(" and {} more", options.in.size() - 1);
  Union found = read_union(options.in, options.input, "");
  if (found.pieces.empty()) return {name, std::move(found.balls)};
  if (found.balls.empty()) return {name, std::move(found.pieces)};
  refuse(name + ": a page shows pieces or spheres, but not both");
}

view::Shown read_shown(const ViewOptions& options, const std::filesystem::path& path) {
  const std::string name = shown_name(path, options);
  if (is_robot_file(path)) return {name, read_robot(options, path)};
  MeshOrHull read = read_mesh_or_hull(path, options.input, NonFinite::Keep);
  if (auto* const hull = std::get_if<ProgressiveHull>(&read)) return {name, std::move(*hull)};
  return {name, std::get<TriangleMesh>(std::move(read))};
}

std::vector<view::Shown> read_all_shown(const ViewOptions& options) {
  if (options.is_union) return {read_parts(options)};
  std::vector<view::Shown> shown;
  for (const auto& path : options.in) {
    shown.push_back(read_shown(options, path));
    stop_if_interrupted();
  }
  return shown;
}

std::optional<view::Original> read_original(const ViewOptions& options) {
  if (options.original.empty()) return std::nullopt;
  return view::Original{shown_name(options.original, options),
                        read_input(options.original, options.original_input, NonFinite::Keep)};
}

/// Robots are in metres, and so is what --unit converts.
std::string unit_of(const ViewOptions& options) {
  const bool is_metres = options.original_input.unit > 0 || std::ranges::any_of(options.in, is_robot_file);
  return is_metres ? "m" : "";
}

std::string written_page(const ViewOptions& options) {
  ProgressLine line;
  return view::page(read_all_shown(options), read_original(options),
                    {.side = options.side,
                     .solid_only = options.solid_only,
                     .unit = unit_of(options),
                     .version = PROHULL_VERSION,
                     .threads = options.threads,
                     .progress = std::ref(line)});
}

}  // namespace

void require_page(const std::filesystem::path& out) {
  if (!view::has_page()) throw InputError(Defect::CannotRead, std::string(view::kNoPage));
  output_suffix(out, {"pages", {".html", ".htm"}}, is_standard_stream(out) ? "html" : "");
}

namespace {

int run_view(const ViewOptions& options) {
  if (options.in.size() > view::kMostShown && !options.is_union)
    refuse(fmt::format("a page shows {} files at most", view::kMostShown));
  require_page(options.out);
  std::vector<std::filesystem::path> inputs = options.in;
  inputs.push_back(options.original);
  check_files(inputs, {options.out});
  const Stopwatch making;
  const std::string page = written_page(options);
  Outputs outputs;
  outputs.add(options.out, page);
  outputs.commit();
  say("{}: {:.1f} MB, which any browser opens, {:.2f} s\n", output_name(options.out),
      static_cast<double>(page.size()) * 1e-6, making.seconds());
  say_more("  {} bytes, with {}\n", grouped(page.size()), counted(options.in.size(), "object"));
  return kDone;
}

}  // namespace

void add_view(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<ViewOptions>(
      app, run, "view",
      "Writes a page of HTML that shows hulls in any browser, in three dimensions. The page is one "
      "file. It needs no network, so that it can be mailed and archived. Verdicts and counts on it "
      "are exact, and distances are proven bounds.",
      [](ViewOptions chosen) {
        chosen.original_input.format = chosen.input.format;  // one of them may be standard input
        return run_view(chosen);
      });
  add_value(command, "in", options.in, "IN",
            std::string("Hulls, meshes or robots to show. Of a .phull file a slider shows all levels; of a robot "
                        "(.urdf, .xacro, .sdf, .mjcf, .xml), sliders move the joints, and links that collide are lit: "
                        "pairs that the .srdf file beside it disables may touch. ") +
                kMeshFiles)
      ->required();
  add_value(command, "-o,--out", options.out, "OUT.html",
            "File for the page, .html. With - it goes to standard output.")
      ->required();
  CLI::Option* const original = add_value(
      command, "--original", options.original, "M",
      "Mesh that each IN is a hull of. The page then tells whether it encloses that mesh, how far it is from it "
      "and where. Without this option, a .phull file is compared with its own finest level.");
  add_format_option(command, options.input);
  add_package_path_option(command, options.robots.package_paths);
  add_unit_options(command, options.original_input, "M (the same as `prohull build` was given for it)");
  for (const char* const option : {"--scale", "--unit"}) command.get_option(option)->needs(original);
  add_choice(command, "--side", options.side, hull_side_names(),
             "Side on which the hulls lie. With inner, M should enclose IN. A .phull file knows its side.");
  command.add_flag("--union", options.is_union,
                   "IN are files of pieces or spheres that cover M together, as `prohull verify --union` reads them: "
                   "each connected component of a mesh is a piece.");
  command.add_flag("--solid-only", options.solid_only,
                   "Ask only for the solid that a closed mesh bounds, as `prohull verify --solid-only` does.");
  add_threads_option(command, options.threads, "The page is the same for any number.");
  add_examples(command,
               {"prohull view horse.phull -o horse.html", "prohull view hull.stl --original horse.ply -o view.html",
                "prohull view coarse.stl fine.stl --original part.stl -o compare.html",
                "prohull view --union pieces.obj --original part.stl -o pieces.html",
                "prohull view --union spheres.yaml --original part.stl -o spheres.html",
                "prohull view arm_safe/arm.urdf -o arm.html",
                "prohull view occluder.obj --original rock.obj --side inner -o occluder.html",
                "prohull view arm_collision.stl --original arm.stl --unit mm -o link.html"});
}

}  // namespace prohull::cli

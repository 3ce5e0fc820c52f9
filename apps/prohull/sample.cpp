#include "prohull/sample.h"

#include <fmt/format.h>

#include <algorithm>

#include "command.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "robot/files/robot_file.h"
#include "robot/hulls/write_robot.h"
#include "robot/samples/sample_robots.h"

namespace prohull::cli {
namespace {

struct SampleOptions {
  std::string name, out_format;
  std::filesystem::path out;
  std::size_t faces = 20000;
  bool has_faces = false;  // they were given
};

bool is_robot(const std::string& name) {
  const auto robots = robot::sample_robots();
  return std::any_of(robots.begin(), robots.end(), [&](const auto& robot) { return robot.name == name; });
}

int make_mesh(const SampleOptions& options) {
  const Stopwatch watch;
  const std::string suffix = output_suffix(options.out, mesh_outputs(), options.out_format);
  check_files({}, {options.out});
  TriangleMesh mesh = make_sample(options.name, options.faces);
  if (stores_float32(mesh_format("mesh" + suffix))) mesh = robot::rounded_to_float32(std::move(mesh));
  Outputs outputs;
  outputs.add(options.out, suffix, [&](const auto& file) { return write_mesh(file, mesh), true; });
  outputs.commit();
  say("{}: {} of {}\n", output_name(options.out), options.name, counted(mesh.face_count(), "face"));
  say_more("  {}, made and written in {:.2f} s\n", counted(mesh.vertex_count(), "vertex", "vertices"), watch.seconds());
  return kDone;
}

/// Before any work. Throws InputError.
void check_robot_options(const SampleOptions& options) {
  if (options.has_faces)
    refuse(fmt::format("--faces is for meshes; the robot {} has meshes of its own sizes; leave --faces out",
                       options.name));
  if (is_standard_stream(options.out) || !options.out_format.empty())
    refuse(fmt::format("the robot {0} is a folder of files; name the folder, as in -o {0}, without --out-format",
                       options.name));
  const std::vector<std::string> meshes = read_mesh_extensions();
  if (robot::is_robot_file(options.out) || std::ranges::find(meshes, options.out.extension().string()) != meshes.end())
    refuse(fmt::format(
        "{}: the robot {} is a folder of files, and this is the name of a file; name the folder, as in -o {}",
        options.out.string(), options.name, options.out.stem().string()));
}

/// Throws InputError(CannotWrite) for what is there, unless it is an empty folder. The current one is refused too: the
/// shell would stay in the folder that is replaced.
void require_new_folder(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder)) return check_files({}, {folder});
  if (std::filesystem::is_directory(folder) && std::filesystem::is_empty(folder) &&
      !std::filesystem::equivalent(folder, "."))
    return;
  throw InputError(Defect::CannotWrite,
                   fmt::format("{}: cannot write: it is there and is no empty folder elsewhere; name a new folder",
                               folder.string()));
}

void write_robot(const std::filesystem::path& folder, const std::string& name, const robot::SampleRobot& robot) {
  std::filesystem::create_directory(folder);
  robot::write_text(folder / (name + ".urdf"), robot.urdf);
  for (const auto& [path, mesh] : robot.meshes) {
    stop_if_interrupted();
    std::filesystem::create_directories((folder / path).parent_path());
    write_mesh(folder / path, mesh);
  }
}

int make_robot(const SampleOptions& options) {
  const Stopwatch watch;
  check_robot_options(options);
  const std::filesystem::path folder = options.out.has_filename() ? options.out : options.out.parent_path();
  require_new_folder(folder);
  const robot::SampleRobot robot = robot::make_sample_robot(options.name);
  Outputs outputs;
  outputs.add(folder, "", [&](const auto& unfinished) { return write_robot(unfinished, options.name, robot), true; });
  outputs.commit();
  std::size_t faces = 0;
  for (const auto& [path, mesh] : robot.meshes) faces += mesh.face_count();
  say("{}: {} with {} of {}\n", (folder / (options.name + ".urdf")).string(), options.name,
      counted(robot.meshes.size(), "mesh", "meshes"), counted(faces, "face"));
  say_more("  made and written in {:.2f} s\n", watch.seconds());
  return kDone;
}

int make(const SampleOptions& options) { return is_robot(options.name) ? make_robot(options) : make_mesh(options); }

}  // namespace

void add_sample(CLI::App& app, Run& run) {
  const auto options = std::make_shared<SampleOptions>();
  CLI::App& command =
      *app.add_subcommand("sample", "Makes one of the bundled meshes or robots, to try other commands with.");
  std::string meshes, robots;
  std::vector<std::string> words;
  const auto add = [&words](std::string& list, std::string_view name, std::string_view description) {
    list += fmt::format("\n  {:<12} {}", name, description);
    words.emplace_back(name);
  };
  for (const SampleInfo& sample : samples()) add(meshes, sample.name, sample.description);
  for (const robot::SampleRobotInfo& sample : robot::sample_robots()) add(robots, sample.name, sample.description);
  add_value(command, "name", options->name, CLI::detail::join(words, "|"),
            "The mesh to make:" + meshes + "\nor the robot, a URDF file and its meshes:" + robots)
      ->required()
      ->transform(one_of("NAME", words));
  add_value(command, "-o,--out", options->out, "OUT",
            fmt::format("File for the mesh. Its name ends in {}, which tells the format. With - it goes to standard "
                        "output. For a robot: a new folder.",
                        alternatives(mesh_outputs().suffixes)))
      ->required();
  add_out_format_option(command, options->out_format, mesh_outputs());
  const CLI::Option* const faces =
      add_number(command, "--faces", options->faces, {4, 1e9},
                 "Number of faces, which the mesh has within 20 % where its shape allows. Not with robots.");
  add_examples(command, {"prohull sample asteroid -o asteroid.ply --faces 1e5",
                         "prohull sample knot -o - --out-format stl | prohull info -", "prohull sample arm -o arm"});
  command.callback([options, faces, &run] {
    options->has_faces = faces->count() > 0;
    run = [options] { return make(*options); };
  });
}

}  // namespace prohull::cli

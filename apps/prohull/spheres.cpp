#include <fmt/format.h>

#include <utility>

#include "certificate_output.h"
#include "command.h"
#include "prohull/detail/cover_summary.h"
#include "prohull/error.h"
#include "prohull/sphere_cover.h"
#include "robot/files/piece_files.h"
#include "robot/files/sphere_file.h"
#include "robot/hulls/write_robot.h"
#include "union_files.h"
#include "verdict.h"

namespace prohull::cli {
namespace {

struct SpheresOptions {
  std::filesystem::path in, out, certificate, report;
  std::string out_format, link;
  InputOptions input;
  SphereCoverOptions cover;
  Length max_distance;
};

struct Outcome {
  SphereCover cover;
  std::size_t faces = 0;
  double diagonal = 0, read_seconds = 0;
  Certificate certificate;

  double void_ratio() const { return cover.volume / cover.original_volume - 1; }
  bool has_volume() const { return cover.original_volume > 0; }
};

OutputKind sphere_outputs() { return {"spheres", {".yaml", ".yml", ".urdf", ".xml", ".json"}}; }

/// "arm" of "arm.stl" and of "arm.stl.gz"
std::string link_name(const SpheresOptions& options) {
  if (!options.link.empty()) return options.link;
  if (is_standard_stream(options.in)) return "link";
  const std::string packed = options.in.extension().string();
  const std::filesystem::path name = options.in.stem();
  return (packed == ".gz" || packed == ".zip" ? name.stem() : name).string();
}

std::string text_of(const SpheresOptions& options, const std::string& suffix, const std::vector<Ball>& balls) {
  const std::string link = link_name(options);
  const robot::LinkBalls spheres{link, balls};
  if (suffix == ".yaml" || suffix == ".yml") return robot::sphere_file(std::span(&spheres, 1));
  if (suffix == ".json") return robot::sphere_json(spheres);
  std::vector<robot::NamedPiece> pieces;
  for (const Ball& ball : balls) pieces.push_back({ball, {}});
  return suffix == ".urdf" ? robot::urdf_of(link, pieces) : robot::mjcf_of(link, pieces);
}

/// The file is read as `prohull verify --union` reads it.
void add_spheres(Outputs& outputs, const SpheresOptions& options, const std::string& suffix,
                 const std::vector<Ball>& balls) {
  const bool holds = outputs.add(options.out, suffix, [&](const std::filesystem::path& file) {
    robot::write_text(file, text_of(options, suffix, balls));
    return read_union({file}, {}, "").balls == balls;
  });
  if (!holds)
    throw InputError(Defect::CannotWrite,
                     fmt::format("{}: {} files do not keep these spheres", output_name(options.out), suffix));
}

/// Before any work: throws InputError for a name that the format cannot hold.
std::string check_options(const SpheresOptions& options) {
  const std::string suffix = output_suffix(options.out, sphere_outputs(), options.out_format);
  check_certified(options.certificate, options.in, suffix, {".yaml"});
  check_files({options.in}, {options.out, options.certificate, options.report});
  text_of(options, suffix, {});
  return suffix;
}

nlohmann::json report_of(const SpheresOptions& options, const Outcome& outcome) {
  const SphereCover& cover = outcome.cover;
  return {{"input", {{"path", options.in.string()}, {"faces", outcome.faces}, {"diagonal", outcome.diagonal}}},
          {"path", options.out.string()},
          {"link", link_name(options)},
          {"verdict", facts(cover.verdict)},
          {"within_bounds", cover.within_bounds},
          {"spheres", cover.balls},
          {"solid_is_wrap", cover.is_of_wrap},
          {"volume", cover.volume},
          {"original_volume", cover.original_volume},
          {"void_ratio", outcome.has_volume() ? nlohmann::json(outcome.void_ratio()) : nlohmann::json()},
          {"void_is_estimated", cover.is_estimated},
          {"notes", cover.notes},
          {"seconds", {{"read", outcome.read_seconds}, {"cover", cover.seconds}, {"verify", cover.verify_seconds}}}};
}

void print_summary(const SpheresOptions& options, const Outcome& outcome) {
  const SphereCover& cover = outcome.cover;
  say("{}\n", line_of_cover(output_name(options.out), cover, outcome.faces, outcome.diagonal));
  if (!cover.within_bounds) say("  --max-distance {:g} is not kept\n", options.cover.max_distance);
  if (const std::string volume = line_of_volume(cover); !volume.empty()) say("  {}\n", volume);
  for (const std::string& note : cover.notes) say("  {}\n", note);
  say("  {}\n", line_of_proof(cover));
  if (cover.verdict.certified && !options.certificate.empty())
    print_certificate(options.certificate, outcome.certificate, {options.out}, options.in);
  say("  read {:.2f} s, cover {:.2f} s, of which verify {:.2f} s\n", outcome.read_seconds, cover.seconds,
      cover.verify_seconds);
}

int run_spheres(SpheresOptions options) {
  const std::string suffix = check_options(options);
  Outcome outcome;
  InputMesh in = read_given(options.in, options.input);
  outcome.read_seconds = in.seconds;
  outcome.faces = in.mesh.face_count(), outcome.diagonal = finite_bounding_box(in.mesh).diagonal();
  in.unit.set(options.cover.max_distance, options.max_distance, "--max-distance");
  const CertifiedOriginal original = certified_original(options.certificate, in.mesh, options.in, options.input);
  outcome.cover = naming(options.in, options.cover,
                         [&](const SphereCoverOptions& how) { return sphere_cover(std::move(in.mesh), how); });
  Outputs outputs;
  if (outcome.cover.verdict.certified) add_spheres(outputs, options, suffix, outcome.cover.balls);
  if (outcome.cover.verdict.certified && !options.certificate.empty()) {
    outcome.certificate = balls_certificate(outcome.cover.balls, original);
    outputs.add(options.certificate, outcome.certificate.bytes);
  }
  outputs.add_report(options.report, report_of(options, outcome));
  outputs.commit();
  print_summary(options, outcome);
  return outcome.cover.verdict.certified && outcome.cover.within_bounds ? kDone : kAnswerIsNo;
}

}  // namespace

void add_spheres(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<SpheresOptions>(
      app, run, "spheres",
      "Covers a mesh by spheres, for planners that take nothing else. Every triangle is covered, which is proven "
      "exactly, and the spheres reach out of the mesh as little as their number allows.",
      run_spheres);
  add_mesh_input(command, options.in, options.input, "Mesh to cover.");
  add_value(command, "-o,--out", options.out, "OUT",
            "File for the spheres. Its name tells the format: .yaml or .yml for cuRobo, .urdf, .xml for MuJoCo, or "
            ".json. With - it goes to standard output.")
      ->required();
  add_out_format_option(command, options.out_format, sphere_outputs());
  add_certificate_option(command, options.certificate, "the spheres");
  add_number(command, "--count", options.cover.max_balls, {1, double{kMostCoverBalls}}, "Number of spheres, at most.");
  add_length(command, "--max-distance", options.max_distance,
             "Largest allowed distance that the spheres may reach out of the mesh. What closes openings of the mesh "
             "counts as mesh. As few spheres as are found to keep it are taken, at most --count. The exit code is 1 if "
             "they do not keep it.");
  command.add_flag("--fill", options.cover.fill, "Cover the inside of the mesh too, not only its surface.");
  add_value(command, "--link", options.link, "NAME",
            "Name of the link in the output. The default is the mesh's file name.");
  add_threads_option(command, options.cover.threads, "The spheres are the same for any number.");
  add_report_option(command, options.report);
  add_examples(command,
               {"prohull spheres arm.stl --unit mm -o arm.yaml",
                "prohull spheres arm.stl --count 100 --max-distance 5 -o arm.urdf",
                "prohull spheres forearm.dae --fill --link forearm_link -o forearm.yml --report forearm.json"});
}

}  // namespace prohull::cli

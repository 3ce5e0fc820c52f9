#include "prohull/cage.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "certificate_output.h"
#include "command.h"
#include "prohull/detail/float32_hull.h"
#include "prohull/detail/rounded.h"
#include "prohull/mesh_io.h"
#include "verdict.h"

namespace prohull::cli {
namespace {

struct CageRunOptions {
  std::filesystem::path in, out, inner, certificate, report;
  InputOptions input;
  std::string out_format;
  CageOptions cage;
  Length gap;
  bool strict = false;
};

/// A hull and its file.
struct File {
  const char* side;
  bool is_inner;
  const CageHull* hull;
  std::filesystem::path path;
  std::string suffix;
  Verdict verdict = {};  ///< of the file
  std::filesystem::path certificate_path = {};
  Certificate certificate = {};

  bool is_as_asked() const {
    return verdict.certified && hull->is_disjoint && hull->keeps_gap && hull->hull().target_reached;
  }
};

Cage cage_of(TriangleMesh mesh, const CageRunOptions& options) {
  return naming(options.in, options.cage, [&](const CageOptions& cage) {
    if (cage.float32_coordinates) check_float32_spacing(mesh);
    return build_cage(std::move(mesh), cage);
  });
}

void write(File& file, Outputs& outputs) {
  const EnclosingHull& hull = file.hull->hull();
  const bool holds_bits = hull.certified && outputs.add(file.path, file.suffix, hull.mesh);
  file.verdict = hull.verdict, file.verdict.certified = hull.certified;
  file.verdict = as_written(std::move(file.verdict), holds_bits);
}

constexpr std::string_view kSideInName = "{side}";

std::filesystem::path certificate_path(const CageRunOptions& options, std::string_view side) {
  std::string name = options.certificate.string();
  if (const auto at = name.find(kSideInName); at != std::string::npos) name.replace(at, kSideInName.size(), side);
  return name;
}

void check_certificate(const CageRunOptions& options, const std::string& suffix, const std::string& suffix_of_inner) {
  check_certified(options.certificate, options.in, suffix);
  if (options.inner.empty() || options.certificate.empty()) return;
  check_certified(options.certificate, options.in, suffix_of_inner);
  if (options.certificate.string().find(kSideInName) == std::string::npos)
    refuse(fmt::format(
        "{}: each hull has a certificate; put {{side}} where outer and inner go, as in cage_{{side}}.phcert",
        options.certificate.string()));
}

void write_certificate(File& file, const CertifiedOriginal& original, const CageRunOptions& options, double asked_gap,
                       Outputs& outputs) {
  const EnclosingHull& hull = file.hull->hull();
  file.certificate_path = certificate_path(options, file.side);
  file.certificate = hull_certificate(
      hull.mesh, original,
      {.side = file.is_inner ? HullSide::Inner : HullSide::Outer, .gap = claimed_gap(asked_gap, hull.padding)});
  outputs.add(file.certificate_path, file.certificate.bytes);
}

// Summary and report

void print_input(const CageRunOptions& options, const Cage& cage) {
  const RepairedMesh& input = cage.outer.made.input;
  say("{}\n", line_of_input(input_name(options.in), input));
  for (const std::string& repair : describe(input.repairs)) say("  {}\n", repair);
  if (cage.inner && input.repairs.dropped_components > 0)
    say("  that is for the outer hull alone: the inner hull stays out of cavities, which lie inside of others\n");
  if (!input.closed) say("  bounds no solid: {}\n", input.obstacle);
  for (const std::string& note : cage.notes) say("  {}\n", note);
}

/// What an inner hull keeps less than the gap.
std::string text_of_missed_gap(double gap, bool is_asked) {
  if (is_asked) return fmt::format("; NOT the {:.6g} asked for: no inner hull that keeps it was found", gap);
  return fmt::format("; NOT the {:.6g} of the outer hull: with --gap, an inner hull may keep it, with less volume",
                     gap);
}

void print_hull(const Cage& cage, const File& file, bool gap_is_asked) {
  const EnclosingHull& hull = file.hull->hull();
  say("{}: {} hull of {}{}\n", output_name(file.path), file.side, counted(hull.mesh.face_count(), "face"),
      described_void(file.hull->made, hull));
  for (const std::string& note : hull.notes) say("  {}\n", note);
  say("  triangles: smallest angle {:.3g} degrees, worst aspect ratio {:.3g}\n",
      file.hull->quality.smallest_angle / kDegree, file.hull->quality.worst_aspect_ratio);
  if (!hull.target_reached) say("  NOT the {} faces asked for: no such hull was found\n", grouped(hull.target_faces));
  if (hull.self_intersections > 0)
    say("  NOT free of self-intersections: {}\n", counted(hull.self_intersections, "pair of faces", "pairs of faces"));
  say("  gap: at least {:.6g}, proven{}\n", rounded_down(hull.padding, 6),
      file.hull->keeps_gap ? "" : text_of_missed_gap(cage.gap, gap_is_asked));
  say("  certified: {}\n", certificate_of(file.verdict));
}

nlohmann::json facts_of(const File& file) {
  nlohmann::json json = facts(file.hull->hull());
  json.update(nlohmann::json{{"path", file.path.string()},
                             {"verdict", facts(file.verdict)},
                             {"disjoint", file.hull->is_disjoint},
                             {"keeps_gap", file.hull->keeps_gap},
                             {"quality", facts(file.hull->quality)},
                             {"smallest_angle_degrees", file.hull->quality.smallest_angle / kDegree},
                             {"worst_aspect_ratio", finite_or_null(file.hull->quality.worst_aspect_ratio)},
                             {"target_reached", file.hull->hull().target_reached}});
  return json;
}

nlohmann::json report_of(const CageRunOptions& options, const Cage& cage, const std::vector<File>& files) {
  nlohmann::json in = facts(cage.outer.made.input.found);
  in["path"] = options.in.string();
  in["repairs"] = describe(cage.outer.made.input.repairs);
  in["notes"] = cage.notes;
  nlohmann::json report{{"input", in},
                        {"gap", cage.gap},
                        {"options",
                         {{"faces", options.cage.outer_faces},
                          {"inner_faces", options.cage.inner_faces},
                          {"scale", options.input.factor()},
                          {"gap", cage.gap},
                          {"even", options.cage.even},
                          {"tight", options.cage.tight},
                          {"float32_coordinates", options.cage.float32_coordinates}}}};
  for (const File& file : files) report[file.side] = facts_of(file);
  return report;
}

std::string inner_suffix(const CageRunOptions& options) {
  return options.inner.empty() ? "" : output_suffix(options.inner, mesh_outputs());
}

int run_cage(CageRunOptions options) {
  const std::string suffix = output_suffix(options.out, mesh_outputs(), options.out_format);
  const std::string suffix_of_inner = inner_suffix(options);
  check_certificate(options, suffix, suffix_of_inner);
  std::vector<std::filesystem::path> outputs_named{options.out, options.inner, options.report,
                                                   certificate_path(options, "outer")};
  if (!options.inner.empty() && !options.certificate.empty())
    outputs_named.push_back(certificate_path(options, "inner"));
  check_files({options.in}, outputs_named);
  const auto keeps_float32 = [](const std::string& ending) {
    return !ending.empty() && stores_float32(mesh_format("hull" + ending));
  };
  options.cage.float32_coordinates = keeps_float32(suffix) || keeps_float32(suffix_of_inner);
  if (options.inner.empty())
    options.cage.inner_faces = 0;
  else if (options.cage.inner_faces == 0)
    options.cage.inner_faces = options.cage.outer_faces;
  const Stopwatch building;
  InputMesh in = read_given(options.in, options.input);
  options.cage.gap = in.unit.number_of(options.gap, "--gap");
  const CertifiedOriginal original = certified_original(options.certificate, in.mesh, options.in, options.input);
  const Cage cage = cage_of(std::move(in.mesh), options);
  const double build_seconds = building.seconds();
  std::vector<File> files{{"outer", false, &cage.outer, options.out, suffix}};
  if (cage.inner) files.push_back({"inner", true, &*cage.inner, options.inner, suffix_of_inner});
  Outputs outputs;
  for (File& file : files) {
    write(file, outputs);
    if (file.verdict.certified && !options.certificate.empty())
      write_certificate(file, original, options, cage.gap, outputs);
  }
  outputs.add_report(options.report, report_of(options, cage, files));
  outputs.commit();
  print_input(options, cage);
  for (const File& file : files) {
    print_hull(cage, file, options.cage.gap > 0);
    if (file.verdict.certified && !options.certificate.empty())
      print_certificate(file.certificate_path, file.certificate, {file.path}, options.in);
  }
  const bool is_disjoint = std::ranges::all_of(files, [](const File& file) { return file.hull->is_disjoint; });
  if (is_disjoint)
    say("disjoint: yes, no face touches {}or itself\n", cage.inner ? "the mesh, the other hull " : "the mesh ");
  else
    say("disjoint: NO\n");
  say("  read, build and verify {:.2f} s\n", build_seconds);
  const bool certified = std::ranges::all_of(files, [](const File& file) { return file.verdict.certified; });
  const bool as_asked = std::ranges::all_of(files, &File::is_as_asked);
  return !certified || (options.strict && !as_asked) ? kAnswerIsNo : kDone;
}

}  // namespace

void add_cage(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<CageRunOptions>(
      app, run, "cage",
      "Builds a cage of a mesh: an outer hull, and with --inner an inner hull, that keep a gap from the mesh. No face "
      "of one touches a face of another, which is decided exactly. So the space between them can be filled with "
      "tetrahedra, and every point of the mesh has coordinates in the outer hull.",
      run_cage);
  CageOptions& cage = options.cage;
  add_mesh_input(command, options.in, options.input, "Mesh to build a cage of.");
  add_mesh_output_options(command, options.out, options.out_format, "the outer hull");
  CLI::Option* const inner =
      add_value(command, "--inner", options.inner, "FILE", "Also build an inner hull, and write it to this file.");
  add_certificate_option(command, options.certificate,
                         "the outer hull (with --inner, of both: {side} in the name becomes outer and inner)");
  add_number(command, "--faces", cage.outer_faces, {4, 1e9}, "Number of faces that a hull should have, at least 4.");
  add_optional_number(command, "--inner-faces", cage.inner_faces, {4, 1e9},
                      "Number of faces that the inner hull should have, if it is not that of --faces.")
      ->needs(inner);
  add_length(command, "--gap", options.gap,
             "Distance that both hulls keep from the mesh, at least. Without this option it is 0.1%. The inner hull "
             "keeps less where none that keeps it is found, as in a thin mesh.");
  command.add_flag(
      "--even", cage.even,
      "Make all triangles of the hulls well shaped, as simulation needs them: split, flip and collapse edges, and move "
      "vertices. The hulls then have more void, and take several times as long: up to four hulls of each side are "
      "tried, all of them where the number of faces is small.");
  command.add_flag("--tight", cage.tight,
                   "Start from hulls of least void, as `prohull build --tight` makes them, which takes longer.");
  add_threads_option(command, cage.threads, "The cage is the same for any number.");
  command.add_flag("--strict", options.strict,
                   "Exit with code 1 if a number of faces or the gap is not reached, or if a hull intersects itself.");
  add_report_option(command, options.report);
  add_examples(command, {"prohull cage horse.ply -o cage.obj",
                         "prohull cage horse.ply --faces 600 -o outer.obj --inner inner.obj --inner-faces 300",
                         "prohull cage organ.stl --unit mm --gap 2mm --even -o outer.ply --report cage.json"});
}

}  // namespace prohull::cli
